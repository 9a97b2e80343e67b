#include "analyses/motions.h"

#include "analyses/rotating_spectrum.h"
#include "analyses/zero_modes.h"
#include "assembly/system.h"
#include "linalg/check.h"
#include "linalg/quadratic_eigen.h"
#include "model/errors.h"

#include <Eigen/LU>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::analyses {

namespace {

using linalg::ComplexPair;
using linalg::Matrix;

/// Combination resonances up to a spin speed involve motions of at most that modulus in rotating
/// axes, and internal damping drives those below it in fixed ones.
constexpr double radius_over_speed = 1.05;

/// How far a real part can be from the truth: rounding of the matrix entries as the eigenvalue
/// feels it (much where two eigenvalues meet, known to the root of the rounding) with an allowance
/// for what the solver adds, and a share of speed and modulus that is always there.
constexpr double allowance = 100;
constexpr double always = 1e-11;

/// Bearings can feed energy into any motion, not only slow ones: cross-coupled stiffness that is
/// not symmetric, or damping that is negative in some direction.
bool bearings_drive(const model::Rotor &rotor) {
    for (const model::Bearing &bearing : rotor.bearings)
        for (const model::BearingCoefficients &at : bearing.rows) {
            const Eigen::Matrix2d c = at.c + at.c.transpose();
            if (at.k(0, 1) != at.k(1, 0) || c.trace() < 0 || c.determinant() < 0)
                return true;
        }
    return false;
}

Eigen::VectorXd root_of_diagonal(const Matrix &matrix) {
    return Eigen::SparseMatrix<double>(matrix.view()).diagonal().cwiseAbs().cwiseSqrt();
}

} // namespace

struct MotionSolver::Data {
    assembly::Discretization d;
    Form form;
    bool tables;
    std::vector<elements::BalancerElement> balancers;
    int harmonics;
    int fewest; ///< motions looked at, however fast they are
    std::unique_ptr<RotatingSpectrum> rotating;
    assembly::FixedSystem fixed;
    Eigen::VectorXd root_K, root_M; ///< weights of displacements and velocities

    Data(const model::Rotor &rotor, Form which, int order, const Arrangement &arrangement, int N)
        : d(rotor, order), form(which), tables(rotor.bearings_depend_on_speed()),
          balancers(balancer_elements(rotor, arrangement)), harmonics(form == Form::hill ? N : 0),
          fewest(form != Form::hill && bearings_drive(rotor) ? least_driven : least) {
        if (in_rotating_axes(form)) {
            rotating = std::make_unique<RotatingSpectrum>(d, 0, balancers, harmonics);
            root_K = root_of_diagonal(rotating->system().K);
            root_M = root_of_diagonal(rotating->system().M);
        } else {
            fixed = assembly::assemble_fixed(d, 0);
            root_K = root_of_diagonal(fixed.K);
            root_M = root_of_diagonal(fixed.M);
        }
    }

    [[nodiscard]] std::vector<ComplexPair> turning_pairs(double speed) const {
        if (tables)
            return pairs_of(RotatingSpectrum(d, speed, balancers, harmonics), speed);
        return pairs_of(*rotating, speed);
    }

    /// With Hill's series at all places 2 i speed apart: at one of them resonant motions meet.
    [[nodiscard]] std::vector<ComplexPair> pairs_of(const RotatingSpectrum &spectrum,
                                                    double speed) const {
        return harmonics > 0 ? spectrum.copies(speed, radius(speed), fewest).pairs
                             : spectrum.eigenvalues(speed, radius(speed), fewest).pairs;
    }

    [[nodiscard]] static double radius(double speed) { return radius_over_speed * std::abs(speed); }

    /// Without the zeros of free rigid motions, which rounding blurs.
    [[nodiscard]] std::vector<ComplexPair> fixed_pairs(double speed) const {
        const assembly::FixedSystem now =
            tables ? assembly::assemble_fixed(d, speed) : assembly::FixedSystem{};
        const assembly::FixedSystem &s = tables ? now : fixed;
        const Matrix D = Matrix::sum(1, s.C, speed, s.G);
        const Matrix K = Matrix::sum(1, s.K, speed, s.Kc);
        const int zeros = zero_modes(d, Form::general, speed, speed).eigenvalues;
        linalg::QuadraticOptions options;
        options.zeros = zeros;
        options.shift = zeros > 0 ? 0.3 * elastic_scale(d) : 0;
        const double reach = radius(speed) + options.shift;
        for (int wanted = fewest + zeros;; wanted += wanted / 2) {
            options.wanted = std::min(wanted, s.M.size());
            const linalg::QuadraticResult found = linalg::solve_quadratic(s.M, D, K, options);
            if (found.complete_radius < reach && options.wanted < s.M.size())
                continue;
            std::vector<ComplexPair> pairs = found.pairs;
            std::sort(pairs.begin(), pairs.end(), [](const auto &a, const auto &b) {
                return std::abs(a.value) < std::abs(b.value);
            });
            for (int skip = zeros; skip > 0 && !pairs.empty(); pairs.erase(pairs.begin()))
                skip -= pairs.front().value.imag() != 0 ? 2 : 1;
            return pairs;
        }
    }

    [[nodiscard]] Motion motion_of(const ComplexPair &pair, double speed) const {
        Motion motion;
        motion.value = pair.value;
        const double size = std::abs(pair.value);
        motion.noise = (allowance * pair.rounding + 10 * pair.residual) * size +
                       always * std::max(size, std::abs(speed));
        // Every term of a Hill series with its own frequency.
        const Eigen::Index n = root_K.size();
        motion.state.resize(2 * pair.vector.size());
        for (Eigen::Index term = 0; term * n < pair.vector.size(); ++term) {
            const Eigen::Index harmonic = (term + 1) / 2;
            const double frequency = 2 * static_cast<double>(harmonic) * speed;
            const std::complex<double> rate =
                term == 0 ? pair.value : std::complex<double>(std::hypot(size, frequency));
            for (Eigen::Index i = 0; i < n; ++i) {
                const std::complex<double> x = pair.vector(term * n + i);
                motion.state(2 * term * n + i) = root_K(i) * x;
                motion.state((2 * term + 1) * n + i) = rate * root_M(i) * x;
            }
        }
        motion.state.normalize();
        motion.may_meet = !rotating || size <= radius(speed);
        return motion;
    }
};

MotionSolver::MotionSolver(const model::Rotor &rotor, Form form, int order,
                           const Arrangement &arrangement, int harmonics)
    : _data(std::make_unique<Data>(rotor, form, order, arrangement, harmonics)) {}

MotionSolver::~MotionSolver() = default;

std::vector<Motion> MotionSolver::at(double speed) const {
    try {
        const std::vector<ComplexPair> pairs =
            _data->rotating ? _data->turning_pairs(speed) : _data->fixed_pairs(speed);
        std::vector<Motion> motions;
        for (const ComplexPair &pair : pairs) {
            motions.push_back(_data->motion_of(pair, speed));
            if (pair.value.imag() == 0)
                continue;
            Motion conjugate = motions.back();
            conjugate.value = std::conj(conjugate.value);
            conjugate.state = conjugate.state.conjugate().eval();
            motions.push_back(std::move(conjugate));
        }
        return motions;
    } catch (const linalg::SolverError &) {
        throw model::AnalysisFailure(fmt::format(
            "the eigenvalues at {:.6g} rad/s could not be found: the eigensolver did not converge "
            "({} unknowns, {} form)",
            speed, unknowns(), form_name(_data->form)));
    }
}

int MotionSolver::unknowns() const {
    return static_cast<int>(_data->root_M.size()) * (2 * _data->harmonics + 1);
}

const assembly::Discretization &MotionSolver::discretization() const { return _data->d; }

double growth_of(const std::vector<Motion> &motions) {
    double growth = -std::numeric_limits<double>::infinity();
    for (const Motion &motion : motions) { // a blurred zero must not hide one that grows
        const double real = motion.value.real();
        growth = std::max(growth, std::abs(real) <= motion.noise ? 0 : real);
    }
    return growth;
}

} // namespace whirl::analyses

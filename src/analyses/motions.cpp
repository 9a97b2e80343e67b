#include "analyses/motions.h"

#include "analyses/hill_motions.h"
#include "analyses/rotating_spectrum.h"
#include "analyses/zero_modes.h"
#include "assembly/hill_system.h"
#include "assembly/system.h"
#include "linalg/check.h"
#include "linalg/quadratic_eigen.h"
#include "linalg/rayleigh.h"
#include "model/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

namespace whirl::analyses {

namespace {

using linalg::ComplexPair;
using linalg::Matrix;
using linalg::RayleighFunctional;
using Complex = std::complex<double>;

/// Combination resonances up to a spin speed involve motions of at most that modulus in rotating
/// axes, and internal damping drives those below it in fixed ones.
constexpr double radius_over_speed = 1.05;

/// How far a real part as the eigensolver gives it can be from the truth: rounding of the matrix
/// entries as the eigenvalue feels it (much where two eigenvalues meet, known to the root of the
/// rounding) with an allowance for what the solver adds, and a share of speed and modulus that is
/// always there. A bound that grows with the mesh: what lies within it is looked at again.
constexpr double allowance = 100;
constexpr double always = 1e-11;

/// Bearings can feed energy into any motion, not only slow ones: cross-coupled stiffness that is
/// not symmetric, or damping that is negative in some direction.
bool bearings_drive(const model::Rotor &rotor) {
    for (const model::Bearing &bearing : rotor.bearings)
        for (const model::BearingCoefficients &at : bearing.rows) {
            const Eigen::Matrix2d c = at.c + at.c.transpose();
            const double determinant = c(0, 0) * c(1, 1) - c(0, 1) * c(1, 0);
            if (at.k(0, 1) != at.k(1, 0) || c.trace() < 0 || determinant < 0)
                return true;
        }
    return false;
}

Eigen::VectorXd root_of_diagonal(const Matrix &matrix) {
    return Eigen::SparseMatrix<double>(matrix.view()).diagonal().cwiseAbs().cwiseSqrt();
}

/// What the residual of a pair leaves possible in its vector of those of its neighbours.
std::vector<RayleighFunctional::Admixture> admixtures(const std::vector<ComplexPair> &pairs,
                                                      std::size_t index, double residual) {
    const Complex own = pairs[index].value;
    std::vector<RayleighFunctional::Admixture> out;
    const auto add = [&](Complex value, const Eigen::VectorXcd &vector) {
        const double distance = std::abs(own - value);
        constexpr double near = 0.3; // of the modulus; farther ones are as the rest
        if (distance < near * std::abs(own))
            out.push_back({std::min(1.0, residual * std::abs(own) / distance), vector});
    };
    for (std::size_t j = 0; j < pairs.size(); ++j) {
        if (j != index)
            add(pairs[j].value, pairs[j].vector);
        if (pairs[j].value.imag() != 0)
            add(std::conj(pairs[j].value), pairs[j].vector.conjugate());
    }
    return out;
}

/// Of copies next to +-i speed, which are one motion, one is kept.
void drop_copies(std::vector<Motion> &motions, double speed) {
    const double width = 2 * std::abs(speed);
    const auto same = [width](const Motion &a, const Motion &b) {
        const Complex d = a.value - b.value;
        return std::abs(Complex(d.real(), std::remainder(d.imag(), width))) < 1e-6 * width &&
               std::abs(a.state.dot(b.state)) > 1 - 1e-6;
    };
    std::vector<Motion> kept;
    for (Motion &motion : motions) {
        const bool border = std::abs(motion.value.imag()) > 0.45 * width;
        if (!border || std::none_of(kept.begin(), kept.end(),
                                    [&](const Motion &other) { return same(motion, other); }))
            kept.push_back(std::move(motion));
    }
    motions = std::move(kept);
}

} // namespace

struct MotionSolver::Data {
    assembly::Discretization d;
    Form form;
    bool tables;
    std::vector<elements::BalancerElement> balancers;
    int fewest; ///< motions looked at, however fast they are
    std::unique_ptr<RotatingSpectrum> rotating;
    std::unique_ptr<HillMotions> hill;
    assembly::FixedSystem fixed;
    Eigen::VectorXd root_K, root_M; ///< weights of displacements and velocities

    Data(const model::Rotor &rotor, Form which, int order, const Arrangement &arrangement, int N)
        : d(rotor, order), form(which), tables(rotor.bearings_depend_on_speed()),
          balancers(balancer_elements(rotor, arrangement)),
          fewest(bearings_drive(rotor) ? least_driven : least) {
        if (in_rotating_axes(form)) {
            rotating = std::make_unique<RotatingSpectrum>(d, 0, balancers, 0);
            root_K = root_of_diagonal(rotating->system().K);
            root_M = root_of_diagonal(rotating->system().M);
            if (form == Form::hill)
                hill = std::make_unique<HillMotions>(d, balancers, bearings_drive(rotor), N);
        } else {
            fixed = assembly::assemble_fixed(d, 0);
            root_K = root_of_diagonal(fixed.K);
            root_M = root_of_diagonal(fixed.M);
        }
    }

    /// Pairs, and the problem that they solve where one needs to look at it again.
    struct Solved {
        std::vector<ComplexPair> pairs;
        std::function<RayleighFunctional()> functional;
    };

    using Sparse = RayleighFunctional::Sparse;

    [[nodiscard]] RayleighFunctional::Structure structure(Eigen::Index unknowns) const {
        return {static_cast<int>(unknowns), 2 * d.planar_size()};
    }

    [[nodiscard]] Solved turning(double speed) const {
        if (hill)
            return turning_hill(speed);
        const auto spectrum =
            tables ? std::make_shared<RotatingSpectrum>(d, speed, balancers, 0)
                   : std::shared_ptr<RotatingSpectrum>(rotating.get(), [](auto *) {});
        return {spectrum->eigenvalues(speed, radius(speed), fewest).pairs, [this, spectrum, speed] {
                    const assembly::RotatingSystem &s = spectrum->system();
                    return RayleighFunctional(Sparse(s.M.view()), Sparse(s.damping(speed).view()),
                                              Sparse(s.stiffness(speed).view()),
                                              structure(s.M.size()));
                }};
    }

    [[nodiscard]] Solved turning_hill(double speed) const {
        HillMotions::Found found = hill->at(speed);
        if (speed == 0)
            return {std::move(found.pairs), nullptr};
        return {std::move(found.pairs), [this, speed, N = found.harmonics] {
                    const assembly::RotatingSystem &s = hill->spectrum(speed, N).system();
                    const assembly::SystemAtSpeed big = assembly::hill_system(
                        s, assembly::turning_supports(d, tables ? speed : 0, s.M.size()), speed, N);
                    // Half the rows of the harmonics: what couples them to the constant term, once
                    // with 1 and once with 1/2, becomes symmetric.
                    Eigen::VectorXd half = Eigen::VectorXd::Constant(big.M.size(), 0.5);
                    half.head(s.M.size()).setOnes();
                    const auto weighted = [&half](const Matrix &A) {
                        return Sparse(half.asDiagonal() * Sparse(A.view()));
                    };
                    return RayleighFunctional(weighted(big.M), weighted(big.D), weighted(big.K),
                                              structure(s.M.size()));
                }};
    }

    [[nodiscard]] static double radius(double speed) { return radius_over_speed * std::abs(speed); }

    /// Without the zeros of free rigid motions, which rounding blurs.
    [[nodiscard]] Solved still(double speed) const {
        const assembly::FixedSystem now =
            tables ? assembly::assemble_fixed(d, speed) : assembly::FixedSystem{};
        const assembly::FixedSystem &s = tables ? now : fixed;
        const Matrix D = Matrix::sum(1, s.C, speed, s.G);
        const Matrix K = Matrix::sum(1, s.K, speed, s.Kc);
        const RayleighFunctional::Structure known = structure(s.M.size());
        const auto functional = [M = Sparse(s.M.view()), D = Sparse(D.view()), K = Sparse(K.view()),
                                 known] { return RayleighFunctional(M, D, K, known); };
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
            return {std::move(pairs), functional};
        }
    }

    /// Displacements and velocities at the time zero, the same for every copy in Hill's series.
    [[nodiscard]] Eigen::VectorXcd state_of(const ComplexPair &pair, double speed) const {
        const Eigen::Index n = root_K.size();
        Eigen::VectorXcd place = pair.vector.head(n);
        Eigen::VectorXcd rate = pair.value * place;
        for (Eigen::Index k = 1; (2 * k + 1) * n <= pair.vector.size(); ++k) {
            const auto cosine = pair.vector.segment((2 * k - 1) * n, n);
            const auto sine = pair.vector.segment(2 * k * n, n);
            place += cosine;
            rate += pair.value * cosine + 2 * static_cast<double>(k) * speed * sine;
        }
        Eigen::VectorXcd state(2 * n);
        state << root_K.cwiseProduct(place), root_M.cwiseProduct(rate);
        return state.normalized();
    }

    [[nodiscard]] Motion motion_of(const ComplexPair &pair, double speed) const {
        Motion motion;
        motion.value = pair.value;
        const double size = std::abs(pair.value);
        motion.noise = (allowance * pair.rounding + 10 * pair.residual) * size +
                       always * std::max(size, std::abs(speed));
        motion.state = state_of(pair, speed);
        motion.may_meet = !rotating || hill || size <= radius(speed);
        motion.repeats = hill ? 2 * std::abs(speed) : 0;
        return motion;
    }

    /// Real parts that the eigensolver cannot tell from zero, from the forms that they consist of.
    void look_again(const Solved &solved, std::size_t index,
                    std::optional<RayleighFunctional> &functional, Motion &motion) const {
        const ComplexPair &pair = solved.pairs[index];
        if (std::abs(pair.value.real()) > 3 * motion.noise || pair.value == 0.0 ||
            !solved.functional)
            return;
        if (!functional)
            functional.emplace(solved.functional());
        const double residual = 10 * pair.residual + 1e-14;
        const RayleighFunctional::Root root =
            functional->root(pair, residual, admixtures(solved.pairs, index, residual));
        if (root.noise < motion.noise && std::abs(root.value - pair.value) <= 10 * motion.noise) {
            motion.value = root.value;
            motion.noise = root.noise;
        }
    }

    [[nodiscard]] std::vector<Motion> motions(double speed) const {
        const Solved solved = rotating ? turning(speed) : still(speed);
        std::optional<RayleighFunctional> functional;
        std::vector<Motion> motions;
        for (std::size_t i = 0; i < solved.pairs.size(); ++i) {
            motions.push_back(motion_of(solved.pairs[i], speed));
            look_again(solved, i, functional, motions.back());
            if (solved.pairs[i].value.imag() == 0)
                continue;
            Motion conjugate = motions.back();
            conjugate.value = std::conj(conjugate.value);
            conjugate.state = conjugate.state.conjugate().eval();
            motions.push_back(std::move(conjugate));
        }
        if (hill && speed != 0)
            drop_copies(motions, speed);
        return motions;
    }
};

MotionSolver::MotionSolver(const model::Rotor &rotor, Form form, int order,
                           const Arrangement &arrangement, int harmonics)
    : _data(std::make_unique<Data>(rotor, form, order, arrangement, harmonics)) {}

MotionSolver::~MotionSolver() = default;

std::vector<Motion> MotionSolver::at(double speed) const {
    try {
        return _data->motions(speed);
    } catch (const linalg::SolverError &) {
        throw model::AnalysisFailure(fmt::format(
            "the eigenvalues at {:.6g} rad/s could not be found: the eigensolver did not converge "
            "({} unknowns, {} form)",
            speed, unknowns(), form_name(_data->form)));
    }
}

int MotionSolver::unknowns() const {
    return static_cast<int>(_data->root_M.size()) *
           (_data->hill ? 2 * _data->hill->harmonics() + 1 : 1);
}

int MotionSolver::harmonics() const { return _data->hill ? _data->hill->harmonics() : 0; }

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

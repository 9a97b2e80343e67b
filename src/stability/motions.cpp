#include "stability/motions.h"

#include "assembly/frequency_scales.h"
#include "assembly/system.h"
#include "linalg/check.h"
#include "linalg/quadratic/quadratic_eigen.h"
#include "model/errors.h"
#include "modes/rotating_spectrum.h"
#include "modes/zero_modes.h"
#include "reduction/projection.h"
#include "results/formulation.h"
#include "stability/hill/hill_motions.h"
#include "stability/periodic_motions.h"
#include "stability/rayleigh.h"
#include "stability/rotor_at_speeds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

namespace whirl::stability {

namespace {

using linalg::ComplexPair;
using linalg::Matrix;
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

/// Motions looked at where bearings can drive fast ones too (cross coupling, negative damping).
constexpr int fewest_driven = 24;

/// Bearings can feed energy into any motion, not only slow ones: cross-coupled stiffness that is
/// not symmetric, or damping that is negative in some direction.
bool bearings_drive(const model::Rotor &rotor) {
    // So can a torque that has no potential.
    return rotor.shaft.axial_torque != 0 || !rotor.every_row([](const auto &at) {
        return model::symmetric(at.k) && !model::pushes_away(at.c);
    });
}

Eigen::VectorXd root_of_diagonal(const Matrix &matrix) {
    return Eigen::SparseMatrix<double>(matrix.view()).diagonal().cwiseAbs().cwiseSqrt();
}

/// How much of its neighbours' vectors the vector of a pair may contain, by its residual.
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

/// Of aliases next to +-i speed, which are one motion, one is kept.
void drop_sidebands(std::vector<Motion> &motions, double speed) {
    const double width = 2 * std::abs(speed);
    const auto same = [width](const Motion &a, const Motion &b) {
        return alias_distance(a.value, b.value, width) < 1e-6 * width &&
               std::abs(a.state.dot(b.state)) > 1 - 1e-6;
    };
    std::vector<Motion> kept;
    for (Motion &motion : motions) {
        const bool border = std::abs(motion.value.imag()) > 0.45 * width;
        if (!border ||
            std::ranges::none_of(kept, [&](const Motion &other) { return same(motion, other); }))
            kept.push_back(std::move(motion));
    }
    motions = std::move(kept);
}

/// The result of `find`; its failure as one that users read.
template <class Find>
auto found_or_said(double speed, int unknowns, results::Form form, const Find &find) {
    try {
        return find();
    } catch (const linalg::SolverError &) {
        throw model::AnalysisFailure(
            model::Sentence("the eigenvalues at {} could not be found: the eigensolver did "
                            "not converge ({} unknowns, {} form)",
                            model::as::speed(speed), unknowns, results::form_name(form)));
    }
}

} // namespace

int fewest_motions(const model::Rotor &rotor) { return bearings_drive(rotor) ? fewest_driven : 8; }

double growth_reach(const model::Rotor &rotor, results::Form form, double speed) {
    constexpr double without_end = std::numeric_limits<double>::infinity();
    const auto quotient = [](const Eigen::Matrix2d &k, const Eigen::Matrix2d &c) {
        if (model::pushes_away(c))
            return without_end;
        if (model::symmetric(k))
            return 0.0;
        const Eigen::Matrix2d damping = (c + c.transpose()) / 2;
        const double skew = std::abs(k(0, 1) - k(1, 0)) / 2;
        return skew / std::sqrt(std::max(
                          damping(0, 0) * damping(1, 1) - damping(0, 1) * damping(1, 0), 0.0));
    };
    if (!rotor.shaft.torque_has_potential())
        return without_end;
    double of_bearings = 0;
    for (const model::Bearing &bearing : rotor.bearings)
        for (const model::BearingCoefficients &at : bearing.rows) {
            if (!model::symmetric(at.m))
                return without_end;
            of_bearings = std::max({of_bearings, quotient(at.k, at.c), quotient(at.kt, at.ct)});
        }
    if (results::in_rotating_axes(form))
        return speed + of_bearings;
    return rotor.shaft.internal_damping != 0 ? std::max(speed, of_bearings) : of_bearings;
}

struct MotionSolver::Data {
    assembly::Discretization d;
    std::shared_ptr<const Eigen::MatrixXd> shapes; ///< none: the whole rotor
    results::Form form;
    bool tables;
    std::vector<balancers::BalancerElement> balancers;
    int fewest; ///< motions looked at, however fast they are
    std::shared_ptr<const modes::RotatingSpectrum> rotating;
    std::unique_ptr<HillMotions> hill;
    std::unique_ptr<PeriodicMotions> periodic; ///< instead of the series
    assembly::FixedSystem fixed;
    Eigen::VectorXd root_K, root_M; ///< weights of displacements and velocities

    Data(const StabilityModel &model, const balancers::Arrangement &arrangement,
         std::shared_ptr<const Eigen::MatrixXd> reduced_to)
        : d(model.rotor, model.order), shapes(std::move(reduced_to)), form(model.form),
          tables(model.rotor.bearings_depend_on_speed()),
          balancers(balancers::balancer_elements(model.rotor, arrangement)),
          fewest(fewest_motions(model.rotor)) {
        if (results::in_rotating_axes(form)) {
            rotating = std::make_shared<modes::RotatingSpectrum>(d, 0, balancers, 0, shapes.get());
            root_K = root_of_diagonal(rotating->system().K);
            root_M = root_of_diagonal(rotating->system().M);
            if (form == results::Form::hill && model.harmonics == 0)
                periodic = std::make_unique<PeriodicMotions>(
                    d, balancers, bearings_drive(model.rotor), model.top, shapes, model.experience);
            else if (form == results::Form::hill)
                hill = std::make_unique<HillMotions>(d, balancers, fewest, model.harmonics);
        } else {
            fixed = fixed_at(0);
            root_K = root_of_diagonal(fixed.K);
            root_M = root_of_diagonal(fixed.M);
        }
    }

    [[nodiscard]] assembly::FixedSystem fixed_at(double speed) const {
        assembly::FixedSystem system = assembly::assemble_fixed(d, speed);
        return shapes ? reduction::Projection(*shapes).of(system) : std::move(system);
    }

    [[nodiscard]] int planar_size() const {
        return shapes ? static_cast<int>(shapes->cols()) : d.planar_size();
    }

    /// Pairs, with the problem where real parts must be computed once more.
    struct Solved {
        std::vector<ComplexPair> pairs;
        std::function<RayleighFunctional()> functional;
    };

    using Sparse = RayleighFunctional::Sparse;

    [[nodiscard]] RayleighFunctional::Structure structure(Eigen::Index unknowns) const {
        return {static_cast<int>(unknowns), 2 * planar_size()};
    }

    [[nodiscard]] Solved turning(double speed) const {
        if (hill)
            return rotating_hill(speed);
        const auto spectrum = tables ? std::make_shared<const modes::RotatingSpectrum>(
                                           d, speed, balancers, 0, shapes.get())
                                     : rotating;
        return {spectrum->eigenvalues(speed, radius(speed), fewest).pairs, [this, spectrum, speed] {
                    const assembly::RotatingSystem &s = spectrum->system();
                    return RayleighFunctional(Sparse(s.M.view()), Sparse(s.damping(speed).view()),
                                              Sparse(s.stiffness(speed).view()),
                                              structure(s.M.size()));
                }};
    }

    [[nodiscard]] Solved rotating_hill(double speed) const {
        HillMotions::Found found = hill->at(speed);
        if (speed == 0)
            return {std::move(found.pairs), nullptr};
        return {std::move(found.pairs), [this, speed, N = found.harmonics] {
                    const assembly::RotatingSystem &s = hill->spectrum(speed, N).system();
                    const assembly::SystemAtSpeed big = hill->spectrum(speed, N).hill_system(speed);
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
        const assembly::FixedSystem now = tables ? fixed_at(speed) : assembly::FixedSystem{};
        const assembly::FixedSystem &s = tables ? now : fixed;
        const Matrix D = Matrix::sum(1, s.C, speed, s.G);
        const Matrix K = Matrix::sum(1, s.K, speed, s.Kc);
        const RayleighFunctional::Structure known = structure(s.M.size());
        const auto functional = [M = Sparse(s.M.view()), D = Sparse(D.view()), K = Sparse(K.view()),
                                 known] { return RayleighFunctional(M, D, K, known); };
        const int zeros = modes::zero_modes(d, results::Form::general, speed, speed).eigenvalues;
        linalg::QuadraticOptions options;
        options.zeros = zeros;
        options.fewest = 1; // enough where they are all up to the reach
        if (shapes)
            options.method = linalg::QuadraticMethod::dense;
        options.shift = zeros > 0 ? 0.3 * assembly::elastic_scale(d) : 0;
        const double reach = radius(speed) + options.shift;
        for (int wanted = fewest + zeros;; wanted += wanted / 2) {
            options.wanted = std::min(wanted, s.M.size());
            const linalg::QuadraticResult found = linalg::solve_quadratic(s.M, D, K, options);
            const bool all = found.method == linalg::QuadraticMethod::dense;
            if (found.complete_radius < reach && !all && options.wanted < s.M.size())
                continue;
            if (found.complete_radius < reach)
                throw linalg::SolverError("the eigenvalues differ by too many orders of magnitude");
            std::vector<ComplexPair> pairs = found.pairs;
            std::ranges::sort(pairs, {}, [](const auto &a) { return std::abs(a.value); });
            for (int skip = zeros; skip > 0 && !pairs.empty(); pairs.erase(pairs.begin()))
                skip -= pairs.front().value.imag() != 0 ? 2 : 1;
            return {std::move(pairs), functional};
        }
    }

    /// Displacements and velocities at the time zero, the same for every alias in Hill's series.
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
        // Balls have no stiffness but that of the spin.
        const Eigen::VectorXd weight = root_K.cwiseMax(std::abs(speed) * root_M);
        Eigen::VectorXcd state(2 * n);
        state << weight.cwiseProduct(place), root_M.cwiseProduct(rate);
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

    /// Real parts that the eigensolver cannot distinguish from zero, from the forms that they
    /// consist of.
    void solve_again(const Solved &solved, std::size_t index,
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

    [[nodiscard]] Solved solved(double speed) const {
        return rotating ? turning(speed) : still(speed);
    }

    /// Of all that were found those that are slow enough to matter at this speed, and the fast ones
    /// that grow; as `fewest` wants it.
    [[nodiscard]] bool matters(const Motion &motion, std::size_t rank, double speed) const {
        constexpr double border = 1.2; // where motions come and go
        return rank < static_cast<std::size_t>(fewest) ||
               std::abs(motion.value) <= border * radius(speed) || motion.grows();
    }

    [[nodiscard]] Solved those_that_matter(double speed) const {
        Solved all = solved(speed);
        std::ranges::stable_sort(all.pairs, {}, [](const auto &a) { return std::abs(a.value); });
        Solved kept{{}, all.functional};
        for (std::size_t i = 0; i < all.pairs.size(); ++i)
            if (matters(motion_of(all.pairs[i], speed), i, speed))
                kept.pairs.push_back(std::move(all.pairs[i]));
        return kept;
    }

    [[nodiscard]] std::vector<Motion> motions(double speed) const {
        if (periodic)
            return periodic->at(speed);
        const Solved solved = those_that_matter(speed);
        std::optional<RayleighFunctional> functional;
        std::vector<Motion> motions;
        for (std::size_t i = 0; i < solved.pairs.size(); ++i) {
            Motion motion = motion_of(solved.pairs[i], speed);
            solve_again(solved, i, functional, motion);
            motions.push_back(motion);
            if (motion.value.imag() == 0)
                continue;
            motion.value = std::conj(motion.value);
            motion.state = motion.state.conjugate().eval();
            motions.push_back(std::move(motion));
        }
        if (hill && speed != 0)
            drop_sidebands(motions, speed);
        return motions;
    }
};

MotionSolver::MotionSolver(const StabilityModel &model, const balancers::Arrangement &arrangement,
                           std::shared_ptr<const Eigen::MatrixXd> shapes)
    : _data(std::make_unique<Data>(model, arrangement, std::move(shapes))) {}

MotionSolver::~MotionSolver() = default;

std::vector<Motion> MotionSolver::at(double speed) const {
    return found_or_said(speed, unknowns(), _data->form, [&] { return _data->motions(speed); });
}

const PeriodicMotions *MotionSolver::by_monodromy() const { return _data->periodic.get(); }

int MotionSolver::unknowns() const {
    return static_cast<int>(_data->root_M.size()) *
           (_data->hill ? 2 * _data->hill->harmonics() + 1 : 1);
}

int MotionSolver::harmonics() const { return _data->hill ? _data->hill->harmonics() : 0; }

const assembly::Discretization &MotionSolver::discretization() const { return _data->d; }

std::complex<double> nearest_alias(std::complex<double> other, const Motion &motion) {
    if (motion.repeats == 0)
        return motion.value;
    const double off = motion.value.imag() - other.imag();
    return {motion.value.real(), other.imag() + std::remainder(off, motion.repeats)};
}

double alias_distance(std::complex<double> a, std::complex<double> b, double repeats) {
    const Complex off = a - b;
    return std::abs(
        Complex(off.real(), repeats != 0 ? std::remainder(off.imag(), repeats) : off.imag()));
}

const Motion &fastest_growing(const std::vector<Motion> &motions) {
    return *std::ranges::max_element(motions, {},
                                     [](const Motion &motion) { return motion.value.real(); });
}

double growth_of(const std::vector<Motion> &motions) {
    double growth = -std::numeric_limits<double>::infinity();
    for (const Motion &motion : motions) { // a blurred zero must not hide one that grows
        growth = std::max(growth, motion.neutral() ? 0 : motion.value.real());
    }
    return growth;
}

} // namespace whirl::stability

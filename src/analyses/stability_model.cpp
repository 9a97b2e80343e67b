#include "analyses/stability_model.h"

#include "analyses/discretization_error.h"
#include "analyses/zero_modes.h"
#include "assembly/rotating_system.h"
#include "linalg/check.h"
#include "linalg/quadratic_eigen.h"
#include "model/errors.h"

#include <Eigen/SparseCholesky>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::analyses {

namespace {

/// An undamped rotor with positive definite K has a positive energy that is conserved.
bool stiffness_positive(const model::Rotor &rotor, int order) {
    const assembly::Discretization d(rotor, order);
    const assembly::FixedSystem system = assembly::assemble_fixed(d, 0);
    const Eigen::SparseMatrix<double> K = system.K.view();
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(K);
    return factors.info() == Eigen::Success && factors.vectorD().minCoeff() > 0;
}

/// Largest distance, over the speed, of the motions of lowest modulus to the nearest of the others.
double largest_change(const std::vector<Motion> &some, const std::vector<Motion> &others,
                      double speed) {
    double worst = 0;
    int looked_at = 0;
    for (const Motion &motion : some) {
        if (std::abs(motion.value) > speed)
            continue;
        ++looked_at;
        double nearest = std::numeric_limits<double>::infinity();
        for (const Motion &other : others)
            nearest = std::min(nearest, std::abs(other.value - motion.value));
        worst = std::max(worst, nearest / speed);
    }
    // Every motion has a copy below the speed, if the series reaches so far.
    return looked_at > 0 ? worst : 1;
}

constexpr int most_harmonics = 8;
constexpr double settled = 1e-8;

/// The fewest harmonics beyond which nothing below the spin speed changes, at three speeds of the
/// case.
int settled_harmonics(const model::Case &scene, int order, const Arrangement &arrangement) {
    // The slowest speed needs most of them.
    std::vector<double> probes;
    for (const double speed : scene.speeds->values())
        if (speed != 0)
            probes.push_back(std::abs(speed));
    std::sort(probes.begin(), probes.end());
    if (probes.size() > 3)
        probes = {probes.front(), probes[probes.size() / 2], probes.back()};
    double worst = 0;
    std::vector<std::vector<Motion>> last;
    for (int N = 1; N <= most_harmonics; ++N) {
        const MotionSolver solver(scene.rotor, Form::hill, order, arrangement, N);
        std::vector<std::vector<Motion>> now;
        worst = 0;
        for (std::size_t i = 0; i < probes.size(); ++i) {
            now.push_back(solver.at(probes[i]));
            worst =
                std::max(worst, last.empty() ? 1.0 : largest_change(last[i], now[i], probes[i]));
        }
        if (worst < settled)
            return N - 1;
        last = std::move(now);
    }
    throw model::AnalysisFailure(fmt::format(
        "the Hill series does not settle: with {} harmonics eigenvalues still change by {:.1e} of "
        "the spin speed; the range of speeds may start too low (harmonics lie 2 x speed apart), or "
        "the bearings differ too much between their directions",
        most_harmonics, worst));
}

} // namespace

StabilityModel stability_model(const model::Case &scene) {
    StabilityModel out;
    out.formulation = choose_formulation(scene);
    out.order = resolve_order(scene, out.formulation);
    const Form form = out.formulation.form;
    if (in_rotating_axes(form)) {
        out.form = form;
        if (form == Form::hill)
            out.harmonics =
                settled_harmonics(scene, out.order, arrangement_at_balance(scene.rotor));
    } else if (form != Form::general) {
        out.conservative = stiffness_positive(scene.rotor, out.order);
        if (!out.conservative)
            out.formulation = {Form::general,
                               "the stiffness is not positive definite: all eigenvalues are looked "
                               "at, whether or not they are frequencies"};
    }
    return out;
}

std::vector<double> search_speeds(const model::SpeedRange &range) {
    constexpr int fewest = 101;
    model::SpeedRange finer = range;
    if (range.count > 1)
        while (finer.count < fewest)
            finer.count = 2 * finer.count - 1; // halves every step: the given speeds stay
    return finer.values();
}

std::vector<StandingSpeed> standing_speeds(const assembly::Discretization &discretization,
                                           const Arrangement &arrangement, bool frozen,
                                           double top) {
    std::vector<StandingSpeed> out;
    if (top <= 0)
        return out;
    const assembly::RotatingSystem system = assembly::assemble_rotating(
        discretization, 0, balancer_elements(discretization.rotor(), arrangement), frozen);
    Eigen::SparseMatrix<double> K = system.K.view();
    Eigen::SparseMatrix<double> Kss = system.Kss.view();
    // Rows of balls have speed^2 as a factor: without it they have no root at zero.
    Eigen::VectorXd ball_rows = Eigen::VectorXd::Zero(K.rows());
    ball_rows.tail(K.rows() - 2 * discretization.planar_size()).setOnes();
    K += Eigen::SparseMatrix<double>(ball_rows.asDiagonal() * Kss);
    Kss = (Eigen::VectorXd::Ones(K.rows()) - ball_rows).asDiagonal() * Kss;
    const Eigen::SparseMatrix<double> Ks = system.Ks.view();
    linalg::QuadraticOptions options;
    options.shift = 0.41 * top;
    options.fewest = 1;
    const auto all = static_cast<int>(K.rows());
    constexpr int small = 150;
    if (all <= small) // with all finite roots, of which there may be few
        options.method = linalg::QuadraticMethod::dense;
    int tries = 0;
    for (int wanted = all <= small ? 1 : 8;; wanted *= 2) {
        options.wanted = std::min(wanted, all);
        linalg::QuadraticResult found;
        try {
            found = linalg::solve_quadratic(Kss, Ks, K, options);
        } catch (const linalg::SolverError &) {
            if (++tries == 4)
                throw;
            options.shift *= 0.63; // an unlucky neighbour of a root, or not resolved from there
            continue;
        }
        if (found.complete_radius < top && all > small && options.wanted < all)
            continue;
        for (const linalg::ComplexPair &pair : found.pairs) {
            const double speed = pair.value.real();
            const double across = std::abs(pair.value.imag());
            if (speed > 1e-6 * top && speed <= top && across < speed)
                out.push_back({speed, across <= 1e-7 * speed});
        }
        std::sort(out.begin(), out.end(),
                  [](const auto &a, const auto &b) { return a.speed < b.speed; });
        const auto same = [](const auto &a, const auto &b) {
            return b.speed - a.speed <= 1e-7 * b.speed;
        };
        out.erase(std::unique(out.begin(), out.end(), same), out.end());
        return out;
    }
}

} // namespace whirl::analyses

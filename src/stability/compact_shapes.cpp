#include "stability/compact_shapes.h"

#include "linalg/symmetric_eigen.h"
#include "reduction/planar_shapes.h"
#include "results/formulation.h"
#include "stability/hill_motions.h"
#include "stability/rotor_at_speeds.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace whirl::stability {

namespace {

using Pairs = std::vector<linalg::ComplexPair>;

/// Eigenvalues of the reduced rotor as far as the search needs them, over the spin speed.
constexpr double agreeing_eigenvalues = 1e-7;
/// Motions are taken at so many speeds of the range.
constexpr std::size_t samples_of_motions = 12;
/// Least part of a motion that a shape must describe: the errors of eigenvalues are the squares.
constexpr std::array least_parts{3e-4, 1e-4, 3e-5, 1e-5};
/// Part of the shapes above which nothing is gained.
constexpr double hardly_fewer = 0.85;

struct MotionsAtSpeed {
    double speed = 0;
    Pairs pairs;
};

std::vector<MotionsAtSpeed> sampled_motions(const MotionSolver &solver,
                                            const std::vector<double> &speeds) {
    std::vector<MotionsAtSpeed> out;
    const std::size_t last = speeds.size() - 1;
    for (std::size_t k = 0; k <= samples_of_motions; ++k) {
        const double speed = speeds[last * k / samples_of_motions];
        if (speed != 0 && (out.empty() || out.back().speed != speed))
            out.push_back({speed, solver.pairs(speed)});
    }
    return out;
}

/// Sum of x x^T over the planar shapes x of all motions, over the amplitudes of r shapes.
Eigen::MatrixXd energies(const std::vector<MotionsAtSpeed> &motions, Eigen::Index r,
                         Eigen::Index term) {
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(r, r);
    for (const MotionsAtSpeed &at : motions)
        for (const linalg::ComplexPair &pair : at.pairs) {
            const Eigen::MatrixXd parts = reduction::planar_parts(pair.vector, r, term);
            const double length = parts.colwise().norm().maxCoeff();
            if (length > 0)
                out += (parts / length) * (parts / length).transpose();
        }
    return out;
}

bool same_motions(const MotionSolver &solver, const std::vector<MotionsAtSpeed> &motions) {
    return std::all_of(motions.begin(), motions.end(), [&solver](const MotionsAtSpeed &at) {
        return missing(at.pairs, solver.pairs(at.speed), at.speed, 0).empty();
    });
}

} // namespace

std::vector<const linalg::ComplexPair *> missing(const Pairs &some, const Pairs &others,
                                                 double speed, double repeats) {
    std::vector<const linalg::ComplexPair *> out;
    for (const linalg::ComplexPair &pair : some) {
        const double allowed =
            agreeing_eigenvalues * std::max(std::abs(pair.value), std::abs(speed)) +
            100 * (pair.rounding + pair.residual) * std::abs(pair.value);
        if (std::none_of(others.begin(), others.end(), [&](const auto &other) {
                return apart(pair.value, other.value, repeats) <= allowed;
            }))
            out.push_back(&pair);
    }
    return out;
}

std::shared_ptr<const Eigen::MatrixXd>
compact_shapes(const StabilityModel &model, const balancers::Arrangement &arrangement,
               const std::shared_ptr<const Eigen::MatrixXd> &all, const MotionSolver &solver,
               const std::vector<double> &speeds) {
    const Eigen::Index r = all->cols();
    const std::vector<MotionsAtSpeed> motions = sampled_motions(solver, speeds);
    const auto principal =
        linalg::symmetric_eigenpairs(energies(motions, r, solver.term_unknowns()));
    const Eigen::VectorXd &energy = principal.eigenvalues(); // ascending
    Eigen::Index tried = 0;
    for (const double part : least_parts) {
        const Eigen::Index few = (energy.array() > part * part).count();
        if (few == tried || few == 0)
            continue;
        if (static_cast<double>(few) > hardly_fewer * static_cast<double>(r))
            break;
        tried = few;
        const auto shapes =
            std::make_shared<const Eigen::MatrixXd>(*all * principal.eigenvectors().rightCols(few));
        if (same_motions(MotionSolver(model, arrangement, shapes), motions))
            return shapes;
    }
    return all;
}

} // namespace whirl::stability

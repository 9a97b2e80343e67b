#include "closed_form/pendulum_branches.h"

#include "closed_form/pendulum_steady_equations.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>

namespace whirl::closed_form {

namespace {

/// Shaft deflection, in arm lengths, at which a branch counts as gone to infinity.
constexpr double furthest = 10.0;

/// One step of arclength continuation; unknowns (xi, eta, R). False where Newton's method fails.
bool continue_branch(const PendulumRotor &rotor, Eigen::Vector3d &at, Eigen::Vector3d &tangent,
                     double step) {
    Eigen::Vector3d next = at + step * tangent;
    for (int iteration = 0; iteration < 12; ++iteration) {
        const PendulumSteadyEquations equations(rotor, next[2]);
        // Derivative by R, by difference: only the direction of the branch depends on it.
        constexpr double delta = 1e-6;
        const Eigen::Vector2d ahead =
            PendulumSteadyEquations(rotor, next[2] + delta).residual(next.head<2>());
        const Eigen::Vector2d behind =
            PendulumSteadyEquations(rotor, next[2] - delta).residual(next.head<2>());
        Eigen::Matrix3d matrix;
        matrix.topLeftCorner<2, 2>() = equations.jacobian(next.head<2>());
        matrix.topRightCorner<2, 1>() = (ahead - behind) / (2.0 * delta);
        matrix.row(2) = tangent.transpose();
        const Eigen::PartialPivLU<Eigen::MatrixXd> lu(matrix);
        Eigen::Vector3d residual;
        residual << equations.residual(next.head<2>()), tangent.dot(next - at) - step;
        const Eigen::Vector3d correction = lu.solve(residual);
        next -= correction;
        if (!next.allFinite())
            return false;
        if (correction.norm() < 1e-11 * (1.0 + next.norm())) {
            tangent = lu.solve(Eigen::Vector3d::UnitZ()).normalized();
            at = next;
            return true;
        }
    }
    return false;
}

/// True where a step went over to another branch. Close branches point the same way, so the turn of
/// the tangent does not tell them apart, but they lie on different sides of the centre: the
/// position, never zero under an imbalance, would change by as much as itself.
bool changed_branch(const Eigen::Vector3d &at, const Eigen::Vector3d &tangent,
                    const Eigen::Vector3d &next, const Eigen::Vector3d &direction) {
    return direction.dot(tangent) < 0.95 ||
           (next - at).head<2>().norm() > 0.2 * at.head<2>().norm();
}

} // namespace

std::vector<BranchPoint> steady_branch(const PendulumRotor &rotor, const BranchPoint &start,
                                       double heading, double from, double to, int largest_points) {
    std::vector<BranchPoint> branch{start};
    const std::complex<double> position = start.motion.position;
    Eigen::Vector3d at(position.real(), position.imag(), start.speed_ratio);
    Eigen::Vector3d tangent = heading * Eigen::Vector3d::UnitZ();
    continue_branch(rotor, at, tangent, 0.0); // turns the tangent along the branch
    const double largest_step = 0.01 * (to - from);
    double step = 0.1 * largest_step;
    while (static_cast<int>(branch.size()) < largest_points && step > 1e-12) {
        Eigen::Vector3d next = at;
        Eigen::Vector3d direction = tangent;
        if (!continue_branch(rotor, next, direction, step) ||
            changed_branch(at, tangent, next, direction)) {
            step *= 0.5;
            continue;
        }
        if (next[2] < from || next[2] > to || next.head<2>().norm() > furthest)
            break;
        at = next;
        tangent = direction;
        branch.push_back({at[2], steady_motion_at(rotor, at[2], at.head<2>())});
        step = std::min(largest_step, 1.3 * step);
    }
    return branch;
}

std::vector<BranchPoint> steady_branch(const PendulumRotor &rotor, double from, double to) {
    const std::vector<PendulumMotion> start = steady_motions(rotor, from);
    if (start.empty())
        return {};
    return steady_branch(rotor, {from, start.front()}, 1.0, from, to);
}

} // namespace whirl::closed_form

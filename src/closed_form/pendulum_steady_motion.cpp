#include "closed_form/pendulum_steady_equations.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

namespace whirl::closed_form {

namespace {

struct Range {
    double low;
    double high;
};

/// Exact range of force over [a, b]: the slope vanishes at most at +-turning.
Range force_range(const PendulumSteadyEquations &equations, double a, double b) {
    Range range{std::min(equations.force(a), equations.force(b)),
                std::max(equations.force(a), equations.force(b))};
    if (equations.linear <= 0.0)
        return range;
    const double length =
        std::cbrt(equations.pendulum * equations.pivot * equations.pivot / equations.linear);
    const double square = length * length - equations.pivot * equations.pivot;
    for (const double turning :
         {std::sqrt(std::max(0.0, square)), -std::sqrt(std::max(0.0, square))}) {
        if (turning > a && turning < b) {
            range.low = std::min(range.low, equations.force(turning));
            range.high = std::max(range.high, equations.force(turning));
        }
    }
    return range;
}

/// Newton's method from `start`; converged roots only.
bool polish(const PendulumSteadyEquations &equations, Eigen::Vector2d &at) {
    for (int iteration = 0; iteration < 60; ++iteration) {
        const Eigen::Vector2d step =
            Eigen::MatrixXd(equations.jacobian(at)).fullPivLu().solve(equations.residual(at));
        at -= step;
        if (!at.allFinite())
            return false;
        if (step.norm() <= 1e-14 * (1.0 + at.norm()))
            return true;
    }
    return false;
}

struct Box {
    Eigen::Vector2d low;
    Eigen::Vector2d high;
};

/// False where one equation cannot vanish in the box.
bool may_hold_root(const PendulumSteadyEquations &equations, const Box &box) {
    const Range x = force_range(equations, box.low[0], box.high[0]);
    const Range y = force_range(equations, box.low[1], box.high[1]);
    const double c = equations.coupling;
    return x.low - c * box.high[1] <= equations.load[0] &&
           x.high - c * box.low[1] >= equations.load[0] &&
           y.low + c * box.low[0] <= equations.load[1] &&
           y.high + c * box.high[0] >= equations.load[1];
}

std::vector<Eigen::Vector2d> all_roots(const PendulumSteadyEquations &equations) {
    // |(1 - R^2) + i R H| |position| <= R_m R^2 (sqrt 2 + |imbalance|).
    const double stiffness = std::hypot(equations.linear, equations.coupling);
    const double bound = std::min(1e3, 1.001 * (1.5 * equations.pendulum + equations.load.norm()) /
                                           std::max(stiffness, 1e-300));
    std::vector<Eigen::Vector2d> roots;
    std::vector<Box> boxes{{Eigen::Vector2d::Constant(-bound), Eigen::Vector2d::Constant(bound)}};
    while (!boxes.empty()) {
        const Box box = boxes.back();
        boxes.pop_back();
        if (!may_hold_root(equations, box))
            continue;
        const Eigen::Vector2d width = box.high - box.low;
        if (width.maxCoeff() < std::max(1e-4 * equations.pivot, 1e-7 * bound)) {
            Eigen::Vector2d root = 0.5 * (box.low + box.high);
            if (!polish(equations, root))
                continue;
            const bool known = std::ranges::any_of(roots, [&](const Eigen::Vector2d &other) {
                return (root - other).norm() < 1e-8 * (equations.pivot + root.norm());
            });
            if (!known)
                roots.push_back(root);
            continue;
        }
        const int axis = width[0] >= width[1] ? 0 : 1;
        Box left = box;
        Box right = box;
        left.high[axis] = right.low[axis] = 0.5 * (box.low[axis] + box.high[axis]);
        boxes.push_back(left);
        boxes.push_back(right);
    }
    return roots;
}

/// Largest real part of the small motions about a steady one; D = d/dtau + i R, zeta = xi + i eta:
/// D^2 zeta + H D zeta + zeta + R_m D^2 (i cos(phi) dphi - cos(psi) dpsi) = 0,
/// dphi'' + h dphi' + R_a R^2/cos(phi) dphi + cos(phi) Im D^2 zeta = 0, dpsi likewise with -Re D^2
/// zeta.
double growth_of(const PendulumRotor &rotor, double R, const PendulumMotion &motion) {
    const double cp = std::cos(motion.phi);
    const double cs = std::cos(motion.psi);
    Eigen::Matrix2d J;
    J << 0.0, -1.0, 1.0, 0.0;
    Eigen::Matrix2d arms; // displacement of the masses by (dphi, dpsi)
    arms << 0.0, -cs, cp, 0.0;

    Eigen::MatrixXd M = Eigen::MatrixXd::Identity(4, 4);
    Eigen::MatrixXd C = Eigen::MatrixXd::Zero(4, 4);
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(4, 4);
    const auto add_acceleration = [&](int row, int column, const Eigen::Matrix2d &left,
                                      const Eigen::Matrix2d &right) {
        M.block<2, 2>(row, column) = left * right;
        C.block<2, 2>(row, column) = 2.0 * R * left * J * right;
        K.block<2, 2>(row, column) = -R * R * left * right;
    };
    const Eigen::Matrix2d I = Eigen::Matrix2d::Identity();
    add_acceleration(0, 0, I, I);
    add_acceleration(0, 2, rotor.mass_ratio * I, arms);
    add_acceleration(2, 0, arms.transpose(), I);
    C.topLeftCorner<2, 2>() += rotor.external_damping * I;
    K.topLeftCorner<2, 2>() += I + R * rotor.external_damping * J;
    C.bottomRightCorner<2, 2>() = rotor.hinge_damping * I;
    const double hinge = rotor.pivot_ratio * R * R;
    K(2, 2) = hinge / cp;
    K(3, 3) = hinge / cs;

    Eigen::MatrixXd state = Eigen::MatrixXd::Zero(8, 8);
    state.topRightCorner<4, 4>().setIdentity();
    state.bottomLeftCorner<4, 4>() = -M.partialPivLu().solve(K);
    state.bottomRightCorner<4, 4>() = -M.partialPivLu().solve(C);
    return state.eigenvalues().real().maxCoeff();
}

} // namespace

PendulumMotion steady_motion_at(const PendulumRotor &rotor, double R,
                                const Eigen::Vector2d &position) {
    PendulumMotion motion;
    motion.position = {position[0], position[1]};
    motion.phi = std::atan(position[1] / rotor.pivot_ratio);
    motion.psi = -std::atan(position[0] / rotor.pivot_ratio);
    motion.growth = growth_of(rotor, R, motion);
    // Undamped motions have their roots on the imaginary axis within rounding (double ones: its
    // root).
    motion.stable = motion.growth < 1e-6;
    return motion;
}

std::vector<PendulumMotion> steady_motions(const PendulumRotor &rotor, double speed_ratio) {
    std::vector<PendulumMotion> motions;
    for (const Eigen::Vector2d &root : all_roots(PendulumSteadyEquations(rotor, speed_ratio)))
        motions.push_back(steady_motion_at(rotor, speed_ratio, root));
    std::ranges::sort(motions, {}, [](const auto &motion) { return std::abs(motion.position); });
    return motions;
}

} // namespace whirl::closed_form

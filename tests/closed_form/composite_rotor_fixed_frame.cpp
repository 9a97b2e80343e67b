#include "closed_form/composite_rotor_matrices.h"

#include <Eigen/Core>
#include <cmath>

namespace whirl::closed_form {

namespace {

constexpr int row_x = 0;
constexpr int row_tilt = 2;
constexpr int row_balls = 4;

/// Directions of a point mass at angle g: outward e and along its circle e'.
struct Directions {
    Eigen::Vector2d outward;
    Eigen::Vector2d along;
};

Directions directions(double angle) {
    return {{std::cos(angle), std::sin(angle)}, {-std::sin(angle), std::cos(angle)}};
}

/// m R^2 e (e . phi'' + 2 Omega e' . phi'): tilt inertia of one point mass.
void add_tilt_of_point(MotionMatrices &m, double inertia, double spin_speed, const Directions &at) {
    m.M.block<2, 2>(row_tilt, row_tilt) += inertia * at.outward * at.outward.transpose();
    m.C.block<2, 2>(row_tilt, row_tilt) +=
        2.0 * spin_speed * inertia * at.outward * at.along.transpose();
}

/// Axisymmetric body on isotropic supports: the two axes couple through the gyroscopic moment only.
void add_body(MotionMatrices &m, const PhysicalParameters &physical) {
    const ReducedSupports &s = physical.supports;
    for (const int axis : {0, 1}) {
        m.M(row_x + axis, row_x + axis) += physical.mass;
        m.M(row_tilt + axis, row_tilt + axis) += physical.base_inertia;
        m.C(row_x + axis, row_x + axis) += s.h_x;
        m.C(row_tilt + axis, row_tilt + axis) += s.h_beta;
        m.C(row_x + axis, row_tilt + axis) += s.h_y;
        m.C(row_tilt + axis, row_x + axis) += s.h_y;
        m.K(row_x + axis, row_x + axis) += s.c_x;
        m.K(row_tilt + axis, row_tilt + axis) += s.c_beta;
        m.K(row_x + axis, row_tilt + axis) += s.c_y;
        m.K(row_tilt + axis, row_x + axis) += s.c_y;
        // Inertia force of the balls' displacement, on the plane A.
        m.M(row_x + axis, row_balls + axis) += 1.0;
        m.M(row_tilt + axis, row_balls + axis) += physical.balancer_position;
    }
    m.C(row_tilt, row_tilt + 1) += physical.spin_speed * physical.polar_inertia;
    m.C(row_tilt + 1, row_tilt) -= physical.spin_speed * physical.polar_inertia;
}

/// Left side of the balls' equation: S seen from the rotor, S'' - 2 i W S' - W^2 S + h_s (S' - i W
/// S).
void add_relative_motion(MotionMatrices &m, double h_s, double w) {
    m.M.block<2, 2>(row_balls, row_balls).setIdentity();
    m.C.block<2, 2>(row_balls, row_balls) << h_s, 2.0 * w, -2.0 * w, h_s;
    m.K.block<2, 2>(row_balls, row_balls) << -w * w, h_s * w, -h_s * w, -w * w;
}

} // namespace

MotionMatrices fixed_frame_matrices(const FixedFrameRotor &rotor, double time) {
    const PhysicalParameters &physical = rotor.physical;
    const BallSet &set = physical.balls;
    const double w = physical.spin_speed;
    const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(6, 6);
    MotionMatrices m{zero, zero, zero};

    add_body(m, physical);
    add_tilt_of_point(m, physical.imbalance.inertia(), w, directions(w * time));
    add_relative_motion(m, set.damping / set.mass, w);
    for (const double angle : rotor.ball_angles) {
        const Directions at = directions(w * time + angle);
        add_tilt_of_point(m, set.mass * set.radius * set.radius, w, at);
        // m R eps'' = -m e' . (x'' + z_A phi''), summed into S along e'.
        const Eigen::Matrix2d share = set.mass * at.along * at.along.transpose();
        m.M.block<2, 2>(row_balls, row_x) += share;
        m.M.block<2, 2>(row_balls, row_tilt) += physical.balancer_position * share;
    }
    return m;
}

} // namespace whirl::closed_form

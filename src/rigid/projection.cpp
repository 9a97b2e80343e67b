#include "rigid/projection.h"

#include "assembly/system.h"
#include "linalg/dense/products.h"
#include "model/variants.h"

#include <Eigen/LU>

#include <algorithm>

namespace whirl::rigid {

namespace {

/// A over the two rigid motions, with the pedestals' deflections eliminated as if they had no mass.
Eigen::Matrix2d condensed(const Eigen::MatrixXd &A) {
    const Eigen::Index pedestals = A.rows() - 2;
    if (pedestals == 0)
        return A;
    const Eigen::MatrixXd inside = A.bottomRightCorner(pedestals, pedestals);
    const Eigen::MatrixXd across = A.topRightCorner(2, pedestals);
    const Eigen::MatrixXd back = A.bottomLeftCorner(pedestals, 2);
    return A.topLeftCorner(2, 2) -
           linalg::times(across, linalg::solved(inside.partialPivLu(), back));
}

} // namespace

RigidRotor rigid_body(const model::Rotor &rotor, double bearing_speed) {
    const assembly::Discretization d(model::without_elasticity(rotor), 1);
    // Over (w at mid-length, phi) and the deflections of the pedestals.
    const assembly::DampedPlanarSystem system = assembly::assemble_damped_planar(d, bearing_speed);
    const Eigen::Matrix2d M = Eigen::MatrixXd(system.M.view()).topLeftCorner<2, 2>();
    const double offset = M(0, 1) / M(0, 0); // of the centre of mass from mid-length
    Eigen::Matrix2d T;                       // (w at mid-length, phi) from (w at the centre, phi)
    T << 1, -offset, 0, 1;
    const Eigen::Matrix2d inertia = T.transpose() * M * T;
    const Eigen::Matrix2d K = T.transpose() * condensed(system.K.view()) * T;
    const Eigen::Matrix2d H =
        T.transpose() * Eigen::MatrixXd(system.C.view()).topLeftCorner<2, 2>() * T;
    return {inertia(0, 0), rotor.shaft.length() / 2 + offset,
            inertia(1, 1), Eigen::MatrixXd(system.G.view())(1, 1),
            K(0, 0),       K(0, 1),
            K(1, 1),       H(0, 0),
            H(0, 1),       H(1, 1)};
}

std::optional<RigidRotor> rigid_projection(const model::Rotor &rotor) {
    const bool pedestals = std::ranges::any_of(
        rotor.bearings, [](const model::Bearing &b) { return b.pedestal.has_value(); });
    if (pedestals || !rotor.bearings_isotropic())
        return std::nullopt;
    return rigid_body(rotor, 0);
}

} // namespace whirl::rigid

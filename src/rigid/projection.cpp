#include "rigid/projection.h"

#include "assembly/system.h"
#include "linalg/dense/products.h"
#include "model/variants.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

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
    return {inertia(0, 0),
            rotor.shaft.length() / 2 + offset,
            inertia(1, 1),
            Eigen::MatrixXd(system.G.view())(1, 1),
            {K(0, 0), K(1, 1), K(0, 1), H(0, 0), H(1, 1), H(0, 1)}};
}

bool tilts_alone(const closed_form::ReducedSupports &s, double rounding) {
    return std::abs(s.c_y) <= rounding * std::sqrt(s.c_x * s.c_beta) &&
           std::abs(s.h_y) <= rounding * std::sqrt(s.h_x * s.h_beta);
}

std::optional<RigidRotor> rigid_projection(const model::Rotor &rotor) {
    const bool pedestals = std::ranges::any_of(
        rotor.bearings, [](const model::Bearing &b) { return b.pedestal.has_value(); });
    if (pedestals || !rotor.bearings_isotropic())
        return std::nullopt;
    return rigid_body(rotor, 0);
}

namespace {

std::string why_not_reduced(const model::Rotor &rotor) {
    if (!rotor.bearings_isotropic())
        return "a bearing is not isotropic";
    if (rotor.bearings_depend_on_speed())
        return "a bearing depends on the spin speed";
    if (std::ranges::any_of(rotor.bearings, [](const model::Bearing &bearing) {
            return bearing.pedestal.has_value();
        }))
        return "a bearing stands on a pedestal";
    if (std::ranges::any_of(rotor.bearings, &model::Bearing::has_mass))
        return "a bearing or seal has mass coefficients";
    if (rotor.shaft.damped_outside())
        return "the shaft has damping of its own";
    return "";
}

} // namespace

std::optional<closed_form::ReducedSupports> reduced_supports(const model::Rotor &rotor,
                                                             double center, std::string &why) {
    why = why_not_reduced(rotor);
    if (!why.empty())
        return std::nullopt;
    closed_form::ReducedSupports sum;
    for (const model::Bearing &bearing : rotor.bearings) {
        const model::BearingCoefficients &row = bearing.rows.front();
        const double z = bearing.z - center;
        sum.c_x += row.k(0, 0);
        sum.c_y += row.k(0, 0) * z;
        sum.c_beta += row.k(0, 0) * z * z + row.kt(0, 0);
        sum.h_x += row.c(0, 0);
        sum.h_y += row.c(0, 0) * z;
        sum.h_beta += row.c(0, 0) * z * z + row.ct(0, 0);
    }
    if (sum.c_x > 0)
        return sum;
    why = "no bearing carries the rotor";
    return std::nullopt;
}

} // namespace whirl::rigid

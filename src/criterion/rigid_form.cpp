#include "criterion/rigid_form.h"

#include "assembly/system.h"
#include "closed_form/rigid_rotor_criterion.h"
#include "criterion/undamped_rotor.h"
#include "model/variants.h"
#include "rigid/inertia.h"

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace whirl::criterion {

namespace {

closed_form::TwoSupportRotor closed_form_rotor(const results::RigidEquivalent &rigid) {
    return {rigid.mass, rigid.diametral, rigid.polar, rigid.k11, rigid.k14, rigid.k33};
}

std::vector<results::SpeedBand> cut(const std::vector<closed_form::Band> &bands, double from,
                                    double to) {
    std::vector<results::SpeedBand> out;
    for (const closed_form::Band &band : bands) {
        const double start = std::max(band.from, from);
        const double end = std::min(band.to.value_or(to), to);
        if (start < end)
            out.push_back({start, end});
    }
    return out;
}

/// K with the pedestals' deflections eliminated, as if they had no mass.
Eigen::Matrix2d condensed(const Eigen::MatrixXd &K) {
    const Eigen::Index pedestals = K.rows() - 2;
    if (pedestals == 0)
        return K;
    return K.topLeftCorner<2, 2>() -
           K.topRightCorner(2, pedestals) * K.bottomRightCorner(pedestals, pedestals)
                                                .partialPivLu()
                                                .solve(K.bottomLeftCorner(pedestals, 2));
}

} // namespace

std::optional<results::RigidEquivalent> rigid_equivalent(const model::Rotor &rotor,
                                                         double bearing_speed) {
    model::Rotor rigid = model::with_mean_bearings(rotor);
    rigid.shaft.rigid = true;
    const assembly::Discretization d(rigid, 1);
    const assembly::PlanarSystem system = assembly::assemble_planar(d, bearing_speed);
    const Eigen::MatrixXd M = system.M.view();
    const Eigen::MatrixXd G = system.G.view();
    const Eigen::Matrix2d K = condensed(system.K.view());
    // Unknowns: deflection at mid-length and slope; `arm` leads from there to the centre of mass.
    const double arm = M(0, 1) / M(0, 0);
    results::RigidEquivalent out;
    out.mass = M(0, 0);
    out.center = rotor.shaft.length() / 2 + arm;
    out.diametral = M(1, 1) - M(0, 0) * arm * arm;
    out.polar = G(1, 1);
    out.type = rigid::rigid_type(out.diametral, out.polar);
    if (out.type == "spherical")
        out.polar = out.diametral;
    out.k11 = K(0, 0);
    out.k14 = K(0, 1) - arm * K(0, 0);
    out.k33 = K(1, 1) - 2 * arm * K(0, 1) + arm * arm * K(0, 0);
    const double determinant = out.k11 * out.k33 - out.k14 * out.k14;
    if (!(out.k11 > 0) || !(determinant > 1e-12 * out.k11 * out.k33))
        return std::nullopt;
    out.critical_speeds = closed_form::resonances(closed_form_rotor(out));
    return out;
}

double rotor_mass(const model::Rotor &rotor) {
    model::Rotor rigid = rotor;
    rigid.shaft.rigid = true;
    const assembly::Discretization d(rigid, 1);
    return assembly::assemble_planar(d, 0).M.view().coeff(0, 0);
}

std::vector<results::SpeedBand> rigid_plane_bands(const results::RigidEquivalent &rigid, double z,
                                                  double from, double to) {
    return cut(closed_form::static_balancing_bands(closed_form_rotor(rigid), z - rigid.center),
               from, to);
}

std::vector<results::SpeedBand> rigid_joint_bands(const results::RigidEquivalent &rigid,
                                                  const std::vector<double> &planes, double from,
                                                  double to) {
    const auto [least, largest] = std::minmax_element(planes.begin(), planes.end());
    // One place, measured by the radius of gyration.
    if (*largest - *least < 1e-9 * std::sqrt(rigid.diametral / rigid.mass))
        return rigid_plane_bands(rigid, *least, from, to);
    return cut(closed_form::dynamic_balancing_bands(closed_form_rotor(rigid)), from, to);
}

} // namespace whirl::criterion

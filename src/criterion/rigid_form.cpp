#include "criterion/rigid_form.h"

#include "closed_form/rigid_rotor_criterion.h"
#include "rigid/inertia.h"

#include <algorithm>
#include <cmath>

namespace whirl::criterion {

namespace {

closed_form::TwoSupportRotor closed_form_rotor(const results::RigidEquivalent &rigid) {
    return {rigid.mass, rigid.diametral, rigid.polar,     rigid.k11,
            rigid.k14,  rigid.k33,       rigid.anisotropy};
}

std::vector<results::Interval> cut(const std::vector<closed_form::Band> &bands, double from,
                                   double to) {
    std::vector<results::Interval> out;
    for (const closed_form::Band &band : bands) {
        const double start = std::max(band.from, from);
        const double end = std::min(band.to.value_or(to), to);
        if (start < end)
            out.push_back({start, end});
    }
    return out;
}

} // namespace

std::optional<results::RigidEquivalent> rigid_equivalent(const rigid::RigidRotor &body,
                                                         double anisotropy, double balancers) {
    results::RigidEquivalent out;
    out.anisotropy = anisotropy;
    out.mass = body.mass;
    out.center = body.center;
    out.diametral = body.A;
    out.polar = body.C;
    out.type = rigid::rigid_type(out.diametral, out.polar);
    if (std::abs(out.polar - out.diametral) < out.anisotropy)
        out.type = "long about one axis, short about the other";
    else if (out.type == "spherical")
        out.polar = out.diametral;
    out.k11 = body.supports.c_x;
    out.k14 = body.supports.c_y;
    out.k33 = body.supports.c_beta;
    const double determinant = out.k11 * out.k33 - out.k14 * out.k14;
    if (!(out.k11 > 0) || !(determinant > 1e-12 * out.k11 * out.k33))
        return std::nullopt;
    const closed_form::TwoSupportRotor rotor = closed_form_rotor(out);
    out.critical_speeds = closed_form::resonances(rotor);
    out.partial_frequencies = closed_form::partial_frequencies(rotor);
    out.z_max = closed_form::farthest_plane(rotor);
    out.omega_0 = std::sqrt(out.k11 / (out.mass + balancers));
    return out;
}

std::vector<results::Interval> rigid_plane_bands(const results::RigidEquivalent &rigid, double z,
                                                 double from, double to) {
    return cut(closed_form::static_balancing_bands(closed_form_rotor(rigid), z - rigid.center),
               from, to);
}

std::vector<results::Interval> rigid_joint_bands(const results::RigidEquivalent &rigid,
                                                 const std::vector<double> &planes, double from,
                                                 double to) {
    const auto [least, largest] = std::ranges::minmax_element(planes);
    // One place, measured by the radius of gyration.
    if (*largest - *least < 1e-9 * std::sqrt(rigid.diametral / rigid.mass))
        return rigid_plane_bands(rigid, *least, from, to);
    return cut(closed_form::dynamic_balancing_bands(closed_form_rotor(rigid)), from, to);
}

} // namespace whirl::criterion

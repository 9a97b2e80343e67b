#include "closed_form/rigid_rotor_criterion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::closed_form {

namespace {

/// Relative allowance within which two inertias, or two ends of a band, count as equal.
constexpr double equal_within = 1e-12;

RotorType type_of(const TwoSupportRotor &rotor) {
    return rotor_type(rotor.diametral_inertia, rotor.polar_inertia);
}

void add_band(std::vector<Band> &bands, double from, std::optional<double> to) {
    // At the two positions of z where the additional speed equals a resonance the band is empty, or
    // the two bands touch.
    if (to && *to <= from * (1.0 + equal_within))
        return;
    bands.push_back({from, to});
}

/// The rotors that stand for the two principal planes; one where they are the same.
std::vector<TwoSupportRotor> principal_planes(const TwoSupportRotor &rotor) {
    std::vector<TwoSupportRotor> planes{rotor};
    if (rotor.anisotropy != 0)
        planes.push_back(rotor);
    planes.front().diametral_inertia -= rotor.anisotropy;
    planes.back().diametral_inertia += planes.size() > 1 ? rotor.anisotropy : 0;
    return planes;
}

/// Speeds that lie in bands of both lists, which ascend.
std::vector<Band> common(const std::vector<Band> &a, const std::vector<Band> &b) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::vector<Band> bands;
    for (const Band &x : a)
        for (const Band &y : b) {
            const double from = std::max(x.from, y.from);
            const double to = std::min(x.to.value_or(infinity), y.to.value_or(infinity));
            if (from < to)
                add_band(bands, from, to < infinity ? std::optional(to) : std::nullopt);
        }
    return bands;
}

/// Bands of every principal plane.
template <class Bands> std::vector<Band> in_both_planes(const TwoSupportRotor &rotor, Bands bands) {
    const std::vector<TwoSupportRotor> planes = principal_planes(rotor);
    std::vector<Band> out = bands(planes.front());
    return planes.size() > 1 ? common(out, bands(planes.back())) : out;
}

std::vector<double> plane_resonances(const TwoSupportRotor &rotor) {
    const double slenderness = rotor.diametral_inertia - rotor.polar_inertia;
    const double determinant = rotor.k11 * rotor.k33 - rotor.k14 * rotor.k14;
    const RotorType type = type_of(rotor);
    if (type == RotorType::spherical)
        return {std::sqrt(determinant / (rotor.mass * rotor.k33))};

    const double leading = rotor.mass * slenderness;
    const double half_middle = 0.5 * (slenderness * rotor.k11 + rotor.mass * rotor.k33);
    // Never negative: ((A - C) k11 - M k33)^2 / 4 + M (A - C) k14^2 for a long rotor, and a sum of
    // positives for a short one.
    const double root = std::sqrt(std::max(0.0, half_middle * half_middle - leading * determinant));
    if (type == RotorType::long_rotor) {
        const double sum = half_middle + root;
        return {std::sqrt(determinant / sum), std::sqrt(sum / leading)};
    }
    const double x =
        half_middle > 0.0 ? determinant / (half_middle + root) : (half_middle - root) / leading;
    return {std::sqrt(x)};
}

std::vector<Band> static_bands_of_plane(const TwoSupportRotor &rotor, double z) {
    const std::vector<double> speeds = plane_resonances(rotor);
    std::vector<Band> bands;
    add_band(bands, speeds.front(), additional_speed(rotor, z));
    if (type_of(rotor) == RotorType::long_rotor)
        bands.push_back({speeds.back(), std::nullopt});
    return bands;
}

std::vector<Band> dynamic_bands_of_plane(const TwoSupportRotor &rotor) {
    if (type_of(rotor) != RotorType::long_rotor)
        return {};
    return {{plane_resonances(rotor).back(), std::nullopt}};
}

} // namespace

std::vector<double> resonances(const TwoSupportRotor &rotor) {
    std::vector<double> all;
    for (const TwoSupportRotor &plane : principal_planes(rotor)) {
        const std::vector<double> speeds = plane_resonances(plane);
        all.insert(all.end(), speeds.begin(), speeds.end());
    }
    std::ranges::sort(all);
    return all;
}

std::vector<double> partial_frequencies(const TwoSupportRotor &rotor) {
    std::vector<double> out{std::sqrt(rotor.k11 / rotor.mass)};
    for (const TwoSupportRotor &plane : principal_planes(rotor))
        if (type_of(plane) == RotorType::long_rotor)
            out.push_back(std::sqrt(plane.k33 / (plane.diametral_inertia - plane.polar_inertia)));
    return out;
}

std::optional<double> farthest_plane(const TwoSupportRotor &rotor) {
    const TwoSupportRotor plane = principal_planes(rotor).back(); // of the larger inertia
    if (type_of(plane) == RotorType::long_rotor)
        return std::nullopt;
    return std::sqrt(std::max(0.0, plane.polar_inertia - plane.diametral_inertia) / plane.mass);
}

std::optional<double> additional_speed(const TwoSupportRotor &rotor, double z) {
    const double inertia = rotor.diametral_inertia + rotor.mass * z * z - rotor.polar_inertia;
    if (inertia <= equal_within * rotor.diametral_inertia)
        return std::nullopt;
    return std::sqrt((rotor.k33 + rotor.k11 * z * z - 2.0 * rotor.k14 * z) / inertia);
}

std::vector<Band> static_balancing_bands(const TwoSupportRotor &rotor, double z) {
    return in_both_planes(
        rotor, [z](const TwoSupportRotor &plane) { return static_bands_of_plane(plane, z); });
}

std::vector<Band> dynamic_balancing_bands(const TwoSupportRotor &rotor) {
    return in_both_planes(rotor, dynamic_bands_of_plane);
}

} // namespace whirl::closed_form

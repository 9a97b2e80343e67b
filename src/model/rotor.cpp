#include "model/rotor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::model {

namespace {

bool alike(const Eigen::Vector2d &directions) { return directions(0) == directions(1); }

template <class Predicate> bool every_pedestal(const Rotor &rotor, Predicate holds) {
    return std::ranges::all_of(rotor.bearings, [&](const Bearing &bearing) {
        return !bearing.pedestal || holds(*bearing.pedestal);
    });
}

bool pedestals_isotropic(const Rotor &rotor) {
    return every_pedestal(rotor, [](const Pedestal &pedestal) {
        return alike(pedestal.mass) && alike(pedestal.k) && alike(pedestal.c);
    });
}

using Property = bool (*)(const Eigen::Matrix2d &);

/// Something holds for stiffness and damping of every bearing at every speed, and for its mass.
bool every_matrix(const Rotor &rotor, Property holds, Property of_mass) {
    return rotor.every_row([=](const BearingCoefficients &row) {
        return holds(row.k) && holds(row.c) && of_mass(row.m) && holds(row.kt) && holds(row.ct);
    });
}

} // namespace

std::optional<std::size_t> Rotor::pedestal_of(const Probe &probe) const {
    const std::span<const Bearing> all = supports();
    std::size_t best = probe.bearing.value_or(0);
    if (!probe.bearing)
        for (std::size_t i = 1; i < all.size(); ++i)
            if (std::abs(all[i].z - probe.z) < std::abs(all[best].z - probe.z))
                best = i;
    return best < all.size() && all[best].pedestal ? std::optional(best) : std::nullopt;
}

std::span<const Bearing> Rotor::supports() const {
    const auto first_seal = std::ranges::find_if(bearings, &Bearing::seal);
    return {bearings.begin(), first_seal};
}

std::span<const Bearing> Rotor::seals() const {
    return std::span(bearings).subspan(supports().size());
}

bool Rotor::bearings_isotropic() const {
    return pedestals_isotropic(*this) && every_matrix(*this, isotropic, isotropic);
}

bool Rotor::bearings_rotation_invariant() const {
    return pedestals_isotropic(*this) && every_matrix(*this, rotation_invariant, isotropic);
}

bool Rotor::bearings_orthotropic() const { return every_matrix(*this, diagonal, diagonal); }

bool Rotor::support_masses_isotropic() const {
    return every_row([](const BearingCoefficients &row) { return isotropic(row.m); }) &&
           every_pedestal(*this, [](const Pedestal &pedestal) { return alike(pedestal.mass); });
}

bool Rotor::damped() const {
    const bool in_bearings = !every_row(
        [](const BearingCoefficients &row) { return row.c.isZero(0) && row.ct.isZero(0); });
    return in_bearings || shaft.damped() ||
           !every_pedestal(*this, [](const Pedestal &pedestal) { return pedestal.c.isZero(0); });
}

bool Rotor::bearings_depend_on_speed() const {
    return std::ranges::any_of(bearings, &Bearing::depends_on_speed);
}

std::string Rotor::balancer_path(std::size_t index) const {
    for (const HeldBalancer &other : held) // in the order of the case file
        if (other.index <= index)
            ++index;
    return fmt::format("balancer[{}]", index);
}

Rotor Rotor::with_held_among_balancers() const {
    Rotor out = *this;
    for (const HeldBalancer &one : held) { // all that come before it are there already
        out.balancers.insert(out.balancers.begin() + static_cast<std::ptrdiff_t>(one.index),
                             one.balancer);
        out.discs.pop_back();
        if (one.anisotropic)
            out.anisotropies.pop_back();
        if (one.unbalanced)
            out.imbalances.pop_back();
    }
    out.held.clear();
    return out;
}

std::vector<CorrectionPlane> Rotor::balancer_planes() const {
    std::vector<CorrectionPlane> planes;
    for (const Balancer &balancer : with_held_among_balancers().balancers)
        planes.push_back({balancer.name, balancer.z});
    return planes;
}

std::vector<double> Rotor::table_bends() const {
    std::vector<double> out;
    for (const Bearing &bearing : bearings)
        for (const double speed : bearing.bends())
            out.push_back(speed);
    std::ranges::sort(out);
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

std::string name_or_number(const std::string &name, const char *kind, std::size_t index) {
    return name.empty() ? fmt::format("{} {}", kind, index + 1) : name;
}

std::string Rotor::probe_name(std::size_t probe) const {
    return name_or_number(probes[probe].name, "probe", probe);
}

std::string Rotor::plane_name(std::size_t plane) const {
    return name_or_number(planes[plane].name, "plane", plane);
}

} // namespace whirl::model

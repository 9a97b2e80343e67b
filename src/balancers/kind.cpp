#include "balancers/kind.h"

#include <algorithm>

namespace whirl::balancers {

void SmallMotions::set_diameter(std::complex<double> D, double rate) {
    constexpr double rounding = 1e-12;
    if (std::abs(std::abs(D) - 1) > rounding)
        return;
    diameter = D / std::abs(D);
    far = far_away * (rate > 0 ? rate : 1.0); // coupled to nothing: any rate does
}

double Outline::radius() const {
    double largest = 0;
    for (const double point : points)
        largest = std::max(largest, point);
    for (const auto *lines : {&arms, &sections})
        for (const auto &[from, to] : *lines)
            largest = std::max(largest, to);
    return largest;
}

HeldParts Kind::held(const std::vector<double> &angles) const {
    const PartsInertia inertia = this->inertia();
    HeldParts out{inertia.mass, inertia.on_circle, inertia.own, 0, inertia.mass * race_centre()};
    const std::vector<CircledMass> masses = circled();
    for (std::size_t j = 0; j < masses.size(); ++j) {
        out.second_moment += std::polar(masses[j].inertia, 2 * angles[j]);
        const Track track{1, out_of_round()};
        out.moment_of_mass += std::polar(masses[j].moment * track.at(angles[j]).value, angles[j]);
    }
    return out;
}

std::unique_ptr<Kind> kind_of(const model::Balancer &balancer) {
    return std::visit([](const auto &parts) { return kind_of(parts); }, balancer.parts);
}

bool has_eccentric_race(const std::vector<model::Balancer> &balancers) {
    return std::ranges::any_of(balancers, [](const model::Balancer &balancer) {
        return kind_of(balancer)->race_centre() != 0.0;
    });
}

bool has_obstructed_race(const std::vector<model::Balancer> &balancers) {
    return std::ranges::any_of(
        balancers, [](const model::Balancer &balancer) { return kind_of(balancer)->obstructed(); });
}

} // namespace whirl::balancers

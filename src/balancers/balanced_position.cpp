#include "balancers/balanced_position.h"

#include "balancers/balance_family.h"
#include "closed_form/balanced_position.h"
#include "model/errors.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace whirl::balancers {

namespace {

/// E = 1 is a product of inputs with nine digits or more.
constexpr double capacity_rounding = 1e-9;

using Masses = std::vector<CircledMass>;

bool equal(const Masses &masses) {
    return std::ranges::all_of(masses, [&](const CircledMass &mass) {
        return mass.moment == masses.front().moment && mass.inertia == masses.front().inertia;
    });
}

/// Imbalance of a balancer that has a balanced position: rounding beyond its capacity removed.
double sound_imbalance(const model::Balancer &balancer) {
    return std::min(balancer.imbalance, kind_of(balancer)->reach().imbalance);
}

double sound_capacity(const model::Balancer &balancer) { return std::max(1.0, capacity(balancer)); }

using Value = std::function<double(const std::vector<double> &)>;

/// Equal masses: the closed form is global.
std::optional<PositionInterval> interval_of_equal(const Masses &masses, double imbalance, double E,
                                                  double constant, double factor,
                                                  const Value &value) {
    // The search divides by n/E: a family without imbalance is reached from one with next to none.
    constexpr double almost_infinite = 1e9;
    const int n = static_cast<int>(masses.size());
    std::optional<PositionInterval> interval =
        closed_form::modulus_interval(n, std::min(E, almost_infinite), constant, factor);
    if (!interval || E <= almost_infinite)
        return interval;
    interval->least_position = symmetric_position(n, std::numeric_limits<double>::infinity());
    for (auto *position : {&interval->least_position, &interval->largest_position})
        restore_balance(masses, imbalance, *position); // D = 0, and A_m0 next to nothing
    interval->least = value(interval->least_position);
    interval->largest = value(interval->largest_position);
    return interval;
}

/// Masses that differ: a search.
PositionInterval interval_of_different(const Masses &masses, double imbalance, double constant,
                                       double factor, const Value &value) {
    double sum = 0;
    for (const CircledMass &mass : masses)
        sum += mass.inertia;
    std::vector<double> factors;
    for (const CircledMass &mass : masses)
        factors.push_back(factor * mass.inertia / sum);
    const auto least = extreme_position(masses, imbalance, constant, factors, 1);
    const auto largest = extreme_position(masses, imbalance, constant, factors, -1);
    return {value(least), value(largest), least, largest};
}

/// Interval of |constant + factor D|.
std::optional<PositionInterval> interval_of(const model::Balancer &balancer, double constant,
                                            double factor) {
    const Masses masses = kind_of(balancer)->circled();
    if (!balance_exists(masses, balancer.imbalance) || std::ssize(masses) > largest_searched_count)
        return std::nullopt;
    const auto value = [&](const std::vector<double> &angles) {
        return std::abs(constant + factor * second_harmonic_of(balancer, angles));
    };
    if (masses.size() <= 2) {
        const auto angles = angles_at_balance(balancer, "balancer");
        return PositionInterval{value(angles), value(angles), angles, angles};
    }
    const double imbalance = sound_imbalance(balancer);
    if (!equal(masses))
        return interval_of_different(masses, imbalance, constant, factor, value);
    return interval_of_equal(masses, imbalance, sound_capacity(balancer), constant, factor, value);
}

} // namespace

double capacity(const model::Balancer &balancer) {
    if (balancer.imbalance == 0)
        return std::numeric_limits<double>::infinity();
    return kind_of(balancer)->reach().imbalance / balancer.imbalance;
}

std::vector<double> angles_at_balance(const model::Balancer &balancer, const std::string &label) {
    const auto kind = kind_of(balancer);
    const Masses masses = kind->circled();
    if (masses.empty())
        throw model::BadInput(
            fmt::format("{}.kind: expected a kind with a balanced position of its own, "
                        "got \"{}\"",
                        label, kind->name()));
    const double E = capacity(balancer);
    if (!balance_exists(masses, balancer.imbalance)) {
        const std::string formula = kind->reach().formula;
        if (masses.size() == 1)
            throw model::BadInput(fmt::format("{}: expected a capacity E = {} of 1 for a balanced "
                                              "position of one {}, got {:.10g}",
                                              label, formula, kind->name(), E));
        if (E >= 1 - capacity_rounding)
            throw model::BadInput(fmt::format(
                "{}: expected {} of which none makes more imbalance, m R, than all others and the "
                "imbalance {} kg m together, for a balanced position; got one that does",
                label, kind->parts(), balancer.imbalance));
        throw model::BadInput(fmt::format("{}: expected a capacity E = {} of at least 1 for a "
                                          "balanced position, got {:.10g}",
                                          label, formula, E));
    }
    if (!balancer.position.empty())
        return turned(balancer.position, -balancer.imbalance_phase);
    if (auto usual = kind->usual_position(std::max(1.0, E)))
        return *usual;
    return position_of_family(masses, sound_imbalance(balancer), 0);
}

std::vector<double> turned(std::vector<double> angles, double by) {
    if (by != 0)
        for (double &angle : angles)
            angle += by;
    return angles;
}

std::complex<double> second_harmonic_of(const model::Balancer &balancer,
                                        const std::vector<double> &angles) {
    const Masses masses = kind_of(balancer)->circled();
    if (masses.empty())
        return 0;
    if (equal(masses))
        return closed_form::second_harmonic(angles);
    std::complex<double> sum = 0;
    double all = 0;
    for (std::size_t j = 0; j < masses.size(); ++j) {
        sum += std::polar(masses[j].inertia, 2 * angles[j]);
        all += masses[j].inertia;
    }
    return sum / all;
}

double imbalance_mass(const model::Balancer &balancer) {
    return balancer.imbalance_radius ? balancer.imbalance / *balancer.imbalance_radius : 0;
}

double imbalance_inertia(const model::Balancer &balancer) {
    return balancer.imbalance * balancer.imbalance_radius.value_or(0);
}

AddedInertias added_inertias(const model::Balancer &balancer) {
    if (!balancer.tilt_inertia)
        return {};
    const PartsInertia parts = kind_of(balancer)->inertia();
    return {parts.on_circle, imbalance_inertia(balancer), parts.own};
}

double mass_of(const model::Balancer &balancer) {
    return kind_of(balancer)->inertia().mass + imbalance_mass(balancer);
}

std::optional<PositionInterval> second_harmonic_interval(const model::Balancer &balancer) {
    return interval_of(balancer, 0, 1);
}

std::optional<PositionInterval> anisotropy_interval(const model::Balancer &balancer) {
    const AddedInertias inertias = added_inertias(balancer);
    return interval_of(balancer, inertias.imbalance / 2, inertias.parts / 2);
}

std::vector<std::vector<double>> sampled_positions(const model::Balancer &balancer, int count,
                                                   const std::string &label) {
    std::vector<std::vector<double>> positions{angles_at_balance(balancer, label)};
    const Masses masses = kind_of(balancer)->circled();
    if (masses.size() <= 2 || sound_capacity(balancer) - 1 <= capacity_rounding)
        return positions;
    const double imbalance = sound_imbalance(balancer);
    std::vector<std::complex<double>> harmonics{second_harmonic_of(balancer, positions.front())};
    const auto add = [&](const std::vector<double> &angles) {
        const auto D = second_harmonic_of(balancer, angles);
        const bool known = std::ranges::any_of(
            harmonics, [&](const auto &other) { return std::abs(other - D) < 1e-9; });
        if (known || std::ssize(positions) >= count)
            return;
        positions.push_back(angles);
        harmonics.push_back(D);
    };
    if (const auto interval = anisotropy_interval(balancer)) {
        add(interval->least_position);
        add(interval->largest_position);
    }
    // Without imbalance three masses have one position only: a bound on the tries ends the search.
    for (int index = 1; index <= 4 * count && std::ssize(positions) < count; ++index)
        add(position_of_family(masses, imbalance, index));
    return positions;
}

} // namespace whirl::balancers

#include "balancers/held.h"

#include "balancers/balanced_position.h"
#include "balancers/kind.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <utility>

namespace whirl::balancers {

namespace {

/// Angles in radians are rounded to 2^-53 of their size: sums that should cancel leave some 1e-16
/// of their terms, of any number of balls less than this.
constexpr double rounding = 1e-14;

std::complex<double> without_rounding(std::complex<double> sum, double terms) {
    return std::abs(sum) <= rounding * terms ? 0 : sum;
}

/// The lists of [simulate] that are one for each balancer without those of held ones.
void drop_starts(std::vector<std::vector<double>> &starts, const std::vector<bool> &held) {
    std::vector<std::vector<double>> free;
    for (std::size_t i = 0; i < starts.size(); ++i)
        if (!held[i])
            free.push_back(std::move(starts[i]));
    starts = std::move(free);
}

/// Puts what a balancer is to the rotor with its parts fixed in it behind the rotor's own.
model::HeldBalancer held_in(model::Rotor &rotor, const model::Balancer &balancer, std::size_t index,
                            const std::vector<double> &angles) {
    const HeldMasses masses = held_masses(balancer, angles);
    model::HeldBalancer out{balancer, index, angles, masses.anisotropy != 0.0,
                            masses.imbalance != 0.0};
    out.balancer.held = true;
    rotor.discs.push_back(masses.disc);
    if (out.anisotropic)
        rotor.anisotropies.push_back({balancer.name, balancer.z, std::abs(masses.anisotropy),
                                      std::arg(masses.anisotropy) / 2});
    if (out.unbalanced)
        rotor.imbalances.push_back(
            {balancer.name, balancer.z, std::abs(masses.imbalance), std::arg(masses.imbalance)});
    return out;
}

/// Says how far off balance the last one held is.
void remark_imbalance(model::Case &scene) {
    const model::HeldBalancer &held = scene.rotor.held.back();
    const model::Imbalance &left = scene.rotor.imbalances.back();
    namespace as = model::as;
    scene.remarks.emplace_back(
        "{}: its {} are held off balance: with its imbalance they leave {} at {}, which count as "
        "an imbalance of the rotor",
        held.balancer.name.empty() ? fmt::format("balancer[{}]", held.index) : held.balancer.name,
        kind_of(held.balancer)->parts(), as::imbalance(left.mr), as::angle(left.phase));
}

} // namespace

HeldMasses held_masses(const model::Balancer &balancer, const std::vector<double> &angles) {
    const HeldParts parts = kind_of(balancer)->held(angles);
    HeldMasses out;
    out.disc.name = balancer.name;
    out.disc.z = balancer.z;
    out.disc.mass = parts.mass + imbalance_mass(balancer);
    if (balancer.tilt_inertia) {
        const double A_m0 = imbalance_inertia(balancer);
        out.disc.Ip = parts.on_circle + parts.own + A_m0;
        out.disc.Id = out.disc.Ip / 2;
        out.anisotropy = without_rounding(
            (parts.second_moment + A_m0 * std::polar(1.0, 2 * balancer.imbalance_phase)) / 2.0,
            parts.on_circle + A_m0);
    }
    out.imbalance = without_rounding(
        parts.moment_of_mass + balancer.imbalance * std::polar(1.0, balancer.imbalance_phase),
        kind_of(balancer)->reach().side_by_side + balancer.imbalance);
    return out;
}

std::vector<double> held_angles(const model::Balancer &balancer, const std::vector<double> *start,
                                const std::string &label) {
    const auto kind = kind_of(balancer);
    if (start && start->size() == kind->start_angles())
        return *start;
    if (kind->circled().empty())
        return std::vector<double>(kind->start_angles(), 0.0);
    if (!balancer.position.empty()) // it need not balance
        return balancer.position;
    return turned(angles_at_balance(balancer, label), balancer.imbalance_phase);
}

model::Rotor with_parts_held(model::Rotor rotor, const std::vector<std::vector<double>> &angles) {
    const std::vector<model::Balancer> balancers = std::exchange(rotor.balancers, {});
    for (std::size_t i = 0; i < balancers.size(); ++i)
        static_cast<void>(held_in(rotor, balancers[i], i, angles[i]));
    return rotor;
}

void hold(model::Case &scene) {
    model::Rotor &rotor = scene.rotor;
    model::SimulateSettings &simulate = scene.simulate;
    std::vector<bool> held;
    for (const model::Balancer &balancer : rotor.balancers)
        held.push_back(balancer.held);
    std::vector<model::Balancer> free;
    for (std::size_t i = 0; i < held.size(); ++i) {
        const model::Balancer &balancer = rotor.balancers[i];
        if (!held[i]) {
            free.push_back(balancer);
            continue;
        }
        const std::vector<double> *start =
            simulate.ball_angles.empty() ? nullptr : &simulate.ball_angles[i];
        const std::vector<double> angles =
            held_angles(balancer, start, fmt::format("balancer[{}]", i));
        rotor.held.push_back(held_in(rotor, balancer, i, angles));
        if (rotor.held.back().unbalanced)
            remark_imbalance(scene);
        if (!balancer.tilt_inertia) { // what is left out of tilting still has to be spun up
            const HeldParts parts = kind_of(balancer)->held(angles);
            simulate.inertia += parts.on_circle + parts.own;
        }
    }
    if (rotor.held.empty())
        return;
    rotor.balancers = std::move(free);
    if (!simulate.ball_angles.empty())
        drop_starts(simulate.ball_angles, held);
    if (!simulate.other_starts.empty())
        scene.remarks.emplace_back("balancers that are held stay where simulate.ball_angles or "
                                   "their balanced position puts them, in simulate.other_starts "
                                   "too");
    for (auto &starts : simulate.other_starts)
        drop_starts(starts, held);
    if (rotor.balancers.empty())
        simulate.other_starts.clear();
}

} // namespace whirl::balancers

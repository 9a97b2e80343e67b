#include "analyses/balance.h"

#include "balancers/kind.h"
#include "results/formulation.h"
#include "results/sentence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace whirl::analyses {

namespace {

using results::Sentence;
namespace as = results::as;

Sentence plane_text(const results::BalancePlane &plane, std::size_t index) {
    return Sentence("{} (z = {})", model::name_or_number(plane.name, "plane", index),
                    as::length(plane.z, 4));
}

bool rigid_says_on(const results::BalanceBands &bands, double speed) {
    return bands.rigid_bands &&
           std::ranges::any_of(*bands.rigid_bands, [speed](const results::Interval &b) {
               return b.from <= speed && b.to > speed;
           });
}

/// Upper ends of the joint band, and what the rigid form says of them.
void joint_ends(const results::BalanceResult &result, std::vector<results::Sentence> &out) {
    const std::string where = result.planes.size() == 1 ? "there" : "at all planes";
    for (const results::BandEnd &end : result.joint.bands.ends) {
        if (!end.upper)
            continue;
        Sentence text("The {}band ends at {}", result.planes.size() == 1 ? "" : "joint ",
                      as::speed(end.speed));
        if (end.pinned)
            text += Sentence(", the critical speed of the rotor pinned {} (the pinned eigenproblem "
                             "agrees to {})",
                             where, as::number(std::abs(*end.pinned / end.speed - 1) + 1e-16, 1));
        if (rigid_says_on(result.joint.bands, end.speed) && !end.rigid)
            text += result.model.formulation.form != results::Form::general
                        ? "; the rigid form has no such end: the shaft bends between the planes"
                        : "; the rigid form, with isotropic bearings, has no such end";
        out.emplace_back("{}.", text);
    }
}

/// One sentence a plane: its additional speeds, beside the rigid ones.
void plane_ends(const results::BalanceResult &result, std::vector<results::Sentence> &out) {
    for (std::size_t i = 0; i < result.planes.size() && result.planes.size() > 1; ++i) {
        std::vector<Sentence> ends;
        bool pinned = true;
        for (const results::BandEnd &end : result.planes[i].bands.ends) {
            if (!end.upper)
                continue;
            pinned = pinned && end.pinned;
            ends.emplace_back("{}", as::speed(end.speed));
            if (end.rigid && end.relative_difference)
                ends.back() += Sentence(" (rigid {}, {} %)", as::speed(*end.rigid),
                                        as::number(100 * *end.relative_difference, 2).with_sign());
            else if (result.rigid)
                ends.back() += " (rigid: no end)";
        }
        if (!ends.empty())
            out.emplace_back("{} alone works up to {}{}.", plane_text(result.planes[i], i),
                             joined(ends, " and "),
                             pinned ? ", where the rotor pinned there is critical" : "");
    }
}

/// Of a rotor that is not axisymmetric: which imbalances a band waits for.
void directions(const results::BalanceResult &result, std::vector<results::Sentence> &out) {
    for (std::size_t i = 0; i < result.planes.size(); ++i) {
        std::vector<Sentence> where;
        for (const results::BandEnd &end : result.planes[i].bands.ends)
            if (!end.upper && end.direction)
                where.emplace_back("at {} those at {}", as::speed(end.speed),
                                   as::angle(*end.direction, 3));
        if (!where.empty())
            out.emplace_back("{}: bands begin where the imbalances of the last direction in the "
                             "rotor are balanced too, {}.",
                             plane_text(result.planes[i], i), joined(where, ", "));
    }
}

/// More planes than rigid motions: the form of a flexible rotor is indefinite by a little.
void excess_planes(const results::BalanceResult &result, bool rigid,
                   std::vector<results::Sentence> &out) {
    const auto count = static_cast<int>(result.planes.size());
    if (count < 3 || result.joint.signature.empty())
        return;
    if (result.joint.rank < count) {
        out.emplace_back("{} planes {} make {} independent imbalances: the form is judged "
                         "on those, the other eigenvalues are zero.",
                         count, rigid ? "of a rigid rotor" : "of which some coincide",
                         result.joint.rank);
        return;
    }
    std::vector<double> sizes; // of the largest eigenvalue over the largest modulus
    std::vector<const results::SignaturePoint *>
        points; // where the rigid form is definite, this one not
    for (const results::SignaturePoint &point : result.joint.signature)
        if (rigid_says_on(result.joint.bands, point.speed) &&
            point.negative < static_cast<int>(point.eigenvalues.size())) {
            points.push_back(&point);
            sizes.push_back(std::abs(point.relative));
        }
    if (points.empty())
        return;
    const results::SignaturePoint &middle = *points[points.size() / 2];
    std::vector<double> shape;
    for (const std::complex<double> &s : middle.worst)
        shape.push_back(s.real());
    out.emplace_back(
        "With {} planes the form is not definite where the rigid one is: at {} {} of {} "
        "eigenvalues are negative and the largest is {}. Over that range it is {} of the largest "
        "modulus: imbalances ({}) that make little resultant force and bend the shaft.",
        count, as::speed(middle.speed), middle.negative, middle.eigenvalues.size(),
        as::inverse_mass(middle.eigenvalues.back(), 3).with_sign(),
        as::number.range(std::ranges::min(sizes), std::ranges::max(sizes), 2),
        as::number.list(shape, 2).with_sign());
}

void without_bands(const results::BalanceResult &result, std::vector<results::Sentence> &out) {
    if (!result.joint.bands.bands.empty() || result.planes.size() < 2)
        return;
    if (result.rigid && result.rigid->type != "long")
        out.emplace_back("No joint band: the rotor is {} (A = {}{}, C = {}), and several planes "
                         "cannot balance it dynamically.",
                         result.rigid->type, as::inertia(result.rigid->diametral, 4),
                         result.rigid->anisotropy > 0
                             ? Sentence(" ∓ {}", as::inertia(result.rigid->anisotropy, 4))
                             : Sentence(),
                         as::inertia(result.rigid->polar, 4));
    else if (!result.joint.bands.rigid_bands || result.joint.bands.rigid_bands->empty())
        out.emplace_back("No joint band in this range of speeds.");
}

double width_of(const std::vector<results::Interval> &bands) {
    double width = 0;
    for (const results::Interval &band : bands)
        width += band.to - band.from;
    return width;
}

/// How much of `a` lies in `b`.
double common_width(const std::vector<results::Interval> &a,
                    const std::vector<results::Interval> &b) {
    double width = 0;
    for (const results::Interval &x : a)
        for (const results::Interval &y : b)
            width += std::max(0.0, std::min(x.to, y.to) - std::max(x.from, y.from));
    return width;
}

/// The criterion (balancers without mass) against the real ones at their balanced position.
void real_balancers(const results::BalanceResult &result, bool damped,
                    std::vector<results::Sentence> &out) {
    if (!result.balanced_position)
        return;
    if (result.balanced_position->all_imbalances)
        out.emplace_back("The balanced position is the one that all imbalances together ask for, "
                         "elsewhere at every speed.");
    const std::vector<results::Interval> &criterion = result.joint.bands.bands;
    const std::vector<results::Interval> &real = result.balanced_position->bands;
    if (real.empty() && !damped) {
        out.emplace_back("With the real balancers the balanced position is stable nowhere: the "
                         "bearings have no damping, and the balls' drag, which turns with the "
                         "rotor, acts as internal damping.");
        return;
    }
    if (result.pendulum.size() == result.planes.size()) { // they reduce, and balance nothing
        out.emplace_back(
            "With the pendulums free and outwards, small motions die out over {} of the range.",
            as::speed(width_of(real), 4));
        return;
    }
    const double both = common_width(criterion, real);
    if (real.empty()) {
        out.emplace_back("With the real balancers the balanced position is stable nowhere in this "
                         "range{}",
                         criterion.empty()
                             ? ", as the criterion says."
                             : ", where the criterion, for balancers without mass, holds: lighter "
                               "balls or more damping in the bearings bring the two together.");
        return;
    }
    Sentence text(
        "With the real balancers the balanced position is stable over {} of the range, the "
        "criterion holds over {}, both over {}.",
        as::speed(width_of(real), 4), as::speed(width_of(criterion), 4), as::speed(both, 4));
    if (both < 0.98 * width_of(criterion))
        text += " Where the criterion holds and the real balancers fail, their mass shifts the "
                "critical speeds and their drag drives the rotor just above them.";
    if (both < 0.98 * width_of(real))
        text += " Where only the real balancers hold, damping keeps them: the criterion asks for "
                "every kind of balancer.";
    if (result.balanced_position->arrangements > 1)
        text += Sentence(" Over {} arrangements of the balls: stable with every one over {}, with "
                         "some over {}.",
                         result.balanced_position->arrangements,
                         as::speed(width_of(result.balanced_position->with_every), 4),
                         as::speed(width_of(result.balanced_position->with_some), 4));
    out.push_back(text);
}

/// Where balancers of any kind do work, whether these come to rest.
void light_balancers(const results::BalanceResult &result, std::vector<results::Sentence> &out) {
    if (!result.first_order)
        return;
    const std::vector<results::Interval> &criterion = result.joint.bands.bands;
    const double both = common_width(criterion, result.first_order->bands);
    if (both < 0.98 * width_of(criterion))
        out.emplace_back("Where the criterion holds the balancers' own motions, to first order in "
                         "their mass, die out over {} of {}: elsewhere they need more drag, or "
                         "less mass.",
                         as::speed(both, 4), as::speed(width_of(criterion), 4));
}

/// Why a motion in time ended otherwise than the eigenvalues of the balanced position promise.
Sentence reason(const results::SimulatedSpeed &run, double time) {
    if (!run.growth)
        return Sentence("{}", run.outcome);
    constexpr double slow = 5; // e-fold changes that a motion needs to get somewhere
    Sentence text("{}, growth {}", run.outcome, as::rate(*run.growth, 2).with_sign());
    if (std::abs(*run.growth) * time < slow)
        text += Sentence(": too slow to be seen in {}", as::time(time, 3));
    else
        text += run.outcome == "balanced" ? ": another motion near the balanced one"
                                          : ": this start leads to another motion";
    return text;
}

/// Motions in time against what the eigenvalues of the balanced position promise.
void motions_in_time(const results::BalanceResult &result, double time,
                     std::vector<results::Sentence> &out) {
    if (result.simulated.empty() || !result.balanced_position)
        return;
    int agree = 0;
    std::vector<Sentence> others;
    for (const results::SimulatedSpeed &run : result.simulated) {
        const bool stable =
            std::ranges::any_of(result.balanced_position->bands, [&](const results::Interval &b) {
                return run.speed > b.from && run.speed < b.to;
            });
        if (stable == (run.outcome == "balanced"))
            ++agree;
        else
            others.emplace_back("{} ({})", as::speed(run.speed), reason(run, time));
    }
    out.emplace_back(
        "Of {} motions in time {} end as the eigenvalues promise{}.", result.simulated.size(),
        agree, others.empty() ? Sentence() : Sentence("; otherwise at {}", joined(others, ", ")));
}

/// n < 1 is not enough: where the motion of least deflection is unstable.
void pendulums(const results::BalanceResult &result, std::vector<results::Sentence> &out) {
    for (const results::PendulumBalance &p : result.pendulum) {
        int helps = 0;
        std::vector<double> unstable; // speeds, rad/s
        for (std::size_t k = 0; k < p.speeds.size(); ++k) {
            if (p.states[k].empty() || p.states[k].front().ratio >= 1)
                continue;
            ++helps;
            if (!p.states[k].front().stable)
                unstable.push_back(p.speeds[k]);
        }
        Sentence text("The pendulums at z = {} reduce the deflection at {} of {} speeds (planar "
                      "theory: above {})",
                      as::length(p.z, 4), helps, p.speeds.size(),
                      as::speed(p.threshold * p.omega_0));
        if (!unstable.empty())
            text +=
                Sentence("; at {} of them, from {}, that motion is unstable and will not be seen",
                         unstable.size(), as::speed.range(unstable.front(), unstable.back()));
        out.emplace_back("{}.", text);
    }
}

/// What each plane needs at most where the balancers work, against what there is.
void needs(const results::BalanceResult &result, std::vector<results::Sentence> &out) {
    if (!result.supply)
        return;
    const results::BalanceSupply &supply = *result.supply;
    for (std::size_t p = 0; p < supply.planes.size(); ++p) {
        const results::PlaneSupply &plane = supply.planes[p];
        double need = -1;
        double least = 0;
        double speed = 0;
        int speeds = 0;
        for (std::size_t k = 0; k < plane.needed.size(); ++k) {
            if (!supply.works[k] || !plane.needed[k])
                continue;
            const double own = std::abs(*plane.needed[k]);
            least = speeds++ == 0 ? own : std::min(least, own);
            if (own > need) {
                need = own;
                speed = result.speeds[k];
            }
        }
        if (need < 0)
            continue;
        // Of a rigid rotor it is: near a resonance its rounding grows to some 1e-10.
        constexpr double constant = 1e-8;
        const Sentence plane_here = plane_text(result.planes[p], p);
        Sentence text = speeds > 1 && need - least <= constant * need
                            ? Sentence("Where the criterion holds, {} needs {}, the same at all "
                                       "these speeds",
                                       plane_here, as::imbalance(need, 4))
                            : Sentence("Where the criterion holds, {} needs at most {}, at {}",
                                       plane_here, as::imbalance(need, 4), as::speed(speed));
        constexpr double just = 1e-12; // an input may ask for just the capacity
        if (plane.capacity && *plane.capacity > 0)
            text += need > *plane.capacity * (1 + just)
                        ? Sentence(": more than the {} that its balancer can supply",
                                   as::imbalance(*plane.capacity, 4))
                        : Sentence(": {} % of the {} that its balancer can supply",
                                   as::number(100 * need / *plane.capacity, 3),
                                   as::imbalance(*plane.capacity, 4));
        out.emplace_back("{}.", text);
    }
}

/// Races whose centre, which balls bring to rest, is not on the axis.
void eccentric_races(const model::Rotor &rotor, std::vector<results::Sentence> &out) {
    for (std::size_t i = 0; i < rotor.balancers.size(); ++i) {
        const model::Balancer &balancer = rotor.balancers[i];
        const std::complex<double> centre = balancers::kind_of(balancer)->race_centre();
        if (centre != 0.0)
            out.emplace_back("The race of {} is off the axis by {}: its balls bring its centre to "
                             "rest, and its plane keeps whirling by that much where they do. What "
                             "is needed of them counts it.",
                             model::name_or_number(balancer.name, "balancer", i),
                             as::amplitude(std::abs(centre), 4));
    }
}

} // namespace

std::vector<results::Sentence> balance_findings(const results::BalanceResult &result,
                                                const model::Case &scene) {
    std::vector<results::Sentence> out;
    if (scene.speeds->to <= scene.speeds->from || scene.speeds->count < 2) {
        needs(result, out);
        eccentric_races(scene.rotor, out);
        return out;
    }
    joint_ends(result, out);
    without_bands(result, out);
    excess_planes(result, scene.rotor.shaft.rigid, out);
    plane_ends(result, out);
    directions(result, out);
    light_balancers(result, out);
    real_balancers(result, scene.rotor.damped(), out);
    needs(result, out);
    eccentric_races(scene.rotor, out);
    motions_in_time(result, scene.simulate.time, out);
    pendulums(result, out);
    return out;
}

} // namespace whirl::analyses

#include "analyses/balance.h"

#include "results/formulation.h"
#include "results/sentence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::analyses {

namespace {

std::string speed_text(double speed) { return fmt::format("{:.6g} rad/s", speed); }

std::string plane_text(const results::BalancePlane &plane, std::size_t index) {
    return plane.name.empty() ? fmt::format("plane {} (z = {:.4g} m)", index + 1, plane.z)
                              : fmt::format("{} (z = {:.4g} m)", plane.name, plane.z);
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
        std::string text =
            fmt::format("The {}band ends at {}", result.planes.size() == 1 ? "" : "joint ",
                        speed_text(end.speed));
        if (end.pinned)
            text +=
                fmt::format(", the critical speed of the rotor pinned {} (the pinned eigenproblem "
                            "agrees to {:.0e})",
                            where, std::abs(*end.pinned / end.speed - 1) + 1e-16);
        if (rigid_says_on(result.joint.bands, end.speed) && !end.rigid)
            text += result.model.formulation.form == results::Form::planar
                        ? "; the rigid form knows no such end: the shaft bends between the planes"
                        : "; the rigid form, with isotropic bearings, knows no such end";
        out.push_back(text + ".");
    }
}

/// One sentence a plane: its additional speeds, beside the rigid ones.
void plane_ends(const results::BalanceResult &result, std::vector<results::Sentence> &out) {
    for (std::size_t i = 0; i < result.planes.size() && result.planes.size() > 1; ++i) {
        std::string text;
        bool pinned = true;
        for (const results::BandEnd &end : result.planes[i].bands.ends) {
            if (!end.upper)
                continue;
            pinned = pinned && end.pinned;
            text += fmt::format("{}{:.6g} rad/s", text.empty() ? "" : " and ", end.speed);
            if (end.rigid && end.relative_difference)
                text += fmt::format(" (rigid {:.6g} rad/s, {:+.2g} %)", *end.rigid,
                                    100 * *end.relative_difference);
            else if (result.rigid)
                text += " (rigid: no end)";
        }
        if (!text.empty())
            out.push_back(fmt::format("{} alone works up to {}{}.", plane_text(result.planes[i], i),
                                      text,
                                      pinned ? ", where the rotor pinned there is critical" : ""));
    }
}

/// More planes than rigid motions: the form of a flexible rotor is indefinite by a little.
void excess_planes(const results::BalanceResult &result, bool rigid,
                   std::vector<results::Sentence> &out) {
    const auto count = static_cast<int>(result.planes.size());
    if (count < 3 || result.joint.signature.empty())
        return;
    if (result.joint.rank < count) {
        out.push_back(fmt::format("{} planes {} make {} independent imbalances: the form is judged "
                                  "on those, the other eigenvalues are zero.",
                                  count, rigid ? "of a rigid rotor" : "of which some coincide",
                                  result.joint.rank));
        return;
    }
    std::vector<double> sizes; // of the largest eigenvalue over the largest modulus
    std::vector<const results::SignaturePoint *>
        points; // where the rigid form is definite, this one not
    for (const results::SignaturePoint &point : result.joint.signature)
        if (rigid_says_on(result.joint.bands, point.speed) && point.negative < count) {
            points.push_back(&point);
            sizes.push_back(std::abs(point.relative));
        }
    if (points.empty())
        return;
    const results::SignaturePoint &middle = *points[points.size() / 2];
    std::string shape;
    for (const std::complex<double> &s : middle.worst)
        shape += fmt::format("{}{:+.2f}", shape.empty() ? "" : ", ", s.real());
    out.push_back(fmt::format(
        "With {} planes the form is not definite where the rigid one is: at {} {} of {} "
        "eigenvalues are negative and the largest is {:+.3g}/kg. Over that range it is {:.1e} to "
        "{:.1e} of the largest modulus: imbalances ({}) that make little resultant force and bend "
        "the shaft.",
        count, speed_text(middle.speed), middle.negative, count, middle.eigenvalues.back(),
        std::ranges::min(sizes), std::ranges::max(sizes), shape));
}

void without_bands(const results::BalanceResult &result, std::vector<results::Sentence> &out) {
    if (!result.joint.bands.bands.empty() || result.planes.size() < 2)
        return;
    if (result.rigid && result.rigid->type != "long")
        out.push_back(fmt::format("No joint band: the rotor is {} (A = {:.4g}, C = {:.4g} kg m2), "
                                  "and several planes cannot balance it dynamically.",
                                  result.rigid->type, result.rigid->diametral,
                                  result.rigid->polar));
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
    const std::vector<results::Interval> &criterion = result.joint.bands.bands;
    const std::vector<results::Interval> &real = result.balanced_position->bands;
    if (real.empty() && !damped) {
        out.emplace_back("With the real balancers the balanced position is stable nowhere: the "
                         "bearings have no damping, and the balls' drag, which turns with the "
                         "rotor, acts as internal damping.");
        return;
    }
    if (result.pendulum.size() == result.planes.size()) { // they reduce, and balance nothing
        out.push_back(
            fmt::format("With the pendulums free and outwards, small motions die out over "
                        "{:.4g} rad/s of the range.",
                        width_of(real)));
        return;
    }
    const double both = common_width(criterion, real);
    if (real.empty()) {
        out.push_back(std::string("With the real balancers the balanced position is stable nowhere "
                                  "in this range") +
                      (criterion.empty() ? ", as the criterion says."
                                         : ", where the criterion, for balancers without mass, "
                                           "holds: lighter balls or more damping in the bearings "
                                           "bring the two together."));
        return;
    }
    std::string text = fmt::format(
        "With the real balancers the balanced position is stable over {:.4g} rad/s of the range, "
        "the criterion holds over {:.4g} rad/s, both over {:.4g} rad/s.",
        width_of(real), width_of(criterion), both);
    if (both < 0.98 * width_of(criterion))
        text += " Where the criterion holds and the real balancers fail, their mass shifts the "
                "critical speeds and their drag drives the rotor just above them.";
    if (both < 0.98 * width_of(real))
        text += " Where only the real balancers hold, damping keeps them: the criterion asks for "
                "every kind of balancer.";
    if (result.balanced_position->arrangements > 1)
        text += fmt::format(" Over {} arrangements of the balls: stable with every one over {:.4g} "
                            "rad/s, with some over {:.4g} rad/s.",
                            result.balanced_position->arrangements,
                            width_of(result.balanced_position->with_every),
                            width_of(result.balanced_position->with_some));
    out.push_back(text);
}

/// Why a motion in time ended otherwise than the eigenvalues of the balanced position promise.
std::string reason(const results::SimulatedSpeed &run, double time) {
    if (!run.growth)
        return run.outcome;
    constexpr double slow = 5; // e-fold changes that a motion needs to get somewhere
    std::string text = fmt::format("{}, growth {:+.2g} 1/s", run.outcome, *run.growth);
    if (std::abs(*run.growth) * time < slow)
        text += fmt::format(": too slow to be seen in {:.3g} s", time);
    else
        text += run.outcome == "balanced" ? ": another motion near the balanced one"
                                          : ": this start leads to a motion beside it";
    return text;
}

/// Motions in time against what the eigenvalues of the balanced position promise.
void motions_in_time(const results::BalanceResult &result, double time,
                     std::vector<results::Sentence> &out) {
    if (result.simulated.empty() || !result.balanced_position)
        return;
    int agree = 0;
    std::string other;
    for (const results::SimulatedSpeed &run : result.simulated) {
        const bool stable =
            std::ranges::any_of(result.balanced_position->bands, [&](const results::Interval &b) {
                return run.speed > b.from && run.speed < b.to;
            });
        if (stable == (run.outcome == "balanced"))
            ++agree;
        else
            other += fmt::format("{}{:.6g} rad/s ({})", other.empty() ? "" : ", ", run.speed,
                                 reason(run, time));
    }
    std::string text = fmt::format("Of {} motions in time {} end as the eigenvalues promise",
                                   result.simulated.size(), agree);
    out.push_back(other.empty() ? text + "." : text + "; otherwise at " + other + ".");
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
        std::string text =
            fmt::format("The pendulums at z = {:.4g} m reduce the deflection at {} "
                        "of {} speeds (planar theory: above {})",
                        p.z, helps, p.speeds.size(), speed_text(p.threshold * p.omega_0));
        if (!unstable.empty())
            text += fmt::format("; at {} of them, from {:.6g} to {:.6g} rad/s, that motion is "
                                "unstable and will not be seen",
                                unstable.size(), unstable.front(), unstable.back());
        out.push_back(text + ".");
    }
}

} // namespace

std::vector<results::Sentence> balance_findings(const results::BalanceResult &result,
                                                const model::Case &scene) {
    std::vector<results::Sentence> out;
    if (scene.speeds->to <= scene.speeds->from || scene.speeds->count < 2)
        return out;
    joint_ends(result, out);
    without_bands(result, out);
    excess_planes(result, scene.rotor.shaft.rigid, out);
    plane_ends(result, out);
    real_balancers(result, scene.rotor.damped(), out);
    motions_in_time(result, scene.simulate.time, out);
    pendulums(result, out);
    return out;
}

} // namespace whirl::analyses

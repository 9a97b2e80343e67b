#include "operation/margins.h"

#include "model/rpm.h"
#include "results/resonances.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace whirl::operation {

namespace {

using results::Sentence;
namespace as = results::as;

using results::CriticalSpeed;
using results::MarginSide;
using results::ResponsePeak;
using results::SeparationMargin;
using results::Whirl;

constexpr double counted_from = results::Damping::least_amplification;
constexpr double most_below = 16; ///< %
constexpr double more_above = 10; ///< %
constexpr double half_power = 17; ///< %
constexpr double most_above = most_below + more_above;

bool counts(const std::optional<double> &amplification) {
    return !amplification || *amplification >= counted_from;
}

/// The peaks that are judged: what probes see, where there are any.
std::vector<const ResponsePeak *> judged(const std::vector<ResponsePeak> &peaks) {
    const bool probes = std::ranges::find(peaks, "probe", &ResponsePeak::of) != peaks.end();
    std::vector<const ResponsePeak *> out;
    for (const ResponsePeak &peak : peaks)
        if (peak.speed > 0 && peak.of == (probes ? "probe" : "station"))
            out.push_back(&peak);
    return out;
}

/// A peak without limit has none; one whose half-power points are not both known no factor.
bool has_factor(const ResponsePeak &peak) { return std::isinf(peak.value) || peak.amplification; }

bool together(const ResponsePeak &peak, const CriticalSpeed &critical) {
    return results::within_width(peak.speed, peak.amplification, critical.speed,
                                 critical.damping.amplification);
}

/// What an imbalance excites: a critical speed, or none of the list, and the peaks that are its.
struct Resonance {
    const CriticalSpeed *critical = nullptr;
    std::vector<const ResponsePeak *> peaks{};
};

/// The one of some critical speeds that a peak belongs to, or none.
Resonance *nearest(const ResponsePeak &peak, std::vector<Resonance> &excited) {
    Resonance *best = nullptr;
    const auto distance = [&peak](const Resonance &resonance) {
        return std::abs(peak.speed - resonance.critical->speed);
    };
    for (Resonance &resonance : excited)
        if (together(peak, *resonance.critical) && (!best || distance(resonance) < distance(*best)))
            best = &resonance;
    return best;
}

/// A free motion that grows there: a steady response, and its amplification, is not what the rotor
/// does, and no distance from the operating speeds is enough.
bool grows(const CriticalSpeed &critical) { return critical.damping.ratio.value_or(0) < 0; }

SeparationMargin of_peak(const ResponsePeak &peak, const CriticalSpeed *critical,
                         const model::Operation &operation) {
    SeparationMargin out = margin_of(
        peak.speed, std::isinf(peak.value) ? std::nullopt : peak.amplification, operation);
    out.source = "response";
    out.of = peak.of;
    out.z = peak.z;
    out.name = peak.name;
    out.angle = peak.angle;
    if (critical) {
        out.whirl = critical->whirl;
        out.plane = critical->plane;
    }
    return out;
}

/// A free motion grows: it has no factor and does not pass.
void fail(SeparationMargin &margin, const model::Operation &operation) {
    if (margin.side != MarginSide::inside)
        margin.required = margin_of(margin.speed, std::nullopt, operation).required;
    margin.amplification.reset();
    margin.grows = true;
    margin.passes = false;
}

SeparationMargin of_damping(const CriticalSpeed &critical, const model::Operation &operation) {
    SeparationMargin out = margin_of(critical.speed, critical.damping.amplification, operation);
    out.source = "damping";
    out.whirl = critical.whirl;
    out.plane = critical.plane;
    return out;
}

/// Of the peaks of one resonance: of each probe its largest, the one that reads most first; of
/// stations, whose peaks differ in nothing that is measured, the largest alone.
std::vector<const ResponsePeak *> one_a_probe(std::vector<const ResponsePeak *> peaks) {
    std::ranges::stable_sort(peaks, std::greater{}, &ResponsePeak::value);
    std::vector<const ResponsePeak *> out;
    const auto same_probe = [](const ResponsePeak *a, const ResponsePeak *b) {
        return a->of != "probe" || a->place == b->place;
    };
    for (const ResponsePeak *peak : peaks)
        if (std::ranges::none_of(
                out, [&](const ResponsePeak *other) { return same_probe(peak, other); }))
            out.push_back(peak);
    return out;
}

/// Its margins, the one that counts first; none of what is critically damped.
std::vector<SeparationMargin> margins_of(const Resonance &resonance,
                                         const model::Operation &operation) {
    const CriticalSpeed *critical = resonance.critical;
    std::vector<SeparationMargin> out;
    for (const ResponsePeak *peak : one_a_probe(resonance.peaks))
        out.push_back(of_peak(*peak, critical, operation));
    if (out.empty() && critical && critical->whirl != Whirl::backward && critical->damping.known())
        out.push_back(of_damping(*critical, operation));
    if (critical && grows(*critical))
        for (SeparationMargin &margin : out)
            fail(margin, operation);
    std::erase_if(out, [](const SeparationMargin &m) { return !counts(m.amplification); });
    return out;
}

} // namespace

double required_margin(std::optional<double> amplification, MarginSide side) {
    if (!counts(amplification) || side == MarginSide::inside)
        return 0;
    const double by_factor = half_power * (amplification ? 1 - 1 / (*amplification - 1.5) : 1.0);
    return side == MarginSide::below ? std::min(by_factor, most_below)
                                     : std::min(more_above + by_factor, most_above);
}

SeparationMargin margin_of(double speed, std::optional<double> amplification,
                           const model::Operation &operation) {
    SeparationMargin out;
    out.speed = speed;
    out.amplification = amplification;
    if (speed < operation.from) {
        out.side = MarginSide::below;
        out.found = 100 * (operation.from - speed) / operation.from;
    } else if (speed > operation.to) {
        out.side = MarginSide::above;
        out.found = 100 * (speed - operation.to) / operation.to;
    }
    if (out.side == MarginSide::inside) {
        out.passes = !counts(amplification);
        return out;
    }
    out.required = required_margin(amplification, out.side);
    const bool reached = out.side == MarginSide::above && speed <= operation.trip.value_or(0);
    out.passes = out.found >= *out.required && !(reached && counts(amplification));
    return out;
}

double lowest_relevant_speed(const model::Operation &operation) {
    return operation.from * (1 - most_below / 100);
}

double highest_relevant_speed(const model::Operation &operation) {
    return std::max(operation.to * (1 + most_above / 100), operation.trip.value_or(0));
}

std::vector<const ResponsePeak *>
peaks_without_factor(const model::Operation &operation,
                     const std::vector<CriticalSpeed> &critical_speeds,
                     const std::vector<ResponsePeak> &peaks) {
    const bool unknown = std::ranges::any_of(
        critical_speeds, [](const CriticalSpeed &critical) { return !critical.damping.known(); });
    std::vector<const ResponsePeak *> out;
    for (const ResponsePeak *peak : judged(peaks))
        if (!has_factor(*peak) && peak->speed > lowest_relevant_speed(operation) &&
            peak->speed < highest_relevant_speed(operation) &&
            (unknown || critical_speeds.empty() ||
             std::ranges::any_of(critical_speeds, [peak](const CriticalSpeed &critical) {
                 return critical.damping.known() && counts(critical.damping.amplification) &&
                        together(*peak, critical);
             })))
            out.push_back(peak);
    return out;
}

namespace {

/// The largest peak that is judged and belongs to a critical speed, or none.
const ResponsePeak *peak_of(const CriticalSpeed &critical, const std::vector<ResponsePeak> &peaks) {
    const ResponsePeak *largest = nullptr;
    for (const ResponsePeak *peak : judged(peaks))
        if (has_factor(*peak) && together(*peak, critical) &&
            (!largest || peak->value > largest->value))
            largest = peak;
    return largest;
}

Sentence about(const ResponsePeak &peak) {
    const Sentence where("at {}{}", as::speed(peak.speed),
                         peak.name.empty() ? std::string() : " of " + peak.name);
    return counts(peak.amplification)
               ? Sentence("the nearest response peak, {}, belongs to another critical "
                          "speed",
                          where)
               : Sentence("its response peak, {}, has an amplification factor of {}, "
                          "below {}",
                          where, as::number(*peak.amplification, 4), as::number(counted_from));
}

bool among(const CriticalSpeed &critical, const std::vector<const CriticalSpeed *> &listed) {
    return std::ranges::find(listed, &critical) != listed.end();
}

/// Says of critical speeds with AF >= 2.5 by their damping, up to the highest speed that matters,
/// why they have no margin: the peak of the response that is theirs shows less, or they whirl
/// backward and have none.
/// @param listed  those with margins
void note_unlisted(const model::Operation &operation, const std::vector<Resonance> &excited,
                   const std::vector<ResponsePeak> &peaks,
                   const std::vector<const CriticalSpeed *> &listed,
                   std::vector<results::Sentence> &notes) {
    for (const Resonance &resonance : excited) {
        const CriticalSpeed &critical = *resonance.critical;
        if (critical.speed > highest_relevant_speed(operation) || !critical.damping.known() ||
            !counts(critical.damping.amplification) || grows(critical) || among(critical, listed))
            continue;
        const ResponsePeak *peak = peak_of(critical, peaks);
        const Sentence factor = critical.damping.amplification
                                    ? Sentence("{}", as::number(*critical.damping.amplification, 4))
                                    : Sentence("without limit");
        notes.emplace_back("margins: none is stated for the {} critical speed {} "
                           "(amplification factor {} by its damping): {}",
                           results::whirl_name(critical.whirl), as::speed(critical.speed), factor,
                           peak ? about(*peak)
                                : Sentence("it has no peak of its own in the response"));
    }
}

/// Says which critical speeds have no amplification factor because the motion grows.
/// @param listed  those with margins
void note_growing(const std::vector<CriticalSpeed> &critical_speeds,
                  const std::vector<const CriticalSpeed *> &listed,
                  std::vector<results::Sentence> &notes) {
    for (const CriticalSpeed &critical : critical_speeds)
        if (critical.speed > 0 && grows(critical))
            notes.emplace_back(model::Weight::warning,
                               "margins: the {} mode is unstable at its critical speed {} "
                               "(damping ratio {}): it has no amplification factor and {}; "
                               "`stability` finds the onset speed",
                               results::whirl_name(critical.whirl), as::speed(critical.speed),
                               as::number(*critical.damping.ratio, 4),
                               among(critical, listed) ? "fails whatever its margin"
                                                       : "no margin, as imbalance does not "
                                                         "excite it");
}

/// Names the probes whose peak at a critical speed with AF >= 2.5 has no factor of its own.
void note_without_factor(const std::vector<CriticalSpeed> &critical_speeds,
                         const std::vector<ResponsePeak> &peaks,
                         std::vector<results::Sentence> &notes) {
    for (const ResponsePeak *peak : judged(peaks))
        if (peak->of == "probe" && !has_factor(*peak) &&
            std::ranges::any_of(critical_speeds, [&](const auto &critical) {
                return critical.damping.known() && counts(critical.damping.amplification) &&
                       together(*peak, critical);
            }))
            notes.emplace_back("margins: none is stated for the peak of probe {}, {}: the "
                               "curve does not fall to the half-power points on both sides "
                               "(other excitation, or the end of [speeds] is too near)",
                               peak->name.empty() ? Sentence("at z = {}", as::length(peak->z))
                                                  : Sentence("{}", peak->name),
                               as::speed(peak->speed));
}

/// Says so where the damping of critical speeds is not known (asymmetric damped rotors): margins
/// are then those of the peaks of the response alone.
void note_unknown_damping(const std::vector<CriticalSpeed> &critical_speeds,
                          std::vector<results::Sentence> &notes) {
    if (std::ranges::any_of(critical_speeds, [](const CriticalSpeed &critical) {
            return !critical.damping.known();
        }))
        notes.emplace_back(model::Weight::information,
                           "margins: judged by response peaks alone, as the damping of "
                           "the critical speeds of this rotor is not known");
}

} // namespace

std::vector<SeparationMargin> separation_margins(const model::Operation &operation,
                                                 const std::vector<CriticalSpeed> &critical_speeds,
                                                 const std::vector<ResponsePeak> &peaks,
                                                 bool backward_too,
                                                 std::vector<results::Sentence> &notes) {
    constexpr double one = 1e-9; // the same motion in two directions counts once
    std::vector<Resonance> excited;
    for (const CriticalSpeed &critical : critical_speeds)
        if (critical.speed > 0 && (backward_too || critical.whirl != Whirl::backward))
            if (excited.empty() || critical.speed > excited.back().critical->speed * (1 + one))
                excited.push_back({&critical});
    std::vector<const ResponsePeak *> strays; // of no critical speed
    for (const ResponsePeak *peak : judged(peaks)) {
        if (!has_factor(*peak))
            continue;
        Resonance *resonance = nearest(*peak, excited);
        (resonance ? resonance->peaks : strays).push_back(peak);
    }
    std::vector<Resonance> resonances;
    for (auto &of_one : results::of_one_resonance_each(std::move(strays)))
        resonances.push_back({nullptr, std::move(of_one)});
    resonances.insert(resonances.end(), excited.begin(), excited.end());
    std::vector<std::vector<SeparationMargin>> groups; // of one resonance each
    std::vector<const CriticalSpeed *> listed;
    for (const Resonance &resonance : resonances)
        if (auto group = margins_of(resonance, operation); !group.empty()) {
            groups.push_back(std::move(group));
            listed.push_back(resonance.critical);
        }
    std::ranges::stable_sort(groups, {}, [](const auto &group) { return group.front().speed; });
    std::vector<SeparationMargin> out;
    for (const auto &group : groups)
        out.insert(out.end(), group.begin(), group.end());
    note_growing(critical_speeds, listed, notes);
    note_unlisted(operation, excited, peaks, listed, notes);
    note_without_factor(critical_speeds, peaks, notes);
    note_unknown_damping(critical_speeds, notes);
    return out;
}

} // namespace whirl::operation

#include "results/resonances.h"

#include "results/damping.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace whirl::results {

namespace {

using Peaks = std::vector<const ResponsePeak *>;

int rank(const ResponsePeak &peak) { return peak.of == "station" ? 0 : peak.of == "probe" ? 1 : 2; }

bool same_place(const ResponsePeak &a, const ResponsePeak &b) {
    return a.of == b.of && a.place == b.place;
}

bool may_be_one(const ResponsePeak &peak, const Peaks &taken) {
    const ResponsePeak &first = *taken.front();
    return within_width(peak.speed, peak.amplification, first.speed, first.amplification) &&
           std::ranges::none_of(taken, [&peak](const ResponsePeak *other) {
               return same_place(peak, *other) ||
                      (!peak.mode.empty() && !other->mode.empty() && peak.mode != other->mode);
           });
}

/// Without half-power points on both sides: beside a higher peak of the same place on a side where
/// there is none, or neither falling that far nor rising to another peak there.
PeakKind without_factor(const ResponsePeak &peak, const std::vector<ResponsePeak> &all) {
    const bool beside_higher = std::ranges::any_of(all, [&peak](const ResponsePeak &other) {
        return same_place(peak, other) && other.value > peak.value &&
               !(other.speed < peak.speed ? peak.lower : peak.upper);
    });
    return beside_higher ? PeakKind::flank : PeakKind::plateau;
}

/// The largest of those with a factor, of the first kind that has one; none: no resonance.
const ResponsePeak *judged_by(const Peaks &peaks) {
    for (const ResponsePeak *peak : peaks)
        if (peak->amplification || std::isinf(peak->value))
            return peak;
    return nullptr;
}

} // namespace

bool within_width(double speed, std::optional<double> factor, double other_speed,
                  std::optional<double> other_factor) {
    constexpr double rounding = 1e-3; // of sharp resonances: far narrower than they are apart
    double sharpness = 1 / rounding;
    for (const auto &each : {factor, other_factor})
        if (each)
            sharpness = std::min(sharpness, *each);
    return std::abs(std::log(speed / other_speed)) <= 1 / sharpness;
}

std::vector<Peaks> of_one_resonance_each(Peaks peaks) {
    std::ranges::stable_sort(peaks, [](const ResponsePeak *a, const ResponsePeak *b) {
        return rank(*a) != rank(*b) ? rank(*a) < rank(*b) : a->value > b->value;
    });
    std::vector<Peaks> out;
    for (const ResponsePeak *peak : peaks) {
        const auto distance = [peak](const Peaks &taken) {
            return std::abs(std::log(taken.front()->speed / peak->speed));
        };
        Peaks *nearest = nullptr;
        for (Peaks &taken : out)
            if (may_be_one(*peak, taken) && (!nearest || distance(taken) < distance(*nearest)))
                nearest = &taken;
        (nearest ? *nearest : out.emplace_back()).push_back(peak);
    }
    return out;
}

std::vector<Resonance> resonances_of(std::vector<ResponsePeak> &peaks) {
    Peaks all;
    for (ResponsePeak &peak : peaks) {
        peak.kind = without_factor(peak, peaks);
        peak.resonance.reset();
        all.push_back(&peak);
    }
    std::vector<Resonance> out;
    for (const Peaks &group : of_one_resonance_each(all)) {
        const ResponsePeak *leader = judged_by(group);
        if (leader == nullptr)
            continue;
        Resonance resonance{.peak = *leader, .peaks = {}};
        resonance.peak.kind = leader->amplification.value_or(Damping::least_amplification) <
                                      Damping::least_amplification
                                  ? PeakKind::heavily_damped
                                  : PeakKind::resonance;
        for (const ResponsePeak *peak : group)
            resonance.peaks.push_back(static_cast<std::size_t>(peak - peaks.data()));
        std::ranges::sort(resonance.peaks);
        out.push_back(std::move(resonance));
    }
    std::ranges::stable_sort(out, {}, [](const Resonance &one) { return one.peak.speed; });
    for (std::size_t i = 0; i < out.size(); ++i)
        for (const std::size_t peak : out[i].peaks) {
            peaks[peak].kind = out[i].peak.kind;
            peaks[peak].resonance = i;
        }
    return out;
}

} // namespace whirl::results

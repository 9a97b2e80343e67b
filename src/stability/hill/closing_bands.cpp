#include "stability/hill/closing_bands.h"

#include "periodic/neutral.h"
#include "stability/hill/periodic_motions.h"

#include <algorithm>
#include <array>
#include <memory>

namespace whirl::stability {

namespace {

/// Bands, with what grows in them by the motions of the reduced rotor.
std::vector<periodic::OpenBand> open_bands(const PeriodicMotions &motions,
                                           const std::vector<results::Interval> &bands) {
    std::vector<periodic::OpenBand> out;
    for (const auto &[from, to] : bands) {
        const double middle = (from + to) / 2;
        const PeriodicMotions::Listed &fastest = motions.fastest_growing(middle);
        out.push_back({middle, to - from, fastest.motion.value, fastest.frequency});
    }
    return out;
}

} // namespace

bool bands_can_be_followed(const BandFinder &finder) {
    const PeriodicMotions *motions = finder.hill() ? finder.hill()->by_monodromy() : nullptr;
    return motions != nullptr && motions->whole() != nullptr && finder.model().rotor.damped();
}

std::optional<double> closing_anisotropy(const std::function<StabilityModel(double dI)> &with,
                                         double given, const BandFinder &finder,
                                         std::vector<results::Interval> bands,
                                         const std::vector<double> &speeds) {
    if (!bands_can_be_followed(finder) || bands.empty() || given <= 0)
        return std::nullopt;
    const balancers::Arrangement &arrangement = finder.arrangement();
    const PeriodicMotions *motions = finder.hill()->by_monodromy();
    const periodic::Family family = [&](double dI) -> std::shared_ptr<const periodic::WholeRotor> {
        const auto own = std::make_shared<const OwnWholeRotor>(with(dI), arrangement);
        return {own, &own->rotor};
    };
    constexpr double margin = 1e-9; // bands that are just closed are still seen by rounding
    // Far enough that something is seen to grow: where motions hardly decay, the last.
    constexpr std::array above{1e-6, 1e-5, 1e-4};
    constexpr int most_steps = 8;
    double from = given;
    std::unique_ptr<BandFinder> closed;
    for (int step = 0; step < most_steps; ++step) {
        const auto closing = periodic::last_to_close(family, from, open_bands(*motions, bands));
        if (!closing || closing->speed < speeds.front() || closing->speed > speeds.back() ||
            closing->noise > above.back() * closing->number)
            return std::nullopt;
        from = closing->number - std::max(margin * closing->number, closing->noise);
        closed = std::make_unique<BandFinder>(with(from), arrangement);
        bands = closed->find(speeds).bands;
        if (bands.empty()) {
            const bool grows_above = std::ranges::any_of(above, [&](double share) {
                const HillSolver beyond(with(closing->number * (1 + share)), arrangement);
                return growth_of(beyond.at(closing->speed)) > 0;
            });
            return grows_above ? std::optional(closing->number) : std::nullopt;
        }
        motions = closed->hill()->by_monodromy();
    }
    return std::nullopt;
}

} // namespace whirl::stability

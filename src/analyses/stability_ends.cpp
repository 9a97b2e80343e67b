#include "analyses/stability_ends.h"

#include "balancers/arrangement.h"
#include "balancers/kind.h"
#include "ends/band_ends.h"
#include "linalg/check.h"
#include "stability/hill/hill_motions.h"
#include "stability/hill/periodic_motions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::analyses {

namespace {

using results::Sentence;
namespace as = results::as;

/// Of one speed: the fastest growing decides.
results::Verdict verdict_of(const std::vector<stability::Motion> &motions) {
    const double growth = stability::growth_of(motions);
    if (growth <= 0)
        return growth < 0 ? results::Verdict::stable : results::Verdict::neutral;
    const bool real = std::ranges::any_of(motions, [growth](const stability::Motion &motion) {
        return motion.value.real() == growth && motion.value.imag() == 0;
    });
    return real ? results::Verdict::diverges : results::Verdict::unstable;
}

void note_doubts(const ends::EndsFound &found, std::vector<Sentence> &notes) {
    if (!found.doubtful.empty())
        notes.emplace_back("the number of growing motions is in doubt at {} speeds, the first of "
                           "them {}: ends inside of unstable bands may be missing there",
                           found.doubtful.size(), as::speed(found.doubtful.front().from, 10));
}

} // namespace

void note_lost_motions(const std::vector<results::Interval> &doubtful, const char *motions,
                       std::vector<Sentence> &notes) {
    constexpr std::size_t few = 3; // named one by one: a longer list is not read
    if (doubtful.empty())
        return;
    std::vector<Sentence> ranges;
    for (const auto &[from, to] : doubtful)
        ranges.emplace_back("{}", as::speed.range(from, to, 10));
    const Sentence where =
        doubtful.size() <= few
            ? Sentence("from {}", joined(ranges, ", "))
            : Sentence(
                  "in {} short ranges of speed from {}", doubtful.size(),
                  as::speed.range(std::ranges::min(doubtful, {}, &results::Interval::from).from,
                                  std::ranges::max(doubtful, {}, &results::Interval::to).to));
    notes.emplace_back("{} {} could not be followed: an unstable band narrower than that may be "
                       "missing there",
                       where, motions);
}

namespace {

/// No answer where none was found to grow and not all are counted.
double growth_of(const ends::FastestGrowing &fastest) {
    return fastest.value.real() > 0 || fastest.counted ? fastest.value.real()
                                                       : std::numeric_limits<double>::quiet_NaN();
}

results::Verdict verdict_of(const ends::FastestGrowing &fastest) {
    const double growth = growth_of(fastest);
    if (std::isnan(growth))
        return results::Verdict::unknown;
    if (growth <= 0)
        return growth < 0 ? results::Verdict::stable : results::Verdict::neutral;
    return fastest.value.imag() == 0 ? results::Verdict::diverges : results::Verdict::unstable;
}

/// At one of the speeds of the result; of the motions on either side of what the elements resolve,
/// where they are told apart.
void add_growth(const ends::AllMotions &motions, double speed, results::StabilityResult &result) {
    const double top = motions.resolved_up_to();
    ends::FastestGrowing all = motions.fastest_growing(speed, 0, top);
    if (motions.form() == results::Form::general)
        result.log_dec.push_back(
            motions.least_log_dec(speed, all).value_or(std::numeric_limits<double>::quiet_NaN()));
    if (std::isfinite(top)) {
        const ends::FastestGrowing faster = motions.fastest_growing(speed, top);
        result.resolved_growth.push_back(growth_of(all));
        result.resolved_verdict.push_back(verdict_of(all));
        result.unresolved_growth.push_back(growth_of(faster));
        // How slowly the fastest motions of a mesh die out says nothing.
        if (faster.value.real() > std::max(0.0, all.value.real()))
            all.value = faster.value;
        all.counted = all.counted && faster.counted;
    }
    result.growth.push_back(growth_of(all));
    result.verdict.push_back(verdict_of(all));
}

} // namespace

void add_hill_growth(const stability::BandFinder &finder, double from,
                     results::StabilityResult &result) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    for (const double speed : result.speeds) {
        const bool known = std::abs(speed) >= from;
        const std::vector<stability::Motion> motions =
            known ? finder.at(speed) : std::vector<stability::Motion>{};
        result.growth.push_back(known ? stability::growth_of(motions) : unknown);
        result.verdict.push_back(known ? verdict_of(motions) : results::Verdict::unknown);
    }
    const stability::PeriodicMotions *periodic = finder.hill()->by_monodromy();
    if (periodic != nullptr && periodic->unconfirmed() > 0)
        result.model.notes.emplace_back(
            "up to {}, but not at rest, growth at some speeds is that of the reduced rotor: the "
            "motion of the full model was not found with as many terms as a Hill series may have",
            as::speed(periodic->unconfirmed()));
}

void add_growth(const ends::AllMotions &motions, results::StabilityResult &result) {
    for (const double speed : result.speeds)
        add_growth(motions, speed, result);
}

BandsBetween bands_between_ends(stability::BandFinder &finder, const std::vector<double> &grid) {
    if (finder.model().resisted)
        return {};
    if (finder.model().form == results::Form::hill)
        return {finder.find(grid), {}};
    ends::EndsFound found = ends::find_ends({finder, grid}, ends::few_steps);
    return {{ends::bands_of(found, {grid.front(), grid.back()}), std::move(found.doubtful)},
            std::move(found.roots)};
}

std::vector<ends::EndOfGrowth> search_bands(stability::BandFinder &finder,
                                            const ends::AllMotions *motions,
                                            const std::vector<double> &grid,
                                            results::StabilityResult &result) {
    if (finder.model().resisted)
        return {};
    std::vector<Sentence> &notes = result.model.notes;
    ends::EndsFound found;
    if (motions != nullptr) {
        found = ends::find_ends(*motions);
        result.unstable = ends::bands_of(found, {grid.front(), grid.back()});
    } else {
        stability::BandsFound bands = finder.find(grid);
        note_lost_motions(bands.doubtful, "the motions", notes);
        result.unstable = std::move(bands.bands);
        found = ends::multiplier_ends([&finder](double speed) { return finder.at(speed); }, grid,
                                      result.unstable);
    }
    note_doubts(found, notes);
    const bool counted = std::ranges::all_of(found.ends, [](const auto &end) {
        return end.growing_below >= 0 && end.growing_above >= 0;
    });
    if (!counted) {
        notes.emplace_back("the ends of growth are not listed: so many lie so close together that "
                           "the growing motions between them could not be counted");
        return {};
    }
    result.ends = std::move(found.ends);
    return std::move(found.roots);
}

void add_growth_of_all_speeds(const ends::AllMotions &motions, results::StabilityResult &result) {
    const std::vector<double> &speeds = result.speeds;
    add_growth(motions, speeds.back(), result);
    const auto same = [&speeds](auto &values) {
        if (!values.empty())
            values.resize(speeds.size(), values.front());
    };
    same(result.growth);
    same(result.verdict);
    same(result.log_dec);
    same(result.resolved_growth);
    same(result.resolved_verdict);
    same(result.unresolved_growth);
    if (speeds.size() > 1 && result.growth.front() > 0) {
        result.unstable = {{speeds.front(), speeds.back()}};
        result.unstable_error = {{0, 0}}; // borders of the range
    }
}

void settle_rounding(GrowthAndVerdict of, const std::vector<double> &speeds,
                     const std::vector<results::Interval> &bands, bool damped) {
    constexpr double hardly = 1e-8;
    const double top = std::max(std::abs(speeds.front()), std::abs(speeds.back()));
    for (std::size_t i = 0; i < speeds.size() && i < of.growth.size(); ++i) {
        const bool inside = std::ranges::any_of(bands, [&](const auto &band) {
            return speeds[i] >= band.from && speeds[i] <= band.to;
        });
        double &growth = of.growth[i];
        if (inside || !(std::abs(growth) <= hardly * top) || (damped && growth < 0))
            continue;
        growth = 0;
        of.verdict[i] = results::Verdict::neutral;
    }
}

int neutral_pairs(const model::Rotor &rotor) {
    const auto elements =
        balancers::balancer_elements(rotor, balancers::arrangement_at_balance(rotor));
    int pairs = 0;
    for (std::size_t i = 0; i < elements.size(); ++i) {
        const auto kind = balancers::kind_of(rotor.balancers[i]);
        const auto masses = static_cast<int>(kind->circled().size());
        const int felt = elements[i].parts.diameter ? 1 : 2;
        if (masses > felt)
            pairs += (masses - felt) * static_cast<int>(kind->coordinates().size()) / masses;
    }
    return pairs;
}

void add_neutral_balls(const model::Rotor &rotor, results::StabilityResult &result) {
    const auto elements =
        balancers::balancer_elements(rotor, balancers::arrangement_at_balance(rotor));
    bool against_each_other = false;
    for (std::size_t i = 0; i < elements.size(); ++i)
        against_each_other =
            against_each_other || (elements[i].parts.diameter &&
                                   balancers::kind_of(rotor.balancers[i])->circled().size() > 1);
    if (!against_each_other)
        return;
    for (const GrowthAndVerdict &of : {GrowthAndVerdict{result.growth, result.verdict},
                                       {result.resolved_growth, result.resolved_verdict}})
        for (std::size_t i = 0; i < of.growth.size(); ++i)
            if (of.growth[i] < 0) {
                of.growth[i] = 0;
                of.verdict[i] = results::Verdict::neutral;
            }
}

std::vector<double> described(const std::vector<double> &speeds,
                              const stability::StabilityModel &model) {
    std::vector<double> forward;
    std::vector<double> backward;
    for (const double speed : speeds)
        if (std::abs(speed) >= model.from)
            (speed < 0 ? backward : forward).push_back(speed);
    if (model.from == 0) // rest is among them: one run
        return speeds;
    return forward.size() >= backward.size() ? forward : backward;
}

void give_up_unsettled(const stability::BandFinder &finder, std::vector<double> &grid,
                       stability::StabilityModel &model) {
    double unsettled = -1;
    for (const double speed : grid)
        try {
            (void)finder.at(speed);
        } catch (const stability::NotSettled &) {
            unsettled = std::max(unsettled, std::abs(speed));
        }
    if (unsettled < 0)
        return;
    model.from = std::numeric_limits<double>::infinity();
    for (const double speed : grid)
        if (std::abs(speed) > unsettled)
            model.from = std::min(model.from, std::abs(speed));
    grid = described(grid, model);
}

} // namespace whirl::analyses

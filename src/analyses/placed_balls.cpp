#include "analyses/placed_balls.h"

#include "analyses/notes/ball_positions.h"
#include "assembly/discretization.h"
#include "balancers/kind.h"
#include "model/errors.h"
#include "model/variants.h"
#include "stability/unstable_bands.h"
#include "states/branches.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace whirl::analyses {

namespace {

using results::Sentence;
namespace as = results::as;

constexpr double not_known_end = std::numeric_limits<double>::quiet_NaN();

model::Case of_order(model::Case scene, int order) {
    scene.rotor = model::with_order(std::move(scene.rotor), order);
    return scene;
}

/// The same rotor with finer elements and more shapes.
model::Case finer(model::Case scene, int order) {
    scene.rotor.shaft.order = order + 4;
    scene.simulate.reduction_tolerance = 1e-8;
    return scene;
}

results::StabilityEnd end_of(const results::SteadyBorder &border) {
    results::StabilityEnd end;
    end.speed = border.speed;
    end.frequency_rotating = border.frequency.value_or(0.0);
    end.kind = border.kind == results::SteadyBorder::Kind::pair ? results::EndKind::pair
                                                                : results::EndKind::zero;
    end.growing_below = border.growing_below;
    end.growing_above = border.growing_above;
    return end;
}

void add_at_speed(const std::optional<states::StateSearch::Found> &found,
                  results::StabilityResult &result) {
    using results::Verdict;
    if (!found || std::isnan(found->state.growth)) {
        result.growth.push_back(not_known_end);
        result.verdict.push_back(Verdict::unknown);
        return;
    }
    const results::SteadyState &state = found->state;
    result.growth.push_back(state.stable ? state.growth : 0);
    result.verdict.push_back(!state.stable                ? Verdict::neutral
                             : *state.stable              ? Verdict::stable
                             : found->fastest.imag() == 0 ? Verdict::diverges
                                                          : Verdict::unstable);
}

} // namespace

std::unique_ptr<states::BalancedOverSpeed>
placed_by_all_imbalances(const model::Case &scene, int order, const std::vector<double> &speeds,
                         std::vector<Sentence> &notes) {
    if (!balls_stand_elsewhere(scene.rotor) ||
        balancers::has_obstructed_race(scene.rotor.balancers))
        return nullptr;
    try {
        auto position = std::make_unique<states::BalancedOverSpeed>(of_order(scene, order), speeds);
        if (std::ranges::any_of(scene.rotor.balancers, [](const model::Balancer &balancer) {
                return !balancer.position.empty();
            }))
            notes.emplace_back("`position` of a balancer is for its own imbalance alone: with "
                               "[[imbalance]] or an eccentric race its balls stand where all of "
                               "these together ask for, symmetrically");
        return position;
    } catch (const model::AnalysisFailure &failure) {
        notes.emplace_back(
            model::Weight::warning,
            "the balanced position is that of balls against the imbalance of their "
            "own balancer, though [[imbalance]] entries or eccentric races make them "
            "stand elsewhere: {}",
            failure.sentence());
    }
    return nullptr;
}

PlacedBands placed_bands(const model::Case &scene, int order,
                         const states::BalancedOverSpeed &position, const std::vector<double> &grid,
                         int arrangement, bool with_errors) {
    PlacedBands out;
    out.range = position.over(grid, arrangement);
    if (!with_errors)
        return out;
    std::optional<states::BalancedOverSpeed> fine;
    const auto error = [&](double speed) {
        for (const results::SteadyBorder &border : out.range.borders) {
            if (border.speed != speed)
                continue;
            if (!fine)
                fine.emplace(finer(of_order(scene, order), order), grid);
            const auto same = fine->same_border(border);
            constexpr double margin = 1.2; // of an estimate, as for other ends of bands
            return same ? margin * std::abs(*same - speed) + states::known_to * std::abs(speed)
                        : not_known_end;
        }
        return 0.0; // of the range
    };
    for (const results::Interval &band : out.range.grows)
        out.errors.emplace_back(error(band.from), error(band.to));
    for (const results::Interval &band : out.range.missing)
        out.missing_errors.emplace_back(error(band.from), error(band.to));
    return out;
}

void answer_for_placed_balls(const model::Case &scene, int order,
                             const states::BalancedOverSpeed &position,
                             const std::vector<double> &grid, results::StabilityResult &result) {
    const assembly::Discretization d(scene.rotor, order);
    result.model.elements = static_cast<int>(d.shaft_mesh().spans.size());
    result.model.unknowns = position.unknowns();
    for (const double speed : result.speeds)
        add_at_speed(position.at(speed), result);
    result.neutral_pairs = position.neutral_pairs();
    if (grid.size() < 2)
        return;
    const PlacedBands first = placed_bands(scene, order, position, grid, 0, true);
    result.unstable = first.range.grows;
    result.unstable_error = first.errors;
    result.no_position = first.range.missing;
    for (const results::SteadyBorder &border : first.range.borders) {
        if (border.kind == results::SteadyBorder::Kind::limit)
            continue;
        result.ends.push_back(end_of(border));
        if (border.kind == results::SteadyBorder::Kind::zero)
            result.zero_root_speeds.push_back(border.speed);
    }
    constexpr int most = 6; // arrangements looked at where the balls have a choice
    const int arrangements = position.arrangements(most);
    if (arrangements == 1)
        return;
    results::ArrangementFamily family;
    family.arrangements = arrangements;
    std::vector<results::Interval> some = first.range.grows;
    family.always_unstable = first.range.grows;
    for (int k = 1; k < arrangements; ++k) {
        const states::BalancedRange other = position.over(grid, k);
        family.always_unstable = stability::common(family.always_unstable, other.grows);
        some.insert(some.end(), other.grows.begin(), other.grows.end());
    }
    family.unstable = stability::joined(std::move(some));
    for (std::size_t i = 0; i < scene.rotor.balancers.size(); ++i)
        family.anisotropy.push_back({not_known_end, not_known_end});
    result.family = std::move(family);
}

void note_missing(const std::vector<results::Interval> &missing, std::vector<Sentence> &notes) {
    for (const results::Interval &interval : missing)
        notes.emplace_back("from {} there is {}", as::speed.range(interval.from, interval.to),
                           no_balanced_position);
}

} // namespace whirl::analyses

#include "analyses/limit_cycle.h"

#include "linalg/check.h"
#include "simulation/outcome.h"
#include "states/limit_cycle.h"

#include <algorithm>
#include <cmath>

namespace whirl::analyses {

namespace {

using results::Sentence;

const char *kind_name(states::BranchPoint::Kind kind) {
    using Kind = states::BranchPoint::Kind;
    return kind == Kind::fold ? "fold" : kind == Kind::border ? "border" : "";
}

const char *end_name(states::CycleBranch::End end) {
    using End = states::CycleBranch::End;
    return end == End::range      ? "range"
           : end == End::standing ? "standing"
           : end == End::points   ? "points"
                                  : "lost";
}

/// What a reader wants to know of a cycle.
results::LimitCycle told(const states::LimitCycles &cycles, const states::LimitCycle &cycle) {
    results::LimitCycle out;
    out.speed = cycle.speed;
    out.period = cycle.period;
    out.growth = cycle.growth();
    out.stable = cycle.stable();
    out.multipliers.assign(cycle.multipliers.begin(), cycle.multipliers.end());
    out.multiplier_error = cycle.multiplier_error;
    out.defect = cycle.defect;
    const simulation::MovingParts &parts = cycles.parts();
    auto turn = cycle.turns.begin();
    for (const simulation::FreeParts &free : parts.free) {
        out.turns.emplace_back(turn, turn + free.motion->size());
        turn += free.motion->size();
    }
    const Eigen::Index r = parts.rotor.size();
    out.largest.assign(parts.free.size(), 0);
    out.least.assign(parts.free.size(), HUGE_VAL);
    constexpr int instants = 720; // of a period: an extreme between two is missed by some 1e-5
    cycles.follow(cycle.start, cycle.speed, cycle.period, instants,
                  [&](double, const Eigen::VectorXd &state) {
                      for (std::size_t i = 0; i < parts.free.size(); ++i) {
                          const reduction::Row &row =
                              parts.planes[static_cast<std::size_t>(parts.free[i].plane)].w;
                          const double w =
                              std::hypot(state.head(r).dot(row), state.segment(r, r).dot(row));
                          out.largest[i] = std::max(out.largest[i], w);
                          out.least[i] = std::min(out.least[i], w);
                      }
                  });
    return out;
}

void add_branch(const model::CycleSettings &settings, const states::LimitCycles &cycles,
                const states::LimitCycle &cycle, results::FoundCycle &out) {
    const states::CycleBranch branch =
        cycles.branch(cycle, settings.speeds->from, settings.speeds->to, settings.speeds->count);
    for (const states::BranchPoint &point : branch.points) {
        out.branch.push_back(told(cycles, point.cycle));
        out.branch.back().kind = kind_name(point.kind);
    }
    out.first_end = end_name(branch.first);
    out.last_end = end_name(branch.last);
}

} // namespace

void add_limit_cycle(const model::Case &scene, const simulation::MotionScene &motion,
                     const simulation::Run &run, results::SimulateResult &result) {
    using results::Outcome;
    const auto none = [&result](const std::string &why) {
        result.model.notes.emplace_back("no limit cycle: {}", why);
    };
    if (const std::string why = states::not_alike_in_time(scene); !why.empty())
        return none(why);
    if (!scene.simulate.held.empty())
        return none("none is looked for with [simulate.sweep], only next to a motion at one speed");
    if (!simulation::ends_at_constant_speed(result))
        return none("the speed changes at the end");
    if (result.outcome != Outcome::lagging && result.outcome != Outcome::whirling)
        return none("the motion ends " + results::outcome_name(result.outcome) +
                    ", not lagging or whirling");
    const states::LimitCycles cycles(motion.parts, motion.moment, run.method());
    try {
        const Eigen::VectorXd end = run.end_in_rotor_axes();
        const auto cycle = cycles.next_to(end, result.speed);
        if (!cycle)
            return none("the motion does not return to where it ended within 400 turns; parts that "
                        "lag by different rates do not, nor does one that is still far from its "
                        "limit (a longer simulate.time)");
        result.cycle.emplace();
        result.cycle->cycle = told(cycles, *cycle);
        result.cycle->away = cycles.apart(*cycle, end);
        const auto &speeds = scene.simulate.cycle->speeds;
        if (speeds && (result.speed < speeds->from || result.speed > speeds->to))
            result.model.notes.emplace_back(
                model::Weight::warning,
                "no branch of the limit cycle: it is at {}, outside of the speeds of "
                "[simulate.cycle], {}",
                results::as::speed(result.speed),
                results::as::speed.range(speeds->from, speeds->to));
        else if (speeds)
            add_branch(*scene.simulate.cycle, cycles, *cycle, *result.cycle);
    } catch (const linalg::SolverError &error) {
        none("a motion next to it cannot be followed, " + error.sentence().text());
    }
}

} // namespace whirl::analyses

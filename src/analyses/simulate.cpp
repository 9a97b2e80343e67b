#include "analyses/simulate.h"

#include "analyses/limit_cycle.h"
#include "analyses/many_starts.h"
#include "balancers/kind.h"
#include "linalg/check.h"
#include "model/errors.h"
#include "process/processes.h"
#include "results/formulation.h"
#include "simulation/equations.h"
#include "simulation/held_motion.h"
#include "simulation/linear_growth.h"
#include "simulation/outcome.h"
#include "simulation/parts_at_rest.h"
#include "simulation/run.h"
#include "simulation/stations/stations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <variant>

namespace whirl::analyses {

namespace {

using results::Sentence;
namespace as = results::as;

void describe_model(const model::Case &scene, const simulation::MotionScene &motion,
                    results::SimulateResult &result) {
    const reduction::ReducedRotor &rotor = motion.parts.rotor;
    result.model.formulation = {results::Form::general,
                                scene.rotor.balancers.empty()
                                    ? "motion in time, fixed frame: modal coordinates of the "
                                      "shaft in x and y"
                                    : "motion in time, fixed frame: modal coordinates of "
                                      "the shaft in x and y, an angle for each ball"};
    result.model.order = motion.order;
    result.model.elements = motion.elements;
    result.model.unknowns = 2 * rotor.size() + motion.parts.free_angles();
    result.model.notes = motion.notes;
    result.modes = rotor.modes;
    result.shapes = rotor.size();
    result.response_error = rotor.response_error;
    result.frequency_error = rotor.frequency_error;
    result.start_angles = motion.start_angles;
    if (std::max(rotor.response_error, rotor.frequency_error) > scene.simulate.reduction_tolerance)
        result.model.notes.emplace_back(
            "{} modes of the shaft (simulate.modes) leave a relative error of {}", rotor.modes,
            as::number(std::max(rotor.response_error, rotor.frequency_error), 2));
}

/// Of each balancer, in the rotor, rad.
std::vector<std::vector<double>> last_angles(const model::Case &scene,
                                             const results::MotionSeries &series) {
    std::vector<std::vector<double>> angles;
    std::size_t next = 0;
    for (const model::Balancer &b : scene.rotor.balancers) {
        angles.emplace_back();
        for (std::size_t j = 0; j < balancers::kind_of(b)->coordinates().size(); ++j)
            angles.back().push_back(series.angles[next++].back());
    }
    return angles;
}

/// Pairs of angles nearer to each other than this.
int overlapping_pairs(const std::vector<double> &angles, double nearest) {
    constexpr double turn = 2 * std::numbers::pi;
    int pairs = 0;
    for (std::size_t i = 0; i < angles.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (std::abs(std::remainder(angles[i] - angles[j], turn)) < nearest)
                ++pairs;
    return pairs;
}

/// A motion that grows beyond all numbers has an outcome all the same: what was followed is judged.
void end_early(results::SimulateResult &result, const Sentence &failure) {
    constexpr std::size_t enough = 100; // points of the series
    if (result.series.time.size() < enough)
        throw model::AnalysisFailure(failure);
    result.time = result.series.time.back();
    for (std::size_t i = 0; i < result.balancers.size(); ++i)
        result.balancers[i].amplitude = result.series.amplitude[i].back();
    result.model.notes.emplace_back("{}; it was followed for {}", failure, as::time(result.time));
}

/// Balls that pass through each other are no balls: those that end in one place are named.
void note_overlaps(const model::Case &scene, results::SimulateResult &result) {
    const std::vector<std::vector<double>> angles = last_angles(scene, result.series);
    for (std::size_t i = 0; i < scene.rotor.balancers.size(); ++i) {
        const model::Balancer &b = scene.rotor.balancers[i];
        const auto *balls = std::get_if<model::Balls>(&b.parts);
        if (!balls || balls->contact)
            continue;
        auto ball = angles[i].begin();
        for (const model::BallRow &row : balls->rows) {
            const auto first = std::exchange(ball, ball + row.n);
            const int pairs = overlapping_pairs({first, ball}, row.touching_angle());
            if (row.diameter > 0 && pairs > 0)
                result.model.notes.emplace_back(
                    "{}: {} {} of balls overlap at the end: their centres are nearer than the "
                    "diameter of a ball, {}{}",
                    b.name.empty() ? scene.rotor.balancer_path(i) : b.name, pairs,
                    pairs == 1 ? "pair" : "pairs", as::length(row.diameter, 4),
                    balls->ellipticity > 0 ? "" : "; contact = true keeps them apart");
        }
    }
}

/// Steady states beside the motions of a sweep, its jumps, and what a reader must know of it.
void judge_sweep(const model::Case &scene, results::SimulateResult &result) {
    results::HeldSweep &sweep = *result.sweep;
    std::vector<double> speeds;
    std::vector<results::HeldMotion *> motions;
    for (results::HeldMotion &motion : sweep.motions) {
        motions.push_back(&motion);
        if (motion.up)
            speeds.push_back(motion.speed);
    }
    sweep.states = match_states(scene, speeds, motions, result.model.notes);
    simulation::find_jumps(sweep);
    const auto restless =
        std::ranges::count_if(sweep.motions, [](const auto &m) { return !m.settled; });
    if (restless > 0)
        result.model.notes.emplace_back(
            "{} of {} motions of the sweep had not settled when the speed went on: a longer "
            "simulate.sweep.hold would tell",
            restless, sweep.motions.size());
    note_unstable(motions, sweep.states, result.model.notes);
}

/// What is known of the motion beside its course: where the balls are, and what the eigenvalues
/// promise.
void judge_balls(const model::Case &scene, int order, results::SimulateResult &result) {
    note_overlaps(scene, result);
    simulation::add_parts_at_rest(scene, order, result);
    // Resistance to rolling makes whole intervals of positions stable, which no eigenvalue knows.
    const bool dry = std::ranges::any_of(scene.rotor.balancers, [](const model::Balancer &b) {
        const auto *balls = std::get_if<model::Balls>(&b.parts);
        return balls && balls->resists();
    });
    if (!dry && simulation::ends_at_constant_speed(result))
        result.linear_growth =
            simulation::linear_growth(scene, result.speed, last_angles(scene, result.series));
}

/// One motion, told apart where it was interrupted by result.restart.
/// @param whole  with its limit cycle, and what its sweep says
results::SimulateResult motion_from(const model::Case &scene, simulation::MotionScene &motion,
                                    const model::Restart *from, bool whole = false) {
    results::SimulateResult result;
    describe_model(scene, motion, result);
    simulation::Run run(scene, motion);
    Sentence failure;
    try {
        if (!run.integrate(from))
            result.restart = run.restart();
    } catch (const linalg::SolverError &error) {
        failure = Sentence("the motion cannot be integrated: {}", error.sentence());
    }
    run.fill(result);
    if (result.restart && scene.rotor.balancers.empty())
        throw model::AnalysisFailure(Sentence("interrupted at {} of {}", as::time(result.time),
                                              as::time(scene.simulate.time)));
    if (result.restart)
        return result;
    if (!failure.empty())
        end_early(result, failure);
    simulation::add_steady_response(scene, motion.order, result);
    if (!scene.rotor.balancers.empty())
        judge_balls(scene, motion.order, result);
    simulation::classify(scene, result);
    if (whole && scene.simulate.cycle)
        add_limit_cycle(scene, motion, run, result);
    if (whole && result.sweep)
        judge_sweep(scene, result);
    if (!failure.empty() && result.outcome != results::Outcome::growing)
        throw model::AnalysisFailure(failure);
    if (result.outcome == results::Outcome::growing && !scene.rotor.shaft.torque_has_potential())
        result.model.notes.emplace_back(
            "an axial torque of this kind has no potential and can drive motions of a shaft whose "
            "ends tilt; stability says how much of the growth is its work");
    return result;
}

results::OtherStart other_start(const results::SimulateResult &motion) {
    results::OtherStart out{
        motion.start_angles, motion.outcome, motion.evidence, motion.residual_ratio, {}, {}};
    for (const results::BalancerMotion &b : motion.balancers)
        out.angles.push_back(b.angles);
    for (const std::vector<double> &plane : motion.series.amplitude) {
        out.amplitude.resize(plane.size(), 0);
        for (std::size_t k = 0; k < plane.size(); ++k)
            out.amplitude[k] = std::max(out.amplitude[k], plane[k]);
    }
    return out;
}

/// The motions from simulate.other_starts; ends early where interrupted, and says so.
void add_other_starts(const model::Case &scene, simulation::MotionScene &motion,
                      results::SimulateResult &result) {
    for (const auto &start : scene.simulate.other_starts) {
        motion.start_angles = simulation::start_of(scene.rotor, start);
        const results::SimulateResult other = motion_from(scene, motion, nullptr);
        if (other.restart) {
            result.model.notes.emplace_back(
                "interrupted: {} of {} other starts were followed to the end",
                result.other_starts.size(), scene.simulate.other_starts.size());
            return;
        }
        result.other_starts.push_back(other_start(other));
    }
}

} // namespace

results::SimulateResult simulate_alone(const model::Case &scene) {
    simulation::MotionScene motion = simulation::motion_scene(scene);
    results::SimulateResult result = motion_from(scene, motion, nullptr);
    if (result.restart)
        throw model::AnalysisFailure("interrupted");
    return result;
}

results::SimulateResult simulate(const model::Case &scene, const model::Restart *from) {
    const bool first = process::process_rank() == 0;
    if (!first && !scene.simulate.starts)
        return {};
    simulation::MotionScene motion = simulation::motion_scene(scene);
    results::SimulateResult result;
    const auto one_motion = [&] {
        simulation::MotionScene own = motion;
        result = motion_from(scene, own, from, true);
        if (!result.restart)
            add_other_starts(scene, own, result);
        return !result.restart;
    };
    if (!scene.simulate.starts) {
        static_cast<void>(one_motion());
        return result;
    }
    std::vector<Sentence> notes;
    results::ManyStarts starts = many_starts(scene, motion, one_motion, notes);
    if (!first || result.restart)
        return result;
    result.starts = std::move(starts);
    result.model.notes.insert(result.model.notes.end(), notes.begin(), notes.end());
    return result;
}

} // namespace whirl::analyses

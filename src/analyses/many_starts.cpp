#include "analyses/many_starts.h"

#include "analyses/random.h"
#include "balancers/kind.h"
#include "linalg/check.h"
#include "model/errors.h"
#include "process/parallel.h"
#include "simulation/held_motion.h"
#include "simulation/run.h"
#include "states/matching.h"
#include "states/state_search.h"

#include <boost/math/distributions/binomial.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

namespace whirl::analyses {

namespace {

using results::HeldMotion;
using results::Sentence;
using std::numbers::pi;

struct TimeWindow {
    double from, until; ///< s
};

/// By which the motions are told.
TimeWindow last_window(const model::SimulateSettings &simulate) {
    if (simulate.held.empty())
        return {0.9 * simulate.time, simulate.time};
    const model::HeldSpeed &last = simulate.held.back();
    return {last.until - simulation::told_by * (last.until - last.from), last.until};
}

void refuse_changing_speed(const model::Case &scene, const simulation::MotionScene &motion) {
    const TimeWindow w = last_window(scene.simulate);
    const simulation::Spin &spin = motion.parts.spin;
    const auto differs = [&](double time) {
        return time > w.from && time <= w.until &&
               spin.at(time, time).speed != spin.at(w.from, w.from).speed;
    };
    if (motion.parts.motor || differs(w.until) || std::ranges::any_of(spin.jumps(), differs))
        throw model::BadInput(fmt::format(
            "{}: simulate.starts: expected a prescribed speed that is constant over the last tenth "
            "of the time, got {}",
            scene.file.string(),
            motion.parts.motor ? "the torque of a motor" : "one that changes"));
}

/// The middles of equal parts of a turn, from -pi to pi.
std::vector<double> grid_of(const model::StartsSettings &starts) {
    std::vector<double> grid;
    for (int i = 0; i < (starts.grid ? starts.count : 0); ++i)
        grid.push_back(2 * pi * (i + 0.5) / starts.count - pi);
    return grid;
}

/// Angles that say where a motion starts, of each balancer, from a list of all.
std::vector<std::vector<double>> by_balancers(const model::Rotor &rotor,
                                              const std::vector<double> &all) {
    std::vector<std::vector<double>> out;
    auto next = all.begin();
    for (const model::Balancer &b : rotor.balancers) {
        const auto first = std::exchange(
            next, next + static_cast<std::ptrdiff_t>(balancers::kind_of(b)->start_angles()));
        out.emplace_back(first, next);
    }
    return out;
}

/// Its coordinates that a start gives, one balancer after the other.
std::vector<double> given_angles(const model::Rotor &rotor,
                                 const std::vector<double> &coordinates) {
    std::vector<double> out;
    auto next = coordinates.begin();
    for (const model::Balancer &b : rotor.balancers) {
        const auto kind = balancers::kind_of(b);
        out.insert(out.end(), next, next + static_cast<std::ptrdiff_t>(kind->start_angles()));
        next += static_cast<std::ptrdiff_t>(kind->coordinates().size());
    }
    return out;
}

/// No balls that cannot pass each other overlap.
bool possible(const simulation::MotionScene &motion) {
    try {
        static_cast<void>(
            simulation::dry_state(motion.parts, motion.start_angles, motion.fastest, true));
        return true;
    } catch (const model::BadInput &) {
        return false;
    }
}

/// One start after the other, by their numbers.
class Starts {
  public:
    Starts(const model::Case &scene, const simulation::MotionScene &motion)
        : _scene(scene), _settings(*scene.simulate.starts), _grid(grid_of(_settings)),
          _usual(given_angles(scene.rotor, motion.start_angles)) {}

    [[nodiscard]] std::size_t count() const {
        const auto n = static_cast<std::size_t>(_settings.count);
        return _settings.grid ? n * n : n;
    }
    [[nodiscard]] const std::vector<double> &grid() const { return _grid; }

    /// Sets the angles of a start. @returns whether there is such a motion
    bool set(std::size_t number, simulation::MotionScene &motion) const {
        std::vector<double> angles = _usual;
        if (_settings.grid) {
            angles.at(static_cast<std::size_t>(_settings.angles[0])) = _grid[number % _grid.size()];
            // Equal balls at one angle would stay together where no others do.
            constexpr double part = 1e-6;
            const bool equal = number % _grid.size() == number / _grid.size();
            angles.at(static_cast<std::size_t>(_settings.angles[1])) =
                _grid[number / _grid.size()] + (equal ? part : 0);
            motion.start_angles =
                simulation::start_of(_scene.rotor, by_balancers(_scene.rotor, angles));
            return possible(motion);
        }
        constexpr int tries = 1000; // of balls so many that they hardly fit
        std::mt19937_64 bits = bits_of(_settings.seed, static_cast<int>(number));
        for (int k = 0; k < tries; ++k) {
            for (double &angle : angles)
                angle = 2 * pi * share_of(bits()) - pi;
            motion.start_angles =
                simulation::start_of(_scene.rotor, by_balancers(_scene.rotor, angles));
            if (possible(motion))
                return true;
        }
        return false;
    }

  private:
    const model::Case &_scene;
    const model::StartsSettings &_settings;
    std::vector<double> _grid;
    std::vector<double> _usual;
};

std::vector<double> packed(const HeldMotion &motion) {
    std::vector<double> numbers{motion.settled ? 1.0 : 0.0, motion.at_rest ? 1.0 : 0.0,
                                motion.speed};
    for (const auto *list : {&motion.planes, &motion.amplitude, &motion.rms})
        numbers.insert(numbers.end(), list->begin(), list->end());
    for (const auto *lists : {&motion.angles, &motion.rates})
        for (const std::vector<double> &list : *lists)
            numbers.insert(numbers.end(), list.begin(), list.end());
    return numbers;
}

HeldMotion unpacked(const std::vector<double> &numbers, const model::Rotor &rotor,
                    std::size_t stations) {
    auto next = numbers.begin();
    const auto list = [&next](std::size_t size) {
        const auto first = std::exchange(next, next + static_cast<std::ptrdiff_t>(size));
        return std::vector<double>(first, next);
    };
    HeldMotion motion;
    motion.settled = *next++ != 0;
    motion.at_rest = *next++ != 0;
    motion.speed = *next++;
    motion.planes = list(rotor.balancers.size());
    motion.amplitude = list(stations);
    motion.rms = list(stations);
    for (auto *lists : {&motion.angles, &motion.rates})
        for (const model::Balancer &b : rotor.balancers)
            lists->push_back(list(balancers::kind_of(b)->coordinates().size()));
    return motion;
}

/// The ways in which the motions end.
void sort_ends(const model::StartsSettings &settings, results::ManyStarts &starts) {
    std::vector<results::MotionEnd> &ends = starts.ends;
    const auto same = [](const results::MotionEnd &end, const HeldMotion &motion) {
        return end.state == motion.state && end.at_rest == motion.at_rest;
    };
    for (const results::StartedMotion &start : starts.motions) {
        if (!start.motion)
            continue;
        const HeldMotion &motion = *start.motion;
        auto end = std::ranges::find_if(ends, [&](const auto &e) { return same(e, motion); });
        if (end == ends.end())
            end = ends.insert(
                end, {.state = motion.state, .at_rest = motion.at_rest, .least = motion.largest()});
        ++end->count;
        end->least = std::min(end->least, motion.largest());
        end->largest = std::max(end->largest, motion.largest());
        end->unsettled += motion.settled ? 0 : 1;
    }
    // Those without a state behind all others, what moves last.
    std::ranges::sort(ends, {}, [](const results::MotionEnd &end) {
        return std::tuple(!end.state.has_value(), end.state.value_or(0), !end.at_rest);
    });
    int followed = 0;
    for (results::StartedMotion &start : starts.motions)
        if (start.motion) {
            const auto end =
                std::ranges::find_if(ends, [&](const auto &e) { return same(e, *start.motion); });
            start.end = static_cast<std::size_t>(end - ends.begin());
            ++followed;
        }
    starts.left_out = static_cast<int>(starts.motions.size()) - followed;
    for (results::MotionEnd &end : ends) {
        end.share = static_cast<double>(end.count) / followed;
        if (settings.grid)
            continue;
        const results::Interval interval = probability_interval(end.count, followed);
        end.low = interval.from;
        end.high = interval.to;
    }
}

} // namespace

std::optional<results::SteadyStates> match_states(const model::Case &scene,
                                                  const std::vector<double> &speeds,
                                                  const std::vector<HeldMotion *> &motions,
                                                  std::vector<Sentence> &notes) {
    if (scene.rotor.balancers.empty())
        return std::nullopt;
    try {
        results::SteadyStates states = states::steady_states(scene, speeds);
        for (HeldMotion *motion : motions)
            motion->state = states::matching_state(scene.rotor, states, *motion);
        return states;
    } catch (const model::AnalysisFailure &failure) {
        notes.emplace_back("motions are not compared with steady states: {}", failure.sentence());
    } catch (const model::BadInput &failure) {
        notes.emplace_back("motions are not compared with steady states: {}", failure.sentence());
    }
    return std::nullopt;
}

void note_unstable(const std::vector<HeldMotion *> &motions,
                   const std::optional<results::SteadyStates> &states,
                   std::vector<Sentence> &notes) {
    const auto unstable = std::ranges::count_if(motions, [&states](const HeldMotion *motion) {
        return motion->state && !states->states[*motion->state].stable.value_or(true);
    });
    if (unstable > 0)
        notes.emplace_back(model::Weight::warning,
                           "{} of {} motions stand in a steady state that does not keep: they "
                           "still leave it, or equal balls at one angle are not parted by rounding",
                           unstable, motions.size());
}

results::Interval probability_interval(int count, int of) {
    using Binomial = boost::math::binomial_distribution<double>;
    constexpr double tail = 0.025; // on either side
    return {count == 0 ? 0 : Binomial::find_lower_bound_on_p(of, count, tail),
            count == of ? 1 : Binomial::find_upper_bound_on_p(of, count, tail)};
}

results::ManyStarts many_starts(const model::Case &scene, simulation::MotionScene &motion,
                                const std::function<bool()> &first, std::vector<Sentence> &notes) {
    refuse_changing_speed(scene, motion);
    static_cast<void>(simulation::dry_state(motion.parts, motion.start_angles, motion.fastest,
                                            !scene.simulate.ball_angles.empty()));
    const Starts starts(scene, motion);
    const TimeWindow window = last_window(scene.simulate);
    bool stopped = false;
    const auto one = [&](std::size_t number) -> process::Outcome {
        if (stopped)
            return {{}, "interrupted"};
        if (!starts.set(number, motion))
            return {{}, "no start"};
        simulation::Run run(scene, motion);
        try {
            if (!run.integrate(nullptr)) {
                stopped = true;
                return {{}, "interrupted"};
            }
        } catch (const linalg::SolverError &) {
            return {{}, "not integrated"};
        }
        return {packed(run.motion_between(window.from, window.until)), ""};
    };
    bool given_up = false;
    const auto outcomes = process::deal(starts.count(), "motions from many starts", one,
                                        [&] { given_up = stopped = !first(); });
    results::ManyStarts out;
    if (outcomes.empty() || given_up)
        return out;
    out.grid = starts.grid();
    const double speed = motion.parts.spin.at(window.until, window.until).speed;
    std::vector<HeldMotion *> motions;
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        static_cast<void>(starts.set(i, motion));
        out.motions.push_back({given_angles(scene.rotor, motion.start_angles), {}, {}});
        if (!outcomes[i].numbers.empty()) {
            out.motions[i].motion =
                unpacked(outcomes[i].numbers, scene.rotor, motion.stations.rows.size());
            out.motions[i].motion->speed = speed;
        }
    }
    for (results::StartedMotion &start : out.motions)
        if (start.motion)
            motions.push_back(&*start.motion);
    if (motions.empty())
        throw model::AnalysisFailure("interrupted, or no motion from any start could be followed");
    out.states = match_states(scene, {speed}, motions, notes);
    sort_ends(*scene.simulate.starts, out);
    note_unstable(motions, out.states, notes);
    for (const char *why : {"interrupted", "no start", "not integrated"}) {
        const auto count =
            std::ranges::count_if(outcomes, [why](const auto &o) { return o.text == why; });
        if (count > 0)
            notes.emplace_back("{} of {} starts are left out: {}", count, outcomes.size(),
                               std::string(why) == "no start" ? "balls would overlap"
                               : std::string(why) == "interrupted"
                                   ? "interrupted"
                                   : "the motion could not be integrated to its end");
    }
    return out;
}

} // namespace whirl::analyses

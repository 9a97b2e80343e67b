#include "analyses/operating/operating.h"

#include "forced/response_places.h"
#include "linalg/roots.h"
#include "operation/doubt.h"
#include "operation/limits.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <utility>

namespace whirl::analyses {

namespace {

namespace as = results::as;
using operation::Doubt;
using operation::VibrationLimit;
using results::Measure;
using results::OperatingPlace;
using results::OperatingResponse;
using results::OperatingRow;
using results::OperatingWorst;
using results::Sentence;

/// What is looked at, and where it is.
struct Spot : OperatingPlace {
    forced::Quantity motion;
    std::optional<int> support;      ///< whose force is told, among bearings and seals
    std::optional<double> clearance; ///< radial, m
    std::vector<VibrationLimit> limits;
    std::size_t probe = 0;
};

/// Something that holds the shaft.
Spot spot_of(const assembly::Discretization &d, int index) {
    const model::Bearing &bearing = d.rotor().bearings[static_cast<std::size_t>(index)];
    Spot spot{
        {bearing.seal ? "seal" : "bearing", bearing.name, bearing.z, {}, true}, {}, {}, {}, {}};
    spot.motion = {forced::stretch_of_bearing(d, index)};
    spot.motion.film = index;
    spot.support = index;
    spot.clearance = bearing.clearance;
    return spot;
}

/// A probe, as it says it measures, or in both ways.
std::vector<Spot> spots_of(const assembly::Discretization &d, std::size_t index) {
    const model::Probe &probe = d.rotor().probes[index];
    std::vector<Spot> out;
    const auto add = [&](std::optional<bool> relative) {
        model::Probe own = probe;
        own.relative = relative;
        Spot spot{{"probe", probe.name, probe.z, probe.angle, relative.value_or(false)},
                  forced::quantity_of(d, own),
                  {},
                  {},
                  {}};
        spot.motion.z = probe.z;
        spot.probe = index;
        out.push_back(std::move(spot));
    };
    const bool both = !probe.on_pedestal && !probe.relative && d.rotor().pedestal_of(probe);
    add(both ? std::optional(false) : probe.relative);
    if (both)
        add(true);
    return out;
}

/// All places, in the order in which they are told of.
std::vector<Spot> spots_in(const assembly::Discretization &d, const model::Case &scene,
                           const std::map<int, std::string> &nodes) {
    const model::Rotor &rotor = d.rotor();
    const model::Limits limits = scene.limits.value_or(model::Limits{});
    std::vector<Spot> out;
    for (std::size_t i = 0; i < rotor.probes.size(); ++i)
        for (Spot &spot : spots_of(d, i)) {
            if (!rotor.probes[i].on_pedestal)
                spot.limits = operation::shaft_limits(limits, *scene.operation);
            out.push_back(std::move(spot));
        }
    for (int i = 0; i < static_cast<int>(rotor.bearings.size()); ++i)
        out.push_back(spot_of(d, i));
    for (int i = 0; i < static_cast<int>(rotor.supports().size()); ++i) {
        const model::Bearing &bearing = rotor.bearings[static_cast<std::size_t>(i)];
        if (!bearing.pedestal)
            continue;
        Spot spot{{"pedestal", bearing.name, bearing.z, {}, false}, {}, {}, {}, {}};
        spot.motion.stretch = {{d.pedestal_unknown(i), 1.0}};
        spot.motion.pedestal = i;
        spot.limits = operation::pedestal_limits(limits, *scene.operation);
        out.push_back(std::move(spot));
    }
    if (rotor.probes.empty())
        for (const auto &[node, name] : nodes) {
            const double z = d.shaft_mesh().nodes[static_cast<std::size_t>(node)];
            Spot spot{{"station", name, z, {}, false}, {d.deflection_at_node(node)}, {}, {}, {}};
            spot.motion.z = z;
            out.push_back(std::move(spot));
        }
    return out;
}

/// Why small motions would say nothing.
Doubt doubt_of(const model::Case &scene) {
    const model::Rotor &rotor = scene.rotor;
    if (Doubt doubt = operation::doubt_of_rotor(scene); !doubt.why.empty())
        return doubt;
    if (std::ranges::none_of(rotor.imbalances, [](const auto &one) { return one.mr != 0; }))
        return {"there is no imbalance that drives the rotor"};
    std::map<double, std::complex<double>> at; // imbalances at one place act as their sum
    double all = 0;
    for (const model::Imbalance &one : rotor.imbalances) {
        at[one.z] += std::polar(std::abs(one.mr), one.phase + (one.mr < 0 ? std::numbers::pi : 0));
        all += std::abs(one.mr);
    }
    double largest = 0;
    for (const auto &[z, sum] : at)
        largest = std::max(largest, std::abs(sum));
    constexpr double cancelled = 1e-9; // of their sizes: rounding of phases
    constexpr double nothing = 1e-15;  // kg m, a billionth of a g mm
    if (largest <= std::max(cancelled * all, nothing))
        return {"the imbalances cancel one another, or are next to nothing"};
    return {};
}

bool beyond_tables(const model::Rotor &rotor, double speed) {
    return std::ranges::any_of(rotor.bearings, [speed](const model::Bearing &bearing) {
        return bearing.depends_on_speed() &&
               (speed < bearing.speeds.front() || speed > bearing.speeds.back());
    });
}

/// Whether a value keeps its limit with all that it may be off; none: it may or may not. A value
/// that is not known keeps none.
std::optional<bool> keeps(double value, double error, double limit) {
    if (value > limit)
        return false;
    return value + std::abs(error) * value <= limit ? std::optional(true) : std::nullopt;
}

double measured(const Moving &moving, Measure what, const Spot &spot) {
    switch (what) {
    case Measure::amplitude:
        return moving.amplitude;
    case Measure::amplitude_rms:
        return moving.amplitude / std::numbers::sqrt2;
    case Measure::velocity:
        return moving.velocity;
    case Measure::velocity_rms:
        return moving.velocity_rms;
    case Measure::clearance_share:
        return moving.amplitude / spot.clearance.value_or(0);
    }
    return forced::no_value;
}

/// All motions together.
class Motion {
  public:
    explicit Motion(const std::vector<std::unique_ptr<Mover>> &movers) : _movers(movers) {}

    void solve(double speed, bool with_error) {
        _limited.clear();
        for (const auto &mover : _movers)
            _limited.push_back(mover->solve(speed, with_error));
    }

    /// How the motion that the imbalances drive is multiplied, and whether others count.
    struct Mix {
        double scale = 1;
        bool others = true;
    };
    [[nodiscard]] Moving of(const forced::Quantity &quantity, const Mix &mix) const {
        Moving sum;
        for (std::size_t i = 0; i < _movers.size(); ++i) {
            const bool imbalances = _movers[i]->of_imbalances();
            if (!imbalances && !mix.others)
                continue;
            const Moving one = _limited[i] ? _movers[i]->of(quantity) : Moving::without_limit();
            sum += imbalances ? one.times(mix.scale) : one;
        }
        return sum;
    }

    [[nodiscard]] const std::vector<std::unique_ptr<Mover>> &movers() const { return _movers; }

  private:
    const std::vector<std::unique_ptr<Mover>> &_movers;
    std::vector<bool> _limited;
};

/// A value that is looked at over a range of speeds.
struct Watch {
    const Spot *spot;
    Measure what;
    Motion::Mix mix;
};
struct Largest {
    double speed = 0, value = 0, error = 0;
};

/// The largest value of each over a range.
class Search {
  public:
    Search(Motion &motion, double from, double to, const std::vector<double> &also)
        : _motion(motion), _from(from), _to(to), _also(also) {}

    [[nodiscard]] std::vector<Largest> largest(const std::vector<Watch> &watches) {
        if (watches.empty())
            return {};
        const std::vector<double> speeds = looked_at(watches);
        std::vector<std::vector<double>> values(watches.size());
        for (const double speed : speeds) {
            _motion.solve(speed, false);
            for (std::size_t i = 0; i < watches.size(); ++i)
                values[i].push_back(value_of(watches[i]));
        }
        std::vector<Largest> out;
        for (std::size_t i = 0; i < watches.size(); ++i)
            out.push_back(largest_of(watches[i], _endless[i], speeds, values[i]));
        return out;
    }

  private:
    Motion &_motion;
    double _from, _to;
    std::vector<double> _also;
    std::vector<std::optional<double>> _endless; ///< where a value is infinite

    [[nodiscard]] double value_of(const Watch &watch) const {
        return measured(_motion.of(watch.spot->motion, watch.mix), watch.what, *watch.spot);
    }

    std::vector<double> looked_at(const std::vector<Watch> &watches) {
        std::vector<forced::Quantity> quantities;
        for (const Watch &watch : watches)
            quantities.push_back(watch.spot->motion);
        _endless.assign(watches.size(), std::nullopt);
        std::set<double> speeds{_from, _to};
        for (const double speed : _also)
            if (speed >= _from && speed <= _to)
                speeds.insert(speed);
        if (_to > _from)
            for (const auto &mover : _motion.movers()) {
                const Mover::Look look = mover->look(_from, _to, quantities);
                speeds.insert(look.speeds.begin(), look.speeds.end());
                for (const auto &[quantity, speed] : look.without_limit)
                    if (mover->of_imbalances() || watches[quantity].mix.others)
                        _endless[quantity] = speed;
            }
        std::erase_if(speeds, [this](double s) { return s < _from || s > _to; });
        return {speeds.begin(), speeds.end()};
    }

    Largest largest_of(const Watch &watch, std::optional<double> endless,
                       const std::vector<double> &speeds, const std::vector<double> &values) {
        if (endless)
            return {*endless, forced::unlimited, forced::no_value};
        // A value that is no number is never the largest: it is told as it is.
        const auto odd = std::ranges::find_if(values, [](double v) { return !std::isfinite(v); });
        if (odd != values.end())
            return {speeds[static_cast<std::size_t>(odd - values.begin())], *odd, forced::no_value};
        // Other tops may rise above the highest of these speeds between them, but little.
        constexpr double nearly = 0.9;
        const double most = std::ranges::max(values);
        Largest out{speeds.front(), -1, 0};
        const auto take = [&](double speed) {
            _motion.solve(speed, false);
            if (const double value = value_of(watch); value > out.value)
                out = {speed, value, 0};
        };
        for (std::size_t k = 0; k < speeds.size(); ++k) {
            const std::size_t left = k == 0 ? 0 : k - 1;
            const std::size_t right = std::min(k + 1, speeds.size() - 1);
            if (values[k] < nearly * most || values[left] > values[k] || values[right] > values[k])
                continue;
            take(speeds[k]);
            if (right > left && most > 0)
                take(linalg::least_place(
                    [&](double speed) {
                        _motion.solve(speed, false);
                        return -value_of(watch);
                    },
                    speeds[left], speeds[right]));
        }
        _motion.solve(out.speed, true);
        const Moving there = _motion.of(watch.spot->motion, watch.mix);
        out.value = measured(there, watch.what, *watch.spot);
        out.error = there.error;
        return out;
    }
};

/// The operating speeds, ascending, with their names.
std::vector<std::pair<double, std::string>> named_speeds(const model::Operation &operation) {
    std::vector<std::pair<double, std::string>> out;
    const auto add = [&out](std::optional<double> speed, const char *name) {
        if (!speed)
            return;
        const auto same = std::ranges::find(out, *speed, &std::pair<double, std::string>::first);
        if (same == out.end())
            out.emplace_back(*speed, name);
        else
            same->second += std::string(", ") + name;
    };
    add(operation.from, "minimum");
    add(operation.normal, "normal");
    add(operation.to, "maximum");
    add(operation.trip, "trip");
    return out;
}

/// Judges a row by the limit of its place that is used most.
void judge(OperatingRow &row, const Spot &spot, const Moving &moving, const Doubt &doubt) {
    double used = -1;
    bool known = true;
    for (const VibrationLimit &limit : spot.limits) {
        const double value = measured(moving, limit.what, spot);
        const std::optional<bool> pass = keeps(value, moving.error, limit.value);
        known = known && limit.why.empty() && pass.has_value();
        if (!(value / limit.value <= used)) {
            used = value / limit.value;
            row.limited = limit.what;
            row.value = value;
            row.limit = limit.value;
            row.pass = pass;
        }
    }
    if (doubt.either_way || (row.pass.value_or(false) && (!known || !doubt.why.empty())))
        row.pass.reset();
}

std::vector<OperatingRow> rows_of(const std::vector<Spot> &spots, const model::Case &scene,
                                  Motion &motion, const Doubt &doubt) {
    std::vector<OperatingRow> out;
    for (const auto &[speed, name] : named_speeds(*scene.operation)) {
        motion.solve(speed, true);
        for (const Spot &spot : spots) {
            const Moving moving = motion.of(spot.motion, {});
            OperatingRow row;
            static_cast<OperatingPlace &>(row) = spot;
            row.speed = speed;
            row.at = name;
            row.amplitude = moving.amplitude;
            row.phase = moving.phase;
            row.velocity = moving.velocity;
            row.acceleration = moving.acceleration;
            row.error = moving.error;
            if (spot.clearance)
                row.clearance_share = measured(moving, Measure::clearance_share, spot);
            if (spot.support) {
                forced::Quantity force = spot.motion;
                force.film.reset();
                force.bearing = *spot.support;
                row.force = motion.of(force, {}).amplitude;
            }
            judge(row, spot, moving, doubt);
            out.push_back(std::move(row));
        }
    }
    return out;
}

/// By which the imbalance grows until the probe that reads most is at its limit, from the lowest
/// operating speed to the maximum continuous one; at least 1.
void find_scale(OperatingResponse &out, const std::vector<Spot> &spots, const model::Case &scene,
                Motion &motion) {
    const model::Operation &operation = *scene.operation;
    const auto limits = operation::shaft_limits(*scene.limits, operation);
    const auto largest = std::ranges::max_element(limits, {}, &VibrationLimit::value);
    if (largest == limits.end()) {
        out.no_scale = {"no limit of what the probes read is given that the imbalance could be "
                        "scaled to"};
        return;
    }
    std::vector<Watch> watches;
    for (const Spot &spot : spots)
        if (!spot.limits.empty() && spot.of == "probe")
            watches.push_back({&spot, Measure::amplitude, {1, false}});
    if (watches.empty()) {
        out.no_scale = {"there is no probe at the shaft that the imbalance could be scaled to"};
        return;
    }
    const std::vector<Largest> found =
        Search(motion, operation.from, operation.to, {}).largest(watches);
    // Of one that may measure in two ways the smaller reading, which asks for more.
    std::map<std::size_t, double> readings;
    for (std::size_t i = 0; i < watches.size(); ++i) {
        const auto [at, first] = readings.emplace(watches[i].spot->probe, found[i].value);
        if (!first)
            at->second = std::min(at->second, found[i].value);
    }
    double most = 0;
    for (const auto &[probe, value] : readings)
        most = std::max(most, value);
    if (!(most > 0) || !std::isfinite(most)) {
        out.no_scale = most > 0 ? Sentence("what the probes read has no limit")
                                : Sentence("the probes read nothing under the imbalances");
        return;
    }
    // API 617 has 0.5 to 6 (theory.md, "Operating speeds"); here the imbalance is never made less.
    constexpr double least = 1;
    constexpr double usual_most = 6;
    out.scale =
        std::clamp(largest->value / most, least, scene.limits->scale_most.value_or(usual_most));
}

void add_worst(OperatingResponse &out, const std::vector<Watch> &watches,
               const std::vector<const VibrationLimit *> &limits, double from, double to,
               Motion &motion, const std::vector<double> &also, const Doubt &doubt) {
    const std::vector<Largest> found = Search(motion, from, to, also).largest(watches);
    for (std::size_t i = 0; i < watches.size(); ++i) {
        OperatingWorst worst;
        static_cast<OperatingPlace &>(worst) = *watches[i].spot;
        worst.what = watches[i].what;
        worst.from = from;
        worst.to = to;
        worst.speed = found[i].speed;
        worst.value = found[i].value;
        worst.error = found[i].error;
        worst.limit = limits[i]->value;
        worst.source = limits[i]->source;
        worst.scale = watches[i].mix.scale;
        worst.pass = keeps(worst.value, worst.error, worst.limit);
        // What is too large is so in spite of most doubts.
        const bool doubtful =
            doubt.either_way || (worst.pass.value_or(false) && !doubt.why.empty());
        if (!limits[i]->why.empty()) {
            worst.pass.reset();
            worst.why = limits[i]->why;
        } else if (doubtful) {
            worst.pass.reset();
            worst.why = doubt.why;
        } else if (!worst.pass) {
            worst.why = std::isfinite(worst.error)
                            ? Sentence("it is nearer to its limit than the error of the value, {}",
                                       as::number(worst.error, 2))
                            : Sentence("the error of the value is not known");
        }
        out.worst.push_back(std::move(worst));
    }
}

} // namespace

OperatingResponse operating_response(const model::Case &scene, const assembly::Discretization &d,
                                     const std::vector<std::unique_ptr<Mover>> &movers,
                                     const std::map<int, std::string> &nodes) {
    OperatingResponse out;
    Motion motion(movers);
    const std::vector<Spot> spots = spots_in(d, scene, nodes);
    const Doubt doubt = doubt_of(scene);
    out.rows = rows_of(spots, scene, motion, doubt);
    if (!scene.limits)
        return out;
    const model::Operation &operation = *scene.operation;
    const double top = operation::top_speed(operation);
    std::vector<double> named;
    for (const auto &[speed, name] : named_speeds(operation))
        named.push_back(speed);

    std::vector<Watch> watches;
    std::vector<const VibrationLimit *> limits;
    for (const Spot &spot : spots)
        for (const VibrationLimit &limit : spot.limits) {
            watches.push_back({&spot, limit.what, {}});
            limits.push_back(&limit);
        }
    add_worst(out, watches, limits, operation.from, top, motion, named, doubt);

    if (!scene.limits->clearance)
        return out;
    if (scene.limits->scaled)
        find_scale(out, spots, scene, motion);
    const VibrationLimit clearance{Measure::clearance_share,
                                   *scene.limits->clearance,
                                   scene.limits->scaled ? "case, scaled as in API 617" : "case",
                                   {}};
    watches.clear();
    for (const Spot &spot : spots)
        if (spot.clearance)
            watches.push_back({&spot, Measure::clearance_share, {out.scale.value_or(1), true}});
    limits.assign(watches.size(), &clearance);
    // Without the scale they are smaller than they are to be: what is too large then, is.
    add_worst(out, watches, limits, 0, top, motion, named,
              doubt.why.empty() ? Doubt{out.no_scale} : doubt);
    for (OperatingWorst &worst : out.worst)
        if (worst.what == Measure::clearance_share && worst.pass.value_or(false) &&
            beyond_tables(scene.rotor, worst.speed)) {
            worst.pass.reset();
            worst.why = {"it is largest at {}, of which a table of a bearing or seal has no rows",
                         as::speed(worst.speed)};
        }
    return out;
}

void note_operating_resonances(const results::OperatingResponse &operating,
                               std::vector<results::Sentence> &notes) {
    std::set<double> speeds;
    for (const OperatingRow &row : operating.rows)
        if (!std::isfinite(row.amplitude))
            speeds.insert(row.speed);
    if (!speeds.empty())
        notes.emplace_back(model::Weight::warning,
                           "no steady motion at the operating {} {}: the rotor is at a resonance "
                           "without damping there, amplitudes have no limit, and nothing is known "
                           "of their errors",
                           speeds.size() == 1 ? "speed" : "speeds",
                           as::speed.list({speeds.begin(), speeds.end()}));
}

} // namespace whirl::analyses

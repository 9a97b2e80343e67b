#include "analyses/periodic_response.h"

#include "analyses/campbell.h"
#include "analyses/operating/operating.h"
#include "forced/periodic_motion.h"
#include "forced/response_places.h"
#include "linalg/roots.h"
#include "mesh_error/estimate.h"
#include "mesh_error/safety.h"
#include "model/errors.h"
#include "modes/formulation.h"
#include "modes/orbits.h"
#include "process/processes.h"
#include "process/progress.h"
#include "results/sentence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

namespace whirl::analyses {

namespace {

namespace as = results::as;
using forced::no_value;
using forced::TurnParts;
using forced::unlimited;

model::Case without_balancers(model::Case scene) { // the response leaves them out
    scene.rotor.balancers.clear();
    return scene;
}

/// The rotor and the same with finer elements, under one load.
class Motions {
  public:
    Motions(const assembly::Discretization &d, const assembly::Discretization *fine, double gravity)
        : _d(d), _fine_d(fine), _motion(d, gravity) {
        if (fine != nullptr)
            _fine.emplace(*fine, gravity);
    }

    /// At a speed; amplitudes without limit where there is a resonance without damping.
    void solve(double speed, bool finer) {
        _limited = _motion.solve(speed) && _motion.rounding() <= forced::resonance_rounding;
        _finer_known = finer && _fine && _fine->solve(speed);
    }
    [[nodiscard]] bool limited() const { return _limited; }
    [[nodiscard]] double rounding() const { return _motion.rounding(); }
    [[nodiscard]] TurnParts at(double z) const { return _motion.motion(_d.deflection_at(z)); }
    [[nodiscard]] TurnParts force(int bearing) const { return _motion.bearing_force(bearing); }
    /// Relative to the largest distance over a turn: the sum of what all parts differ by.
    [[nodiscard]] double error_at(double z, const TurnParts &parts) const {
        return error(parts,
                     _finer_known ? _fine->motion(_fine_d->deflection_at(z)) : TurnParts{parts});
    }
    /// A deflection or a force, in all directions.
    [[nodiscard]] TurnParts of(const forced::Quantity &quantity) const {
        return quantity.bearing != forced::Quantity::deflection ? force(quantity.bearing)
                                                                : _motion.motion(quantity.stretch);
    }
    /// Of a deflection, relative as above.
    [[nodiscard]] double error_of(const forced::Quantity &quantity, const TurnParts &parts) const {
        return error(parts, _finer_known ? _fine->motion(forced::stretch_of(*_fine_d, quantity))
                                         : TurnParts{parts});
    }
    /// What a probe looks at.
    [[nodiscard]] TurnParts at(const model::Probe &probe) const {
        return _motion.motion(forced::stretch_of_probe(_d, probe));
    }
    /// Relative to what it reads.
    [[nodiscard]] double error_of_probe(const model::Probe &probe, const TurnParts &seen) const {
        const TurnParts whole = at(probe);
        const TurnParts finer =
            _finer_known ? _fine->motion(forced::stretch_of_probe(*_fine_d, probe)) : whole;
        const double largest = seen.largest();
        return largest == 0 ? 0 : error(whole, finer) * whole.largest() / largest;
    }
    [[nodiscard]] double error_of_force(int bearing, const TurnParts &parts) const {
        return error(parts, _finer_known ? _fine->bearing_force(bearing) : TurnParts{parts});
    }
    /// What moves of a motion under the weight: nothing where rounding of what stands still leaves
    /// as much.
    [[nodiscard]] TurnParts moving(const TurnParts &parts) const {
        const forced::Phasor still = parts.part(0);
        const double size = std::hypot(still.x.real(), still.y.real());
        TurnParts out = parts.moving();
        constexpr double rounding = 1e-14; // of the sums behind it, at the least
        if (out.largest() <= 10 * std::max(_motion.rounding(), rounding) * size)
            out.parts.clear();
        return out;
    }
    [[nodiscard]] int unknowns() const { return _motion.unknowns(); }

  private:
    const assembly::Discretization &_d;
    const assembly::Discretization *_fine_d;
    forced::PeriodicMotion _motion;
    std::optional<forced::PeriodicMotion> _fine;
    bool _limited = true, _finer_known = false;

    [[nodiscard]] double error(const TurnParts &here, const TurnParts &finer) const {
        if (_fine && !_finer_known)
            return unlimited;
        const std::size_t count = std::max(here.parts.size(), finer.parts.size());
        double difference = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const int multiple = here.first + 2 * static_cast<int>(i);
            const forced::Phasor a = here.part(multiple);
            const forced::Phasor b = finer.part(multiple);
            difference += modes::ellipse_of(a.x - b.x, a.y - b.y).major;
        }
        const double largest = here.largest();
        return (largest > 0 ? mesh_error::estimate_safety * difference / largest : 0) +
               _motion.rounding();
    }
};

/// Of the spin speed: imbalances drive at odd ones, the weight at even ones; higher ones are driven
/// by the square and more of what the bearings differ by.
constexpr std::array multiples_looked_at{1.0, 2.0, 3.0, 4.0};

/// A place or a bearing whose largest distance over a turn is looked at.
struct Watched {
    results::ResponsePeak peak; ///< what and where it is
    std::function<TurnParts(const Motions &)> parts;
    std::function<double(const Motions &, const TurnParts &)> error;
};

/// Speeds at which peaks are looked for: those asked for, an even grid, and those about which a
/// free motion is near resonance, where a peak can be narrower than both: its frequency, or that of
/// its line between two speeds of the diagram, passes one of the first multiples that drive it.
/// @param odd  the multiples of imbalances, not those of the weight
std::vector<double> looked_at(const model::SpeedRange &range,
                              const results::CampbellResult &free_motions, bool odd) {
    constexpr int even = 200;
    const double low = std::min(range.from, range.to);
    const double high = std::max(range.from, range.to);
    std::vector<double> all = range.values();
    for (int i = 0; i <= even; ++i)
        all.push_back(low + (high - low) * i / even);
    const auto about = [&](double speed, double ratio) {
        const double width = std::max(std::abs(ratio), 1e-9) * speed;
        for (const double widths : {-8.0, -4.0, -2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0, 4.0, 8.0})
            all.push_back(speed + widths * width);
    };
    const auto drives = [odd](double multiple) { return (std::fmod(multiple, 2) != 0) == odd; };
    for (const results::Crossing &crossing : free_motions.crossings)
        if (drives(crossing.multiple))
            about(crossing.speed, crossing.damping.ratio.value_or(0));
    for (const results::CampbellMode &mode : free_motions.modes)
        for (std::size_t k = 0; k + 1 < free_motions.speeds.size(); ++k)
            for (const double multiple : multiples_looked_at) {
                if (!drives(multiple) || !mode.frequency[k] || !mode.frequency[k + 1])
                    continue;
                const double here = *mode.frequency[k] - multiple * free_motions.speeds[k];
                const double there = *mode.frequency[k + 1] - multiple * free_motions.speeds[k + 1];
                if ((here < 0) != (there < 0))
                    about(free_motions.speeds[k] +
                              (free_motions.speeds[k + 1] - free_motions.speeds[k]) * here /
                                  (here - there),
                          mode.damping_ratio[k].value_or(0));
            }
    std::erase_if(all, [&](double speed) { return speed < low || speed > high; });
    std::ranges::sort(all);
    // Nearer to each other than the curve can tell.
    constexpr double same = 1e-9;
    const auto last = std::unique(all.begin(), all.end(),
                                  [](double a, double b) { return b - a <= same * std::abs(b); });
    all.erase(last, all.end());
    return all;
}

/// Free motions over the range, with crossings of the multiples that loads have.
results::CampbellResult free_motions_of(const model::Case &scene) {
    model::Case bare = without_balancers(scene);
    bare.campbell.multiples = {multiples_looked_at.begin(), multiples_looked_at.end()};
    return hill_crossings(bare).diagram;
}

/// Largest values of the quantities over the range, and their curves.
class PeakSearch {
  public:
    PeakSearch(Motions &motions, const std::vector<Watched> &watched,
               const results::CampbellResult &free_motions, std::vector<double> speeds)
        : _motions(motions), _watched(watched), _free(free_motions), _speeds(std::move(speeds)) {}

    void find(std::vector<results::ResponsePeak> &peaks, results::ResponseCurves &curves) {
        curves.speeds = _speeds;
        curves.values.resize(_watched.size());
        curves.phases.resize(_watched.size());
        std::vector<double> noise;
        for (const double speed : _speeds) {
            _motions.solve(speed, false);
            noise.push_back(10 * std::max(_motions.rounding(), 1e-14));
            for (std::size_t i = 0; i < _watched.size(); ++i) {
                const TurnParts parts = _watched[i].parts(_motions);
                curves.values[i].push_back(_motions.limited() ? parts.largest() : unlimited);
                curves.phases[i].push_back(_motions.limited() ? phase(parts) : no_value);
            }
        }
        for (std::size_t i = 0; i < _watched.size(); ++i)
            for (std::size_t k = 1; k + 1 < _speeds.size(); ++k) {
                const std::vector<double> &v = curves.values[i];
                const double least = (1 - noise[k]) * v[k]; // what rises above rounding
                if (v[k - 1] < least && v[k + 1] <= v[k] && v[k] > 0)
                    peaks.push_back(peak(i, k, v));
            }
    }

  private:
    Motions &_motions;
    const std::vector<Watched> &_watched;
    const results::CampbellResult &_free;
    std::vector<double> _speeds;

    static double phase(const TurnParts &parts) {
        const forced::Phasor lowest = parts.part(parts.first == 0 ? 2 : parts.first);
        return std::arg(lowest.x);
    }

    double value(std::size_t i, double speed, bool finer = false) {
        _motions.solve(speed, finer);
        return _motions.limited() ? _watched[i].parts(_motions).largest() : unlimited;
    }

    results::ResponsePeak peak(std::size_t i, std::size_t k, const std::vector<double> &values) {
        const double speed = linalg::least_place([&](double s) { return -value(i, s); },
                                                 _speeds[k - 1], _speeds[k + 1]);
        results::ResponsePeak out = _watched[i].peak;
        out.speed = speed;
        out.value = value(i, speed, true);
        const TurnParts parts = _watched[i].parts(_motions);
        const bool limited = _motions.limited();
        out.phase = phase(parts);
        out.error = _watched[i].error(_motions, parts);
        out.error_parts.mesh = out.error;
        if (limited) {
            out.lower = half_power(i, k, values, speed, out.value, -1);
            out.upper = half_power(i, k, values, speed, out.value, 1);
        }
        if (out.lower && out.upper)
            out.amplification = speed / (*out.upper - *out.lower);
        constexpr double sharp = 1e5; // a damping ratio of 5e-6: only then it can have no limit
        const auto at = !limited || (out.amplification && *out.amplification > sharp)
                            ? pole(i, speed)
                            : std::nullopt;
        if (at || !limited) {
            out.speed = at.value_or(speed);
            out.value = unlimited;
            out.phase = out.error = no_value;
            out.error_parts = {};
            out.lower = out.upper = out.amplification = std::nullopt;
            out.speed_error = at ? 1e-9 : 1e-8;
            return out;
        }
        // A resonance that is off by a part e of its speed turns the phase of the motion by 2 AF e,
        // which is the difference to the finer elements.
        const double width = out.amplification.value_or(1);
        out.speed_error = std::max(1e-8, std::min(out.error, 1.0) / (2 * width));
        out.mode = nearest_mode(speed, out.amplification);
        return out;
    }

    /// Where it grows like 1 / distance to the end, as next to the end of an unstable range, at
    /// which a root passes zero, damping or not: by a factor of ten at a tenth of the distance. A
    /// resonance that damping limits would have a damping ratio below 1e-7 to come so near to that.
    std::optional<double> pole(std::size_t i, double speed) {
        constexpr double far = 1e-6; // of the speed; the largest of samples is within 1e-8
        for (const double part : {far, far / 10}) {
            const double d = part * speed;
            const double left = 1 / value(i, speed - d);
            const double right = 1 / value(i, speed + d);
            if (left + right > 0)
                speed += d * (left - right) / (left + right);
        }
        for (const int side : {-1, 1})
            if (!(value(i, speed * (1 + side * far / 10)) > 9 * value(i, speed * (1 + side * far))))
                return std::nullopt;
        return speed;
    }

    /// Where the curve has fallen to 1/sqrt(2) of a peak, before it rises above the peak.
    std::optional<double> half_power(std::size_t i, std::size_t k,
                                     const std::vector<double> &values, double speed, double top,
                                     int side) {
        const double level = top / std::numbers::sqrt2;
        double inside = speed;
        for (auto j = static_cast<std::ptrdiff_t>(k) + side; j >= 0 && j < std::ssize(_speeds);
             j += side) {
            const double s = _speeds[static_cast<std::size_t>(j)];
            const double v = values[static_cast<std::size_t>(j)];
            if (v > top)
                return std::nullopt;
            if ((s - speed) * side <= 0)
                continue;
            if (v > level) {
                inside = s;
                continue;
            }
            const auto above = [&](double at) { return value(i, at) - level; };
            constexpr double close = 1e-8; // of a width
            return linalg::root_between(above, inside, above(inside), s, v - level, close);
        }
        return std::nullopt;
    }

    /// The line that crosses the spin speed next to a peak, within its width.
    [[nodiscard]] std::string nearest_mode(double speed,
                                           std::optional<double> amplification) const {
        const double width = speed / amplification.value_or(1e4);
        std::string out;
        double least = width;
        for (const results::Crossing &crossing : _free.crossings)
            if (const double away = std::abs(crossing.speed - speed); away <= least) {
                least = away;
                out = _free.modes[static_cast<std::size_t>(crossing.mode)].label;
            }
        return out;
    }
};

/// The semi-axes at other multiples than the first, where they are more than rounding leaves.
void add_harmonics(results::ResponseNode &node, const std::vector<TurnParts> &over_speed) {
    std::size_t most = 0;
    for (const TurnParts &parts : over_speed)
        most = std::max(most, parts.parts.size());
    for (std::size_t j = 1; j < most; ++j) {
        results::ResponseHarmonic harmonic;
        harmonic.multiple = 1 + 2 * static_cast<int>(j);
        double largest = 0;
        for (std::size_t k = 0; k < over_speed.size(); ++k) {
            const forced::Phasor part = over_speed[k].part(harmonic.multiple);
            const modes::Ellipse orbit = modes::ellipse_of(part.x, part.y);
            harmonic.major.push_back(orbit.major);
            harmonic.minor.push_back(orbit.minor);
            if (node.amplitude[k] > 0 && std::isfinite(node.amplitude[k]))
                largest = std::max(largest, orbit.major / node.amplitude[k]);
        }
        constexpr double seen = 1e-6; // of the amplitude
        if (largest > seen)
            node.harmonics.push_back(std::move(harmonic));
    }
}

void note_resonances(results::ResponseResult &result, const std::vector<double> &amplitudes) {
    const std::vector<double> speeds = forced::speeds_without_limit(result.speeds, amplitudes);
    if (!speeds.empty())
        result.model.notes.emplace_back(
            model::Weight::warning,
            "no steady motion at {}: a resonance without damping, or a series that does not settle",
            as::speed.list(speeds));
}

/// What both loads need.
struct Scene {
    const model::Case &scene;
    const assembly::Discretization &d;
    const assembly::Discretization *fine;
    const results::CampbellResult &free_motions;
    std::map<int, std::string> nodes;

    [[nodiscard]] double place(int node) const {
        return d.shaft_mesh().nodes[static_cast<std::size_t>(node)];
    }
};

/// Stations, bearings and probes.
/// @param moving  without what stands still
std::vector<Watched> watched_in(const Scene &all, bool moving, bool probes) {
    std::vector<Watched> out;
    const auto of = [&](const char *what, int place, double z, const std::string &name) {
        results::ResponsePeak peak;
        peak.of = what;
        peak.place = place;
        peak.z = z;
        peak.name = name;
        return peak;
    };
    const auto part = [moving](const Motions &m, const TurnParts &parts) {
        return moving ? m.moving(parts) : parts;
    };
    int place = 0;
    for (const auto &[node, name] : all.nodes) {
        const double z = all.place(node);
        out.push_back(
            {of("station", place++, z, name), [=](const Motions &m) { return part(m, m.at(z)); },
             [=](const Motions &m, const TurnParts &) { return m.error_at(z, m.at(z)); }});
    }
    place = 0;
    for (const model::Bearing &bearing : all.d.rotor().supports()) {
        const int i = place++;
        out.push_back(
            {of("bearing", i, bearing.z, bearing.name),
             [=](const Motions &m) { return part(m, m.force(i)); },
             [=](const Motions &m, const TurnParts &) { return m.error_of_force(i, m.force(i)); }});
    }
    place = 0;
    if (probes)
        for (const model::Probe &probe : all.d.rotor().probes) {
            results::ResponsePeak peak = of("probe", place++, probe.z, probe.name);
            peak.angle = probe.angle;
            const double angle = probe.angle;
            out.push_back({peak, [=](const Motions &m) { return m.at(probe).read(angle); },
                           [=](const Motions &m, const TurnParts &seen) {
                               return m.error_of_probe(probe, seen);
                           }});
        }
    return out;
}

void add_imbalance_response(const Scene &all, results::ResponseResult &result) {
    Motions motions(all.d, all.fine, 0);
    forced::add_places(result, all.d, all.nodes);
    std::vector<std::vector<TurnParts>> over_speed(result.nodes.size());
    for (const double speed : result.speeds) {
        motions.solve(speed, true);
        const bool limited = motions.limited();
        for (std::size_t i = 0; i < result.nodes.size(); ++i) {
            results::ResponseNode &node = result.nodes[i];
            const TurnParts parts = limited ? motions.at(node.z) : TurnParts{1, {}};
            over_speed[i].push_back(parts);
            const forced::Phasor u = limited ? parts.part(1) : forced::Phasor{unlimited, unlimited};
            const modes::Ellipse orbit = modes::ellipse_of(u.x, u.y);
            node.amplitude.push_back(limited ? parts.largest() : unlimited);
            node.major.push_back(limited ? orbit.major : unlimited);
            node.minor.push_back(limited ? orbit.minor : no_value);
            node.x.push_back(limited ? std::abs(u.x) : unlimited);
            node.y.push_back(limited ? std::abs(u.y) : unlimited);
            node.phase.push_back(limited ? std::arg(u.x) : no_value);
            node.x_phase.push_back(node.phase.back());
            node.y_phase.push_back(limited ? std::arg(u.y) : no_value);
            node.inclination.push_back(limited ? forced::inclination_of(u, 1e-12) : no_value);
            node.error.push_back(limited ? motions.error_at(node.z, parts) : unlimited);
        }
        for (std::size_t i = 0; i < result.bearings.size(); ++i) {
            const TurnParts parts = motions.force(static_cast<int>(i));
            result.bearings[i].force.push_back(limited ? parts.largest() : unlimited);
            result.bearings[i].error.push_back(
                limited ? motions.error_of_force(static_cast<int>(i), parts) : unlimited);
        }
        for (std::size_t i = 0; i < result.probes.size(); ++i) {
            results::ResponseProbe &probe = result.probes[i];
            const model::Probe &of = all.d.rotor().probes[i];
            const TurnParts seen = motions.at(of).read(of.angle);
            probe.amplitude.push_back(limited ? seen.largest() : unlimited);
            probe.phase.push_back(limited ? std::arg(seen.part(1).x) : no_value);
            probe.error.push_back(limited ? motions.error_of_probe(of, seen) : unlimited);
        }
    }
    for (std::size_t i = 0; i < result.nodes.size(); ++i)
        add_harmonics(result.nodes[i], over_speed[i]);
    result.model.unknowns = motions.unknowns();
    note_resonances(result, result.nodes.front().amplitude);
    if (result.speeds.size() < 2)
        return;
    const std::vector<Watched> watched = watched_in(all, false, true);
    PeakSearch(motions, watched, all.free_motions,
               looked_at(model::required_speeds(all.scene), all.free_motions, true))
        .find(result.peaks, result.curves);
}

/// One drive of such a rotor, at the operating speeds.
class PeriodicMover : public Mover {
  public:
    PeriodicMover(const Scene &all, double gravity)
        : Mover(gravity == 0), _all(all), _motions(all.d, all.fine, gravity), _odd(gravity == 0) {}

    bool solve(double speed, bool with_error) override {
        _speed = speed;
        _motions.solve(speed, with_error);
        return _motions.limited();
    }

    [[nodiscard]] Moving of(const forced::Quantity &quantity) const override {
        const TurnParts whole = _motions.of(quantity);
        TurnParts parts = quantity.angle ? whole.read(*quantity.angle) : whole;
        if (!_odd)
            parts = _motions.moving(parts);
        Moving out;
        out.amplitude = parts.largest();
        if (out.amplitude > 0)
            out.phase = std::arg(parts.part(_odd ? 1 : 2).x);
        double squares = 0; // of the velocities: an upper bound of the largest over all directions
        const TurnParts velocity = over_time(parts, &squares);
        out.velocity = velocity.largest();
        out.velocity_rms = std::sqrt(squares / 2);
        out.acceleration = over_time(velocity, nullptr).largest();
        out.error = quantity.bearing != forced::Quantity::deflection
                        ? _motions.error_of_force(quantity.bearing, whole)
                        : _motions.error_of(quantity, whole);
        if (out.amplitude > 0)
            out.error *= whole.largest() / out.amplitude;
        return out;
    }

    [[nodiscard]] Look look(double from, double to,
                            const std::vector<forced::Quantity> &) const override {
        model::Case there = _all.scene;
        constexpr int lines = 60; // between which free motions are followed
        there.speeds = model::SpeedRange{from, to, lines};
        return {looked_at(*there.speeds, free_motions_of(there), _odd), {}};
    }

  private:
    const Scene &_all;
    Motions _motions;
    bool _odd;
    double _speed = 0;

    /// The derivative. @param squares  of the semi-major axes of its parts, summed up
    [[nodiscard]] TurnParts over_time(TurnParts parts, double *squares) const {
        for (std::size_t i = 0; i < parts.parts.size(); ++i) {
            const double rate = (parts.first + 2 * static_cast<int>(i)) * _speed;
            forced::Phasor &part = parts.parts[i];
            part.x *= forced::imaginary_unit * rate;
            part.y *= forced::imaginary_unit * rate;
            if (squares != nullptr)
                *squares += std::pow(modes::ellipse_of(part.x, part.y).major, 2);
        }
        return parts;
    }
};

void add_operating(const Scene &all, results::ResponseResult &result) {
    std::vector<std::unique_ptr<Mover>> movers;
    movers.push_back(std::make_unique<PeriodicMover>(all, 0));
    if (all.scene.response.gravity != 0)
        movers.push_back(std::make_unique<PeriodicMover>(all, all.scene.response.gravity));
    result.operating = operating_response(all.scene, all.d, movers, all.nodes);
    note_operating_resonances(*result.operating, result.model.notes);
}

void add_gravity_response(const Scene &all, results::ResponseResult &result) {
    Motions motions(all.d, all.fine, all.scene.response.gravity);
    results::GravityResponse &out = result.gravity.emplace();
    out.gravity = all.scene.response.gravity;
    forced::add_places(out, all.d, all.nodes);
    for (const double speed : result.speeds) {
        motions.solve(speed, true);
        const bool limited = motions.limited();
        for (results::GravityStation &station : out.stations) {
            const TurnParts parts = motions.at(station.z);
            const forced::Phasor still = parts.part(0);
            const double sag = std::hypot(still.x.real(), still.y.real());
            const double moves = motions.moving(parts).largest();
            const double error = motions.error_at(station.z, parts) * parts.largest();
            station.sag.push_back(limited ? sag : unlimited);
            station.sag_x.push_back(limited ? still.x.real() : no_value);
            station.sag_y.push_back(limited ? still.y.real() : no_value);
            station.twice.push_back(limited ? moves : unlimited);
            station.phase.push_back(limited && moves > 0 ? std::arg(parts.part(2).x) : no_value);
            station.error.push_back(limited ? (moves > 0 ? error / moves : 0) : unlimited);
            station.sag_error.push_back(limited ? (sag > 0 ? error / sag : 0) : unlimited);
        }
        for (std::size_t i = 0; i < out.bearings.size(); ++i) {
            const TurnParts parts = motions.force(static_cast<int>(i));
            const forced::Phasor still = parts.part(0);
            const double carried = std::hypot(still.x.real(), still.y.real());
            const double moves = motions.moving(parts).largest();
            const double error =
                motions.error_of_force(static_cast<int>(i), parts) * parts.largest();
            out.bearings[i].carried.push_back(limited ? carried : unlimited);
            out.bearings[i].twice.push_back(limited ? moves : unlimited);
            out.bearings[i].error.push_back(limited ? (moves > 0 ? error / moves : 0) : unlimited);
            out.bearings[i].carried_error.push_back(limited ? (carried > 0 ? error / carried : 0)
                                                            : unlimited);
        }
    }
    result.model.unknowns = motions.unknowns();
    if (result.speeds.size() < 2)
        return;
    const std::vector<Watched> watched = watched_in(all, true, false);
    PeakSearch(motions, watched, all.free_motions,
               looked_at(model::required_speeds(all.scene), all.free_motions, false))
        .find(out.peaks, out.curves);
}

} // namespace

bool response_is_periodic(const model::Case &scene) {
    const model::Case bare = without_balancers(scene);
    const bool forces = !scene.rotor.forces.empty() || !scene.response.receptances.empty();
    return (bare.rotor.rotating_anisotropy() ||
            (scene.formulation == model::FormChoice::hill && !forces)) &&
           modes::choose_formulation(bare).form == results::Form::hill;
}

results::ResponseResult periodic_response(const model::Case &scene) {
    const model::Case bare = without_balancers(scene);
    results::ResponseResult result;
    result.speeds = model::required_speeds(scene).values();
    result.model.formulation = modes::choose_formulation(bare);
    result.model.order = mesh_error::resolve_order(bare, result.model.formulation);
    const assembly::Discretization d(bare.rotor, result.model.order);
    result.model.elements = static_cast<int>(d.shaft_mesh().spans.size());
    constexpr int highest = 30; // order of elements
    std::optional<assembly::Discretization> fine;
    if (!d.rigid())
        fine.emplace(bare.rotor, std::min(mesh_error::finer_order(result.model.order), highest));
    std::optional<process::Stage> stage(std::in_place, "free motions", 0.0, 0.3);
    const results::CampbellResult free_motions =
        result.speeds.size() < 2 ? results::CampbellResult{} : free_motions_of(bare);
    if (process::process_rank() != 0)
        return {};
    stage.emplace("response", 0.3, 0.9);
    const Scene all{bare, d, fine ? &*fine : nullptr, free_motions, forced::attached_nodes(d)};
    if (!bare.rotor.imbalances.empty())
        add_imbalance_response(all, result);
    if (bare.response.gravity != 0)
        add_gravity_response(all, result);
    if (bare.operation && !bare.rotor.imbalances.empty())
        add_operating(all, result);
    result.model.notes.emplace_back(
        model::Weight::information,
        "rotor and bearings both differ between their directions: the motion has many multiples of "
        "the spin speed; amplitudes are the largest over a turn, ellipses and phases those of 1x");
    return result;
}

} // namespace whirl::analyses

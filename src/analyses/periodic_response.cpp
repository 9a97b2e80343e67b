#include "analyses/periodic_response.h"

#include "analyses/operating/operating.h"
#include "forced/curve_peaks.h"
#include "forced/periodic_motion.h"
#include "forced/response_places.h"
#include "mesh_error/estimate.h"
#include "mesh_error/safety.h"
#include "model/errors.h"
#include "modes/formulation.h"
#include "modes/orbits.h"
#include "process/processes.h"
#include "process/progress.h"
#include "results/sentence.h"
#include "synchronous/parts.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
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
        if (out.largest() <= 10 * least_rounding() * size)
            out.parts.clear();
        return out;
    }
    /// Relative to what stands still and what moves together.
    [[nodiscard]] double least_rounding() const {
        constexpr double of_sums = 1e-14; // behind every deflection
        return std::max(_motion.rounding(), of_sums);
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

/// A place or a bearing whose largest distance over a turn is looked at.
struct Watched {
    results::ResponsePeak peak; ///< what and where it is
    std::function<TurnParts(const Motions &)> parts;
    std::function<double(const Motions &, const TurnParts &)> error;
};

/// What is looked at of it: under the weight what moves.
/// @param first  multiple of the spin speed that a load drives
TurnParts seen(const Motions &motions, const TurnParts &parts, int first) {
    return first > 1 ? motions.moving(parts) : parts;
}
TurnParts seen(const Motions &motions, const Watched &watched, int first) {
    return seen(motions, watched.parts(motions), first);
}

/// A row of numbers a quantity: x and y of each of its parts.
Eigen::RowVectorXcd numbers_of(const TurnParts &motion) {
    Eigen::RowVectorXcd out(2 * std::ssize(motion.parts));
    Eigen::Index place = 0;
    for (const forced::Phasor &part : motion.parts) {
        out(place++) = part.x;
        out(place++) = part.y;
    }
    return out;
}

TurnParts parts_of(const Eigen::RowVectorXcd &numbers, int first) {
    TurnParts out{first, {}};
    for (Eigen::Index i = 0; i + 1 < numbers.size(); i += 2)
        out.parts.push_back({numbers(i), numbers(i + 1)});
    return out;
}

/// Rows of all bearing tables, rad/s, between neighbouring ones of which every coefficient stays
/// within 1 % of the largest one of its kind there of a straight line: all rows of a coarse table,
/// few of one with many rows along a curve.
std::vector<double> rows_of_straight_pieces(const model::Rotor &rotor) {
    constexpr double straight = 0.01;
    const std::vector<double> rows = synchronous::table_speeds(rotor);
    const std::vector<double> bends = rotor.table_bends();
    std::vector<double> out;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const bool last = i + 1 == rows.size();
        const bool needed = last || std::ranges::binary_search(bends, rows[i]) ||
                            std::ranges::any_of(rotor.bearings, [&](const auto &bearing) {
                                return bearing.depends_on_speed() &&
                                       bearing.bend_between(out.back(), rows[i + 1]) > straight;
                            });
        if (needed)
            out.push_back(rows[i]);
    }
    return out;
}

/// The ends of a range of speeds of one sign, the rows of bearing tables between and halves of the
/// fastest: multiples of the spin speed crowd resonances towards rest. Of a range on both sides of
/// rest two.
std::vector<std::vector<double>> cuts_of(const model::Rotor &rotor,
                                         const model::SpeedRange &range) {
    const double high = std::max(range.from, range.to);
    const double low = std::min(range.from, range.to);
    constexpr double slowest = 1e-6; // of the fastest speed: at rest nothing moves
    std::vector<std::vector<double>> out;
    const auto add = [&](double from, double to) {
        std::vector<double> &cuts = out.emplace_back();
        cuts = {from, to};
        constexpr int halves = 6;
        double half = std::abs(from) > std::abs(to) ? from : to;
        for (int i = 0; i < halves; ++i)
            cuts.push_back(half /= 2);
        for (const double row : rows_of_straight_pieces(rotor))
            cuts.push_back(row);
        std::erase_if(cuts, [=](double cut) { return cut < from || cut > to; });
        std::ranges::sort(cuts);
        constexpr double same = 1e-6; // of the fastest
        const auto last = std::unique(cuts.begin(), cuts.end(), [=](double a, double b) {
            return b - a < same * std::max(std::abs(from), std::abs(to)) && b != to;
        });
        cuts.erase(last, cuts.end());
    };
    if (low < 0)
        add(low, std::min(high, slowest * low));
    if (high > 0)
        add(std::max(low, slowest * high), high);
    return out;
}

/// Amplitudes over a range of speeds.
/// @param first  multiple of the spin speed
forced::CurvePeaks amplitudes(Motions &motions, const std::vector<Watched> &watched, int first,
                              const std::vector<double> &cuts) {
    const auto solve = [&](double speed) -> std::optional<linalg::RationalCurve::Values> {
        motions.solve(speed, false);
        if (!motions.limited())
            return std::nullopt;
        std::vector<Eigen::RowVectorXcd> rows;
        Eigen::Index columns = 2; // of what does not move
        linalg::RationalCurve::Values out;
        out.rounding.setZero(std::ssize(watched));
        for (const Watched &one : watched) {
            const TurnParts parts = one.parts(motions);
            out.rounding(std::ssize(rows)) = motions.least_rounding() * parts.largest();
            rows.push_back(numbers_of(seen(motions, parts, first)));
            columns = std::max(columns, rows.back().size());
        }
        out.numbers.setZero(std::ssize(rows), columns);
        for (Eigen::Index i = 0; i < std::ssize(rows); ++i) {
            const Eigen::RowVectorXcd &row = rows[static_cast<std::size_t>(i)];
            out.numbers.row(i).head(row.size()) = row;
        }
        return out;
    };
    const auto size = [first](const Eigen::RowVectorXcd &numbers) {
        return parts_of(numbers, first).largest();
    };
    const auto change = [first](const Eigen::RowVectorXcd &numbers,
                                const Eigen::RowVectorXcd &changes) {
        return parts_of(numbers, first).change_of_largest(parts_of(changes, first));
    };
    // Values of peaks are solved for.
    constexpr double enough = 1e-8;
    return {{cuts, cuts.front(), cuts.back(), enough}, solve, {size, change}};
}

/// Largest values of the quantities over the range, and their curves.
class PeakSearch {
  public:
    /// @param first  multiple of the spin speed that the motion has
    PeakSearch(Motions &motions, const std::vector<Watched> &watched, int first)
        : _motions(motions), _watched(watched), _first(first) {}

    /// @param ranges  ends of pieces, rad/s
    void find(const std::vector<std::vector<double>> &ranges,
              std::vector<results::ResponsePeak> &peaks, results::ResponseCurves &curves,
              std::vector<model::Sentence> &notes) {
        curves.values.resize(_watched.size());
        curves.phases.resize(_watched.size());
        std::vector<forced::Peak> tops;
        for (const std::vector<double> &cuts : ranges) {
            const forced::CurvePeaks found = amplitudes(_motions, _watched, _first, cuts);
            tops.insert(tops.end(), found.peaks().begin(), found.peaks().end());
            forced::note_missing(found.unsettled(), notes);
            forced::add_curve(found.drawn(), curves);
        }
        std::ranges::stable_sort(tops, {}, &forced::Peak::quantity);
        for (const forced::Peak &top : tops)
            peaks.push_back(peak(top));
    }

  private:
    Motions &_motions;
    const std::vector<Watched> &_watched;
    int _first;

    results::ResponsePeak peak(const forced::Peak &top) {
        const std::size_t i = top.quantity;
        results::ResponsePeak out = _watched[i].peak;
        out.speed = top.speed;
        if (!std::isinf(top.value))
            _motions.solve(top.speed, true);
        if (std::isinf(top.value) || !_motions.limited()) {
            out.value = unlimited;
            out.phase = out.error = no_value;
            out.speed_error = std::isinf(top.value) ? 1e-9 : 1e-8;
            return out;
        }
        const TurnParts parts = seen(_motions, _watched[i], _first);
        out.value = parts.largest();
        out.phase = std::arg(parts.part(_first).x);
        out.error = _watched[i].error(_motions, parts);
        out.error_parts.mesh = out.error;
        out.lower = top.lower;
        out.upper = top.upper;
        if (out.lower && out.upper)
            out.amplification = std::abs(out.speed) / (*out.upper - *out.lower);
        // A resonance that is off by a part e of its speed turns the phase of the motion by 2 AF e,
        // which is the difference to the finer elements.
        const double width = out.amplification.value_or(1);
        out.speed_error = std::max(1e-9, std::min(out.error, 1.0) / (2 * width));
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
    std::map<int, std::string> nodes;

    [[nodiscard]] double place(int node) const {
        return d.shaft_mesh().nodes[static_cast<std::size_t>(node)];
    }
};

/// Stations, bearings and probes.
std::vector<Watched> watched_in(const Scene &all, bool probes) {
    std::vector<Watched> out;
    const auto of = [&](const char *what, int place, double z, const std::string &name) {
        results::ResponsePeak peak;
        peak.of = what;
        peak.place = place;
        peak.z = z;
        peak.name = name;
        return peak;
    };
    int place = 0;
    for (const auto &[node, name] : all.nodes) {
        const double z = all.place(node);
        out.push_back(
            {of("station", place++, z, name), [=](const Motions &m) { return m.at(z); },
             [=](const Motions &m, const TurnParts &) { return m.error_at(z, m.at(z)); }});
    }
    place = 0;
    for (const model::Bearing &bearing : all.d.rotor().supports()) {
        const int i = place++;
        out.push_back(
            {of("bearing", i, bearing.z, bearing.name),
             [=](const Motions &m) { return m.force(i); },
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
    const std::vector<Watched> watched = watched_in(all, true);
    PeakSearch(motions, watched, 1)
        .find(cuts_of(all.d.rotor(), model::required_speeds(all.scene)), result.peaks,
              result.curves, result.model.notes);
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
        const TurnParts parts = seen(_motions, watched(quantity), first());
        Moving out;
        out.amplitude = parts.largest();
        if (out.amplitude > 0)
            out.phase = std::arg(parts.part(first()).x);
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
                            const std::vector<forced::Quantity> &quantities) const override {
        std::vector<Watched> all;
        for (const forced::Quantity &quantity : quantities)
            all.push_back(watched(quantity));
        Look out;
        Motions motions(_all.d, nullptr, _odd ? 0 : _all.scene.response.gravity);
        for (const std::vector<double> &cuts : cuts_of(_all.d.rotor(), {from, to, 2}))
            for (const auto &sample : amplitudes(motions, all, first(), cuts).drawn())
                out.speeds.push_back(sample.speed);
        return out;
    }

  private:
    const Scene &_all;
    Motions _motions;
    bool _odd;
    double _speed = 0;

    [[nodiscard]] int first() const { return _odd ? 1 : 2; }

    [[nodiscard]] static Watched watched(const forced::Quantity &quantity) {
        const auto parts = [&quantity](const Motions &motions) {
            const TurnParts whole = motions.of(quantity);
            return quantity.angle ? whole.read(*quantity.angle) : whole;
        };
        return {{}, parts, {}};
    }

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
    const std::vector<Watched> watched = watched_in(all, false);
    PeakSearch(motions, watched, 2)
        .find(cuts_of(all.d.rotor(), model::required_speeds(all.scene)), out.peaks, out.curves,
              result.model.notes);
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
    if (process::process_rank() != 0)
        return {};
    const process::Stage stage("response", 0.0, 0.9);
    const Scene all{bare, d, fine ? &*fine : nullptr, forced::attached_nodes(d)};
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

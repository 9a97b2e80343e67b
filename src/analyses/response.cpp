#include "analyses/response.h"

#include "analyses/critical.h"
#include "analyses/names/mode_naming.h"
#include "analyses/notes/growth.h"
#include "analyses/operating/operating.h"
#include "analyses/orbits/response_orbits.h"
#include "analyses/periodic_response.h"
#include "forced/forced_motion.h"
#include "forced/response_error.h"
#include "forced/response_gravity.h"
#include "forced/response_places.h"
#include "forced/response_receptance.h"
#include "mesh_error/estimate.h"
#include "model/case.h"
#include "model/errors.h"
#include "model/variants.h"
#include "modes/orbits.h"
#include "operation/margins.h"
#include "process/parallel.h"
#include "process/progress.h"
#include "results/formulation.h"
#include "results/resonances.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

namespace whirl::analyses {

namespace {

using results::Sentence;
namespace as = results::as;

using forced::no_value;
using forced::unlimited;

void refuse_what_is_missing(const model::Case &scene) {
    if (scene.rotor.imbalances.empty() && scene.rotor.forces.empty() &&
        scene.response.gravity == 0 && scene.response.receptances.empty())
        throw model::BadInput(
            fmt::format("{}: imbalance: missing, expected at least one "
                        "[[imbalance]], as z = 0.5, mr = \"100 g mm\", to drive "
                        "the response, or the imbalance of a balancer, [[force]], "
                        "response.gravity or response.receptance",
                        scene.file.string()));
    model::Rotor without = scene.rotor; // the response leaves balancers out
    without.balancers.clear();
    if (!without.rotating_anisotropy())
        return;
    const bool forces = !scene.rotor.forces.empty();
    if (forces || !scene.response.receptances.empty())
        throw model::BadInput(fmt::format(
            "{}: {}: expected a rotor that is the same from every direction, got one with "
            "[[anisotropy]] or two bending stiffnesses: a force of one frequency moves it at "
            "several, which is not computed",
            scene.file.string(), forces ? "force" : "response.receptance"));
}

/// The lists of a result, in the order of a row: one value of each a speed.
std::vector<std::vector<double> *> lists_of(results::HarmonicMotion &result) {
    std::vector<std::vector<double> *> lists;
    for (results::ResponseNode &node : result.nodes)
        lists.insert(lists.end(),
                     {&node.amplitude, &node.phase, &node.major, &node.minor, &node.x,
                      &node.x_phase, &node.y, &node.y_phase, &node.inclination, &node.error});
    for (results::ResponseBearing &bearing : result.bearings)
        lists.insert(lists.end(), {&bearing.force, &bearing.error});
    for (results::ResponseProbe &probe : result.probes)
        lists.insert(lists.end(), {&probe.amplitude, &probe.phase, &probe.error});
    return lists;
}

/// The response at one speed, as rows for lists_of().
class Response {
  public:
    Response(const assembly::Discretization &d, results::Form form,
             const std::map<int, std::string> &nodes, const forced::Drive &drive = {})
        : _discretization(d), _nodes(nodes), _forced(d, form, drive), _finer(d, form, drive) {}

    [[nodiscard]] int unknowns() const { return _forced.unknowns(); }

    /// False at a resonance without damping.
    bool solve(double speed) {
        if (!forced::solves(_forced, speed))
            return false;
        _error_known = forced::solves(_finer, speed);
        return _forced.rounding() <= forced::resonance_rounding || confirmed() || unexcited(speed);
    }

    /// The motion solved last, at all places.
    [[nodiscard]] SolvedMotion solved() {
        return {_forced, _error_known ? &_finer : nullptr, rounding()};
    }

    std::vector<double> row(double speed) {
        if (!solve(speed))
            return no_limit();
        std::vector<double> row;
        add_nodes(row);
        add_bearings(row);
        add_probes(row);
        return row;
    }

  private:
    const assembly::Discretization &_discretization;
    const std::map<int, std::string> &_nodes;
    forced::ForcedMotion _forced;
    forced::ResponseError _finer;
    bool _error_known = true;

    /// Where the finer model has confirmed what rounding could have decided, the difference to it
    /// is both.
    [[nodiscard]] double rounding() const {
        return _forced.rounding() > forced::resonance_rounding ? 0 : _forced.rounding();
    }

    /// By the elements and by rounding.
    [[nodiscard]] double error(double by_elements) const {
        return _error_known ? by_elements + rounding() : unlimited;
    }

    /// The finer model has the same motion: its rounding is another, and no
    /// resonance of its own is in just this place. Very short elements look ill
    /// conditioned without being it.
    [[nodiscard]] bool confirmed() const {
        if (!_error_known || _discretization.rigid())
            return false;
        return std::ranges::all_of(_nodes, [&](const auto &node) {
            const double z = place_of(node.first);
            return _finer.at(z, _forced.at(z)) < 0.1;
        });
    }

    [[nodiscard]] double place_of(int node) const {
        return _discretization.shaft_mesh().nodes[static_cast<std::size_t>(node)];
    }

    [[nodiscard]] std::vector<forced::Phasor> motions() const {
        std::vector<forced::Phasor> out;
        for (const auto &[node, name] : _nodes)
            out.push_back(_forced.at(place_of(node)));
        return out;
    }

    /// A resonance of a motion that nothing excites: a little beside it the rotor
    /// moves in the same way, where an excited one would be smaller by orders of magnitude.
    [[nodiscard]] bool unexcited(double speed) {
        constexpr double beside = 1e-8;
        constexpr double beside_rest = 1e-6; // rad/s
        constexpr double same = 1e-4;
        const std::vector<forced::Phasor> here = motions();
        _forced.solve(speed != 0 ? speed * (1 + beside) : beside_rest);
        const std::vector<forced::Phasor> there = motions();
        _forced.solve(speed);
        double difference = 0;
        double size = 0;
        for (std::size_t i = 0; i < here.size(); ++i) {
            difference = std::max(
                {difference, std::abs(here[i].x - there[i].x), std::abs(here[i].y - there[i].y)});
            size = std::max({size, std::abs(there[i].x), std::abs(there[i].y)});
        }
        return difference <= same * size;
    }

    void add_nodes(std::vector<double> &row) {
        for (const auto &[node, name] : _nodes) {
            const double z = place_of(node);
            const forced::Phasor u = _forced.at(z);
            const modes::Ellipse orbit = modes::ellipse_of(u.x, u.y);
            row.insert(row.end(), {orbit.major, std::arg(u.x), orbit.major, orbit.minor,
                                   std::abs(u.x), std::arg(u.x), std::abs(u.y), std::arg(u.y),
                                   forced::inclination_of(u, _forced.rounding()),
                                   error(_error_known ? _finer.at(z, u) : 0)});
        }
    }

    void add_bearings(std::vector<double> &row) {
        const auto bearings = static_cast<int>(_discretization.rotor().supports().size());
        for (int bearing = 0; bearing < bearings; ++bearing) {
            const forced::Phasor force = _forced.bearing_force(bearing);
            row.insert(row.end(), {modes::ellipse_of(force.x, force.y).major,
                                   error(_error_known ? _finer.of_force(bearing, force) : 0)});
        }
    }

    void add_probes(std::vector<double> &row) {
        for (const model::Probe &probe : _discretization.rotor().probes) {
            const forced::Phasor u =
                _forced.motion(forced::stretch_of_probe(_discretization, probe));
            const std::complex<double> seen = forced::reading(u, probe.angle);
            row.insert(row.end(), {std::abs(seen), std::arg(seen),
                                   error(_error_known ? _finer.of_probe(probe, u) : 0)});
        }
    }

    /// Amplitudes and forces without limit, everything else none.
    [[nodiscard]] std::vector<double> no_limit() const {
        std::vector<double> row;
        for (std::size_t i = 0; i < _nodes.size(); ++i)
            row.insert(row.end(), {unlimited, no_value, unlimited, no_value, unlimited, no_value,
                                   unlimited, no_value, no_value, unlimited});
        for (std::size_t i = 0; i < _discretization.rotor().supports().size(); ++i)
            row.insert(row.end(), {unlimited, unlimited});
        for (std::size_t i = 0; i < _discretization.rotor().probes.size(); ++i)
            row.insert(row.end(), {unlimited, no_value, unlimited});
        return row;
    }
};

/// @param drive  what moves the rotor
void note_resonances(results::ResponseResult &result, const results::HarmonicMotion &motion,
                     const Sentence &drive) {
    const std::vector<double> speeds =
        forced::speeds_without_limit(result.speeds, motion.nodes.front().amplitude);
    if (!speeds.empty())
        result.model.notes.emplace_back(
            model::Weight::warning,
            "no steady motion at {}: the rotor is at a resonance without damping, or free to move "
            "under its {}; amplitudes there have no limit, or are not determined where the "
            "{} does not drive that mode",
            as::speed.list(speeds), drive, drive);
}

/// Coefficients of bearings bend at the rows of their tables, and curves with them: a largest value
/// at one of these speeds may be no resonance.
void note_bends(const model::Rotor &rotor, results::ResponseResult &result) {
    constexpr double at_row = 1e-7; // of the speed
    std::set<double> bends;
    const auto peaks_at = [](const results::HarmonicMotion &motion, double row) {
        return std::ranges::any_of(motion.peaks, [row](const auto &peak) {
            return std::abs(peak.speed - row) <= at_row * std::abs(row);
        });
    };
    for (const model::Bearing &bearing : rotor.supports())
        if (bearing.depends_on_speed())
            for (const double row : bearing.speeds)
                if (peaks_at(result, row) ||
                    std::ranges::any_of(result.forces, [&](const results::ForceResponse &forces) {
                        return peaks_at(forces, row);
                    }))
                    bends.insert(row);
    if (!bends.empty())
        result.model.notes.emplace_back(
            "peaks at {} are at rows of a bearing table, where its coefficients bend: they need "
            "not be resonances, and another interpolation may not have them",
            as::speed.list({bends.begin(), bends.end()}));
}

/// The case with the imbalances that its balancers are for, and nodes between which receptances are
/// asked for.
model::Case driven(model::Case scene) {
    scene.rotor = model::with_balancer_imbalances(std::move(scene.rotor));
    refuse_what_is_missing(scene);
    for (const model::Receptance &asked : scene.response.receptances)
        scene.rotor.stations.insert(scene.rotor.stations.end(), {{asked.from}, {asked.to}});
    return scene;
}

constexpr std::array direction_names{"x", "y", "forward", "backward"};

/// Re(x exp(i w t)), Re(y exp(i w t)): y a quarter turn behind x where it turns with the spin.
forced::Push push_of(const model::HarmonicForce &force) {
    const std::complex<double> f = std::polar(force.amplitude, force.phase);
    switch (force.direction) {
    case model::ForceDirection::x:
        return {force.z, {f, 0}};
    case model::ForceDirection::y:
        return {force.z, {0, f}};
    case model::ForceDirection::forward:
        return {force.z, {f, -forced::imaginary_unit * f}};
    case model::ForceDirection::backward:
        return {force.z, {f, forced::imaginary_unit * f}};
    }
    return {};
}

/// It has the frequency of the imbalances of the case, and acts together with them.
bool joins_imbalances(const model::HarmonicForce &force, const model::Case &scene) {
    return force.multiple == 1.0 && !scene.rotor.imbalances.empty();
}

/// The imbalances, with the forces that have their frequency.
forced::Drive synchronous_drive(const model::Case &scene) {
    forced::Drive drive;
    for (const model::HarmonicForce &force : scene.rotor.forces)
        if (joins_imbalances(force, scene))
            drive.forces.push_back(push_of(force));
    drive.unbalanced = !drive.forces.empty();
    return drive;
}

/// Form of the equations and order of the elements.
void choose_model(const model::Case &scene, results::ModelSummary &model) {
    model.formulation = forced::response_formulation(scene);
    if ((scene.rotor.imbalances.empty() && scene.response.gravity == 0) ||
        synchronous_drive(scene).unbalanced)
        model.formulation = {results::Form::general,
                             "forces of one frequency: forced motion in x and y"};
    model::Case bare = scene; // the order is judged by frequencies
    bare.rotor.balancers.clear();
    model.order = mesh_error::resolve_order_in_best_form(bare);
}

/// Stations, bearings and probes.
forced::Watched watched_places(const assembly::Discretization &d) {
    forced::Watched all = forced::watched(d, forced::attached_nodes(d));
    for (const model::Probe &probe : d.rotor().probes)
        all.add(forced::quantity_of(d, probe), "probe", probe.z, probe.name);
    return all;
}

/// Of stations, bearings and probes.
/// @returns those of the orbits in clearances
std::vector<results::ResponsePeak> add_imbalance_peaks(results::ResponseResult &result,
                                                       const assembly::Discretization &d,
                                                       const model::Case &scene, bool with_errors) {
    forced::Watched all = watched_places(d);
    const std::size_t others = all.quantities.size();
    watch_clearances(all, d);
    forced::add_peaks(result.peaks, result.curves, d, result.model.formulation.form, all,
                      model::required_speeds(scene), {synchronous_drive(scene), with_errors},
                      result.model.notes);
    return clearance_peaks(result, others);
}

/// The motion at all speeds, for process 0.
/// @returns whether this is process 0
bool add_rows(results::HarmonicMotion &motion, const std::vector<double> &speeds,
              Response &response, const assembly::Discretization &d,
              const std::map<int, std::string> &nodes) {
    double done = 0;
    const std::vector<std::vector<double>> rows = process::rows_at(speeds, [&](double speed) {
        process::report_progress(done++ / static_cast<double>(speeds.size()));
        return response.row(speed);
    });
    if (rows.empty())
        return false;
    forced::add_places(motion, d, nodes);
    const std::vector<std::vector<double> *> lists = lists_of(motion);
    for (const std::vector<double> &row : rows)
        for (std::size_t i = 0; i < lists.size(); ++i)
            lists[i]->push_back(row.at(i));
    return true;
}

/// Lists over the speeds, peaks and curves.
void add_imbalance_response(results::ResponseResult &result, const assembly::Discretization &d,
                            const model::Case &scene) {
    const results::Form form = result.model.formulation.form;
    const std::map<int, std::string> nodes = forced::attached_nodes(d);
    const forced::Drive drive = synchronous_drive(scene);
    Response response(d, form, nodes, drive);
    std::optional<process::Stage> stage(std::in_place, "response at the speeds", 0.0, 0.6);
    if (!add_rows(result, result.speeds, response, d, nodes))
        return;
    result.model.unknowns = response.unknowns();
    note_resonances(result, result, "imbalance");
    if (drive.unbalanced)
        result.model.notes.emplace_back(
            "forces at 1x, {} of them, act together with the imbalances: the response is to both",
            drive.forces.size());
    stage.emplace("peaks", 0.6, 1.0);
    const std::vector<results::ResponsePeak> peaks = add_imbalance_peaks(result, d, scene, true);
    add_orbits(result, d, scene, nodes, peaks, [&response](double speed) {
        return response.solve(speed) ? std::optional(response.solved()) : std::nullopt;
    });
}

/// The forces of one frequency, and what they are as a drive.
struct ForcesOfOne {
    results::ForceResponse response; ///< without motions
    forced::Drive drive;
};

/// Those of each frequency, but for those that have that of the imbalances.
std::vector<ForcesOfOne> forces_by_frequency(const model::Case &scene) {
    std::vector<ForcesOfOne> all;
    for (const model::HarmonicForce &force : scene.rotor.forces) {
        if (joins_imbalances(force, scene))
            continue;
        auto same = std::ranges::find_if(all, [&force](const ForcesOfOne &of) {
            return of.response.multiple == force.multiple &&
                   of.response.frequency == force.frequency;
        });
        if (same == all.end()) {
            same = all.insert(same, ForcesOfOne{});
            same->response.multiple = force.multiple;
            same->response.frequency = force.frequency;
            same->drive.sweep.frequency = force.frequency.value_or(0);
            same->drive.sweep.frequency_rate = force.multiple.value_or(0);
        }
        same->response.forces.push_back(
            {force.z, force.name, force.amplitude, force.phase,
             direction_names.at(static_cast<std::size_t>(force.direction))});
        same->drive.forces.push_back(push_of(force));
    }
    return all;
}

/// What forces of one frequency do together, of each frequency of its own.
void add_force_responses(results::ResponseResult &result, const assembly::Discretization &d,
                         const model::Case &scene) {
    std::vector<forced::Drive> drives;
    for (ForcesOfOne &one : forces_by_frequency(scene)) {
        result.forces.push_back(std::move(one.response));
        drives.push_back(std::move(one.drive));
    }
    const std::map<int, std::string> nodes = forced::attached_nodes(d);
    bool first_process = true;
    for (std::size_t i = 0; i < drives.size(); ++i) {
        const auto share = [&](double part) {
            return (static_cast<double>(i) + part) / static_cast<double>(drives.size());
        };
        results::ForceResponse &out = result.forces[i];
        Response response(d, results::Form::general, nodes, drives[i]);
        std::optional<process::Stage> stage(std::in_place, "response to the forces", share(0),
                                            share(0.6));
        first_process = add_rows(out, result.speeds, response, d, nodes);
        if (!first_process)
            continue;
        result.model.unknowns = std::max(result.model.unknowns, response.unknowns());
        note_resonances(result, out, "force");
        stage.emplace("peaks under the forces", share(0.6), share(1));
        forced::add_peaks(out.peaks, out.curves, d, results::Form::general, watched_places(d),
                          model::required_speeds(scene), {drives[i], true}, result.model.notes);
    }
    if (!first_process)
        result.forces.clear();
}

/// At the operating speeds, by process 0.
void add_operating(results::ResponseResult &result, const assembly::Discretization &d,
                   const model::Case &scene) {
    const std::map<int, std::string> nodes = forced::attached_nodes(d);
    std::vector<std::unique_ptr<Mover>> movers;
    const auto add = [&](results::Form form, const forced::Drive &drive) {
        const auto response = std::make_shared<Response>(d, form, nodes, drive);
        movers.push_back(forced_mover(d, form, drive, [response](double speed) {
            return response->solve(speed) ? std::optional(response->solved()) : std::nullopt;
        }));
    };
    if (!scene.rotor.imbalances.empty())
        add(result.model.formulation.form, synchronous_drive(scene));
    for (const ForcesOfOne &one : forces_by_frequency(scene))
        add(results::Form::general, one.drive);
    if (const results::Form form = forced::form_under_weight(scene.rotor);
        scene.response.gravity != 0 && form == results::Form::rotating) {
        forced::Drive weight; // it moves what it does not only bend
        weight.gravity = scene.response.gravity;
        add(form, weight);
    }
    result.operating = operating_response(scene, d, movers, nodes);
    note_operating_resonances(*result.operating, result.model.notes);
    if (movers.size() > 1)
        result.model.notes.emplace_back(
            "operating speeds: the motions of {} frequencies are added up with their largest "
            "values, as if these came together",
            movers.size());
}

void add_margins(results::ResponseResult &result, const model::Case &scene) {
    std::vector<results::CriticalSpeed> critical_speeds;
    try {
        critical_speeds = listed_critical_speeds(scene);
    } catch (const model::AnalysisFailure &failure) {
        result.model.notes.emplace_back("margins of the peaks alone: {}", failure.sentence());
    }
    result.margins = operation::separation_margins(*scene.operation, critical_speeds, result.peaks,
                                                   !scene.rotor.bearings_rotation_invariant(),
                                                   result.model.notes);
}

void note_balancers(const model::Rotor &rotor, results::ResponseResult &result) {
    if (!rotor.balancers.empty())
        result.model.notes.emplace_back(
            "the rotor is driven by its imbalances and by those that its balancers are to balance; "
            "the balancers' own parts are left out");
}

} // namespace

results::ResponseResult response_peaks(const model::Case &asked, bool with_errors) {
    const model::Case scene = driven(asked);
    if (scene.rotor.imbalances.empty() && scene.response.gravity == 0)
        throw model::BadInput(
            fmt::format("{}: imbalance: missing, expected at least one [[imbalance]], or the "
                        "imbalance of a balancer, to drive the response whose peaks are looked for",
                        scene.file.string()));
    results::ResponseResult result;
    choose_model(scene, result.model);
    const assembly::Discretization d(scene.rotor, result.model.order);
    result.model.elements = static_cast<int>(d.shaft_mesh().spans.size());
    result.model.unknowns = forced::ForcedMotion(d, result.model.formulation.form).unknowns();
    static_cast<void>(add_imbalance_peaks(result, d, scene, with_errors));
    return result;
}

results::ResponseResult
response_in_operation(const model::Case &scene,
                      const std::vector<results::CriticalSpeed> &critical_speeds) {
    results::ResponseResult result;
    choose_model(scene, result.model);
    const assembly::Discretization d(scene.rotor, result.model.order);
    static_cast<void>(add_imbalance_peaks(result, d, scene, true));
    result.margins = operation::separation_margins(*scene.operation, critical_speeds, result.peaks,
                                                   !scene.rotor.bearings_rotation_invariant(),
                                                   result.model.notes);
    add_operating(result, d, scene);
    return result;
}

namespace {

void add_resonances(results::ResponseResult &result) {
    result.resonances = results::resonances_of(result.peaks);
    for (results::ForceResponse &response : result.forces)
        response.resonances = results::resonances_of(response.peaks);
    if (result.gravity)
        result.gravity->resonances = results::resonances_of(result.gravity->peaks);
}

} // namespace

results::ResponseResult unbalance_response(const model::Case &asked) {
    const model::Case scene = driven(asked);
    results::ResponseResult result;
    if (response_is_periodic(scene)) {
        result = periodic_response(scene);
        if (result.nodes.empty() && !result.gravity)
            return {}; // not process 0
        const ModesBeside modes(scene, result.model.order);
        name_modes(result.peaks, modes, {1, 0, true, 3});
        if (result.gravity)
            name_modes(result.gravity->peaks, modes, {2, 0, false, 4});
        add_resonances(result);
        note_balancers(scene.rotor, result);
        if (scene.operation && !result.nodes.empty())
            add_margins(result, scene);
        note_growing_motions(modes, result.model);
        return result;
    }
    result.speeds = model::required_speeds(scene).values();
    choose_model(scene, result.model);
    const assembly::Discretization d(scene.rotor, result.model.order);
    result.model.elements = static_cast<int>(d.shaft_mesh().spans.size());
    std::vector<std::pair<const char *, std::function<void()>>> parts;
    if (!scene.rotor.imbalances.empty())
        parts.emplace_back("response to the imbalances",
                           [&] { add_imbalance_response(result, d, scene); });
    if (!scene.rotor.forces.empty())
        parts.emplace_back("response to the forces",
                           [&] { add_force_responses(result, d, scene); });
    if (scene.response.gravity != 0)
        parts.emplace_back("motion under the weight",
                           [&] { forced::add_gravity_response(result, d, scene); });
    if (!scene.response.receptances.empty())
        parts.emplace_back("receptances", [&] { forced::add_receptances(result, d, scene); });
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto share = [&parts](std::size_t part) {
            return static_cast<double>(part) / static_cast<double>(parts.size());
        };
        const process::Stage stage(parts[i].first, share(i), share(i + 1));
        parts[i].second();
    }
    if (result.nodes.empty() && !result.gravity && result.forces.empty() && !result.receptance)
        return {}; // not process 0
    const ModesBeside modes(asked, result.model.order);
    name_modes(result.peaks, modes, {1, 0, !synchronous_drive(scene).unbalanced});
    for (results::ForceResponse &response : result.forces)
        name_modes(response.peaks, modes,
                   {response.multiple.value_or(0), response.frequency.value_or(0), false});
    add_resonances(result);
    note_bends(scene.rotor, result);
    if (scene.operation && !result.nodes.empty())
        add_margins(result, scene);
    if (scene.operation && (!result.nodes.empty() || !result.forces.empty()))
        add_operating(result, d, scene);
    note_growing_motions(modes, result.model);
    note_balancers(scene.rotor, result);
    return result;
}

} // namespace whirl::analyses

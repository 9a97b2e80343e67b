#include "properties/invariance_checks.h"
#include "analyses/campbell.h"
#include "analyses/critical.h"
#include "modes/formulation.h"
#include "properties/long_checks.h"
#include "properties/random_scenes.h"
#include "properties/spectra_difference.h"
#include "properties/transforms.h"
#include "results/campbell.h"
#include "results/critical.h"
#include "results/formulation.h"
#include "results/sentence.h"
#include "support/balancer_parts.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl::properties {

namespace {

using Answer = std::optional<std::string>;

const std::vector<std::size_t> its_speed{0};

/// Whirl modes and critical speeds of the changed scene against those of the scene itself.
std::string differences(InvarianceScene &s, const model::Case &changed,
                        const Allowance &allowance = {}) {
    const int modes = s.scene().campbell.modes;
    std::string out = spectra_difference(s.campbell(), its_speed, analyses::campbell(changed),
                                         its_speed, modes, allowance);
    if (out.empty() && !s.turning_parts())
        out = critical_difference(s.critical(), analyses::critical_speeds(changed), modes - 1,
                                  allowance);
    return out;
}

model::Case finer_mesh(model::Case scene) {
    for (model::Segment &segment : scene.rotor.shaft.segments)
        segment.elements *= 2;
    return scene;
}

/// Another look at the same rotor.
struct View {
    std::string name;
    model::Case (*change)(model::Case, Draw &);
};

const std::vector<View> &views() {
    static const std::vector<View> all{
        {"turned axes", [](model::Case scene, Draw &) { return turned(std::move(scene), 0.7); }},
        {"mirrored rotor", [](model::Case scene, Draw &) { return mirrored(std::move(scene)); }},
        {"split segments", split},
        {"another order", [](model::Case scene, Draw &) { return permuted(std::move(scene)); }},
        {"finer mesh", [](model::Case scene, Draw &) { return finer_mesh(std::move(scene)); }},
    };
    return all;
}

/// All of them at once: what changes under one of them changes here too, at a fifth of the time.
/// Only then each by itself, for its name.
Answer other_views(InvarianceScene &s) {
    model::Case changed = s.scene();
    for (const View &view : views())
        changed = view.change(std::move(changed), s.draw());
    const std::string together = differences(s, changed);
    if (together.empty())
        return together;
    for (const View &view : views()) {
        const std::string alone = differences(s, view.change(s.scene(), s.draw()));
        if (!alone.empty())
            return view.name + ": " + alone;
    }
    return "none by itself, but together: " + together;
}

/// Iterations end a little earlier or later in other units, and a mode a thousand times slower than
/// the elastic ones is known to a millionth of 1e-16 less than these.
constexpr double rounding_of_units = 1e-9;

/// Powers of two, so that not a digit changes unless a number of the program has a dimension.
Answer other_units(InvarianceScene &s) {
    const Units units{std::ldexp(1.0, s.draw().integer(-12, 12)),
                      std::ldexp(1.0, s.draw().integer(-12, 12)),
                      std::ldexp(1.0, s.draw().integer(-8, 8))};
    const model::Case changed = in_units(s.scene(), units);
    results::CampbellResult result = analyses::campbell(changed);
    for (results::CampbellMode &mode : result.modes) {
        for (auto *list : {&mode.frequency, &mode.real})
            for (std::optional<double> &value : *list)
                if (value)
                    *value *= units.time;
        for (std::optional<double> &error : mode.error)
            if (error)
                error = 0;
    }
    results::CampbellResult here = s.campbell();
    for (results::CampbellMode &mode : here.modes)
        for (std::optional<double> &error : mode.error)
            if (error)
                error = 0;
    return spectra_difference(here, its_speed, result, its_speed, s.scene().campbell.modes,
                              {rounding_of_units, false, true});
}

Answer other_names(InvarianceScene &s) {
    const results::CampbellResult result = analyses::campbell(renamed(s.scene()));
    if (result.modes.size() != s.campbell().modes.size())
        return "another number of modes";
    for (std::size_t i = 0; i < result.modes.size(); ++i) {
        const results::CampbellMode &a = s.campbell().modes[i];
        const results::CampbellMode &b = result.modes[i];
        if (a.label != b.label || a.frequency != b.frequency || a.error != b.error)
            return a.label + " is not what it was";
    }
    return "";
}

Answer negative_spin(InvarianceScene &s) {
    if (s.tables())
        return std::nullopt;
    const model::Case turned = reflected(s.scene());
    const int modes = s.scene().campbell.modes;
    std::string out = spectra_difference(s.campbell(), its_speed, analyses::campbell(turned),
                                         its_speed, modes, {});
    if (!out.empty() || s.turning_parts() || turned.speeds->to >= 0)
        return out;
    results::CriticalResult critical = analyses::critical_speeds(turned);
    for (results::CriticalSpeed &one : critical.critical_speeds)
        one.speed = -one.speed;
    return critical_difference(s.critical(), critical, modes - 1, {});
}

bool could_not_follow(const std::vector<results::Sentence> &notes) {
    return std::any_of(notes.begin(), notes.end(), [](const std::string &note) {
        return note.find("could not be followed") != std::string::npos;
    });
}

/// Lines and crossings over a range, from few speeds and from more.
Answer grid_difference(InvarianceScene &s) {
    model::Case coarse = s.scene();
    coarse.speeds = s.range();
    model::Case fine = coarse;
    fine.speeds->count = 2 * coarse.speeds->count - 1;
    const results::CampbellResult few = analyses::campbell(coarse);
    const results::CampbellResult many = analyses::campbell(fine);
    std::string out =
        spectra_difference(few, {0, 1, 2}, many, {0, 2, 4}, coarse.campbell.modes, {});
    if (!out.empty())
        return out;
    out = crossing_difference(few, many, 1e-8);
    // Balls lock to the rotor and leave it many times; where a motion is lost, a note says so.
    const bool said = !coarse.rotor.balancers.empty() && could_not_follow(few.model.notes);
    return out.empty() || said ? "" : "crossing " + out;
}

Answer finer_grid(InvarianceScene &s) {
    return s.turning_parts() ? std::nullopt : grid_difference(s);
}

/// Of parts that turn and are not round: whirl in rotating axes, hundreds of spectra.
Answer finer_grid_turning(InvarianceScene &s) {
    return s.turning_parts() ? grid_difference(s) : std::nullopt;
}

Answer vanishing_anisotropy(InvarianceScene &s) {
    if (s.turning_parts() || !s.scene().rotor.bearings_rotation_invariant())
        return std::nullopt;
    model::Case changed = s.scene();
    const model::Disc &disc = changed.rotor.discs.front();
    changed.rotor.anisotropies.push_back({"", disc.z, 1e-9 * disc.Ip, 0.3});
    return spectra_difference(s.campbell(), its_speed, analyses::campbell(changed), its_speed,
                              s.scene().campbell.modes, {1e-7, false, true});
}

Answer vanishing_balls(InvarianceScene &s) {
    if (s.turning_parts() || !s.scene().rotor.bearings_rotation_invariant())
        return std::nullopt;
    model::Case changed = s.scene();
    model::Balancer balls;
    balls.z = changed.rotor.discs.front().z;
    tests::row(balls).n = 2;
    tests::row(balls).mass = 1e-10 * changed.rotor.discs.front().mass;
    tests::row(balls).radius = 0.1 * changed.rotor.shaft.length();
    tests::row(balls).damping = 150 * tests::row(balls).mass;
    balls.imbalance = tests::row(balls).mass * tests::row(balls).radius;
    changed.rotor.balancers.push_back(balls);
    changed.campbell.modes += 6; // the balls' own motions lie between
    return spectra_difference(s.campbell(), its_speed, analyses::campbell(changed), its_speed,
                              s.scene().campbell.modes, {1e-6, true, false});
}

Answer nearly_at_rest(InvarianceScene &s) {
    if (!s.scene().rotor.balancers.empty())
        return std::nullopt; // balls at rest are in no hurry to be anywhere
    model::Case rest = s.scene();
    rest.speeds = model::SpeedRange{0, 0, 1};
    model::Case slow = rest;
    slow.speeds = model::SpeedRange{1e-8, 1e-8, 1};
    return spectra_difference(analyses::campbell(rest), {0}, analyses::campbell(slow), {0},
                              s.scene().campbell.modes - 1, {1e-8, false, false});
}

Answer other_form(InvarianceScene &s) {
    const results::Form form = modes::choose_formulation(s.scene()).form;
    if (form == results::Form::hill)
        return std::nullopt;
    model::Case changed = s.scene();
    if (form == results::Form::planar && s.draw().chance(0.3))
        changed.formulation = model::FormChoice::hyperbolic;
    else if (form == results::Form::general || form == results::Form::rotating) {
        if (s.turning_parts() || !s.scene().rotor.bearings_rotation_invariant())
            return std::nullopt;
        changed.formulation = model::FormChoice::rotating;
    } else {
        changed.formulation = model::FormChoice::general;
    }
    return spectra_difference(s.campbell(), its_speed, analyses::campbell(changed), its_speed,
                              s.scene().campbell.modes, {});
}

} // namespace

InvarianceScene::InvarianceScene(int number)
    : _scene(random_scene(number)), _range(*_scene.speeds),
      _draw(static_cast<std::uint64_t>(number) + 77777777) {
    const double speed = _draw.chance(0.5) ? _range.from : _range.to;
    _scene.speeds = model::SpeedRange{speed, speed, 1};
}

bool InvarianceScene::series() const {
    return modes::choose_formulation(_scene).form == results::Form::hill;
}

const results::CampbellResult &InvarianceScene::campbell() {
    if (!_campbell)
        _campbell = analyses::campbell(_scene);
    return *_campbell;
}

const results::CriticalResult &InvarianceScene::critical() {
    if (!_critical)
        _critical = analyses::critical_speeds(_scene);
    return *_critical;
}

std::string InvarianceScene::words() const {
    const model::Rotor &r = _scene.rotor;
    std::string out = results::form_name(modes::choose_formulation(_scene).form);
    out += ", order " + std::to_string(r.shaft.order);
    if (tables())
        out += ", tables";
    if (r.damped())
        out += ", damped";
    if (r.shaft.internal_damping != 0)
        out += ", internal damping";
    if (!r.balancers.empty())
        out += ", balls";
    if (!r.anisotropies.empty())
        out += ", anisotropy";
    return out;
}

const std::vector<Invariance> &invariances() {
    static const std::vector<Invariance> all{
        {"turned, mirrored, split, reordered, finer", other_views},
        {"other units", other_units},
        {"other names", other_names},
        {"negative spin", negative_spin},
        {"finer grid", finer_grid},
        {"finer grid, turning parts", finer_grid_turning, true},
        {"anisotropy to nothing", vanishing_anisotropy},
        {"balls to nothing", vanishing_balls, true},
        {"nearly at rest", nearly_at_rest},
        {"another form of the equations", other_form},
        {"static deflection", static_response},
        {"response, turned axes", turned_response},
        {"response, mirrored rotor", mirrored_response},
        {"stability, turned axes", turned_stability, true},
        {"stability, mirrored rotor", mirrored_stability, true},
        {"stability, finer grid", finer_stability, true},
        {"balance, turned axes", turned_balance, true},
        {"balance, mirrored rotor", mirrored_balance, true},
    };
    return all;
}

} // namespace whirl::properties

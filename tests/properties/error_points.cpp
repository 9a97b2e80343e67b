#include "properties/error_points.h"
#include "analyses/campbell.h"
#include "analyses/critical.h"
#include "model/errors.h"
#include "oracles/continuum_roots.h"
#include "results/campbell.h"
#include "results/critical.h"
#include "results/whirl.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::properties {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// A printed frequency or critical speed.
struct Printed {
    double frequency = 0;
    double estimate = 0;
    results::Whirl whirl = results::Whirl::mixed;
};

/// Ascending, no more than the modes asked for: those of which none may be missing.
std::vector<Printed> lowest(std::vector<Printed> all, int modes) {
    std::sort(all.begin(), all.end(),
              [](const Printed &a, const Printed &b) { return a.frequency < b.frequency; });
    all.resize(std::min(all.size(), static_cast<std::size_t>(modes)));
    return all;
}

std::vector<Printed> at_speed(const results::CampbellResult &result, std::size_t k, int modes) {
    std::vector<Printed> all;
    for (const results::CampbellMode &mode : result.modes)
        if (mode.frequency[k])
            all.push_back({*mode.frequency[k], mode.error[k].value_or(none), mode.whirl[k]});
    return lowest(std::move(all), modes);
}

/// Printed numbers of one sense beside the true ones of the same index.
void compare(const std::vector<Printed> &printed, const oracles::Continuum &continuum,
             const oracles::Question &question, const std::string &sense, const ErrorPoint &about,
             std::vector<ErrorPoint> &out) {
    if (printed.empty())
        return;
    // Coarse meshes err upwards by factors at most; beyond that the point says so.
    const oracles::Real highest = 4 * static_cast<oracles::Real>(printed.back().frequency);
    const std::vector<oracles::Real> truth =
        frequencies(continuum, question, static_cast<int>(printed.size()), highest);
    for (std::size_t i = 0; i < printed.size(); ++i) {
        ErrorPoint point = about;
        point.mode = static_cast<int>(i) + 1;
        point.sense = sense;
        point.printed = printed[i].frequency;
        point.estimate = printed[i].estimate;
        point.truth = i < truth.size() ? static_cast<double>(truth[i]) : none;
        point.error = i < truth.size()
                          ? static_cast<double>(std::abs(printed[i].frequency - truth[i]) /
                                                std::abs(printed[i].frequency))
                          : std::numeric_limits<double>::infinity();
        out.push_back(point);
    }
}

void compare_all(const std::vector<Printed> &printed, const oracles::Continuum &continuum,
                 bool synchronous, const ErrorPoint &about, std::vector<ErrorPoint> &out) {
    if (continuum.coupled()) {
        compare(printed, continuum, {oracles::Motion::both, about.speed, synchronous}, "both",
                about, out);
        return;
    }
    for (const bool forward : {true, false}) {
        std::vector<Printed> some;
        for (const Printed &p : printed)
            if ((p.whirl == results::Whirl::forward) == forward)
                some.push_back(p);
        const auto motion = forward ? oracles::Motion::forward : oracles::Motion::backward;
        compare(some, continuum, {motion, about.speed, synchronous},
                forward ? "forward" : "backward", about, out);
    }
}

/// The lowest ones, wherever they are.
std::vector<Printed> critical_speeds(model::Case scene) {
    scene.speeds.reset();
    std::vector<Printed> printed;
    for (const results::CriticalSpeed &c : analyses::critical_speeds(scene).critical_speeds)
        printed.push_back({c.speed, c.error, c.whirl});
    return printed;
}

} // namespace

Kind kind_of(int number) {
    return number % 5 == 4 ? Kind::damped : number % 2 == 0 ? Kind::isotropic : Kind::orthotropic;
}

model::Case random_case(int number) {
    Draw draw(static_cast<std::uint64_t>(number) + 1);
    model::Case scene;
    scene.name = "rotor " + std::to_string(number);
    scene.rotor = random_rotor(draw, kind_of(number));
    scene.rotor.shaft.order = draw.integer(1, 10);
    for (model::Segment &s : scene.rotor.shaft.segments)
        s.elements = draw.integer(1, 8);
    const double from = draw.chance(0.4) ? 0 : draw.between(0, 1500);
    scene.speeds = model::SpeedRange{from, draw.between(from, 2000), 5};
    scene.campbell.modes = 8;
    scene.campbell.multiples.clear();
    scene.rotor.shaft.tolerance = draw.over_decades(1e-10, 1e-5);
    return scene;
}

ErrorPoints undamped_points(const model::Case &scene, int number) {
    ErrorPoints out;
    const oracles::Continuum continuum(continuum_of(scene.rotor));
    ErrorPoint about;
    about.rotor = number;
    about.kind = kind_of(number);
    about.order = scene.rotor.shaft.order;
    try {
        const results::CampbellResult result = analyses::campbell(scene);
        const std::pair<std::size_t, const char *> places[] = {
            {0, "first speed"}, {2, "middle speed"}, {1, "interpolated speed"}};
        for (const auto &[k, name] : places) {
            about.what = name;
            about.speed = result.speeds[k];
            compare_all(at_speed(result, k, scene.campbell.modes), continuum, false, about,
                        out.points);
        }
    } catch (const std::exception &failure) {
        out.refusals.push_back("campbell: " + std::string(failure.what()));
    }
    try {
        const std::vector<Printed> printed = critical_speeds(scene);
        about.what = "critical";
        about.speed = 0;
        compare_all(lowest(printed, scene.campbell.modes), continuum, true, about, out.points);
    } catch (const std::exception &failure) {
        out.refusals.push_back("critical: " + std::string(failure.what()));
    }
    return out;
}

ErrorPoints automatic_points(const model::Case &as_given, int number) {
    ErrorPoints out;
    model::Case scene = as_given;
    scene.rotor.shaft.order_auto = true;
    const oracles::Continuum continuum(continuum_of(scene.rotor));
    ErrorPoint about;
    about.rotor = number;
    about.kind = kind_of(number);
    about.what = "auto";
    try {
        const results::CampbellResult result = analyses::campbell(scene);
        about.order = result.model.order;
        for (std::size_t k = 0; k < result.speeds.size(); k += 2) {
            about.speed = result.speeds[k];
            compare_all(at_speed(result, k, scene.campbell.modes), continuum, false, about,
                        out.points);
        }
    } catch (const std::exception &failure) {
        out.refusals.push_back("auto: " + std::string(failure.what()));
    }
    try {
        const std::vector<Printed> printed = critical_speeds(scene);
        about.speed = 0;
        compare_all(lowest(printed, scene.campbell.modes), continuum, true, about, out.points);
    } catch (const std::exception &failure) {
        out.refusals.push_back("auto, critical: " + std::string(failure.what()));
    }
    for (ErrorPoint &point : out.points)
        point.estimate = scene.rotor.shaft.tolerance;
    return out;
}

} // namespace whirl::properties

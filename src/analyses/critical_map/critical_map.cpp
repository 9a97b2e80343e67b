#include "analyses/critical_map/critical_map.h"

#include "analyses/critical_map/crossings.h"
#include "analyses/critical_map/points.h"
#include "mesh_error/estimate.h"
#include "model/errors.h"
#include "model/variants.h"
#include "modes/formulation.h"
#include "modes/orbits.h"
#include "process/parallel.h"
#include "rigid/shaft.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::analyses {

using results::CriticalMap;
using results::CriticalMapCurve;
using synchronous::SynchronousModes;

namespace {

/// Decades around the stiffnesses of shaft and bearings, two more on either side.
std::pair<double, double> usual_range(const model::Rotor &rotor,
                                      std::optional<std::size_t> varied) {
    double low = std::numeric_limits<double>::infinity();
    double high = 0;
    const auto look_at = [&](double k) {
        if (k > 0 && std::isfinite(k)) {
            low = std::min(low, k);
            high = std::max(high, k);
        }
    };
    if (!rotor.shaft.rigid)
        look_at(rigid::bending_stiffness(rotor));
    for (std::size_t i = 0; i < rotor.supports().size(); ++i)
        for (const model::BearingCoefficients &row : rotor.bearings[i].rows)
            if (!varied || *varied == i) {
                look_at(row.k(0, 0));
                look_at(row.k(1, 1));
            }
    if (high == 0)
        low = high = 1e6;
    return {std::pow(10, std::floor(std::log10(low)) - 2),
            std::pow(10, std::ceil(std::log10(high)) + 2)};
}

/// Evenly spaced in the logarithm; a range that is given in part reaches as far as is usual, or
/// over four decades.
std::vector<double> map_stiffnesses(const model::CriticalMapSettings &settings,
                                    const model::Rotor &rotor) {
    const auto [low, high] = usual_range(rotor, settings.bearing);
    const double from =
        settings.from.value_or(settings.to ? std::min(low, *settings.to / 1e4) : low);
    const double to = settings.to.value_or(std::max(high, settings.from ? 1e4 * from : high));
    std::vector<double> values;
    for (int i = 0; i < settings.points; ++i)
        values.push_back(from *
                         std::pow(to / from, static_cast<double>(i) / (settings.points - 1)));
    values.back() = to;
    return values;
}

double largest_map_error(const MapScene &map, const std::vector<double> &stiffness) {
    double largest = 0;
    for (const double k : {stiffness.front(), stiffness[stiffness.size() / 2], stiffness.back()}) {
        const auto numbers = point_at(map, k);
        for (std::size_t i = numbers.size() / 2; i < numbers.size(); ++i)
            if (!std::isnan(numbers[i]))
                largest = std::max(largest, numbers[i]);
    }
    return largest;
}

MapScene map_scene(const model::Case &scene, const model::CriticalMapSettings &settings,
                   const std::vector<double> &stiffness) {
    MapScene map;
    map.rotor = model::isotropic_without_damping(scene.rotor);
    map.varied = settings.bearing;
    map.wanted = std::max(1, (scene.campbell.modes + 1) / 2);
    map.symmetric = scene.formulation != model::FormChoice::general;
    model::Case at_middle = scene;
    at_middle.rotor = map.with_stiffness(stiffness[stiffness.size() / 2]);
    map.form =
        modes::without_planar_damped(modes::choose_formulation(at_middle), at_middle.rotor).form;
    if (map.form == results::Form::hill)
        throw model::BadInput("formulation: expected another than \"hill\" for a critical speed "
                              "map, whose supports are isotropic");
    const model::Shaft &shaft = scene.rotor.shaft;
    map.order = shaft.rigid ? 1 : shaft.order;
    if (shaft.order_auto && !shaft.rigid)
        map.order = mesh_error::lowest_order(shaft.tolerance, [&](int order) {
            map.order = order;
            return largest_map_error(map, stiffness);
        });
    return map;
}

bool same_everywhere(const std::vector<double> &a, const std::vector<double> &b) {
    constexpr double rounding = 1e-9;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (!(std::abs(a[i] - b[i]) <= rounding * a[i]))
            return false;
    return true;
}

CurveOf add_curves(const MapScene &map, const std::vector<process::Outcome> &points,
                   CriticalMap &out) {
    CurveOf curve_of;
    for (std::size_t s = 0; s < map_senses.size(); ++s) {
        int number = 0;
        for (std::size_t i = 0; i < map.kept(); ++i) {
            CriticalMapCurve curve;
            curve.whirl = map_senses[s];
            bool exists = false;
            for (const process::Outcome &point : points) {
                curve.speed.push_back(point.numbers[s * map.kept() + i]);
                curve.error.push_back(point.numbers[(2 + s) * map.kept() + i]);
                exists = exists || !std::isnan(curve.speed.back());
            }
            if (!exists)
                continue;
            const bool second_direction = map.form == results::Form::rotating && number > 0 &&
                                          same_everywhere(curve.speed, out.curves.back().speed);
            if (!second_direction) {
                curve.number = ++number;
                out.curves.push_back(std::move(curve));
            }
            curve_of[{map_senses[s], i}] = out.curves.size() - 1;
        }
    }
    return curve_of;
}

/// Deflection of a whirl in the direction in which it is largest, largest 1.
std::vector<double> deflection_of(const modes::Stations &stations, results::Form form,
                                  const Eigen::VectorXcd &shape) {
    const bool planar = form == results::Form::planar;
    const Eigen::Index n = shape.size() / 2;
    const Eigen::VectorXcd x =
        stations.deflections(planar ? shape : Eigen::VectorXcd(shape(Eigen::seqN(0, n, 2))));
    const Eigen::VectorXcd y =
        planar ? Eigen::VectorXcd(Eigen::VectorXcd::Zero(x.size()))
               : stations.deflections(Eigen::VectorXcd(shape(Eigen::seqN(1, n, 2))));
    Eigen::Index most = 0;
    const double square = (x.cwiseAbs2() + y.cwiseAbs2()).maxCoeff(&most);
    const Eigen::VectorXd along =
        (x * std::conj(x[most]) + y * std::conj(y[most])).real() / (square > 0 ? square : 1);
    return {along.begin(), along.end()};
}

void add_shapes(const MapScene &map, const CurveOf &curve_of, CriticalMap &out) {
    for (const bool soft : {true, false}) {
        const assembly::Discretization d(
            map.with_stiffness(soft ? out.stiffness.front() : out.stiffness.back()), map.order);
        const modes::Stations stations = modes::Stations::for_drawing(d);
        out.z = stations.z();
        const SynchronousModes list = lowest_of_each(map, d);
        for (const results::Whirl whirl : map_senses) {
            const auto places = of_sense(list, whirl);
            for (std::size_t i = 0; i < places.size(); ++i) {
                const auto found = curve_of.find({whirl, i});
                if (found == curve_of.end())
                    continue;
                CriticalMapCurve &curve = out.curves[found->second];
                std::vector<double> &shape = soft ? curve.soft : curve.stiff;
                if (shape.empty())
                    shape = deflection_of(stations, map.form, list.modes[places[i]].shape);
            }
        }
    }
}

/// What the map leaves out of the rotor, and what it cannot know.
void add_notes(const model::Rotor &rotor, const MapScene &map, const CriticalMap &out,
               std::vector<std::string> &notes) {
    const bool other_axes = !rotor.bearings_isotropic() && (map.varied || !rotor.seals().empty());
    notes.push_back(fmt::format(
        "critical speed map: without damping and cross coupling{}{}{}",
        rotor.shaft.axial_torque != 0 ? " and without the axial torque" : "",
        other_axes ? "; supports that do not vary have the mean of their x and y coefficients" : "",
        map.form == results::Form::rotating
            ? "; forward only, the balls of balancers held in place; where inertias or stiffnesses "
              "of the rotor differ in two directions, each direction has its curve"
            : ""));
    if (!map.varied && (out.bearings.size() > 1 || !rotor.bearings_isotropic()))
        notes.emplace_back(
            "critical speed map: a crossing is a critical speed of the rotor on bearings that all "
            "have that stiffness in every direction, not of the rotor itself, whose bearings "
            "differ");
    for (const CriticalMapCurve &curve : out.curves)
        if (std::ranges::any_of(curve.error, [](double error) { return std::isinf(error); }))
            notes.push_back(fmt::format(
                "critical speed map: errors of the {} curve {} are not known everywhere",
                results::whirl_name(curve.whirl), curve.number));
}

} // namespace

CriticalMap critical_map(const model::Case &scene, results::ModelSummary &model) {
    const model::CriticalMapSettings settings =
        scene.critical_map.value_or(model::CriticalMapSettings{});
    if (scene.rotor.supports().empty())
        throw model::BadInput("bearing: expected at least one, whose stiffness the critical speed "
                              "map varies, got none");
    CriticalMap out;
    out.bearing = settings.bearing;
    out.stiffness = map_stiffnesses(settings, scene.rotor);
    const MapScene map = map_scene(scene, settings, out.stiffness);
    const auto points =
        process::deal(out.stiffness.size(), "critical speed map", [&](std::size_t i) {
            return process::Outcome{point_at(map, out.stiffness[i]), ""};
        });
    if (points.empty()) // another process has them
        return out;
    const CurveOf curve_of = add_curves(map, points, out);
    add_shapes(map, curve_of, out);
    double low = std::numeric_limits<double>::infinity();
    double high = 0;
    for (const CriticalMapCurve &curve : out.curves)
        for (const double speed : curve.speed)
            if (!std::isnan(speed)) {
                low = std::min(low, speed);
                high = std::max(high, speed);
            }
    if (high > 0) {
        out.bearings = bearings_across(scene.rotor, settings.bearing, low, high);
        add_crossings(map, curve_of, scene.rotor, out, model.notes);
    }
    add_notes(scene.rotor, map, out, model.notes);
    return out;
}

} // namespace whirl::analyses

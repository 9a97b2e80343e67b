#include "analyses/critical_map/critical_map.h"

#include "analyses/critical_map/points.h"
#include "assembly/planes.h"
#include "mesh_error/estimate.h"
#include "model/errors.h"
#include "model/variants.h"
#include "modes/formulation.h"
#include "modes/orbits.h"
#include "process/parallel.h"
#include "rigid/shaft.h"
#include "synchronous/critical_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace whirl::analyses {

using results::CriticalMap;
using results::CriticalMapBearing;
using results::CriticalMapCrossing;
using results::CriticalMapCurve;
using synchronous::SynchronousModes;

namespace {

using results::Sentence;
namespace as = results::as;

/// Decades around the stiffnesses of shaft and bearings, two more on either side.
std::pair<double, double> usual_range(const model::Rotor &rotor,
                                      std::optional<std::size_t> varied) {
    std::vector<double> around;
    if (!rotor.shaft.rigid)
        around.push_back(rigid::bending_stiffness(rotor));
    for (std::size_t i = 0; i < rotor.supports().size(); ++i)
        for (const model::BearingCoefficients &row : rotor.bearings[i].rows)
            if (!varied || *varied == i)
                around.insert(around.end(), {row.k(0, 0), row.k(1, 1)});
    std::erase_if(around, [](double k) { return !(k > 0 && std::isfinite(k)); });
    if (around.empty())
        around = {1e6};
    const auto [low, high] = std::ranges::minmax(around);
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

/// Shapes for all points; none where they cannot be found at once.
std::optional<synchronous::SharedShapes> shapes_for(const MapScene &map,
                                                    const std::vector<double> &stiffness) {
    const assembly::Discretization stiff(map.with_stiffness(stiffness.back()), map.order);
    const SynchronousModes highest = lowest_of_each(map, stiff);
    if (highest.modes.empty())
        return std::nullopt;
    constexpr double beyond = 1.1;
    const assembly::Discretization soft(map.with_stiffness(stiffness.front()), map.order);
    return synchronous::shared_shapes(soft, beyond * highest.modes.back().eigenvalue.imag(),
                                      static_cast<int>(highest.modes.size()));
}

MapScene map_scene(const model::Case &scene, const model::CriticalMapSettings &settings,
                   const std::vector<double> &stiffness) {
    MapScene map;
    map.rotor = model::isotropic_without_damping(scene.rotor);
    map.varied = settings.bearing;
    map.wanted = std::max(1, (scene.campbell.modes + 1) / 2);
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
    map.shapes = shapes_for(map, stiffness);
    return map;
}

bool same_everywhere(const std::vector<double> &a, const std::vector<double> &b) {
    constexpr double rounding = 1e-9;
    return std::ranges::equal(a, b,
                              [](double x, double y) { return std::abs(x - y) <= rounding * x; });
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
    const assembly::Planes planes(shape);
    const Eigen::VectorXcd x = stations.deflections(planar ? shape : planes.x);
    const Eigen::VectorXcd y = planar ? Eigen::VectorXcd(Eigen::VectorXcd::Zero(x.size()))
                                      : stations.deflections(planes.y);
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

/// kxx (direction 0) or kyy (1) at the rows of a bearing, N/m.
std::vector<double> direct_stiffness(const model::Bearing &bearing, int direction) {
    std::vector<double> k;
    for (const model::BearingCoefficients &row : bearing.rows)
        k.push_back(row.k(direction, direction));
    return k;
}

bool equal_stiffness(const model::Bearing &a, const model::Bearing &b) {
    return a.speeds == b.speeds && direct_stiffness(a, 0) == direct_stiffness(b, 0) &&
           direct_stiffness(a, 1) == direct_stiffness(b, 1);
}

/// Enough speeds that straight lines on logarithmic axes follow lines that are straight on others.
std::vector<double> speeds_across(const model::Bearing &bearing, double low, double high) {
    std::vector<double> speeds{low, high};
    if (!bearing.depends_on_speed())
        return speeds;
    constexpr int steps = 200;
    for (int k = 1; k < steps; ++k)
        speeds.push_back(low * std::pow(high / low, static_cast<double>(k) / steps));
    for (const double speed : bearing.speeds)
        if (speed > low && speed < high)
            speeds.push_back(speed);
    std::ranges::sort(speeds);
    return speeds;
}

struct OnMap {
    std::size_t curve = 0;
    double difference = 0; ///< relative, of the speeds
};

/// Which curve passes through a speed at a stiffness, looked up on the map itself; none where it is
/// beyond those that the map keeps.
std::optional<OnMap> curve_through(const MapScene &map, const CurveOf &curve_of, double k,
                                   results::Whirl whirl, double speed) {
    const assembly::Discretization d(map.with_stiffness(k), map.order);
    const SynchronousModes list = lowest_of_each(map, d);
    const auto places = of_sense(list, whirl);
    std::optional<OnMap> nearest;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto found = curve_of.find({whirl, i});
        const double difference = std::abs(list.modes[places[i]].eigenvalue.imag() - speed) / speed;
        if (found != curve_of.end() && (!nearest || difference < nearest->difference))
            nearest = OnMap{found->second, difference};
    }
    constexpr double another_curve = 1e-3;
    return nearest && nearest->difference < another_curve ? nearest : std::nullopt;
}

/// The stiffnesses of the bearings over speed, to be laid across a map: equal bearings together;
/// all of them, or the one that varies.
/// @param rotor     as the case has it
/// @param low,high  speeds of the map, rad/s
std::vector<CriticalMapBearing> bearings_across(const model::Rotor &rotor,
                                                std::optional<std::size_t> varied, double low,
                                                double high) {
    std::vector<CriticalMapBearing> out;
    for (std::size_t i = 0; i < rotor.supports().size(); ++i) {
        if (varied && *varied != i)
            continue;
        const model::Bearing &bearing = rotor.bearings[i];
        const auto equal = std::ranges::find_if(out, [&](const auto &other) {
            return equal_stiffness(rotor.bearings[other.bearings.front()], bearing);
        });
        if (equal != out.end()) {
            equal->bearings.push_back(i);
            continue;
        }
        CriticalMapBearing across;
        across.bearings = {i};
        across.isotropic = direct_stiffness(bearing, 0) == direct_stiffness(bearing, 1);
        across.speeds = speeds_across(bearing, low, high);
        for (const double speed : across.speeds) {
            const model::BearingCoefficients at = bearing.at(speed);
            across.kxx.push_back(at.k(0, 0));
            across.kyy.push_back(at.k(1, 1));
        }
        out.push_back(std::move(across));
    }
    return out;
}

/// Where the stiffness of a bearing in one direction (0 or 1), as it is at that speed, meets those
/// of the map, as roots.
/// @param across   place of the bearing in the map
/// @param highest  speed of the map, rad/s
std::vector<CriticalMapCrossing> crossings_of(const MapScene &map, const model::Bearing &bearing,
                                              int direction, std::size_t across, double highest,
                                              std::vector<results::Sentence> &notes) {
    const std::vector<double> k = direct_stiffness(bearing, direction);
    const assembly::Discretization d(
        model::with_support_stiffness(map.rotor, map.varied, k, bearing.speeds), map.order);
    const SynchronousModes found =
        synchronous::all_synchronous_modes(d, map.form, static_cast<int>(2 * map.kept()), highest);
    for (const auto &[from, to] : found.doubtful)
        notes.emplace_back(model::Weight::warning,
                           "critical speed map: crossings from {} may be missing",
                           as::speed.range(from, to));
    const auto errors = synchronous::errors_by_finer_model(d, map.form, found, notes);
    std::vector<CriticalMapCrossing> out;
    for (std::size_t i = 0; i < found.modes.size(); ++i) {
        const double speed = found.modes[i].eigenvalue.imag();
        out.push_back({across, direction == 0 ? "kxx" : "kyy", speed,
                       bearing.at(speed).k(direction, direction), found.modes[i].whirl, 1,
                       errors[i].sum()});
    }
    return out;
}

/// Adds a crossing that lies on the map and on one of its curves.
void keep(CriticalMapCrossing crossing, const MapScene &map, const CurveOf &curve_of,
          CriticalMap &out, std::vector<results::Sentence> &notes) {
    if (crossing.stiffness < out.stiffness.front() || crossing.stiffness > out.stiffness.back())
        return;
    const auto on =
        curve_through(map, curve_of, crossing.stiffness, crossing.whirl, crossing.speed);
    if (!on)
        return;
    constexpr double same_root = 1e-8; // far above rounding, far below any two curves' distance
    if (on->difference > same_root)
        notes.emplace_back("critical speed map: the crossing at {} misses its curve by {} of it",
                           as::speed(crossing.speed), as::number(on->difference, 2));
    crossing.number = out.curves[on->curve].number;
    const bool second_direction =
        !out.crossings.empty() && out.crossings.back().bearing == crossing.bearing &&
        out.crossings.back().of == crossing.of && out.crossings.back().whirl == crossing.whirl &&
        out.crossings.back().number == crossing.number &&
        std::abs(out.crossings.back().speed - crossing.speed) <= 1e-9 * crossing.speed;
    if (!second_direction)
        out.crossings.push_back(std::move(crossing));
}

/// Adds where the stiffnesses of the bearings meet the curves of the map.
/// @param rotor    as the case has it
/// @param highest  speed of the map, rad/s
void add_crossings(const MapScene &map, const CurveOf &curve_of, const model::Rotor &rotor,
                   double highest, CriticalMap &out, std::vector<results::Sentence> &notes) {
    for (std::size_t i = 0; i < out.bearings.size(); ++i) {
        const bool isotropic = out.bearings[i].isotropic;
        const model::Bearing &bearing = rotor.bearings[out.bearings[i].bearings.front()];
        for (int direction = 0; direction < (isotropic ? 1 : 2); ++direction)
            for (CriticalMapCrossing &crossing :
                 crossings_of(map, bearing, direction, i, highest, notes)) {
                if (isotropic)
                    crossing.of = "k";
                keep(std::move(crossing), map, curve_of, out, notes);
            }
    }
}

/// What the map leaves out of the rotor, and what it cannot know.
void add_notes(const model::Rotor &rotor, const MapScene &map, const CriticalMap &out,
               std::vector<results::Sentence> &notes) {
    const bool unlike_pedestals =
        std::ranges::any_of(rotor.supports(), [](const model::Bearing &bearing) {
            const auto unlike = [](const Eigen::Vector2d &of) { return of(0) != of(1); };
            return bearing.pedestal &&
                   (unlike(bearing.pedestal->k) || unlike(bearing.pedestal->mass));
        });
    const bool other_axes = !rotor.bearings_isotropic() && (map.varied || !rotor.seals().empty());
    notes.emplace_back(
        model::Weight::information, "critical speed map: without damping and cross coupling{}{}{}",
        rotor.shaft.axial_torque != 0 ? " and without the axial torque" : "",
        unlike_pedestals
            ? "; pedestals, and supports that do not vary, have the mean of their x and y "
              "coefficients"
        : other_axes ? "; supports that do not vary have the mean of their x and y coefficients"
                     : "",
        map.form == results::Form::rotating
            ? "; forward only, the balls of balancers held in place; where inertias or stiffnesses "
              "of the rotor differ in two directions, each direction has its curve"
            : "");
    if (!map.varied && (out.bearings.size() > 1 || !rotor.bearings_isotropic()))
        notes.emplace_back(
            model::Weight::information,
            "critical speed map: a crossing is a critical speed of the rotor on bearings that all "
            "have that stiffness in every direction, not of the rotor itself, whose bearings "
            "differ");
    for (const CriticalMapCurve &curve : out.curves)
        if (std::ranges::any_of(curve.error, [](double error) { return std::isinf(error); }))
            notes.emplace_back(
                "critical speed map: errors of the {} curve {} are not known everywhere",
                results::whirl_name(curve.whirl), curve.number);
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
    std::vector<double> speeds;
    for (const CriticalMapCurve &curve : out.curves)
        std::ranges::remove_copy_if(curve.speed, std::back_inserter(speeds),
                                    [](double speed) { return std::isnan(speed); });
    if (const double high = speeds.empty() ? 0 : std::ranges::max(speeds); high > 0) {
        out.bearings =
            bearings_across(scene.rotor, settings.bearing, std::ranges::min(speeds), high);
        add_crossings(map, curve_of, scene.rotor, high, out, model.notes);
    }
    add_notes(scene.rotor, map, out, model.notes);
    return out;
}

} // namespace whirl::analyses

#include "analyses/orbits/response_orbits.h"

#include "modes/orbits.h"
#include "results/resonances.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace whirl::analyses {

namespace {

using results::Sentence;
namespace as = results::as;

using results::ResponsePeak;

constexpr const char *in_clearance = "clearance"; // of peaks that are taken out again

const char *kind_of(const model::Bearing &bearing) { return bearing.seal ? "seal" : "bearing"; }

/// Where the machine runs, at its slowest, normal and fastest, and the largest resonances of
/// stations between; without operating speeds the largest of all. Ascending.
std::vector<double> usual_speeds(const model::Case &scene, std::vector<ResponsePeak> peaks) {
    constexpr std::size_t most = 6;
    std::vector<ResponsePeak> largest;
    for (const results::Resonance &one : results::resonances_of(peaks))
        if (one.peak.of == "station" && std::isfinite(one.peak.value))
            largest.push_back(one.peak);
    std::ranges::stable_sort(largest, [](const ResponsePeak &a, const ResponsePeak &b) {
        return a.value > b.value * (1 + 1e-9); // not for rounding to choose among equal ones
    });
    if (!scene.operation)
        return largest.empty() ? std::vector<double>{} : std::vector{largest.front().speed};
    const model::Operation &operation = *scene.operation;
    std::vector<double> speeds{operation.from};
    for (const double speed : {operation.normal.value_or(operation.to), operation.to})
        if (speed > speeds.back())
            speeds.push_back(speed);
    std::erase_if(largest, [&operation](const ResponsePeak &peak) {
        return !(std::abs(peak.speed) > operation.from && std::abs(peak.speed) < operation.to);
    });
    for (std::size_t i = 0; i < std::min(largest.size(), most); ++i)
        speeds.push_back(largest[i].speed);
    std::ranges::sort(speeds);
    return speeds;
}

results::Orbit orbit_of(const char *of, double z, const std::string &name,
                        const forced::Phasor &u) {
    const modes::Ellipse ellipse = modes::ellipse_of(u.x, u.y);
    return {of,
            z,
            name,
            std::abs(u.x),
            std::arg(u.x),
            std::abs(u.y),
            std::arg(u.y),
            ellipse.major,
            ellipse.minor,
            {},
            0};
}

results::Orbit orbit_in(const assembly::Discretization &d, int index, const SolvedMotion &at) {
    const model::Bearing &bearing = d.rotor().bearings[static_cast<std::size_t>(index)];
    const forced::Phasor u = at.motion.motion(forced::stretch_of_bearing(d, index));
    results::Orbit orbit = orbit_of(kind_of(bearing), bearing.z, bearing.name, u);
    orbit.clearance = bearing.clearance;
    orbit.error =
        at.error([&](const forced::ResponseError &finer) { return finer.of_stretch(index, u); });
    return orbit;
}

/// Bearings and seals, then stations without one.
results::Orbits orbits_at(const assembly::Discretization &d,
                          const std::map<int, std::string> &nodes, double speed,
                          const SolvedMotion &at) {
    results::Orbits out{speed, {}};
    std::set<int> taken;
    for (int i = 0; i < static_cast<int>(d.rotor().bearings.size()); ++i) {
        out.stations.push_back(orbit_in(d, i, at));
        taken.insert(d.shaft_mesh().node_at(out.stations.back().z));
    }
    for (const auto &[node, name] : nodes) {
        if (taken.contains(node))
            continue;
        const double z = d.shaft_mesh().nodes[static_cast<std::size_t>(node)];
        const forced::Phasor u = at.motion.motion(d.deflection_at_node(node));
        out.stations.push_back(orbit_of("station", z, name, u));
        out.stations.back().error =
            at.error([&](const forced::ResponseError &finer) { return finer.at(z, u); });
    }
    return out;
}

/// The angle of the rotor at which an orbit is farthest out; of a circle, and of the two opposite
/// ones, that on the positive side.
double farthest_instant(std::complex<double> x, std::complex<double> y) {
    constexpr double circle = 1e-9;
    const forced::WhirlParts parts({x, y});
    const bool round = std::min(std::abs(parts.a), std::abs(parts.d)) <= circle * std::abs(x);
    double instant = round ? -std::arg(x) : -(std::arg(parts.a) + std::arg(parts.d)) / 2;
    const std::complex<double> turn = std::polar(1.0, instant);
    const double along_x = (x * turn).real();
    const double along_y = (y * turn).real();
    if ((std::abs(along_x) > circle * std::abs(along_y) ? along_x : along_y) < 0)
        instant += std::numbers::pi;
    return std::remainder(instant, 2 * std::numbers::pi);
}

results::DeflectedShape shape_at(const assembly::Discretization &d, double speed,
                                 const forced::ForcedMotion &motion) {
    const modes::Stations stations = modes::Stations::for_drawing(d);
    const Eigen::MatrixXcd planar = motion.planar_motion();
    const Eigen::VectorXcd x = stations.deflections(planar.col(0));
    const Eigen::VectorXcd y = planar.cols() > 1 ? stations.deflections(planar.col(1))
                                                 : Eigen::VectorXcd(-forced::imaginary_unit * x);
    results::DeflectedShape shape;
    shape.speed = speed;
    shape.z = stations.z();
    Eigen::Index farthest = 0;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        shape.envelope.push_back(modes::ellipse_of(x(i), y(i)).major);
        if (shape.envelope.back() > shape.largest * (1 + 1e-9)) {
            shape.largest = shape.envelope.back();
            farthest = i;
        }
    }
    shape.largest_z = shape.z[static_cast<std::size_t>(farthest)];
    shape.instant = farthest_instant(x(farthest), y(farthest));
    const std::complex<double> turn = std::polar(1.0, shape.instant);
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        shape.x.push_back((x(i) * turn).real());
        shape.y.push_back((y(i) * turn).real());
    }
    return shape;
}

/// The larger of the orbits at the ends of the range, and the peaks between.
results::ClearanceUse largest_use(const assembly::Discretization &d, int index,
                                  const model::SpeedRange &range,
                                  const std::vector<ResponsePeak> &peaks,
                                  const MotionAt &motion_at) {
    const model::Bearing &bearing = d.rotor().bearings[static_cast<std::size_t>(index)];
    results::ClearanceUse use{kind_of(bearing), bearing.z, bearing.name, *bearing.clearance, 0,
                              range.from,       0};
    const auto take = [&use](double size, double speed, double error) {
        if (size / use.clearance > use.share) {
            use.share = size / use.clearance;
            use.speed = speed;
            use.error = error;
        }
    };
    for (const double speed : {range.from, range.count > 1 ? range.to : range.from}) {
        if (const auto at = motion_at(speed)) {
            const results::Orbit orbit = orbit_in(d, index, *at);
            take(orbit.major, speed, orbit.error);
        } else {
            take(forced::unlimited, speed, forced::no_value);
        }
    }
    for (const ResponsePeak &peak : peaks)
        if (peak.place == index)
            take(peak.value, peak.speed, peak.error);
    return use;
}

void note_use(results::ModelSummary &model, const results::ClearanceUse &use) {
    const Sentence of = results::place_in_words(use.of, use.name, use.z, 5);
    if (std::isinf(use.share))
        model.notes.emplace_back(
            "clearance: the orbit in {} has no limit at {}, a resonance without damping", of,
            as::speed(use.speed));
    else if (use.share > 1)
        model.notes.emplace_back(
            "clearance: the orbit in {} takes {} % of its radial clearance at {}: the shaft would "
            "touch, and these equations, which have no contact, do not hold there",
            of, as::number(100 * use.share, 3), as::speed(use.speed));
}

} // namespace

void watch_clearances(forced::Watched &all, const assembly::Discretization &d) {
    for (int i = 0; i < static_cast<int>(d.rotor().bearings.size()); ++i) {
        const model::Bearing &bearing = d.rotor().bearings[static_cast<std::size_t>(i)];
        if (!bearing.clearance)
            continue;
        forced::Quantity quantity{forced::stretch_of_bearing(d, i)};
        quantity.film = i;
        all.add(std::move(quantity), in_clearance, bearing.z, bearing.name);
        all.places.back().place = i;
    }
}

std::vector<ResponsePeak> clearance_peaks(results::ResponseResult &result,
                                          std::size_t other_quantities) {
    std::vector<ResponsePeak> taken;
    std::ranges::copy_if(result.peaks, std::back_inserter(taken),
                         [](const ResponsePeak &peak) { return peak.of == in_clearance; });
    std::erase_if(result.peaks, [](const ResponsePeak &peak) { return peak.of == in_clearance; });
    for (auto *lists : {&result.curves.values, &result.curves.phases})
        lists->resize(std::min(lists->size(), other_quantities));
    return taken;
}

void add_orbits(results::ResponseResult &result, const assembly::Discretization &d,
                const model::Case &scene, const std::map<int, std::string> &nodes,
                const std::vector<ResponsePeak> &peaks, const MotionAt &motion_at) {
    const model::SpeedRange &range = model::required_speeds(scene);
    std::vector<double> speeds = scene.response.orbits_at;
    if (speeds.empty())
        speeds = usual_speeds(scene, result.peaks);
    if (speeds.empty())
        speeds = {range.count > 1 ? range.to : range.from};
    // At a resonance without damping there is a note already, unless the case asks for that speed.
    const auto at_each = [&](const std::vector<double> &all, const char *asked, const auto &add) {
        for (const double speed : all) {
            if (const auto at = motion_at(speed))
                add(speed, *at);
            else if (asked != nullptr)
                result.model.notes.emplace_back(
                    "{}: {} is a resonance without damping: deflections have no limit", asked,
                    as::speed(speed));
        }
    };
    const bool own_orbits = !scene.response.orbits_at.empty();
    const bool own_shapes = !scene.response.shape_at.empty();
    at_each(speeds, own_orbits ? "orbits_at" : nullptr, [&](double speed, const SolvedMotion &at) {
        result.orbits.push_back(orbits_at(d, nodes, speed, at));
    });
    at_each(own_shapes ? scene.response.shape_at : speeds, own_shapes ? "shape_at" : nullptr,
            [&](double speed, const SolvedMotion &at) {
                result.shapes.push_back(shape_at(d, speed, at.motion));
            });
    for (int i = 0; i < static_cast<int>(d.rotor().bearings.size()); ++i)
        if (d.rotor().bearings[static_cast<std::size_t>(i)].clearance)
            result.clearances.push_back(largest_use(d, i, range, peaks, motion_at));
    for (const results::ClearanceUse &use : result.clearances)
        note_use(result.model, use);
}

} // namespace whirl::analyses

#include "forced/response_places.h"

#include "results/sentence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <set>
#include <utility>

namespace whirl::forced {

std::vector<double> speeds_without_limit(const std::vector<double> &speeds,
                                         const std::vector<double> &amplitudes) {
    std::vector<double> out;
    for (std::size_t i = 0; i < speeds.size(); ++i)
        if (std::isinf(amplitudes[i]))
            out.push_back(speeds[i]);
    return out;
}

results::Form form_under_weight(const model::Rotor &rotor) {
    return rotor.shaft.asymmetric() ? results::Form::rotating : results::Form::general;
}

std::map<int, std::string> attached_nodes(const assembly::Discretization &d) {
    std::map<int, std::string> nodes;
    const auto &mesh = d.shaft_mesh();
    nodes[0];
    nodes[static_cast<int>(mesh.nodes.size()) - 1];
    std::set<std::pair<int, std::string>> named; // a balancer and its imbalance have one name
    const auto collect = [&](const auto &items) {
        for (const auto &item : items) {
            const int node = mesh.node_at(item.z);
            std::string &name = nodes[node];
            if (!item.name.empty() && named.emplace(node, item.name).second)
                name += name.empty() ? item.name : ", " + item.name;
        }
    };
    const model::Rotor &rotor = d.rotor();
    collect(rotor.discs);
    collect(rotor.bearings);
    collect(rotor.anisotropies);
    collect(rotor.imbalances);
    collect(rotor.forces);
    collect(rotor.balancers);
    collect(rotor.planes);
    collect(rotor.probes);
    return nodes;
}

void add_places(results::HarmonicMotion &motion, const assembly::Discretization &d,
                const std::map<int, std::string> &nodes) {
    for (const auto &[index, name] : nodes) {
        results::ResponseNode node;
        node.z = d.shaft_mesh().nodes[static_cast<std::size_t>(index)];
        node.name = name;
        motion.nodes.push_back(node);
    }
    for (const model::Bearing &bearing : d.rotor().supports())
        motion.bearings.push_back({bearing.z, bearing.name, {}, {}});
    for (const model::Probe &probe : d.rotor().probes)
        motion.probes.push_back({probe.z, probe.angle, probe.name, {}, {}, {}});
}

void add_places(results::GravityResponse &response, const assembly::Discretization &d,
                const std::map<int, std::string> &nodes) {
    for (const auto &[node, name] : nodes) {
        response.stations.emplace_back().z = d.shaft_mesh().nodes[static_cast<std::size_t>(node)];
        response.stations.back().name = name;
    }
    for (const model::Bearing &bearing : d.rotor().supports()) {
        response.bearings.emplace_back().z = bearing.z;
        response.bearings.back().name = bearing.name;
    }
}

double inclination_of(const Phasor &motion, double rounding) {
    const WhirlParts parts(motion); // longest where the two are parallel
    const auto &[a, d] = parts;
    const double smaller = std::min(std::abs(a), std::abs(d));
    const double larger = std::max(std::abs(a), std::abs(d));
    if (smaller <= (rounding + 1e-14) * larger)
        return no_value;
    const double angle = std::arg(a * std::conj(d)) / 2;
    return angle <= -std::numbers::pi / 2 ? angle + std::numbers::pi : angle;
}

Quantity quantity_of(const assembly::Discretization &d, const model::Probe &probe) {
    Quantity out{stretch_of_probe(d, probe), Quantity::deflection, probe.angle};
    out.probe = probe;
    return out;
}

void Watched::add(Quantity quantity, const char *of, double place, const std::string &name) {
    const int before = places.empty() || places.back().of != of ? 0 : places.back().place + 1;
    places.emplace_back().of = of;
    places.back().place = before;
    places.back().z = place;
    places.back().name = name;
    places.back().angle = quantity.angle;
    quantity.z = place;
    quantities.push_back(std::move(quantity));
}

Watched watched(const assembly::Discretization &d, const std::map<int, std::string> &nodes) {
    Watched out;
    for (const auto &[node, name] : nodes)
        out.add({d.deflection_at_node(node)}, "station",
                d.shaft_mesh().nodes[static_cast<std::size_t>(node)], name);
    const auto bearings = d.rotor().supports();
    for (int i = 0; i < static_cast<int>(bearings.size()); ++i) {
        const model::Bearing &bearing = bearings[static_cast<std::size_t>(i)];
        out.add({stretch_of_bearing(d, i), i}, "bearing", bearing.z, bearing.name);
    }
    return out;
}

namespace {

results::ResponsePeak described(const Peak &peak, results::ResponsePeak place) {
    place.speed = peak.speed;
    place.value = peak.value;
    place.phase = peak.phase;
    place.lower = peak.lower;
    place.upper = peak.upper;
    if (peak.lower && peak.upper)
        place.amplification = std::abs(peak.speed) / (*peak.upper - *peak.lower);
    place.error = no_value;
    place.error_parts = {no_value, no_value, no_value};
    place.speed_error = no_value;
    return place;
}

void set_errors(results::ResponsePeak &peak, const PeakErrors &of_mesh, double by_interpolation,
                double by_rounding) {
    peak.error_parts = {of_mesh.value, by_interpolation, by_rounding};
    peak.error = peak.error_parts.sum();
    peak.speed_error = std::max(of_mesh.speed, 4 * std::numeric_limits<double>::epsilon());
}

} // namespace

void add_curve(const std::vector<CurvePeaks::Sample> &samples, results::ResponseCurves &curves) {
    for (const CurvePeaks::Sample &sample : samples) {
        curves.speeds.push_back(sample.speed);
        for (std::size_t i = 0; i < sample.values.size(); ++i) {
            curves.values[i].push_back(sample.values[i]);
            curves.phases[i].push_back(std::arg(sample.numbers(static_cast<Eigen::Index>(i), 0)));
        }
    }
}

void note_missing(const std::vector<std::pair<double, double>> &ranges,
                  std::vector<model::Sentence> &notes) {
    for (const auto &[from, to] : ranges)
        notes.emplace_back(model::Weight::warning,
                           "peaks from {} to {} may be missing: the speeds at which the motion was "
                           "solved for do not tell all resonances there apart",
                           results::as::speed(from), results::as::speed(to));
}

void add_peaks(std::vector<results::ResponsePeak> &peaks, results::ResponseCurves &curves,
               const assembly::Discretization &d, results::Form form, const Watched &all,
               const model::SpeedRange &range, const PeakOptions &options,
               std::vector<model::Sentence> &notes) {
    if (range.count < 2 || !(range.to > range.from) || all.quantities.empty())
        return;
    curves.values.resize(all.quantities.size());
    curves.phases.resize(all.quantities.size());
    std::vector<std::pair<std::size_t, results::ResponsePeak>> found_at; // quantity, peak
    const auto add_between = [&](double from, double to) {               // of one sign
        const CertifiedPeaks found = response_peaks(d, form, all.quantities, from, to, options);
        for (std::size_t i = 0; i < found.peaks.size(); ++i) {
            const std::size_t quantity = found.peaks[i].quantity;
            results::ResponsePeak peak = described(found.peaks[i], all.places[quantity]);
            if (options.with_errors)
                set_errors(peak, found.errors[i], found.interpolation_error,
                           found.peaks[i].rounding);
            found_at.emplace_back(quantity, std::move(peak));
        }
        note_missing(found.unsettled, notes);
        add_curve(found.curve, curves);
    };
    if (range.from < 0)
        add_between(range.from, std::min(range.to, 0.0));
    if (range.to > 0)
        add_between(std::max(range.from, 0.0), range.to);
    std::ranges::stable_sort(found_at,
                             [](const auto &a, const auto &b) { return a.first < b.first; });
    for (auto &[quantity, peak] : found_at)
        peaks.push_back(std::move(peak));
}

} // namespace whirl::forced

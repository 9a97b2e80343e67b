#include "report/response/marks.h"

#include "report/common/words.h"
#include "report/pictures/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace whirl::report {

using results::HarmonicMotion;
using results::ResponsePeak;
using results::ResponseResult;

namespace {

/// The values of a station over the speeds of the curves, or of the case where there are none.
const std::vector<double> &amplitudes_of(const HarmonicMotion &result, std::size_t i) {
    return i < result.curves.values.size() ? result.curves.values[i] : result.nodes[i].amplitude;
}
const std::vector<double> &phases_of(const HarmonicMotion &result, std::size_t i) {
    return i < result.curves.phases.size() ? result.curves.phases[i] : result.nodes[i].phase;
}

/// "2951 rpm"
std::string speed_text(const Units &units, const ResponsePeak &peak) {
    return drawn_speed(units, peak.speed) + " " + units.name(Quantity::speed);
}

} // namespace

std::vector<const ResponsePeak *> labelled_peaks(const HarmonicMotion &result, std::size_t place,
                                                 const std::string &of) {
    std::vector<const ResponsePeak *> peaks;
    for (const ResponsePeak &peak : result.peaks)
        if (peak.of == of && peak.place == static_cast<int>(place) && std::isfinite(peak.value))
            peaks.push_back(&peak);
    return peaks;
}

std::string peak_text(const Units &units, const ResponsePeak &peak,
                      const std::vector<results::Resonance> &resonances) {
    const std::string speed = speed_text(units, peak);
    if (!peak.resonance || *peak.resonance >= resonances.size())
        return speed + ", " + results::peak_kind_name(peak.kind);
    const auto &factor = resonances[*peak.resonance].peak.amplification;
    return factor ? fmt::format("{}, AF {}", speed, drawn_number(*factor, 3)) : speed;
}

std::optional<std::size_t> largest_station(const HarmonicMotion &result) {
    std::optional<std::size_t> largest;
    double most = 0; // none where nothing moves
    for (std::size_t i = 0; i < result.nodes.size(); ++i) {
        double here = 0;
        for (const std::vector<double> *values :
             {&amplitudes_of(result, i), &result.nodes[i].amplitude})
            for (const double value : *values)
                here = std::isnan(value) ? here : std::max(here, value);
        for (const ResponsePeak &peak : result.peaks)
            if (peak.of == "station" && peak.place == static_cast<int>(i))
                here = std::max(here, peak.value);
        if (here > most * (1 + 1e-9)) { // not for rounding to choose among equal ones
            most = here;
            largest = i;
        }
    }
    return largest;
}

bool has_polar(const ResponseResult &result) {
    double most = 0;
    for (std::size_t i = 0; i < result.nodes.size(); ++i)
        for (const double value : amplitudes_of(result, i)) {
            if (!std::isfinite(value))
                return false;
            most = std::max(most, value);
        }
    return most > 0 && result.speeds.size() > 1 &&
           std::all_of(result.peaks.begin(), result.peaks.end(),
                       [](const ResponsePeak &peak) { return std::isfinite(peak.value); });
}

namespace {

/// What the polar plot has a curve of.
struct PolarLine {
    std::string name;
    std::size_t curve = 0; ///< among those of the result
    std::vector<const ResponsePeak *> peaks;
};

/// The probes, whose readings have amplitude and phase in one direction; without any the stations.
std::vector<PolarLine> polar_lines(const Units &units, const ResponseResult &result) {
    std::vector<PolarLine> lines;
    const std::size_t before = result.nodes.size() + result.bearings.size();
    for (std::size_t i = 0; i < result.probes.size(); ++i) {
        const auto &probe = result.probes[i];
        if (before + i < result.curves.values.size())
            lines.push_back({fmt::format("{} at {}", place_text(units, probe.name, probe.z),
                                         degrees_text(probe.angle)),
                             before + i, labelled_peaks(result, i, "probe")});
    }
    if (lines.empty())
        for (const std::size_t i : drawn_nodes(result))
            lines.push_back({place_text(units, result.nodes[i].name, result.nodes[i].z), i,
                             labelled_peaks(result, i)});
    return lines;
}

double largest_of(const ResponseResult &result, const PolarLine &line) {
    double most = 0;
    for (const double value : amplitudes_of(result, line.curve))
        most = std::max(most, value);
    for (const ResponsePeak *peak : line.peaks)
        most = std::max(most, peak->value);
    return most;
}

std::vector<PlotPoint> polar_points(const Units &units, const ResponseResult &result,
                                    std::size_t curve) {
    std::vector<PlotPoint> points;
    const std::vector<double> &amplitude = amplitudes_of(result, curve);
    const std::vector<double> &phase = phases_of(result, curve);
    for (std::size_t k = 0; k < amplitude.size() && k < phase.size(); ++k) {
        const double size = units(Quantity::amplitude, amplitude[k]);
        if (size == 0)
            points.push_back({0, 0});
        else if (std::isfinite(phase[k]))
            points.push_back({size * std::cos(phase[k]), size * std::sin(phase[k])});
    }
    return points;
}

/// The place before the first of three, on a curve that turns on as it does between them.
std::complex<double> beyond(std::complex<double> first, std::complex<double> second,
                            std::complex<double> third) {
    const std::complex<double> step = second - first;
    const std::complex<double> turn = step / (third - second);
    return first - step * turn / std::abs(turn);
}

/// A curve without corners through the points, four pieces between neighbours: a loop is known at
/// some twenty places, which straight lines would make a polygon. Cubic, with the root of the
/// distances as parameter (centripetal Catmull-Rom), which neither overshoots nor makes loops.
std::vector<PlotPoint> smooth(const std::vector<PlotPoint> &points) {
    constexpr int pieces = 4;
    std::vector<std::complex<double>> p;
    for (const PlotPoint &point : points)
        if (const std::complex<double> here(point.x, *point.y); p.empty() || here != p.back())
            p.push_back(here);
    if (p.size() < 3)
        return points;
    std::vector<PlotPoint> out;
    for (std::size_t k = 0; k + 1 < p.size(); ++k) {
        const std::complex<double> q[4] = {
            k > 0 ? p[k - 1] : beyond(p[0], p[1], p[2]), p[k], p[k + 1],
            k + 2 < p.size() ? p[k + 2] : beyond(p[k + 1], p[k], p[k - 1])};
        double t[4] = {0, 0, 0, 0};
        for (int i = 0; i < 3; ++i)
            t[i + 1] = t[i] + std::sqrt(std::abs(q[i + 1] - q[i]));
        for (int i = 0; i < pieces; ++i) {
            const double at = t[1] + (t[2] - t[1]) * i / pieces;
            std::complex<double> level[3];
            const auto between = [&](const std::complex<double> &a, const std::complex<double> &b,
                                     double from, double to) {
                return ((to - at) * a + (at - from) * b) / (to - from);
            };
            for (int j = 0; j < 3; ++j) // Barry and Goldman's pyramid
                level[j] = between(q[j], q[j + 1], t[j], t[j + 1]);
            const std::complex<double> a = between(level[0], level[1], t[0], t[2]);
            const std::complex<double> b = between(level[1], level[2], t[1], t[3]);
            const std::complex<double> place = between(a, b, t[1], t[2]);
            out.push_back({place.real(), place.imag()});
        }
    }
    out.push_back({p.back().real(), p.back().imag()});
    return out;
}

} // namespace

Chart polar_chart(const model::Case &scene, const ResponseResult &result, const Units &units) {
    const std::vector<PolarLine> lines = polar_lines(units, result);
    const PolarLine *largest = nullptr;
    double most = 0; // in the unit of the axes
    for (const PolarLine &line : lines)
        if (const double here = units(Quantity::amplitude, largest_of(result, line));
            !largest || here > most * (1 + 1e-9)) { // not for rounding to choose among equal ones
            largest = &line;
            most = here;
        }
    const bool probes = !result.probes.empty();
    ChartPanel panel =
        polar_panel(640, chart_axis(units, probes ? "in phase" : "x", Quantity::amplitude),
                    chart_axis(units, probes ? "90° ahead" : "y", Quantity::amplitude), most);
    for (std::size_t i = 0; i < lines.size(); ++i)
        panel.curves.push_back(
            chart_curve(lines[i].name, smooth(polar_points(units, result, lines[i].curve)), i));
    ChartCurve tops{"peaks of " + largest->name, {}, {"", "#000000", "1", 6}, 0, 1.5};
    for (const ResponsePeak *peak : largest->peaks) {
        const double size = units(Quantity::amplitude, peak->value);
        tops.points.push_back({size * std::cos(peak->phase), size * std::sin(peak->phase)});
        if (size > 0.14 * most) // not amid all loops
            panel.labels.push_back(
                {speed_text(units, *peak), tops.points.back().x, *tops.points.back().y});
    }
    panel.curves.push_back(tops);
    return {"Polar plot: " + title_of(scene),
            fmt::format(
                "{} at the angle of {}, from {} to {} {}",
                units.label(probes ? "reading of the probes" : "amplitude", Quantity::amplitude),
                probes ? "its phase" : "the phase of x", drawn_speed(units, result.speeds.front()),
                drawn_speed(units, result.speeds.back()), units.name(Quantity::speed)),
            {panel}};
}

} // namespace whirl::report

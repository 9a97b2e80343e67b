#include "report/pictures/figures.h"

#include "report/pictures/operation.h"
#include "report/pictures/style.h"
#include "results/samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::report {

using results::SampledAnswer;
using results::SamplesResult;

namespace {

constexpr std::size_t most_panels = 12;

/// The numbers of an answer as they are drawn: speeds in rpm, amplitudes in µm.
double factor_of(const SampledAnswer &answer) {
    return answer.unit == "rad/s" ? rpm
           : answer.unit == "m"   ? double(micrometres)
           : answer.unit == "N"   ? double(newtons)
                                  : 1.0;
}

std::string axis_of(const SampledAnswer &answer) {
    return answer.unit == "rad/s" ? "Spin speed (rpm)"
           : answer.unit == "m"   ? "Amplitude (µm)"
           : answer.unit == "N"   ? "Force (N)"
           : answer.unit == "1"   ? "Share"
                                  : answer.unit;
}

std::vector<double> shown_values(const SampledAnswer &answer) {
    std::vector<double> values;
    for (const std::optional<double> &value : answer.values)
        if (value)
            values.push_back(*value * factor_of(answer));
    return values;
}

/// A step of 1, 2 or 5 times a power of ten that divides a width into three to six parts or so.
double step_of(double width) {
    const double power = std::pow(10, std::floor(std::log10(width / 3)));
    const double times = width / 3 / power;
    return power * (times >= 5 ? 5 : times >= 2 ? 2 : 1);
}

struct Histogram {
    Range range;
    double width = 1; ///< of a bar
    std::vector<int> counts;
};

Histogram histogram_of(const std::vector<double> &values) {
    Histogram out;
    out.range = range_of(values);
    const double wanted = std::round(std::sqrt(static_cast<double>(values.size())));
    out.counts.resize(static_cast<std::size_t>(std::clamp(wanted, 5.0, 30.0)));
    out.width = (out.range.high - out.range.low) / static_cast<double>(out.counts.size());
    for (const double value : values) {
        const auto bar = static_cast<std::size_t>((value - out.range.low) / out.width);
        ++out.counts[std::min(bar, out.counts.size() - 1)];
    }
    return out;
}

/// Lines at the quantiles, their intervals shaded, and the case as it is.
std::string marks_of(const SampledAnswer &answer) {
    const double factor = factor_of(answer);
    std::string text;
    for (const results::SampleQuantile &quantile : answer.quantiles) {
        const auto place = [&](const std::optional<double> &end, const char *border) {
            return end ? fmt::format("first {:.9g}", *end * factor) : std::string(border);
        };
        text += fmt::format("set object rectangle from {},graph 0 to {},graph 1 behind "
                            "fc rgb '#FBE3CF' fs solid noborder\n",
                            place(quantile.low, "graph 0"), place(quantile.high, "graph 1"));
        text += upright(quantile.value * factor, "front lw 1.8 lc rgb '#D55E00'");
        text += fmt::format("set label '{} %' at first {:.9g},graph 1.05 center font ',11' "
                            "textcolor '#B04E00'\n",
                            readable(100 * quantile.share), quantile.value * factor);
    }
    if (answer.nominal)
        text += upright(*answer.nominal * factor, "front lw 1.4 dt (6,4) lc rgb '#000000'");
    return text;
}

std::string panel_of(const model::Case &scene, const SampledAnswer &answer) {
    const Histogram histogram = histogram_of(shown_values(answer));
    const auto [low, high] = histogram.range;
    std::vector<PlotPoint> bars;
    for (std::size_t i = 0; i < histogram.counts.size(); ++i)
        bars.push_back({low + (static_cast<double>(i) + 0.5) * histogram.width,
                        static_cast<double>(histogram.counts[i])});
    const int most = *std::max_element(histogram.counts.begin(), histogram.counts.end());
    const double margin = 0.06 * (high - low);
    const Range x{low - margin, high + margin};
    Curves drawn;
    drawn.add(bars, "using 1:2 with boxes lc rgb '#3C97CF' fs transparent solid 0.45 border lc rgb "
                    "'#0072B2'");
    return marks_of(answer) + (answer.unit == "rad/s" ? operation_band(scene, x) : "") +
           axes_over(x, {0, 1.08 * most}) +
           fmt::format(
               "set title {} font ',12' offset 0,0.2\nset xlabel '{}' font ',11' offset 0,0.4\n"
               "set ylabel 'samples' font ',11' offset 1.5,0\n"
               "set xtics {:.9g} font ',11'\nset ytics font ',11'\nset boxwidth {:.9g}\n",
               plot_text(answer.name), axis_of(answer), step_of(high - low), histogram.width) +
           drawn.script() + "unset object\nunset arrow\nunset label\nunset title\n";
}

std::string subtitle_of(const model::Case &scene, const SamplesResult &result, std::size_t drawn,
                        std::size_t all) {
    std::string text = fmt::format(
        "{} samples{}; lines: quantiles, shaded: their intervals of 95 %; dashed: the "
        "case as it is",
        result.count, result.failed > 0 ? fmt::format(", {} of them failed", result.failed) : "");
    if (scene.operation)
        text += "; green: operating speeds";
    if (drawn < all)
        text += fmt::format("; the first {} of {} answers", drawn, all);
    return text;
}

} // namespace

Figure samples_figure(const model::Case &scene, const SamplesResult &result, const Units &) {
    std::vector<const SampledAnswer *> drawn;
    std::size_t all = 0;
    for (const SampledAnswer &answer : result.answers) {
        if (answer.present == 0)
            continue;
        if (++all <= most_panels)
            drawn.push_back(&answer);
    }
    const std::size_t columns = drawn.size() == 4 ? 2 : std::clamp<std::size_t>(drawn.size(), 1, 3);
    const std::size_t rows = std::max<std::size_t>((drawn.size() + columns - 1) / columns, 1);
    constexpr int head = 70;
    constexpr int row_height = 290;
    const int height = head + static_cast<int>(rows) * row_height;
    const double across = 1.0 / static_cast<double>(columns);
    const double down = static_cast<double>(row_height) / height;
    const double top = 1 - static_cast<double>(head) / height;
    std::string panels = "set grid y lc rgb '#E4E4E4' lt 1 lw 0.6\nunset key\nset format x '%g'\n";
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        const double left = static_cast<double>(i % columns) * across;
        const std::size_t row = i / columns;
        const double upper = top - static_cast<double>(row) * down;
        panels += panel_margins(left + 0.2 * across, left + 0.94 * across, upper - 0.8 * down,
                                upper - 0.2 * down) +
                  panel_of(scene, *drawn[i]);
    }
    if (drawn.empty())
        panels += "set xrange [0:1]\nset yrange [0:1]\nplot NaN notitle\n";
    return figure_of(columns == 1 ? 900 : 1300, height, "Uncertain entries: " + title_of(scene),
                     subtitle_of(scene, result, drawn.size(), all), panels);
}

} // namespace whirl::report

#include "report/pictures/figures.h"

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

std::vector<double> shown_values(const Units &units, const SampledAnswer &answer) {
    std::vector<double> values;
    for (const std::optional<double> &value : answer.values)
        if (value)
            values.push_back(units(answer.quantity, *value));
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

/// Lines at the quantiles, their intervals shaded behind the histogram, and the case as it is.
ChartPanel panel_of(const Units &units, const SampledAnswer &answer) {
    const Histogram histogram = histogram_of(shown_values(units, answer));
    const auto [low, high] = histogram.range;
    const double margin = 0.06 * (high - low);
    ChartPanel panel{170, answer_axis(units, answer), {.title = "samples"}};
    panel.title = units.text(answer.name);
    panel.x.low = low - margin;
    panel.x.high = high + margin;
    panel.x.step = step_of(high - low);
    panel.y.low = 0;
    panel.y.high = 1.25 * std::ranges::max(histogram.counts); // room for the shares
    ChartCurve bars = chart_area({"", "#9DCBE7"});
    for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
        const double left = low + static_cast<double>(i) * histogram.width;
        const double count = histogram.counts[i];
        bars.points.insert(bars.points.end(), {{left, 0},
                                               {left, count},
                                               {left + histogram.width, count},
                                               {left + histogram.width, 0}});
    }
    const ChartCurve outline{"", bars.points, {"", "#0072B2"}, 1};
    const double factor = units.factor(answer.quantity);
    std::vector<ChartCurve> lines;
    for (const results::SampleQuantile &quantile : answer.quantiles) {
        const double at = quantile.value * factor;
        const auto end = [factor](std::optional<double> value, double otherwise) {
            return value ? *value * factor : otherwise;
        };
        panel.curves.push_back(upright_band(
            panel, {end(quantile.low, *panel.x.low), end(quantile.high, *panel.x.high)},
            {"interval of 95 %", "#FBE3CF"}));
        lines.push_back(upright_line(panel, at, {"quantile", "#D55E00"}, 1.8));
        panel.labels.push_back(
            {drawn_number(100 * quantile.share) + " %", at, 0.97 * *panel.y.high, "#B04E00"});
    }
    if (answer.nominal)
        lines.push_back(upright_line(panel, *answer.nominal * factor,
                                     {"case as it is", "#000000", "(6,4)"}, 1.4));
    panel.curves.insert(panel.curves.end(), {bars, outline});
    panel.curves.insert(panel.curves.end(), lines.begin(), lines.end());
    return panel;
}

} // namespace

Chart samples_chart(const model::Case &scene, const SamplesResult &result, const Units &units) {
    Chart chart{"Uncertain entries: " + title_of(scene),
                fmt::format("{} {}", result.count, result.count == 1 ? "sample" : "samples"),
                {}};
    std::size_t all = 0;
    for (const SampledAnswer &answer : result.answers) {
        if (answer.present == 0 || ++all > most_panels)
            continue;
        chart.panels.push_back(panel_of(units, answer));
        chart.panels.back().beside = all % 2 == 0;
    }
    if (result.failed > 0)
        chart.subtitle += fmt::format(", {} of them failed", result.failed);
    if (all > most_panels)
        chart.subtitle += fmt::format("; the first {} of {} answers", most_panels, all);
    return chart;
}

} // namespace whirl::report

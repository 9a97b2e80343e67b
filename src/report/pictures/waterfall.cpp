#include "report/pictures/figures.h"

#include "report/pictures/style.h"
#include "results/transient.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace whirl::report {

using results::Waterfall;

namespace {

constexpr double shown_share = 2e-3; ///< of the largest: nothing of that size beyond is not drawn
constexpr double room = 8;           ///< the highest line is as high as so many gaps between lines
constexpr double orders[] = {1, 2, 3};

/// The speed changes, and only rises or only falls.
bool monotonic(const std::vector<double> &speeds) {
    return speeds.front() != speeds.back() &&
           (std::is_sorted(speeds.begin(), speeds.end()) ||
            std::is_sorted(speeds.begin(), speeds.end(), std::greater<>()));
}

/// Highest frequency, rad/s, with something to see, and at least twice the spin speed.
double highest_frequency(const Waterfall &waterfall, double largest) {
    std::size_t last = 0;
    for (const std::vector<double> &spectrum : waterfall.amplitude)
        for (std::size_t i = last; i < spectrum.size(); ++i)
            if (spectrum[i] > shown_share * largest)
                last = i;
    double fastest = 0;
    for (const double speed : waterfall.speeds)
        fastest = std::max(fastest, std::abs(speed));
    const double wanted = std::max(1.2 * waterfall.frequencies[last], 2.2 * fastest);
    return std::min(wanted, waterfall.frequencies.back());
}

/// Where the lines stand and how high they are.
class Layout {
  public:
    Layout(const Units &units, const Waterfall &waterfall)
        : _units(units), _waterfall(waterfall), _over_speed(monotonic(waterfall.speeds)) {
        for (const std::vector<double> &spectrum : waterfall.amplitude)
            _largest = std::max(_largest, *std::max_element(spectrum.begin(), spectrum.end()));
        for (std::size_t k = 0; k < waterfall.times.size(); ++k)
            if (!_over_speed || k == 0 || waterfall.speeds[k] != waterfall.speeds[k - 1])
                _order.push_back(k); // of those at one speed the first
        std::sort(_order.begin(), _order.end(),
                  [&](std::size_t a, std::size_t b) { return base(a) > base(b); });
        const double gap = (highest() - lowest()) / static_cast<double>(_order.size());
        _scale = _largest > 0 ? room * gap / _largest : 0;
        _right = units(Quantity::frequency, highest_frequency(waterfall, _largest));
    }

    [[nodiscard]] bool over_speed() const { return _over_speed; }
    [[nodiscard]] double largest() const { return _largest; } ///< m
    [[nodiscard]] double right() const { return _right; }     ///< a frequency in its unit
    [[nodiscard]] double base(std::size_t k) const {
        return _over_speed ? _units(Quantity::speed, _waterfall.speeds[k]) : _waterfall.times[k];
    }
    [[nodiscard]] double lowest() const { return base(_order.back()); }
    [[nodiscard]] double highest() const { return base(_order.front()); }
    [[nodiscard]] double top() const { return highest() + _scale * _largest; }
    /// From the back to the front, which hides what is behind.
    [[nodiscard]] const std::vector<std::size_t> &order() const { return _order; }

    [[nodiscard]] std::vector<PlotPoint> line(std::size_t k) const {
        std::vector<PlotPoint> points;
        for (std::size_t i = 0; i < _waterfall.frequencies.size(); ++i)
            if (const double x = _units(Quantity::frequency, _waterfall.frequencies[i]);
                x <= _right)
                points.push_back({x, base(k) + _scale * _waterfall.amplitude[k][i]});
        return points;
    }
    /// A multiple of the spin speed across the lines.
    [[nodiscard]] std::vector<PlotPoint> multiple(double order) const {
        std::vector<PlotPoint> points;
        for (const std::size_t k : _order) {
            const double x = _units(Quantity::frequency, order * std::abs(_waterfall.speeds[k]));
            points.push_back({x, x <= _right ? std::optional(base(k)) : std::nullopt});
        }
        return points;
    }

  private:
    const Units &_units;
    const Waterfall &_waterfall;
    bool _over_speed;
    double _largest = 0;
    double _scale = 0; ///< of the axis per m
    double _right = 0;
    std::vector<std::size_t> _order;
};

/// Each line hides what is behind it.
std::vector<ChartCurve> lines_of(const Layout &layout) {
    std::vector<ChartCurve> curves;
    for (const std::size_t k : layout.order()) {
        ChartCurve line{"", layout.line(k), series_style(0), 0.9};
        ChartCurve below = chart_area({"", "#FFFFFF"}, line.points);
        below.points.push_back({line.points.back().x, layout.base(k)});
        below.points.push_back({line.points.front().x, layout.base(k)});
        curves.insert(curves.end(), {below, line});
    }
    std::size_t number = 0;
    for (const double order : orders)
        curves.push_back(chart_curve(drawn_number(order) + "× spin speed", layout.multiple(order),
                                     ++number, 1.3, "(4,4)"));
    return curves;
}

} // namespace

Chart waterfall_chart(const model::Case &scene, const Waterfall &waterfall, const Units &units) {
    const Layout layout(units, waterfall);
    ChartPanel panel{590, chart_axis(units, "Frequency", Quantity::frequency),
                     layout.over_speed() ? chart_axis(units, "Spin speed", Quantity::speed)
                                         : chart_axis(units, "Time", Quantity::time),
                     lines_of(layout)};
    panel.x.low = 0;
    panel.x.high = layout.right();
    panel.y.low = layout.lowest();
    panel.y.high = layout.top();
    return {"Waterfall: " + title_of(scene),
            fmt::format("{}, windows of {}; the highest line is {}",
                        place_text(units, waterfall.name, waterfall.z),
                        drawn_value(units, Quantity::time, waterfall.window, 3),
                        drawn_value(units, Quantity::amplitude, layout.largest(), 4)),
            {panel}};
}

} // namespace whirl::report

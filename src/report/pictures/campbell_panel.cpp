#include "report/pictures/campbell_panel.h"

#include "report/common/gnuplot.h"
#include "results/whirl.h"

#include <algorithm>

namespace whirl::report {

using results::CampbellMode;
using results::CampbellResult;
using results::Whirl;

std::optional<double> Panel::value(const CampbellMode &mode, std::size_t i) const {
    const auto value = entry(damping ? mode.log_dec : mode.frequency, i);
    return value && !damping ? *value * hertz : value;
}

std::vector<std::vector<PlotPoint>>
stretches(const Panel &panel, const CampbellResult &result,
          const std::function<bool(const CampbellMode &, std::size_t)> &belongs) {
    std::vector<std::vector<PlotPoint>> lines;
    for (const CampbellMode &mode : result.modes) {
        std::vector<PlotPoint> line;
        for (std::size_t i = 0; i + 1 < result.speeds.size(); ++i) {
            const auto here = panel.value(mode, i);
            const auto next = panel.value(mode, i + 1);
            if (here && next && belongs(mode, i)) {
                if (line.empty())
                    line.push_back({result.speeds[i] * rpm, here});
                line.push_back({result.speeds[i + 1] * rpm, next});
            } else if (!line.empty()) {
                lines.push_back(std::move(line));
                line.clear();
            }
        }
        if (!line.empty())
            lines.push_back(std::move(line));
    }
    return lines;
}

std::vector<PlotPoint> markers(const Panel &panel, const CampbellResult &result, Whirl sense) {
    std::vector<PlotPoint> points;
    const std::size_t step = std::max<std::size_t>(1, result.speeds.size() / 10);
    for (std::size_t m = 0; m < result.modes.size(); ++m) {
        const CampbellMode &mode = result.modes[m];
        for (std::size_t i = 0; i < result.speeds.size() && i < mode.whirl.size(); ++i) {
            const auto value = panel.value(mode, i);
            const bool lone = (i == 0 || !panel.value(mode, i - 1)) &&
                              (i + 1 >= result.speeds.size() || !panel.value(mode, i + 1));
            if (value && mode.whirl[i] == sense && (lone || (i + m * step / 3) % step == step / 2))
                points.push_back({result.speeds[i] * rpm, value});
        }
    }
    return points;
}

} // namespace whirl::report

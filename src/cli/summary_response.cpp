#include "cli/summary.h"

#include "cli/table.h"
#include "cli/words.h"
#include "results/response.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace whirl::cli {

namespace {

struct Peak {
    double value = 0;
    double speed = 0;
    double error = 0;
};

Peak peak_of(const std::vector<double> &values, const std::vector<double> &errors,
             const std::vector<double> &speeds) {
    Peak peak;
    for (std::size_t i = 0; i < std::min(values.size(), speeds.size()); ++i)
        if (i == 0 || values[i] > peak.value)
            peak = {values[i], speeds[i], i < errors.size() ? errors[i] : 0};
    return peak;
}

std::string size_of(const Peak &peak) {
    return std::isinf(peak.value) ? "no limit" : readable(peak.value);
}

std::string error_of(const Peak &peak) {
    return std::isfinite(peak.error) ? rough(peak.error) : "-";
}

} // namespace

std::string summary(const model::Case &scene, const results::ResponseResult &result) {
    std::string text = heading(scene, "Unbalance response, " + range_text(result.speeds));
    Table nodes({"station", "largest amplitude m", "at rpm", "error"});
    for (const results::ResponseNode &node : result.nodes) {
        const Peak peak = peak_of(node.amplitude, node.error, result.speeds);
        nodes.add(
            {place(node.name, node.z), size_of(peak), readable(peak.speed * rpm), error_of(peak)});
    }
    text += nodes.text();
    Table probes({"probe", "looks along deg", "largest reading m", "at rpm", "error"});
    for (const results::ResponseProbe &probe : result.probes) {
        const Peak peak = peak_of(probe.amplitude, probe.error, result.speeds);
        probes.add({place(probe.name, probe.z), readable(probe.angle * 180 / std::numbers::pi),
                    size_of(peak), readable(peak.speed * rpm), error_of(peak)});
    }
    if (!probes.empty())
        text += "\n" + probes.text();
    Table bearings({"bearing", "largest force N", "at rpm", "error"});
    for (const results::ResponseBearing &bearing : result.bearings) {
        const Peak peak = peak_of(bearing.force, bearing.error, result.speeds);
        bearings.add({place(bearing.name, bearing.z), size_of(peak), readable(peak.speed * rpm),
                      error_of(peak)});
    }
    if (!bearings.empty())
        text += "\n" + bearings.text();
    return text + model_text(result.model);
}

} // namespace whirl::cli

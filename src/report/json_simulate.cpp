#include "report/json_simulate.h"

#include "report/json.h"
#include "report/json_parts.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace whirl::report {

namespace {

Json balancer(const results::BalancerMotion &b) {
    return {{"z", b.z},
            {"name", b.name},
            {"kind", b.kind},
            {"coordinates", b.coordinates},
            {"E", json_number(b.capacity)},
            {"angles", b.angles},
            {"rates", b.rates},
            {"swing", b.swing},
            {"amplitude", b.amplitude},
            {"amplitude_without_balls", b.reference}};
}

Json integration(const results::SimulateResult &result) {
    return {{"method", result.integrator},
            {"steps", result.steps},
            {"rate_evaluations", result.rate_evaluations}};
}

Json reduction(const results::SimulateResult &result) {
    return {{"modes", result.modes},
            {"shapes", result.shapes},
            {"response_error", result.response_error},
            {"frequency_error", result.frequency_error}};
}

Json audit(const results::MotionAudit &audit) {
    return {{"energy_error", audit.energy_error},
            {"energy_scale", audit.energy_scale},
            {"momentum_error", audit.momentum_error},
            {"momentum_scale", audit.momentum_scale}};
}

Json other_starts(const std::vector<results::OtherStart> &list) {
    Json out = Json::array();
    for (const results::OtherStart &start : list)
        out.push_back({{"start_angles", start.start_angles},
                       {"outcome", results::outcome_name(start.outcome)},
                       {"evidence", start.evidence},
                       {"residual_ratio", json_number(start.residual_ratio)},
                       {"balls", start.angles},
                       {"amplitude", start.amplitude}});
    return out;
}

} // namespace

std::string to_json(const model::Case &scene, const results::SimulateResult &result) {
    Json json = json_envelope("simulate", scene, result.model);
    json["outcome"] = results::outcome_name(result.outcome);
    json["evidence"] = result.evidence;
    json["residual_ratio"] = json_number(result.residual_ratio);
    json["trend"] = json_number(result.trend);
    json["linear_growth"] = json_number(result.linear_growth);
    json["decision_time"] = json_number(result.decision_time);
    json["time"] = result.time;
    json["speed"] = result.speed;
    json["revolutions"] = result.revolutions;
    json["balls"] = Json::array(); // the final angles, a list for each balancer
    json["balancers"] = Json::array();
    for (const results::BalancerMotion &b : result.balancers) {
        json["balls"].push_back(b.angles);
        json["balancers"].push_back(balancer(b));
    }
    json["start_angles"] = result.start_angles;
    json["other_starts"] = other_starts(result.other_starts);
    json["reduction"] = reduction(result);
    json["integration"] = integration(result);
    json["audit"] = audit(result.audit);
    json["series"] = {{"time", result.series.time},
                      {"speed", result.series.speed},
                      {"amplitude", result.series.amplitude},
                      {"angles", result.series.angles}};
    return json_text(json);
}

std::string to_csv(const results::SimulateResult &result) {
    const results::MotionSeries &series = result.series;
    std::string csv = "time [s],speed [rad/s]";
    for (std::size_t i = 0; i < series.amplitude.size(); ++i)
        csv += fmt::format(",amplitude_{0} [m],x_{0} [m],y_{0} [m]", i);
    for (std::size_t i = 0; i < series.angles.size(); ++i)
        csv += fmt::format(",angle_{} [rad]", i);
    csv += "\n";
    for (std::size_t k = 0; k < series.time.size(); ++k) {
        csv += fmt::format("{},{}", series.time[k], series.speed[k]);
        for (std::size_t i = 0; i < series.amplitude.size(); ++i)
            csv += fmt::format(",{},{},{}", series.amplitude[i][k], series.x[i][k], series.y[i][k]);
        for (const std::vector<double> &angles : series.angles)
            csv += fmt::format(",{}", angles[k]);
        csv += "\n";
    }
    return csv;
}

} // namespace whirl::report

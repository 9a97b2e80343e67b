#include "report/json_show.h"

#include "report/json_parts.h"

namespace whirl::report {

namespace {

Json pair(const std::optional<results::Interval> &interval) {
    return interval ? Json{interval->first, interval->second} : Json(nullptr);
}

Json numbers_json(const results::DimensionlessNumbers &d) {
    return {{"C", d.C},
            {"A", json_number(d.A)},
            {"A_m", d.A_m},
            {"A_m0", d.A_m0},
            {"m", d.m},
            {"z_A", d.z_A},
            {"p2", json_number(d.p2)},
            {"c_y", json_number(d.c_y)},
            {"h_x", json_number(d.h_x)},
            {"h_beta", json_number(d.h_beta)},
            {"h_y", json_number(d.h_y)},
            {"h_s", json_number(d.h_s)}};
}

} // namespace

Json balancer_json(const results::BalancerNumbers &balancer) {
    Json json{{"name", balancer.name}, {"z", balancer.z}, {"E", balancer.E}};
    json["D_c"] = balancer.D ? Json(balancer.D->real()) : Json(nullptr);
    json["D_s"] = balancer.D ? Json(balancer.D->imag()) : Json(nullptr);
    json["D_interval"] = pair(balancer.D_interval);
    json["dA"] = json_number(balancer.dA);
    json["dA_interval"] = pair(balancer.dA_interval);
    json["dA_paper"] = json_number(balancer.dA_paper);
    json["position"] = balancer.position;
    json["bare_rotor"] = {{"mass", balancer.bare.mass},
                          {"Id", balancer.bare.Id},
                          {"Ip", balancer.bare.Ip},
                          {"Ip_over_Id", balancer.bare.Ip / balancer.bare.Id},
                          {"z_GA", balancer.bare.z_GA}};
    json["dimensionless"] = numbers_json(balancer.dimensionless);
    return json;
}

Json anisotropy_json(const std::optional<results::AnisotropyChart> &chart) {
    if (!chart)
        return nullptr;
    Json unstable = Json::array();
    if (chart->unstable)
        unstable.push_back({chart->unstable->from, json_number(chart->unstable->to)});
    return {{"C", chart->C},
            {"A", chart->anisotropy},
            {"p", chart->p},
            {"h", chart->h},
            {"critical_speeds", chart->critical_speeds},
            {"unstable", unstable},
            {"permissible", chart->permissible},
            {"permissible_speed", json_number(chart->permissible_speed)}};
}

} // namespace whirl::report

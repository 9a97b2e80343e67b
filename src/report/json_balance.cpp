#include "report/json_balance.h"

#include "report/json_parts.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <utility>
#include <vector>

namespace whirl::report {

namespace {

Json bands(const std::vector<results::SpeedBand> &list) {
    Json out = Json::array();
    for (const auto &band : list)
        out.push_back({band.from, band.to});
    return out;
}

Json bands(const std::optional<std::vector<results::SpeedBand>> &list) {
    return list ? bands(*list) : Json(nullptr);
}

void add_bands(Json &json, const results::BalanceBands &of) {
    json["bands"] = bands(of.bands);
    json["band_errors"] = Json::array();
    for (const auto &[at_from, at_to] : of.errors)
        json["band_errors"].push_back({json_number(at_from), json_number(at_to)});
    json["rigid_bands"] = bands(of.rigid_bands);
    json["pinned_critical_speeds"] = of.pinned;
    json["ends"] = Json::array();
    for (const auto &end : of.ends)
        json["ends"].push_back({{"speed", end.speed},
                                {"end", end.upper ? "upper" : "lower"},
                                {"error", json_number(end.error)},
                                {"rigid", json_number(end.rigid)},
                                {"relative_difference", json_number(end.relative_difference)},
                                {"pinned", json_number(end.pinned)}});
}

Json balanced_position(const std::optional<results::BalancedPosition> &of) {
    if (!of)
        return nullptr;
    Json errors = Json::array();
    for (const auto &[at_from, at_to] : of->errors)
        errors.push_back({json_number(at_from), json_number(at_to)});
    return {{"bands", bands(of->bands)},
            {"band_errors", errors},
            {"arrangements", of->arrangements},
            {"with_every", bands(of->with_every)},
            {"with_some", bands(of->with_some)}};
}

Json joint(const results::JointBalance &of) {
    Json json = Json::object();
    add_bands(json, of.bands);
    json["rank"] = of.rank;
    json["signature"] = Json::array();
    for (const auto &point : of.signature) {
        Json real = Json::array();
        Json imag = Json::array();
        for (const auto &s : point.worst) {
            real.push_back(s.real());
            imag.push_back(s.imag());
        }
        json["signature"].push_back({{"speed", point.speed},
                                     {"eigenvalues", point.eigenvalues},
                                     {"negative", point.negative},
                                     {"relative", point.relative},
                                     {"worst_real", real},
                                     {"worst_imag", imag}});
    }
    return json;
}

Json rigid(const std::optional<results::RigidEquivalent> &of) {
    if (!of)
        return nullptr;
    return {{"mass", of->mass},
            {"center_of_mass", of->center},
            {"Id", of->diametral},
            {"Ip", of->polar},
            {"k11", of->k11},
            {"k14", of->k14},
            {"k33", of->k33},
            {"type", of->type},
            {"critical_speeds", of->critical_speeds}};
}

Json best(const results::BestPlace &place) {
    return {{"z", place.z}, {"share", place.share}, {"margin", place.margin}};
}

Json placement(const results::Placement &map) {
    return {{"z", map.z},
            {"speeds", map.speeds},
            {"criterion", map.criterion},
            {"share", map.share},
            {"best", best(map.best)},
            {"pairs",
             {{"speed", map.pair_speed},
              {"z", map.pair_z},
              {"largest_eigenvalue", map.pair_value},
              {"best", best(map.best_pair)}}}};
}

Json curves(const std::vector<results::PendulumCurve> &list) {
    Json out = Json::array();
    for (const auto &curve : list) {
        Json exact = Json::array();
        for (const auto &value : curve.exact)
            exact.push_back(json_number(value));
        out.push_back({{"arm", curve.arm},
                       {"pivot", curve.pivot},
                       {"rho", curve.rho},
                       {"H", curve.external_damping},
                       {"speed_ratio", curve.ratios},
                       {"approximate", curve.approximate},
                       {"exact", exact},
                       {"stable", curve.stable}});
    }
    return out;
}

/// The motion of least deflection at each speed fills the lists; all are in `motions`.
Json pendulum(const results::PendulumBalance &of) {
    Json efficiency{
        {"speeds", of.speeds},     {"exact", Json::array()},     {"approximate", Json::array()},
        {"stable", Json::array()}, {"planar", Json::array()},    {"phi", Json::array()},
        {"psi", Json::array()},    {"collision", Json::array()}, {"motions", Json::array()}};
    for (std::size_t k = 0; k < of.speeds.size(); ++k) {
        efficiency["approximate"].push_back(json_number(of.approximate[k]));
        efficiency["planar"].push_back(json_number(of.planar[k]));
        Json motions = Json::array();
        for (const auto &state : of.states[k])
            motions.push_back({{"ratio", state.ratio},
                               {"phi", state.phi},
                               {"psi", state.psi},
                               {"growth", state.growth},
                               {"stable", state.stable},
                               {"collision", state.collision}});
        const bool none = motions.empty();
        for (const auto &[key, from] :
             {std::pair("exact", "ratio"), std::pair("stable", "stable"), std::pair("phi", "phi"),
              std::pair("psi", "psi"), std::pair("collision", "collision")})
            efficiency[key].push_back(none ? Json(nullptr) : motions.front().at(from));
        efficiency["motions"].push_back(motions);
    }
    return {{"name", of.name},
            {"z", of.z},
            {"rho", of.rho},
            {"threshold", of.threshold},
            {"limit", of.limit},
            {"planar_equivalent",
             {{"mass", of.mass},
              {"omega_0", of.omega_0},
              {"H", of.external_damping},
              {"h", of.hinge_damping}}},
            {"efficiency", efficiency},
            {"designs", curves(of.designs)},
            {"dampings", curves(of.dampings)}};
}

} // namespace

Json balance_json(const results::BalanceResult &result) {
    Json json = Json::object();
    json["findings"] = result.findings;
    json["speeds"] = result.speeds;
    json["critical_speeds"] = result.critical_speeds;
    json["sharp"] = result.sharp;
    json["planes"] = Json::array();
    for (const auto &plane : result.planes) {
        Json entry{{"name", plane.name}, {"z", plane.z}};
        add_bands(entry, plane.bands);
        entry["criterion"] = plane.criterion;
        json["planes"].push_back(entry);
    }
    json["joint"] = joint(result.joint);
    json["rigid"] = rigid(result.rigid);
    json["simulated"] = Json::array();
    for (const auto &run : result.simulated)
        json["simulated"].push_back({{"speed", run.speed},
                                     {"outcome", run.outcome},
                                     {"residual_ratio", json_number(run.residual_ratio)},
                                     {"growth", json_number(run.growth)}});
    json["balanced_position"] = balanced_position(result.balanced_position);
    if (result.placement)
        json["placement"] = placement(*result.placement);
    json["pendulum"] = Json::array();
    for (const auto &balancer : result.pendulum)
        json["pendulum"].push_back(pendulum(balancer));
    return json;
}

} // namespace whirl::report

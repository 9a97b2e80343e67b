#include "report/json.h"

#include "report/json_parts.h"
#include "results/response.h"

namespace whirl::report {

std::string to_json(const model::Case &scene, const results::ResponseResult &result) {
    Json json = json_envelope("response", scene, result.model);
    json["speeds"] = result.speeds;
    json["nodes"] = Json::array();
    for (const auto &node : result.nodes)
        json["nodes"].push_back({{"z", node.z},
                                 {"name", node.name},
                                 {"amplitude", node.amplitude},
                                 {"phase", node.phase},
                                 {"major", node.major},
                                 {"minor", node.minor},
                                 {"x", node.x},
                                 {"x_phase", node.x_phase},
                                 {"y", node.y},
                                 {"y_phase", node.y_phase},
                                 {"inclination", node.inclination},
                                 {"error", node.error}});
    json["bearings"] = Json::array();
    for (const auto &bearing : result.bearings)
        json["bearings"].push_back({{"z", bearing.z},
                                    {"name", bearing.name},
                                    {"force", bearing.force},
                                    {"error", bearing.error}});
    json["probes"] = Json::array();
    for (const auto &probe : result.probes)
        json["probes"].push_back({{"z", probe.z},
                                  {"angle", probe.angle},
                                  {"name", probe.name},
                                  {"amplitude", probe.amplitude},
                                  {"phase", probe.phase},
                                  {"error", probe.error}});
    return json_text(json);
}

} // namespace whirl::report

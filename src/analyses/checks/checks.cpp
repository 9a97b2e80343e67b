#include "analyses/checks/checks.h"
namespace whirl::results {
std::optional<double> Check::margin() const { return std::nullopt; }
std::string judgement_name(Judgement j) { return j == Judgement::passes ? "passes" : j == Judgement::fails ? "fails" : "incomplete"; }
}
namespace whirl::analyses {
results::Assessment assess(const model::Case &scene, const Computed &computed) {
    results::Assessment a;
    a.sentence = "stub";
    if (computed.critical && computed.critical->margins)
        for (const auto &m : *computed.critical->margins) {
            results::Check c;
            c.name = "separation margin"; c.value = m.found/100; c.limit = m.required ? std::optional(*m.required/100) : std::nullopt; c.percent = true; c.at_least = true; c.pass = m.passes; c.where = results::Sentence("critical speed {}", results::as::speed(m.speed,5)); c.source = "API 617";
            a.checks.push_back(c);
        }
    return a;
}
model::Case over_operation(model::Case scene) { if (scene.operation) scene.speeds = model::SpeedRange{scene.operation->from, scene.operation->trip.value_or(scene.operation->to), 21}; return scene; }
}

#include "analyses/weights/procedure.h"

#include "analyses/critical.h"
#include "analyses/weights/model_vibration.h"
#include "model/mass.h"
#include "model/variants.h"
#include "results/critical.h"
#include "results/enum_name.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace whirl::analyses {

namespace {

using model::RotorBody;
using results::BalancingProcedure;
using results::Sentence;
namespace as = results::as;

/// Forward critical speeds, ascending: all up to a speed, rad/s, and the lowest.
/// @param lowest  so many of both whirls at least
std::vector<double> forward_speeds(model::Case scene, double up_to, int lowest) {
    scene.speeds = model::SpeedRange{0, up_to, 2};
    scene.campbell.modes = lowest;
    std::vector<double> out;
    for (const results::CriticalSpeed &critical : unjudged_critical_speeds(scene).critical_speeds)
        if (critical.whirl == results::Whirl::forward)
            out.push_back(critical.speed);
    std::ranges::sort(out);
    return out;
}

/// Which critical speeds bend the shaft rather than move it as a whole in its bearings. Compliances
/// in series add up as 1/speed^2: 1 - (speed/rigid)^2 is what the shaft has of it, with the same
/// critical speed of the rotor whose shaft does not bend; exact for one mass, and a measure for
/// others. Rotors with a rigid shaft have two at most.
std::vector<bool> bend(const std::vector<double> &flexible, const std::vector<double> &rigid) {
    constexpr double most_of_it = 0.5;
    std::vector<bool> out;
    for (std::size_t k = 0; k < flexible.size(); ++k)
        out.push_back(k >= rigid.size() || 1 - std::pow(flexible[k] / rigid[k], 2) > most_of_it);
    return out;
}

RotorBody body_of(const model::Case &scene) {
    if (scene.weights->body)
        return *scene.weights->body;
    double discs = 0;
    for (const model::Disc &disc : scene.rotor.discs)
        discs += disc.mass;
    return discs > 0 && discs >= model::mass_of_shaft_and_discs(scene.rotor) / 2
               ? RotorBody::discs
               : RotorBody::integral;
}

struct Choice {
    std::vector<std::string> procedures;
    const char *why;
};

/// The table of ISO 21940-12 of configurations and procedures, as it is commonly known: not taken
/// from its text.
Choice procedures_of(RotorBody body, int discs, bool removable) {
    switch (body) {
    case RotorBody::discs:
    case RotorBody::sections:
        if (removable)
            return discs > 1
                       ? Choice{{"C", "D", "E"},
                                "its parts come off: they are balanced one by one before they "
                                "go on the shaft, from controlled imbalances, or in stages as "
                                "they are put on, and the shaft has none of its own to speak "
                                "of"}
                       : Choice{{"C", "A", "B"},
                                "its one part comes off and is balanced by itself"};
        if (discs <= 1)
            return {{"A", "B"},
                    "its imbalance is in one part, where it is corrected: in one plane, or in two "
                    "where the part may wobble"};
        if (discs == 2)
            return {{"B", "G"},
                    "its imbalances are in two parts: two planes in them take these away at any "
                    "speed, unless the parts wobble"};
        return {{"G"},
                "its imbalances are in more parts than two, which do not come off: at low speed "
                "they cannot be told apart"};
    case RotorBody::roll:
        return {{"F", "G"},
                "its imbalance is all along a uniform body: planes in the best places may do where "
                "it runs below its second bending critical speed, else it takes several speeds"};
    case RotorBody::integral:
        break;
    }
    return {{"G"},
            "its imbalance may be anywhere along it: it shows only near its bending critical "
            "speeds"};
}

/// How many planes, and whether there are as many.
Sentence planes_sentence(const BalancingProcedure &procedure, std::size_t planes) {
    if (!procedure.flexible)
        return Sentence("two planes are needed, one where a couple does not matter; the case has "
                        "{}",
                        planes);
    if (procedure.bending == 0)
        return Sentence("two planes are needed, as of a rigid rotor: its first bending critical "
                        "speed is above {}, though not far; the case has {}",
                        as::speed(procedure.service_speed), planes);
    const int all = procedure.bending + 2;
    const auto count = static_cast<int>(planes);
    const std::string &first = procedure.procedures.front();
    const bool in_parts = first == "A" || first == "B";
    Sentence out(
        "{}{} planes are needed, two more than {}, to leave the bearings free at low speed "
        "too; {} where low-speed balancing did that and the weights must not undo it; the "
        "case has {}",
        !in_parts              ? Sentence()
        : procedure.discs == 2 ? Sentence("one in each of the two parts will do as long "
                                          "as the imbalance is there; where it may be "
                                          "elsewhere too, ")
                               : Sentence("one in the part, or two where it may wobble, "
                                          "will do as long as the imbalance is there; "
                                          "where it may be elsewhere too, "),
        all,
        procedure.bending == 1
            ? Sentence("the one bending motion whose critical speed is below {}",
                       as::speed(procedure.service_speed))
            : Sentence("the {} bending motions whose critical speeds are below {}",
                       procedure.bending, as::speed(procedure.service_speed)),
        std::max(1, procedure.bending), planes);
    out +=
        count >= all ? Sentence(": enough") : Sentence(": {} too few for the first", all - count);
    return out;
}

} // namespace

std::optional<double> service_speed(const model::Case &scene) {
    if (scene.operation)
        return scene.operation->to;
    double speed = 0;
    for (const model::ReadingPlace &place : scene.weights->places)
        speed = std::max(speed, place.speed.value_or(0));
    for (const double own : scene.weights->speeds)
        speed = std::max(speed, own);
    return speed > 0 ? std::optional(speed) : std::nullopt;
}

results::BalancingProcedure balancing_procedure(const model::Case &scene, double service_speed,
                                                int order) {
    model::Case bare = without_balancers(scene);
    bare.rotor = model::isotropic_without_damping(std::move(bare.rotor));
    bare.rotor.shaft.order = order;
    bare.rotor.shaft.order_auto = false;
    BalancingProcedure out;
    const RotorBody body = body_of(scene);
    out.body = results::enum_name(body, {"discs", "sections", "roll", "integral"});
    out.body_given = scene.weights->body.has_value();
    out.removable = scene.weights->removable;
    out.discs = static_cast<int>(scene.rotor.discs.size());
    out.service_speed = service_speed;
    constexpr double rigid_up_to = 0.7; // of the first bending critical speed, by common rule
    // Times the service speed: where the next bending critical speed mostly is, and how far the
    // first one matters.
    constexpr double near = 2;
    constexpr double reach = 4 / rigid_up_to;
    const int lowest = scene.campbell.modes;
    std::vector<double> speeds;
    std::vector<bool> bending;
    if (bare.rotor.shaft.rigid) {
        speeds = forward_speeds(bare, reach * service_speed, lowest);
        bending.assign(speeds.size(), false);
    } else {
        model::Case stiff = bare;
        stiff.rotor.shaft.rigid = true;
        const std::vector<double> of_stiff = forward_speeds(stiff, reach * service_speed, lowest);
        speeds = forward_speeds(bare, near * service_speed, 1);
        bending = bend(speeds, of_stiff);
        if (bending.empty() || !bending.back() || speeds.back() <= service_speed) {
            speeds = forward_speeds(bare, reach * service_speed, lowest);
            bending = bend(speeds, of_stiff);
        }
    }
    std::optional<double> first;
    for (std::size_t k = 0; k < speeds.size(); ++k) {
        const bool below = speeds[k] <= service_speed;
        out.criticals += below ? 1 : 0;
        if (!bending[k])
            continue;
        out.bending += below ? 1 : 0;
        first = first.value_or(speeds[k]);
        if (!below && !out.next_bending)
            out.next_bending = speeds[k];
    }
    out.flexible = first && service_speed > rigid_up_to * *first;
    if (!out.flexible) {
        out.why =
            first ? Sentence("it behaves as a rigid rotor (ISO 21940-11): its highest "
                             "service speed {} is below {} % of its first bending critical "
                             "speed {}",
                             as::speed(service_speed), as::number(100 * rigid_up_to),
                             as::speed(*first))
                  : Sentence(
                        "it behaves as a rigid rotor (ISO 21940-11): no bending "
                        "critical speed was found up to several times its highest service speed {}",
                        as::speed(service_speed));
    } else {
        const Choice choice = procedures_of(body, out.discs, out.removable);
        out.procedures = choice.procedures;
        out.why = Sentence(
            "it has flexible behaviour, {} bending critical {} below its highest "
            "service speed {}{}, and is taken as {}{}: {}",
            out.bending, out.bending == 1 ? "speed" : "speeds", as::speed(service_speed),
            out.next_bending ? Sentence(", the next at {}", as::speed(*out.next_bending))
                             : Sentence(),
            out.body, out.body_given ? "" : " by the masses of discs and shaft (weights.body)",
            choice.why);
    }
    out.planes = planes_sentence(out, scene.rotor.planes.size());
    return out;
}

} // namespace whirl::analyses

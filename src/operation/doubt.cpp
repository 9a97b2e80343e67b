#include "operation/doubt.h"

#include "operation/limits.h"

namespace whirl::operation {

Doubt doubt_of_rotor(const model::Case &scene, double from, double to) {
    if (!scene.rotor.balancers.empty())
        return {{"it is that of the machine without the balancers' own parts"}, true};
    for (const model::Bearing &bearing : scene.rotor.bearings)
        if (bearing.depends_on_speed() &&
            (bearing.speeds.front() > from || bearing.speeds.back() < to))
            return {{"the table of the {} has no rows beyond {}, and speeds {} count",
                     results::place_in_words(bearing.seal ? "seal" : "bearing", bearing.name,
                                             bearing.z),
                     results::as::speed.range(bearing.speeds.front(), bearing.speeds.back()),
                     results::as::speed.range(from, to)}};
    return {};
}

Doubt doubt_of_rotor(const model::Case &scene) {
    return doubt_of_rotor(scene, scene.operation->from, operation::top_speed(*scene.operation));
}

} // namespace whirl::operation

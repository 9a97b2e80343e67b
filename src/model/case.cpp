#include "model/case.h"

#include "model/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::model {

const SpeedRange &required_speeds(const Case &scene) {
    if (!scene.speeds)
        throw BadInput(fmt::format("{}: speeds: missing, expected a section [speeds], as from = 0, "
                                   "to = \"12000 rpm\", count = 101",
                                   scene.file.string()));
    return *scene.speeds;
}

std::pair<double, double> range_of_moduli(double from, double to) {
    const double a = std::abs(from);
    const double b = std::abs(to);
    const bool through_rest = (from < 0) != (to < 0);
    return {through_rest ? 0 : std::min(a, b), std::max(a, b)};
}

} // namespace whirl::model

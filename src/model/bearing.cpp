#include "model/bearing.h"

#include <algorithm>
#include <iterator>

namespace whirl::model {

BearingCoefficients Bearing::at(double speed) const {
    if (!depends_on_speed() || speed <= speeds.front())
        return rows.front();
    if (speed >= speeds.back())
        return rows.back();
    const auto above = std::upper_bound(speeds.begin(), speeds.end(), speed);
    const auto i = static_cast<std::size_t>(std::distance(speeds.begin(), above));
    const double t = (speed - speeds[i - 1]) / (speeds[i] - speeds[i - 1]);
    const BearingCoefficients &a = rows[i - 1];
    const BearingCoefficients &b = rows[i];
    return {(1 - t) * a.k + t * b.k, (1 - t) * a.c + t * b.c, (1 - t) * a.kt + t * b.kt,
            (1 - t) * a.ct + t * b.ct};
}

} // namespace whirl::model

#include "report/pictures/shaft_outline.h"

#include <algorithm>

namespace whirl::report {

double shaft_radius(const model::Shaft &shaft, double z) {
    double start = 0;
    double radius = 0;
    for (const auto &segment : shaft.segments) {
        const double share = segment.length > 0 ? (z - start) / segment.length : 0;
        if (share >= -1e-9 && share <= 1 + 1e-9)
            radius = std::max(
                radius,
                (segment.outer_start + share * (segment.outer_end - segment.outer_start)) / 2);
        start += segment.length;
    }
    return radius;
}

} // namespace whirl::report

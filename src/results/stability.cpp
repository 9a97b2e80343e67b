#include "results/stability.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace whirl::results {

double largest_growth(const StabilityResult &result) {
    double largest = std::nan("");
    for (const double rate :
         result.resolved_growth.empty() ? result.growth : result.resolved_growth)
        largest = std::fmax(largest, rate);
    return largest;
}

const std::vector<Interval> &unstable_speeds(const StabilityResult &result) {
    return result.resolved_up_to ? result.resolved_unstable : result.unstable;
}

const StabilityResult &least_stable(const StabilityResult &result) {
    const auto order = [](const StabilityResult &one) {
        const double none = std::numeric_limits<double>::infinity();
        const double growth = largest_growth(one);
        return std::tuple(unstable_speeds(one).empty(),
                          one.level1 ? one.level1->critical_cross_coupling.value_or(none) : none,
                          std::isnan(growth) ? -none : -growth); // not known: it may be any
    };
    const StabilityResult *worst = &result;
    for (const StabilityResult &one : result.clearances)
        if (order(one) < order(*worst))
            worst = &one;
    return *worst;
}

} // namespace whirl::results

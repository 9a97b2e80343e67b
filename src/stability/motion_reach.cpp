#include "stability/motion_reach.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace whirl::stability {

double motion_reach(std::vector<std::vector<double>> sizes, double least) {
    constexpr std::size_t fewest = 8; // slowest motions at a speed, which always count
    std::vector<double> all;
    for (std::vector<double> &here : sizes) {
        std::ranges::sort(here);
        if (!here.empty())
            least = std::max(least, here[std::min(here.size(), fewest) - 1]);
        all.insert(all.end(), here.begin(), here.end());
    }
    std::ranges::sort(all);
    double below = least;
    double widest = 1;
    double reach = 2 * least;
    for (const double size : all) {
        if (size <= least)
            continue;
        const double above = std::min(size, 2 * least);
        if (above / below > widest) {
            widest = above / below;
            reach = std::sqrt(above * below);
        }
        if (size >= 2 * least)
            break;
        below = size;
    }
    return reach;
}

} // namespace whirl::stability

#include "ends/speed_families.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace whirl::ends {

namespace {

/// For each entry of a list the place of its counterpart in a list at least as long: ascending
/// places, least sum of differences.
std::vector<std::size_t> counterparts(const std::vector<double> &list,
                                      const std::vector<double> &longest) {
    const std::size_t m = list.size();
    const std::size_t n = longest.size();
    constexpr double none = std::numeric_limits<double>::infinity();
    // least[i][j]: the first i entries among the first j of the longest.
    std::vector<std::vector<double>> least(m + 1, std::vector<double>(n + 1, none));
    std::ranges::fill(least[0], 0.0);
    for (std::size_t i = 1; i <= m; ++i)
        for (std::size_t j = i; j <= n; ++j)
            least[i][j] = std::min(least[i][j - 1],
                                   least[i - 1][j - 1] + std::abs(list[i - 1] - longest[j - 1]));
    std::vector<std::size_t> out(m);
    for (std::size_t i = m, j = n; i > 0; --j)
        if (j == i || least[i][j] < least[i][j - 1])
            out[--i] = j - 1;
    return out;
}

} // namespace

std::vector<results::Interval> intervals_of(const std::vector<std::vector<double>> &lists) {
    std::vector<results::Interval> out;
    const auto longest =
        std::ranges::max_element(lists, {}, [](const auto &a) { return a.size(); });
    if (longest == lists.end())
        return out;
    for (const double speed : *longest)
        out.push_back({speed, speed});
    for (const std::vector<double> &list : lists) {
        const std::vector<std::size_t> places = counterparts(list, *longest);
        for (std::size_t i = 0; i < list.size(); ++i) {
            auto &[from, to] = out[places[i]];
            from = std::min(from, list[i]);
            to = std::max(to, list[i]);
        }
    }
    return out;
}

} // namespace whirl::ends

#include "report/pictures/labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace whirl::report {

std::vector<double> spread(const std::vector<double> &wanted, double gap, Range range) {
    std::vector<std::size_t> order(wanted.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return wanted[a] < wanted[b]; });
    std::vector<double> places = wanted;
    for (int sweep = 0; sweep < 200; ++sweep)
        for (std::size_t i = 1; i < order.size(); ++i) {
            const double missing = gap - (places[order[i]] - places[order[i - 1]]);
            if (missing <= 0)
                continue;
            places[order[i - 1]] -= missing / 2;
            places[order[i]] += missing / 2;
        }
    // Bounds that are themselves a gap apart keep the gaps.
    const double count = static_cast<double>(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const double rank = static_cast<double>(i);
        double &place = places[order[i]];
        place = std::min(std::max(place, range.low + rank * gap),
                         range.high - (count - 1 - rank) * gap);
    }
    return places;
}

namespace {

double overlap(const LabelPlacer::Box &a, const LabelPlacer::Box &b) {
    const double width = std::min(a.x + a.width, b.x + b.width) - std::max(a.x, b.x);
    const double height = std::min(a.y + a.height, b.y + b.height) - std::max(a.y, b.y);
    return width > 0 && height > 0 ? width * height : 0;
}

} // namespace

bool LabelPlacer::free(const Box &box) const {
    return box.x >= 0 && box.x + box.width <= 1 && box.y >= 0 && box.y + box.height <= 1 &&
           std::ranges::none_of(_labels, [&](const Box &other) { return overlap(box, other) > 0; });
}

bool LabelPlacer::take(const Box &box) {
    const bool taken = free(box);
    if (taken)
        _labels.push_back(box);
    return taken;
}

std::optional<LabelPlacer::Box> LabelPlacer::place(double x, double y, double width,
                                                   double height) {
    const double off = 0.45 * height;
    // The label's nearest edge or corner sits `reach` away from the point.
    const auto start = [](double direction, double size) {
        return direction > 0.1 ? 0 : direction < -0.1 ? -size : -size / 2;
    };
    std::optional<Box> best;
    double least = HUGE_VAL;
    for (int ring = 0; ring < 4; ++ring)
        for (int side = 0; side < 8; ++side) {
            const double reach = off + ring * 0.9 * height;
            const double angle = -pi / 4 + side * pi / 4;
            const double c = std::cos(angle);
            const double s = std::sin(angle);
            const Box box{x + reach * 0.6 * c + start(c, width), y + reach * s + start(s, height),
                          width, height};
            if (!free(box))
                continue;
            double cost = 1e-6 * (ring * 8 + side);
            for (const Box &other : _boxes)
                cost += overlap(box, other) / (width * height);
            if (cost < least) {
                least = cost;
                best = box;
            }
        }
    if (best)
        _labels.push_back(*best);
    return best;
}

std::string left_out(int count, const std::string &mark, const std::string &at) {
    return count == 0 ? ""
                      : fmt::format("set label '{} more {}{}: see the table' at graph {} left font "
                                    "',10' textcolor '#555555'\n",
                                    count, mark, count == 1 ? "" : "s", at);
}

} // namespace whirl::report

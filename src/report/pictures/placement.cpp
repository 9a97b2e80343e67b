#include "report/pictures/figures.h"

#include "report/pictures/operation.h"
#include "report/pictures/shaft_outline.h"
#include "report/pictures/style.h"
#include "results/balance.h"

#include <fmt/format.h>

#include <cmath>

namespace whirl::report {

namespace {

using Values = std::vector<std::vector<double>>; // [y][x]

/// Green below zero (balances), orange above; readable without colour by the black line at zero.
std::vector<ChartCurve> criterion_map(const std::vector<double> &x, const std::vector<double> &y,
                                      const Values &values) {
    std::vector<ChartCurve> curves = chart_map(x, y, values,
                                               {{-0.6, {"balances, below −0.6", "#00543C"}},
                                                {-0.2, {"balances, −0.6 to −0.2", "#4DB08C"}},
                                                {0, {"balances, −0.2 to 0", "#CFEADF"}},
                                                {0.2, {"does not, 0 to 0.2", "#FADDC8"}},
                                                {0.6, {"does not, 0.2 to 0.6", "#EE9A5C"}},
                                                {HUGE_VAL, {"does not, above 0.6", "#A34400"}}});
    ChartCurve zero{"limit", {}, {"", "#000000"}, 1.6};
    struct Corner {
        std::size_t i, j;
    };
    const auto cross = [&](const std::vector<Corner> &triangle) {
        std::vector<PlotPoint> ends;
        for (std::size_t k = 0; k < triangle.size(); ++k) {
            const auto &[i, j] = triangle[k];
            const auto &[m, n] = triangle[(k + 1) % triangle.size()];
            const double from = values[j][i];
            const double to = values[n][m];
            const double part = from / (from - to);
            if ((from < 0) != (to < 0) && std::isfinite(part))
                ends.push_back({std::lerp(x[i], x[m], part), std::lerp(y[j], y[n], part)});
        }
        if (ends.size() == 2)
            add_piece(zero.points, ends[0], ends[1]);
    };
    for (std::size_t j = 0; j + 1 < y.size(); ++j)
        for (std::size_t i = 0; i + 1 < x.size(); ++i) {
            cross({{i, j}, {i + 1, j}, {i, j + 1}});
            cross({{i + 1, j + 1}, {i + 1, j}, {i, j + 1}});
        }
    if (!zero.points.empty())
        curves.push_back(zero);
    return curves;
}

std::string best_place_text(const Units &units, const results::BestPlace &place) {
    std::string text;
    for (const double z : place.z)
        text += (text.empty() ? "z = " : " and ") + drawn_number(units(Quantity::length, z), 4);
    return text + " " + units.name(Quantity::length) +
           (place.share > 0 ? fmt::format(": {:.0f} % of the speeds", 100 * place.share)
                            : ", the least bad");
}

} // namespace

Chart placement_chart(const model::Case &scene, const results::Placement &map, const Units &units) {
    const ChartAxis z = along_shaft(units, scene.rotor);
    ChartPanel one{330, z, along_speeds(units, map.speeds)};
    one.title = "one plane; best (broken line) " + best_place_text(units, map.best);
    std::vector<double> speeds = scaled(map.speeds, units.factor(Quantity::speed));
    Values criterion = map.criterion;
    if (speeds.size() == 1) { // alone it has no area
        speeds = {*one.y.low, *one.y.high};
        criterion.push_back(criterion.front());
    }
    one.curves = criterion_map(scaled(map.z, units.factor(Quantity::length)), speeds, criterion);
    add_operation(scene, units, {"ends of operating speeds", "#FFC83D", "(9,5)"}, one);
    one.y.spin_speed = false; // behind the map they would show at its sides alone
    for (const double best : scaled(map.best.z, units.factor(Quantity::length))) {
        one.curves.push_back(upright_line(one, best, {"", "#FFFFFF"}, 4));
        one.curves.push_back(upright_line(one, best, {"best place", "#5B2A86", "(8,4)"}, 2));
    }
    ChartPanel rotor{90, z, {.low = -1.3, .high = 1.1}, rotor_outline(units, scene.rotor, 1)};
    rotor.y.names = {{0, ""}};
    const std::vector<double> places = scaled(map.pair_z, units.factor(Quantity::length));
    Values pairs = map.pair_value;
    for (std::size_t i = 0; i < pairs.size(); ++i)
        pairs[i][i] = NAN; // both planes are one: zero but for rounding
    ChartPanel two{560, z, z, criterion_map(places, places, pairs)};
    two.square = true;
    two.x.title = units.label("z of one plane", Quantity::length);
    two.y.title = units.label("z of the other plane", Quantity::length);
    two.title =
        fmt::format("two planes at {}; {} {}", drawn_value(units, Quantity::speed, map.pair_speed),
                    map.best_pair.share > 0 ? "cross: best two over all speeds,"
                                            : "no two balance at any of the speeds; cross:",
                    best_place_text(units, map.best_pair));
    if (map.best_pair.z.size() == 2) {
        const PlotPoint best{units(Quantity::length, map.best_pair.z[0]),
                             units(Quantity::length, map.best_pair.z[1])};
        two.curves.push_back({"", {best}, {"", "#FFFFFF", "1", 7}, 0, 2.6});
        two.curves.push_back({"best two", {best}, {"", "#5B2A86", "1", 2}, 0, 2});
    }
    return {"Where along the shaft auto-balancers work: " + title_of(scene),
            "the criterion times the mass of the rotor: −1 is a free rigid body",
            {one, rotor, two}};
}

} // namespace whirl::report

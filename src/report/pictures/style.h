#pragma once

#include "report/common/units.h"
#include "report/common/words.h"
#include "results/whirl.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::report {

/// Colour, dash and marker of a sense of whirl. The colours are of Okabe and Ito's set, which
/// colour-blind readers tell apart; dash and marker carry the same information without colour.
struct LineStyle {
    std::string name;       ///< for legends
    std::string colour{};   ///< #rrggbb
    std::string dash = "1"; ///< gnuplot's dash type
    int point = 7;          ///< gnuplot's point type
};

/// Of critical speeds that are damped so heavily that they count as none (AF < 2.5).
inline constexpr const char *heavy_colour = "#A0A0A0";

[[nodiscard]] LineStyle whirl_style(results::Whirl whirl);
/// The index-th of a row of styles that differ in colour, dash and marker.
[[nodiscard]] LineStyle series_style(std::size_t index);

/// A number in a text of a picture, its power of ten as it is written by hand: "2·10⁷".
[[nodiscard]] std::string drawn_number(double value, int digits = 5);
/// The same of a number in SI, with its unit: "2·10⁷ N/m".
[[nodiscard]] std::string drawn_value(const Units &units, Quantity quantity, double si,
                                      int digits = 5);
/// Of an angle in rad: "45°".
[[nodiscard]] std::string degrees_text(double angle);
/// A speed beside a mark, in rpm or whatever it is read in: "17", "3.77", "12346", "1.614·10⁸".
[[nodiscard]] std::string drawn_speed(const Units &units, double speed);
/// A place of the rotor in a legend: "race, z = 0.5 m".
[[nodiscard]] std::string place_text(const Units &units, const std::string &name, double z);

/// One point of a polyline; a gap where y is missing.
struct PlotPoint {
    double x = 0;
    std::optional<double> y;
};
/// For the scripts of pages: [x, y].
template <class Json> void to_json(Json &json, const PlotPoint &point) {
    json = Json::array({point.x, point.y});
}
/// Named data block of gnuplot.
[[nodiscard]] std::string data_block(const std::string &name, const std::vector<PlotPoint> &line);

/// One value over another, each times a factor, as far as both lists go.
[[nodiscard]] std::vector<PlotPoint> points_over(const std::vector<double> &x, double x_factor,
                                                 const std::vector<double> &y, double y_factor);
/// Each times a factor.
[[nodiscard]] std::vector<double> scaled(std::vector<double> values, double factor);
/// Angles in degrees within (-180, 180], cut where they jump from one end to the other, and where
/// there is none.
[[nodiscard]] std::vector<PlotPoint> angles_over(const std::vector<double> &x, double x_factor,
                                                 const std::vector<double> &angles);

/// A circle about the origin.
[[nodiscard]] std::vector<PlotPoint> circle_points(double radius);

constexpr double picture_font = 14; ///< of gnuplot (common/gnuplot.cpp), pixels

struct Range {
    double low = 0;
    double high = 1;
};
/// Smallest and largest of the values, widened where they are equal but for rounding.
[[nodiscard]] Range range_of(const std::vector<double> &values);

} // namespace whirl::report

#pragma once

#include "report/pictures/style.h"
#include "results/campbell.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace whirl::report {

/// An entry that the list may not have.
template <class T>
std::optional<T> entry(const std::vector<std::optional<T>> &list, std::size_t i) {
    return i < list.size() ? list[i] : std::nullopt;
}

/// "1F"; with the direction in which the mode moves as a line at the last speed: "1M, vertical".
[[nodiscard]] std::string end_name(const Units &units, const results::CampbellMode &mode);

/// What a panel shows over the spin speed, and where.
struct Panel {
    const Units &units;
    bool damping = false;
    Range x{};                  ///< speeds, in their unit
    Range y{};                  ///< frequencies in theirs, or logarithmic decrements
    double bottom = 0, top = 1; ///< fractions of the figure
    double pixels_wide = 1, pixels_high = 1;

    [[nodiscard]] std::optional<double> value(const results::CampbellMode &mode,
                                              std::size_t i) const;
    [[nodiscard]] double speed(double si) const { return units(Quantity::speed, si); }
    [[nodiscard]] double frequency(double si) const { return units(Quantity::frequency, si); }
    [[nodiscard]] double across(double speed_value) const {
        return (speed_value - x.low) / (x.high - x.low);
    }
    [[nodiscard]] double up(double value) const { return (value - y.low) / (y.high - y.low); }
};

/// Of each mode the steps between neighbouring speeds that are no line of a motion: its frequency
/// springs by far more than before and after. Of an anisotropic rotor a motion has two frequencies,
/// whirl and twice the spin speed less whirl, of which the larger share is drawn; and between the
/// given speeds two motions may have exchanged their places.
[[nodiscard]] std::vector<std::vector<bool>> sprung_steps(const results::CampbellResult &result);

/// Polylines of the stretches between neighbouring speeds that belong to a class.
[[nodiscard]] std::vector<std::vector<PlotPoint>>
stretches(const Panel &panel, const results::CampbellResult &result,
          const std::function<bool(const results::CampbellMode &, std::size_t)> &belongs);

/// Polylines of the other frequencies of motions that have two, in the fixed frame.
[[nodiscard]] std::vector<std::vector<PlotPoint>>
other_frequencies(const Panel &panel, const results::CampbellResult &result);

/// Sparse markers, staggered from mode to mode; a lone point always gets one.
[[nodiscard]] std::vector<PlotPoint>
markers(const Panel &panel, const results::CampbellResult &result, results::Whirl sense);

} // namespace whirl::report

#pragma once

#include <span>
#include <vector>

namespace whirl::simulation {

/// How the size of a motion changes towards the end: lines fitted to the logarithm of the largest
/// sizes in equal windows (so that a beat, which is shorter than the windows, does not count), over
/// the whole time looked at and over its last half.
struct Trend {
    double end_rate = 0; ///< of growth over the last half, 1/s
    /// Both rates are beyond three of their standard errors, the change is beyond a tenth, and it
    /// goes on: the rate at the end is at least half of that over the whole.
    bool growing = false;
    bool decaying = false;
    /// The size changed by more than a tenth over the last half, beyond three standard errors,
    /// whether or not it goes on.
    bool changing = false;
};

/// @param time    of the samples, s, ascending
/// @param size    at each, >= 0
/// @param from    only samples from this time on are looked at
/// @param noise   sizes below this are none
[[nodiscard]] Trend trend_of(const std::vector<double> &time, const std::vector<double> &size,
                             double from, double noise);

/// How far values swing to and fro while they may move on as well: greatest less least about the
/// straight line from the first to the last of them. (Of a motion that only bends it is small.)
[[nodiscard]] double swing_about_line(std::span<const double> values);
/// Greatest less least, less what they have moved on from the first to the last. (Of a motion
/// that only moves on it is 0, and what swings within it shows as it slows down.)
[[nodiscard]] double swing_back(std::span<const double> values);

/// One of these around each sample: of those in a window of `width` s that begins at it (the last
/// samples take the last whole window).
[[nodiscard]] std::vector<double> swings_of(const std::vector<double> &time,
                                            const std::vector<double> &values, double width,
                                            double (*swing)(std::span<const double>));

/// Largest of these lists at each of `size` times; 0 where all are shorter.
[[nodiscard]] std::vector<double> largest_of(const std::vector<std::vector<double>> &lists,
                                             std::size_t size);

} // namespace whirl::simulation

#include "analyses/motion_trend.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::analyses {

namespace {

constexpr int windows = 12;
constexpr double change_that_counts = 0.1; ///< of log(size): what the eye sees in a picture
constexpr double standard_errors = 3;
constexpr double goes_on = 0.5; ///< of the rate over the whole that is left at its end

/// Largest size in each of the windows of [from, last time].
std::vector<double> largest_in_windows(const std::vector<double> &time,
                                       const std::vector<double> &size, double from) {
    std::vector<double> largest(windows, 0.0);
    const double width = (time.back() - from) / windows;
    for (std::size_t i = 0; i < time.size(); ++i) {
        if (time[i] < from)
            continue;
        const auto window = static_cast<std::size_t>(
            std::clamp(static_cast<int>((time[i] - from) / width), 0, windows - 1));
        largest[window] = std::max(largest[window], size[i]);
    }
    return largest;
}

struct Line {
    double slope = 0;
    double error = 0; ///< standard error of the slope
};

/// Line through equally spaced values; the slope per space.
Line line_through(const double *values, int count) {
    double mean = 0;
    for (int i = 0; i < count; ++i)
        mean += values[i] / count;
    double moment = 0;
    double spread = 0;
    for (int i = 0; i < count; ++i) {
        const double x = i - (count - 1) / 2.0;
        moment += x * (values[i] - mean);
        spread += x * x;
    }
    const double slope = moment / spread;
    double residue = 0;
    for (int i = 0; i < count; ++i)
        residue += std::pow(values[i] - mean - slope * (i - (count - 1) / 2.0), 2);
    return {slope, std::sqrt(residue / (count - 2) / spread)};
}

bool significant(const Line &line, double spaces) {
    return std::abs(line.slope) > standard_errors * line.error &&
           std::abs(line.slope * spaces) > change_that_counts;
}

} // namespace

Trend trend_of(const std::vector<double> &time, const std::vector<double> &size, double from,
               double noise) {
    Trend trend;
    if (time.size() != size.size() || time.empty() || time.back() <= from)
        return trend;
    std::vector<double> logarithm = largest_in_windows(time, size, from);
    if (*std::max_element(logarithm.begin(), logarithm.end()) <= noise)
        return trend;
    const double least = std::max(noise, std::numeric_limits<double>::min());
    for (double &value : logarithm)
        value = std::log(std::max(value, least));
    const double width = (time.back() - from) / windows;
    const Line whole = line_through(logarithm.data(), windows);
    const Line end = line_through(logarithm.data() + windows / 2, windows / 2);
    trend.rate = whole.slope / width;
    trend.end_rate = end.slope / width;
    trend.changing = significant(end, windows / 2.0);
    const bool lasting =
        significant(whole, windows) && std::abs(end.slope) > standard_errors * end.error &&
        end.slope * whole.slope > 0 && std::abs(end.slope) >= goes_on * std::abs(whole.slope);
    trend.growing = lasting && end.slope > 0;
    trend.decaying = lasting && end.slope < 0;
    return trend;
}

std::vector<double> swings_of(const std::vector<double> &time, const std::vector<double> &values,
                              double width) {
    std::vector<double> swings(values.size(), 0.0);
    for (std::size_t i = 0; i < values.size(); ++i) {
        double low = values[i];
        double high = values[i];
        std::size_t j = i;
        for (; j < values.size() && time[j] <= time[i] + width; ++j) {
            low = std::min(low, values[j]);
            high = std::max(high, values[j]);
        }
        if (j == values.size() && i > 0 && time.back() < time[i] + width)
            swings[i] = std::max(high - low, swings[i - 1]); // no whole window is left
        else
            swings[i] = high - low;
    }
    return swings;
}

} // namespace whirl::analyses

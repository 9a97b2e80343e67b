#include "simulation/trend.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace whirl::simulation {

namespace {

constexpr int windows = 12; ///< enough maxima for a straight line and its standard error
constexpr double change_that_counts = 0.1; ///< of log(size): what the eye sees in a picture
constexpr double standard_errors = 3;      ///< 99.7 % of normal scatter
constexpr double goes_on = 0.5;            ///< of the rate over the whole that is left at its end

/// The largest size within each window of time, and when it was.
struct Peaks {
    Eigen::ArrayXd times; ///< s
    Eigen::ArrayXd sizes;
};

/// Of the windows of [from, last time]; sizes below `least` count as that.
Peaks peaks_in_windows(const std::vector<double> &time, const std::vector<double> &size,
                       double from, double least) {
    const double width = (time.back() - from) / windows;
    Peaks peaks;
    peaks.times = from + (Eigen::ArrayXd::LinSpaced(windows, 0, windows - 1) + 0.5) * width;
    Eigen::ArrayXd largest = Eigen::ArrayXd::Zero(windows);
    for (std::size_t i = 0; i < time.size(); ++i) {
        if (time[i] < from)
            continue;
        const int window = std::clamp(static_cast<int>((time[i] - from) / width), 0, windows - 1);
        if (size[i] <= largest(window))
            continue;
        largest(window) = size[i];
        peaks.times(window) = time[i];
    }
    peaks.sizes = largest.max(least);
    return peaks;
}

struct Line {
    double slope = 0; ///< 1/s
    double error = 0; ///< standard error of the slope
};

/// Through the logarithms of the last so many peaks.
Line line_through(const Peaks &peaks, int last) {
    const Eigen::ArrayXd times = peaks.times.tail(last) - peaks.times.tail(last).mean();
    const Eigen::ArrayXd logarithms = peaks.sizes.tail(last).log();
    const Eigen::ArrayXd sizes = logarithms - logarithms.mean();
    const double spread = times.square().sum();
    const double slope = (times * sizes).sum() / spread;
    const double residue = (sizes - slope * times).square().sum();
    return {slope, std::sqrt(residue / (last - 2) / spread)};
}

bool significant(const Line &line, double duration) {
    return std::abs(line.slope) > standard_errors * line.error &&
           std::abs(line.slope * duration) > change_that_counts;
}

} // namespace

Trend trend_of(const std::vector<double> &time, const std::vector<double> &size, double from,
               double noise) {
    Trend trend;
    if (time.size() != size.size() || time.empty() || time.back() <= from)
        return trend;
    const double least = std::max(noise, std::numeric_limits<double>::min());
    const Peaks peaks = peaks_in_windows(time, size, from, least);
    if (peaks.sizes.maxCoeff() <= least) // nothing
        return trend;
    const Line whole = line_through(peaks, windows);
    const Line end = line_through(peaks, windows / 2);
    const double duration = time.back() - from;
    trend.end_rate = end.slope;
    trend.changing = significant(end, duration / 2);
    const bool lasting =
        significant(whole, duration) && std::abs(end.slope) > standard_errors * end.error &&
        end.slope * whole.slope > 0 && std::abs(end.slope) >= goes_on * std::abs(whole.slope);
    trend.growing = lasting && end.slope > 0;
    trend.decaying = lasting && end.slope < 0;
    return trend;
}

double swing_about_line(std::span<const double> values) {
    if (values.size() < 3)
        return 0;
    const double step = (values.back() - values.front()) / static_cast<double>(values.size() - 1);
    double low = 0;
    double high = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double about = values[i] - values.front() - static_cast<double>(i) * step;
        low = std::min(low, about);
        high = std::max(high, about);
    }
    return high - low;
}

double swing_back(std::span<const double> values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return *high - *low - std::abs(values.back() - values.front());
}

std::vector<double> swings_of(const std::vector<double> &time, const std::vector<double> &values,
                              double width, double (*swing)(std::span<const double>)) {
    std::vector<double> swings(values.size(), 0.0);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto here = static_cast<std::ptrdiff_t>(i);
        const auto until =
            std::upper_bound(time.begin() + here, time.end(), time[i] + width) - time.begin();
        swings[i] = swing({values.begin() + here, values.begin() + until});
        if (i > 0 && time.back() < time[i] + width) // no whole window is left
            swings[i] = std::max(swings[i], swings[i - 1]);
    }
    return swings;
}

std::vector<double> largest_of(const std::vector<std::vector<double>> &lists, std::size_t size) {
    std::vector<double> largest(size, 0.0);
    for (const std::vector<double> &list : lists)
        for (std::size_t i = 0; i < std::min(size, list.size()); ++i)
            largest[i] = std::max(largest[i], list[i]);
    return largest;
}

} // namespace whirl::simulation

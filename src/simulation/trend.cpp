#include "simulation/trend.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace whirl::simulation {

namespace {

constexpr int windows = 12;
constexpr double change_that_counts = 0.1; ///< of log(size): what the eye sees in a picture
constexpr double standard_errors = 3;
constexpr double goes_on = 0.5; ///< of the rate over the whole that is left at its end

/// The largest size within a window of time and when it was.
struct Peak {
    double time = 0; ///< s
    double logarithm = 0;
};

/// Of each of the windows of [from, last time]; sizes below `least` count as that.
std::vector<Peak> peaks_in_windows(const std::vector<double> &time, const std::vector<double> &size,
                                   double from, double least) {
    const double width = (time.back() - from) / windows;
    std::vector<Peak> peaks;
    std::vector<double> largest(windows, 0.0);
    for (int i = 0; i < windows; ++i)
        peaks.push_back({from + (i + 0.5) * width, 0});
    for (std::size_t i = 0; i < time.size(); ++i) {
        if (time[i] < from)
            continue;
        const auto window = static_cast<std::size_t>(
            std::clamp(static_cast<int>((time[i] - from) / width), 0, windows - 1));
        if (size[i] <= largest[window])
            continue;
        largest[window] = size[i];
        peaks[window].time = time[i];
    }
    for (std::size_t i = 0; i < largest.size(); ++i)
        peaks[i].logarithm = std::log(std::max(largest[i], least));
    return peaks;
}

struct Line {
    double slope = 0; ///< 1/s
    double error = 0; ///< standard error of the slope
};

Line line_through(std::span<const Peak> peaks) {
    const auto count = static_cast<double>(peaks.size());
    double middle = 0;
    double mean = 0;
    for (const Peak &peak : peaks) {
        middle += peak.time / count;
        mean += peak.logarithm / count;
    }
    double moment = 0;
    double spread = 0;
    for (const Peak &peak : peaks) {
        moment += (peak.time - middle) * (peak.logarithm - mean);
        spread += std::pow(peak.time - middle, 2);
    }
    const double slope = moment / spread;
    double residue = 0;
    for (const Peak &peak : peaks)
        residue += std::pow(peak.logarithm - mean - slope * (peak.time - middle), 2);
    return {slope, std::sqrt(residue / (count - 2) / spread)};
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
    const std::vector<Peak> peaks = peaks_in_windows(time, size, from, least);
    const auto nothing = [&](const Peak &peak) { return peak.logarithm <= std::log(least); };
    if (std::ranges::all_of(peaks, nothing))
        return trend;
    const std::span<const Peak> all(peaks);
    const Line whole = line_through(all);
    const Line end = line_through(all.last(windows / 2));
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

std::vector<double> largest_of(const std::vector<std::vector<double>> &lists, std::size_t size) {
    std::vector<double> largest(size, 0.0);
    for (const std::vector<double> &list : lists)
        for (std::size_t i = 0; i < std::min(size, list.size()); ++i)
            largest[i] = std::max(largest[i], list[i]);
    return largest;
}

} // namespace whirl::simulation

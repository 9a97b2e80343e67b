#pragma once

#include "results/transient.h"

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace whirl::simulation {

/// Evenly spaced samples of deflections in windows that spread over the time.
class WindowSamples {
  public:
    /// @param end      of the motion, s
    /// @param fastest  rad/s: samples follow motions up to four times as fast
    WindowSamples(std::size_t stations, double end, double fastest);

    [[nodiscard]] double window() const { return _spacing * _count; } ///< s
    struct Wanted {
        std::size_t window;
        int sample;
        double time; ///< s
    };
    /// The samples in (from, to], or [from, to] at 0, that were not asked for before.
    [[nodiscard]] std::vector<Wanted> between(double from, double to);
    void set(std::size_t station, std::size_t window, int sample, const Eigen::Vector2d &w) {
        _values[station][window][static_cast<std::size_t>(sample)] = {w(0), w(1)};
    }

    /// Windows that begin before this time are none.
    void leave_out_before(double time);
    /// Spectra of one station; without the speeds.
    [[nodiscard]] results::Waterfall spectra(std::size_t station) const;

  private:
    int _count = 0;      ///< samples in a window
    double _spacing = 0; ///< s
    std::size_t _open = 0;
    std::vector<double> _starts; ///< of the windows, s
    std::vector<int> _next;      ///< sample of each window that comes next
    std::vector<std::vector<std::vector<std::complex<double>>>> _values; ///< station, window
};

} // namespace whirl::simulation

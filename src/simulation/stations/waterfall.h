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
    /// Calls want(window, sample, time) for every sample in (from, to], or [from, to] at 0.
    template <class Want> void each_between(double from, double to, Want &&want) {
        for (std::size_t k = _open; k < _starts.size() && _starts[k] <= to; ++k) {
            while (_next[k] < _count && time(k, _next[k]) <= to) {
                if (time(k, _next[k]) >= from)
                    want(k, _next[k], time(k, _next[k]));
                ++_next[k];
            }
            if (_next[k] == _count && k == _open)
                ++_open;
        }
    }
    void set(std::size_t station, std::size_t window, int sample, const Eigen::Vector2d &w) {
        _values[station][window][static_cast<std::size_t>(sample)] = {w(0), w(1)};
    }

    /// Spectra of one station. @param speed_at  spin speed at a time, rad/s
    template <class Speed>
    [[nodiscard]] results::Waterfall waterfall(std::size_t station, Speed &&speed_at) const {
        results::Waterfall out = spectra(station);
        for (const double t : out.times)
            out.speeds.push_back(speed_at(t));
        return out;
    }

  private:
    int _count = 0;      ///< samples in a window
    double _spacing = 0; ///< s
    std::size_t _open = 0;
    std::vector<double> _starts; ///< of the windows, s
    std::vector<int> _next;      ///< sample of each window that comes next
    std::vector<std::vector<std::vector<std::complex<double>>>> _values; ///< station, window

    [[nodiscard]] double time(std::size_t window, int sample) const {
        return _starts[window] + sample * _spacing;
    }
    [[nodiscard]] results::Waterfall spectra(std::size_t station) const;
};

} // namespace whirl::simulation

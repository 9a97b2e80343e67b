#include "simulation/stations/waterfall.h"

#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace whirl::simulation {

namespace {

using std::numbers::pi;
constexpr int most_windows = 60;      ///< lines of a waterfall that can be seen one by one
constexpr int most_samples = 512;     ///< in a window, a power of two
constexpr int least_samples = 64;     ///< of a window: fewer leave hardly a spectrum
constexpr double reach = 4;           ///< spectra go up to so many times the fastest frequency
constexpr double oversampled = 1.25;  ///< over Nyquist's rate, for what the window's edges alias
constexpr double largest_share = 0.1; ///< of the time that a window may take

} // namespace

WindowSamples::WindowSamples(std::size_t stations, double end, double fastest)
    : _count(most_samples), _spacing(pi / (oversampled * reach * fastest)) {
    while (_count > least_samples && _count * _spacing > largest_share * end)
        _count /= 2;
    if (_count * _spacing > end) // less than a dozen turns: nothing to resolve
        return;
    const double last = end - (_count - 1) * _spacing;
    for (int k = 0; k < most_windows; ++k)
        _starts.push_back(last * k / (most_windows - 1) * (1 - 1e-12));
    _next.resize(_starts.size(), 0);
    _values.assign(stations, {_starts.size(),
                              std::vector<std::complex<double>>(static_cast<std::size_t>(_count))});
}

std::vector<WindowSamples::Wanted> WindowSamples::between(double from, double to) {
    std::vector<Wanted> out;
    for (std::size_t k = _open; k < _starts.size() && _starts[k] <= to; ++k) {
        const auto time = [&] { return _starts[k] + _next[k] * _spacing; };
        for (; _next[k] < _count && time() <= to; ++_next[k])
            if (time() >= from)
                out.push_back({k, _next[k], time()});
        if (_next[k] == _count && k == _open)
            ++_open;
    }
    return out;
}

void WindowSamples::leave_out_before(double time) {
    const auto first = std::ranges::lower_bound(_starts, time) - _starts.begin();
    _starts.erase(_starts.begin(), _starts.begin() + first);
    _next.resize(_starts.size());
    for (auto &windows : _values)
        windows.resize(_starts.size());
}

/// Hann's window, whose mean is a half: a circle of radius A at one of the frequencies gives A.
results::Waterfall WindowSamples::spectra(std::size_t station) const {
    results::Waterfall out;
    if (_starts.empty())
        return out;
    out.window = window();
    const int highest = static_cast<int>(_count / (2 * oversampled));
    for (int i = 0; i <= highest; ++i)
        out.frequencies.push_back(2 * pi * i / window());
    Eigen::FFT<double> fft;
    std::vector<std::complex<double>> spectrum;
    for (std::size_t k = 0; k < _starts.size(); ++k) {
        std::vector<std::complex<double>> values = _values[station][k];
        for (int i = 0; i < _count; ++i)
            values[static_cast<std::size_t>(i)] *= 0.5 * (1 - std::cos(2 * pi * i / _count));
        fft.fwd(spectrum, values);
        std::vector<double> amplitude;
        for (int i = 0; i <= highest; ++i) {
            const double forward = std::abs(spectrum[static_cast<std::size_t>(i)]);
            const double backward =
                i == 0 ? 0 : std::abs(spectrum[static_cast<std::size_t>(_count - i)]);
            amplitude.push_back((forward + backward) * 2 / _count);
        }
        out.times.push_back(_starts[k] + window() / 2);
        out.amplitude.push_back(std::move(amplitude));
    }
    return out;
}

} // namespace whirl::simulation

#include "oracles/duhamel.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace whirl::oracles {

namespace {

using Long = Duhamel::Long;

/// Points and weights on [-1, 1]: roots of the Legendre polynomial by Newton's method.
std::array<std::pair<Long, Long>, 16> gauss_legendre() {
    constexpr int n = 16;
    std::array<std::pair<Long, Long>, n> out;
    for (int i = 0; i < n; ++i) {
        Long x = std::cos(std::numbers::pi_v<Long> * (i + 0.75L) / (n + 0.5L));
        Long slope = 1;
        for (int pass = 0; pass < 100; ++pass) {
            Long before = 1;
            Long value = x;
            for (int k = 2; k <= n; ++k) {
                const Long next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
                before = value;
                value = next;
            }
            slope = n * (x * value - before) / (x * x - 1);
            x -= value / slope;
        }
        out[static_cast<std::size_t>(i)] = {x, 2 / ((1 - x * x) * slope * slope)};
    }
    return out;
}

} // namespace

Duhamel::Duhamel(const Spring &spring, std::function<Complex(Long)> force, Long panel,
                 const Motion &start)
    : _spring(spring), _force(std::move(force)), _panel(panel), _motion(start) {
    const Long decay = spring.damping / (2 * spring.mass);
    const Complex swing = std::sqrt(Complex(decay * decay - spring.stiffness / spring.mass));
    _fast = -decay + swing;
    _slow = -decay - swing;
}

/// w = (I1 - I2)/(l1 - l2), w' = (l1 I1 - l2 I2)/(l1 - l2), where I' = l I + f/m for both roots.
Duhamel::Motion Duhamel::advanced(const Motion &from, Long t, Long step) const {
    static const auto rule = gauss_legendre();
    Complex first = (from.v - _slow * from.w) * std::exp(_fast * step);
    Complex second = (from.v - _fast * from.w) * std::exp(_slow * step);
    for (const auto &[x, weight] : rule) {
        const Long s = step * (1 + x) / 2;
        const Complex f = _force(t + s) * (weight * step / 2 / _spring.mass);
        first += f * std::exp(_fast * (step - s));
        second += f * std::exp(_slow * (step - s));
    }
    const Complex apart = _fast - _slow;
    return {(first - second) / apart, (_fast * first - _slow * second) / apart};
}

Duhamel::Motion Duhamel::at(Long t) {
    while (_t + _panel < t) {
        _motion = advanced(_motion, _t, _panel);
        _t += _panel;
    }
    return advanced(_motion, _t, t - _t);
}

Duhamel::Peak Duhamel::largest(const Spring &spring, const std::function<Complex(Long)> &force,
                               Long panel, Long end, const Motion &start) {
    Duhamel motion(spring, force, panel, start);
    const auto growth = [](const Motion &m) {
        return m.w.real() * m.v.real() + m.w.imag() * m.v.imag();
    };
    Peak peak{std::abs(start.w), 0};
    Motion here = start;
    for (Long t = 0; t < end; t += panel) {
        const Long step = std::min(panel, end - t);
        const Motion next = motion.advanced(here, t, step);
        if (growth(here) > 0 && growth(next) <= 0) {
            Long low = 0;
            Long high = step;
            for (int halving = 0; halving < 60; ++halving) {
                const Long middle = (low + high) / 2;
                (growth(motion.advanced(here, t, middle)) > 0 ? low : high) = middle;
            }
            const Long value = std::abs(motion.advanced(here, t, low).w);
            if (value > peak.value)
                peak = {value, t + low};
        }
        here = next;
    }
    return peak;
}

long double Ramp::speed(long double t) const {
    return t < duration ? from + (to - from) / duration * t : to;
}

long double Ramp::angle(long double t) const {
    if (t < duration)
        return from * t + (to - from) / duration * t * t / 2;
    return (from + to) / 2 * duration + to * (t - duration);
}

std::complex<long double> Ramp::force(long double mr, long double t) const {
    const long double acceleration = t < duration ? (to - from) / duration : 0;
    const std::complex<long double> i(0, 1);
    return mr * (speed(t) * speed(t) - i * acceleration) * std::exp(i * angle(t));
}

} // namespace whirl::oracles

#include "forced/curve_peaks.h"

#include "linalg/roots.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace whirl::forced {

namespace {

/// Step over the distance to the nearest pole: an analytic function is a cubic there to 1e-4.
constexpr double step_over_distance = 0.2;
constexpr int steps_at_least = 300;    // for pictures
constexpr double smallest_step = 1e-7; // of the speed
/// Poles that are so near to the real speeds, of the speed, may be without damping.
constexpr double hardly_damped = 1e-5;
/// The nearest to one, of its speed, that is looked at for that.
constexpr double undamped = 1e-8;

std::complex<double> nearest_pole(const linalg::RationalCurve &piece, double speed) {
    std::complex<double> out(std::numeric_limits<double>::infinity(), 0);
    for (const std::complex<double> pole : piece.poles())
        if (std::abs(pole - speed) < std::abs(out - speed))
            out = pole;
    return out;
}

/// What is solved for over a power of the speed.
linalg::RationalCurve::Solve by_power(const linalg::RationalCurve::Solve &solve, int power) {
    return [solve, power](double speed) {
        auto out = solve(speed);
        if (out) {
            out->numbers /= std::pow(speed, power);
            out->rounding /= std::abs(std::pow(speed, power));
        }
        return out;
    };
}

} // namespace

CurvePeaks::CurvePeaks(Range range, const linalg::RationalCurve::Solve &solve, Size size)
    : _range(std::move(range)), _solve(solve), _size(std::move(size)),
      _motion(_range.cuts, by_power(solve, _range.power), _range.enough, _range.most) {
    constexpr int most_rounds = 6; // a guard: each solves for the motion at the maxima found
    for (int round = 0; round < most_rounds; ++round) {
        _samples.clear();
        _peaks.clear();
        for (const linalg::RationalCurve &piece : _motion.pieces())
            sample_piece(piece);
        for (std::size_t q = 0; q < _samples.front().values.size(); ++q)
            find(q);
        if (_motion.take_in(compared_speeds(_peaks)) <= _range.enough)
            break;
    }
}

CurvePeaks::WithSlope CurvePeaks::with_slope(const linalg::RationalCurve &piece,
                                             double speed) const {
    auto [numbers, changes] = piece.with_slope(speed);
    if (const int power = _range.power; power != 0) {
        const double factor = std::pow(speed, power);
        numbers *= factor;
        changes = factor * changes + (power / speed) * numbers;
    }
    return {std::move(numbers), std::move(changes)};
}

CurvePeaks::Sample CurvePeaks::sample(const linalg::RationalCurve &piece, double speed) const {
    auto [numbers, changes] = with_slope(piece, speed);
    Sample out{speed, std::move(numbers), {}, {}};
    for (Eigen::Index i = 0; i < out.numbers.rows(); ++i) {
        out.values.push_back(_size.of(out.numbers.row(i)));
        out.slopes.push_back(_size.change(out.numbers.row(i), changes.row(i)));
    }
    return out;
}

std::pair<double, double> CurvePeaks::value_and_slope(std::size_t quantity, double speed) const {
    const auto [numbers, changes] = with_slope(speed);
    const auto row = static_cast<Eigen::Index>(quantity);
    return {_size.of(numbers.row(row)), _size.change(numbers.row(row), changes.row(row))};
}

void CurvePeaks::sample_piece(const linalg::RationalCurve &piece) {
    const double range = _range.cuts.back() - _range.cuts.front();
    double speed = piece.from();
    while (true) {
        _samples.push_back(sample(piece, speed));
        if (speed >= piece.to())
            return;
        double step = range / steps_at_least;
        for (const std::complex<double> pole : piece.poles())
            step = std::min(step, step_over_distance * std::abs(pole - speed));
        step = std::max(step, smallest_step * std::abs(speed));
        // No minute last step.
        speed = speed + 1.2 * step >= piece.to() ? piece.to() : speed + step;
    }
}

void CurvePeaks::find(std::size_t quantity) {
    for (std::size_t k = 0; k + 1 < _samples.size(); ++k) {
        const Sample &a = _samples[k];
        const Sample &b = _samples[k + 1];
        if (b.speed <= _range.from || a.speed >= _range.to || !(a.slopes[quantity] > 0) ||
            !(b.slopes[quantity] <= 0) || !stands_out(quantity, k))
            continue;
        const std::optional<Peak> peak = peak_between(quantity, k);
        if (peak && peak->speed > _range.from && peak->speed < _range.to)
            _peaks.push_back(*peak);
    }
}

/// More than rounding: on one side at least the curve has fallen after a step; and it falls before
/// it rises above that beyond a bend, since tables with many rows bend a flat top at several of
/// them.
bool CurvePeaks::stands_out(std::size_t quantity, std::size_t left) const {
    const auto value = [&](std::size_t sample) { return _samples[sample].values[quantity]; };
    const linalg::RationalCurve &piece = _motion.piece_at(_samples[left].speed);
    const double top = std::max(value(left), value(left + 1));
    const double fallen = (1 - std::max(_range.shallow, 10 * std::min(piece.misfit(), 0.01))) * top;
    const auto outward = [&](std::size_t sample, int direction) { // 1: falls; -1: rises; 0: neither
        bool bend = false;
        for (auto i = static_cast<std::ptrdiff_t>(sample); i >= 0 && i < std::ssize(_samples);
             i += direction) {
            const auto here = static_cast<std::size_t>(i);
            bend = bend || (here != sample &&
                            _samples[here].speed ==
                                _samples[here - static_cast<std::size_t>(direction)].speed);
            if (value(here) < fallen)
                return 1;
            if (value(here) > top)
                return bend ? -1 : 0;
        }
        return 0;
    };
    const int below = outward(left, -1);
    const int above = outward(left + 1, 1);
    return std::max(below, above) == 1 && std::min(below, above) >= 0 &&
           !piece.only_rounding(quantity);
}

/// Part of a top that the curve falls by before it rises above it, on the side where that is less;
/// from half the speed to twice: farther down rounding of slow motions is another.
double CurvePeaks::fall(std::size_t quantity, std::size_t left, double top) const {
    constexpr double rounding = 1e-9;
    const auto lowest = [&](std::size_t start, int direction) {
        const double first = std::abs(_samples[start].speed);
        double out = top;
        for (auto i = static_cast<std::ptrdiff_t>(start); i >= 0 && i < std::ssize(_samples);
             i += direction) {
            const Sample &s = _samples[static_cast<std::size_t>(i)];
            if (s.values[quantity] > (1 + rounding) * top || std::abs(s.speed) < first / 2 ||
                std::abs(s.speed) > 2 * first)
                break;
            out = std::min(out, s.values[quantity]);
        }
        return out;
    };
    return 1 - std::max(lowest(left, -1), lowest(left + 1, 1)) / top;
}

std::vector<double> CurvePeaks::compared_speeds(std::vector<Peak> peaks) {
    std::ranges::sort(peaks, {}, &Peak::speed);
    std::vector<double> out;
    constexpr double near_enough = 0.1; // of the width
    for (const Peak &peak : peaks)
        if (std::isfinite(peak.value) &&
            (out.empty() || peak.speed - out.back() > near_enough * peak.width))
            out.push_back(peak.speed);
    return out;
}

/// Amplitudes of all quantities; without limit where there is no solution.
Eigen::VectorXd CurvePeaks::solved_values(double speed) const {
    Eigen::VectorXd out(_samples.front().values.size());
    const auto solved = _solve(speed);
    for (Eigen::Index i = 0; i < out.size(); ++i)
        out(i) =
            solved ? _size.of(solved->numbers.row(i)) : std::numeric_limits<double>::infinity();
    return out;
}

/// Where quantities grow like 1 / distance to the end: at a tenth of the distance at least twofold,
/// as they do where the pole is most of them. A resonance that damping limits would have a damping
/// ratio below 6e-8 to come so near to that. The place is that of the quantity which grows most.
const CurvePeaks::NextToReal &CurvePeaks::next_to_real(double pole) {
    const auto [known, missing] = _next_to_real.try_emplace(pole);
    NextToReal &out = known->second;
    if (!missing)
        return out;
    constexpr double far = 10 * undamped; // of the speed
    constexpr double grown = 2;
    const Eigen::VectorXd near = solved_values(pole * (1 + far));
    const Eigen::VectorXd beside = solved_values(pole * (1 + 10 * far));
    Eigen::Index strongest = 0;
    double most = 0;
    for (Eigen::Index i = 0; i < near.size(); ++i)
        if (const double growth = near(i) / beside(i); growth > most) {
            most = growth;
            strongest = i;
        }
    out.speed = pole;
    for (const double part : {10 * far, far, far / 10}) {
        const double d = part * std::abs(out.speed);
        const double left = 1 / solved_values(out.speed - d)(strongest);
        const double right = 1 / solved_values(out.speed + d)(strongest);
        if (left + right > 0)
            out.speed += d * (left - right) / (left + right);
    }
    out.without_limit.assign(_samples.front().values.size(), true);
    for (const double side : {-far, far}) {
        const Eigen::VectorXd inside = solved_values(out.speed * (1 + side / 10));
        const Eigen::VectorXd outside = solved_values(out.speed * (1 + side));
        for (Eigen::Index i = 0; i < inside.size(); ++i)
            if (!(inside(i) > grown * outside(i)))
                out.without_limit[static_cast<std::size_t>(i)] = false;
    }
    return out;
}

std::optional<Peak> CurvePeaks::peak_between(std::size_t quantity, std::size_t left) {
    const Sample &a = _samples[left];
    const Sample &b = _samples[left + 1];
    Peak out;
    out.quantity = quantity;
    const linalg::RationalCurve &piece = _motion.piece_at(a.speed);
    for (const std::complex<double> pole : piece.poles())
        if (pole.real() > a.speed && pole.real() < b.speed &&
            std::abs(pole.imag()) < hardly_damped * std::abs(pole.real())) {
            const NextToReal &found = next_to_real(pole.real());
            if (found.without_limit[quantity]) {
                out.speed = found.speed;
                out.value = std::numeric_limits<double>::infinity();
                out.phase = std::numeric_limits<double>::quiet_NaN();
                return out;
            }
            if (std::abs(pole.imag()) < undamped * std::abs(pole.real()))
                return std::nullopt; // nothing drives that mode here
        }
    out.speed = a.speed;
    out.bend = a.speed == b.speed;
    if (!out.bend)
        out.speed = linalg::root_between(
            [&](double speed) { return value_and_slope(quantity, speed).second; }, a.speed,
            a.slopes[quantity], b.speed, b.slopes[quantity]);
    const Eigen::RowVectorXcd numbers = at(out.speed).row(static_cast<Eigen::Index>(quantity));
    out.value = _size.of(numbers);
    out.phase = std::arg(numbers(0));
    const std::complex<double> pole = nearest_pole(piece, out.speed);
    const double farthest = std::max(std::abs(_range.cuts.front()), std::abs(_range.cuts.back()));
    out.width = std::isfinite(pole.real()) && pole.imag() != 0 ? std::abs(pole.imag()) : farthest;
    if (!out.bend)
        out.fall = fall(quantity, left, out.value);
    out.lower = half_power(out, left, -1);
    out.upper = half_power(out, left + 1, 1);
    return out;
}

/// Where the curve has fallen to 1/sqrt(2) of a maximum, before it rises above that.
std::optional<double> CurvePeaks::half_power(const Peak &peak, std::size_t start,
                                             int direction) const {
    const std::size_t q = peak.quantity;
    const double level = peak.value / std::numbers::sqrt2;
    const auto crossing = [&](double near, double near_value, double far, double far_value) {
        constexpr double close = 1e-12; // of the speed
        return linalg::root_between(
            [&](double speed) { return value_and_slope(q, speed).first - level; }, near,
            near_value - level, far, far_value - level, close);
    };
    double near = peak.speed;
    double near_value = peak.value;
    const Sample *before = nullptr;
    for (auto i = static_cast<std::ptrdiff_t>(start); i >= 0 && i < std::ssize(_samples);
         i += direction) {
        const Sample &s = _samples[static_cast<std::size_t>(i)];
        if (s.values[q] <= level)
            return crossing(near, near_value, s.speed, s.values[q]);
        // A valley between two samples may reach down to the level.
        if (before != nullptr && before->speed != s.speed && direction * before->slopes[q] < 0 &&
            direction * s.slopes[q] > 0) {
            const double bottom =
                linalg::root_between([&](double speed) { return value_and_slope(q, speed).second; },
                                     before->speed, before->slopes[q], s.speed, s.slopes[q]);
            if (const double value = value_and_slope(q, bottom).first; value <= level)
                return crossing(near, near_value, bottom, value);
        }
        constexpr double rounding = 1e-9;
        if (s.values[q] > peak.value * (1 + rounding)) // a higher one before
            return std::nullopt;
        near = s.speed;
        near_value = s.values[q];
        before = &s;
    }
    return std::nullopt;
}

std::vector<CurvePeaks::Sample> CurvePeaks::drawn() const {
    constexpr double seen = 0.03;   // of a value
    constexpr double turned = 0.15; // of a phase, rad: at a peak the value stands still
    const double step = (_range.to - _range.from) / steps_at_least;
    // A curve without limit is drawn up to 3e-4 beside it.
    const auto without_limit = [&](double speed) {
        return std::ranges::any_of(_peaks, [speed](const Peak &peak) {
            return std::isinf(peak.value) && std::abs(peak.speed - speed) < 3e-4 * std::abs(speed);
        });
    };
    std::vector<Sample> out;
    for (const Sample &s : _samples) {
        if (s.speed < _range.from || s.speed > _range.to || without_limit(s.speed))
            continue;
        bool keep = out.empty() || s.speed - out.back().speed > step;
        for (std::size_t i = 0; !keep && i < s.values.size(); ++i) {
            const auto row = static_cast<Eigen::Index>(i);
            const double turn = std::arg(s.numbers(row, 0)) - std::arg(out.back().numbers(row, 0));
            keep = std::abs(s.values[i] - out.back().values[i]) > seen * s.values[i] ||
                   std::abs(std::remainder(turn, 2 * std::numbers::pi)) > turned;
        }
        if (keep)
            out.push_back(s);
    }
    return out;
}

} // namespace whirl::forced

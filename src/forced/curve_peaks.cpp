#include "forced/curve_peaks.h"

#include "linalg/roots.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <utility>

namespace whirl::forced {

namespace {

/// Misfit of the interpolated motion at new speeds that is accepted, relative: lower peaks than
/// that beside what else moves are none. Values of peaks are solved for.
constexpr double enough = 1e-8;
/// Step over the distance to the nearest pole: an analytic function is a cubic there to 1e-4.
constexpr double step_over_distance = 0.2;
constexpr int steps_at_least = 200; // for pictures
/// Smallest step, of the speed: narrower resonances are as without damping.
constexpr double smallest_step = 1e-7;

} // namespace

CurvePeaks::CurvePeaks(const std::vector<double> &cuts, const linalg::RationalCurve::Solve &solve,
                       Size size)
    : _size(std::move(size)) {
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
        _pieces.emplace_back(cuts[i], cuts[i + 1], solve, enough);
    constexpr int most_rounds = 6; // a guard: each solves for the motion at the maxima found
    for (int round = 0; round < most_rounds; ++round) {
        _samples.clear();
        for (const linalg::RationalCurve &piece : _pieces)
            sample_piece(piece);
        find();
        if (confirmed())
            break;
    }
}

/// Of the piece that a speed lies in.
std::size_t CurvePeaks::place_of(double speed) const {
    const auto after = std::ranges::upper_bound(_pieces, speed, {}, &linalg::RationalCurve::from);
    return after == _pieces.begin() ? 0 : static_cast<std::size_t>(after - _pieces.begin() - 1);
}

std::vector<std::pair<double, double>> CurvePeaks::unsettled() const {
    std::vector<std::pair<double, double>> out;
    for (const linalg::RationalCurve &piece : _pieces)
        if (piece.misfit() > enough) {
            if (!out.empty() && out.back().second == piece.from())
                out.back().second = piece.to();
            else
                out.emplace_back(piece.from(), piece.to());
        }
    return out;
}

CurvePeaks::Sample CurvePeaks::sample(double speed) const {
    Sample out{speed, piece_of(speed).at(speed), {}};
    for (Eigen::Index i = 0; i < out.numbers.rows(); ++i)
        out.values.push_back(_size.of(out.numbers.row(i)));
    return out;
}

double CurvePeaks::value(std::size_t quantity, double speed) const {
    return _size.of(piece_of(speed).at(speed).row(static_cast<Eigen::Index>(quantity)));
}

double CurvePeaks::slope(std::size_t quantity, double speed) const {
    const linalg::RationalCurve &piece = piece_of(speed);
    const auto row = static_cast<Eigen::Index>(quantity);
    return _size.change(piece.at(speed).row(row), piece.slope(speed).row(row));
}

void CurvePeaks::sample_piece(const linalg::RationalCurve &piece) {
    const double range = _pieces.back().to() - _pieces.front().from();
    double speed = piece.from();
    while (true) {
        if (_samples.empty() || _samples.back().speed < speed)
            _samples.push_back(sample(speed));
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

void CurvePeaks::find() {
    _tops.clear();
    for (std::size_t q = 0; q < _samples.front().values.size(); ++q)
        for (std::size_t k = 1; k + 1 < _samples.size(); ++k) {
            const double here = _samples[k].values[q];
            // Less than that are no maxima of a motion that changes on the scale of the steps.
            const double noise = 10 * std::max(piece_of(_samples[k].speed).misfit(), enough);
            const double least = (1 - std::min(noise, 0.1)) * here;
            if (here > 0 && _samples[k - 1].values[q] < here && _samples[k + 1].values[q] <= here &&
                std::min(_samples[k - 1].values[q], _samples[k + 1].values[q]) < least)
                _tops.push_back(top_about(q, k));
        }
}

/// Solves for the motion at the maxima. @returns whether it is as interpolated
bool CurvePeaks::confirmed() {
    std::vector<double> speeds;
    for (const Top &top : _tops)
        if (std::isfinite(top.value))
            speeds.push_back(top.speed);
    std::ranges::sort(speeds);
    std::vector<std::vector<double>> places(_pieces.size());
    std::optional<double> last;
    for (const double speed : speeds) {
        const std::size_t place = place_of(speed);
        const linalg::RationalCurve &piece = _pieces[place];
        double width = piece.to() - piece.from();
        for (const std::complex<double> pole : piece.poles())
            width = std::min(width, std::abs(pole - speed));
        constexpr double near_enough = 0.1; // of the distance to the pole
        if (last && speed - *last < near_enough * width)
            continue;
        last = speed;
        places[place].push_back(speed);
    }
    bool news = false;
    for (std::size_t i = 0; i < _pieces.size(); ++i) {
        const bool settled = _pieces[i].misfit() <= enough; // else it never is
        if (settled && !places[i].empty() && _pieces[i].take_in(places[i]) > enough)
            news = true;
    }
    return !news;
}

Top CurvePeaks::top_about(std::size_t quantity, std::size_t middle) const {
    Top out;
    out.quantity = quantity;
    const double from = _samples[middle - 1].speed;
    const double to = _samples[middle + 1].speed;
    for (const std::complex<double> pole : piece_of(_samples[middle].speed).poles())
        if (pole.real() > from && pole.real() < to &&
            std::abs(pole.imag()) < smallest_step * std::abs(pole.real())) {
            out.speed = pole.real();
            out.value = std::numeric_limits<double>::infinity();
            return out;
        }
    const auto slope_at = [&](double speed) { return slope(quantity, speed); };
    const double before = slope_at(from);
    const double after = slope_at(to);
    out.speed =
        before > 0 && after < 0
            ? linalg::root_between(slope_at, from, before, to, after)
            : linalg::least_place([&](double speed) { return -value(quantity, speed); }, from, to);
    out.value = value(quantity, out.speed);
    out.lower = half_power(out, middle, -1);
    out.upper = half_power(out, middle, 1);
    return out;
}

/// Where the curve has fallen to 1/sqrt(2) of a maximum, before it rises above that.
std::optional<double> CurvePeaks::half_power(const Top &top, std::size_t start,
                                             int direction) const {
    const double level = top.value / std::numbers::sqrt2;
    const auto above = [&](double speed) { return value(top.quantity, speed) - level; };
    double inside = top.speed;
    for (auto j = static_cast<std::ptrdiff_t>(start); j >= 0 && j < std::ssize(_samples);
         j += direction) {
        const Sample &s = _samples[static_cast<std::size_t>(j)];
        const double there = s.values[top.quantity];
        constexpr double rounding = 1e-7;
        if (there > (1 + rounding) * top.value)
            return std::nullopt;
        if ((s.speed - top.speed) * direction <= 0)
            continue;
        if (there > level) {
            inside = s.speed;
            continue;
        }
        constexpr double close = 1e-12; // of the speed
        return linalg::root_between(above, inside, above(inside), s.speed, there - level, close);
    }
    return std::nullopt;
}

std::vector<CurvePeaks::Sample> CurvePeaks::drawn() const {
    constexpr double seen = 0.03; // of a value
    const double step = (_samples.back().speed - _samples.front().speed) / steps_at_least;
    std::vector<Sample> out;
    for (const Sample &s : _samples) {
        bool keep = out.empty() || s.speed - out.back().speed >= step;
        for (std::size_t i = 0; !keep && i < s.values.size(); ++i)
            keep = std::abs(s.values[i] - out.back().values[i]) > seen * s.values[i];
        if (keep)
            out.push_back(s);
    }
    return out;
}

} // namespace whirl::forced

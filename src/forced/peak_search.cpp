#include "forced/peak_search.h"

#include "linalg/roots.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace whirl::forced {

namespace {

/// Beyond the speeds asked for, as a share of them, half-power points are looked for.
constexpr double beyond = 0.3;
/// Step over the distance to the nearest pole: an analytic function is a cubic there to 1e-4.
constexpr double step_to_pole = 0.2;
constexpr int fewest_steps = 300; // for pictures
/// Relative distance from such a pole at which the motion is evaluated.
constexpr double beside_pole = 1e-7;
constexpr double no_phase = std::numeric_limits<double>::quiet_NaN();

/// At rest there is no force; this share of the fastest speed is the slowest looked at.
constexpr double slowest = 1e-6;

double low_end(double from, double to) {
    return from < 0 ? (1 + beyond) * from : std::max((1 - beyond) * from, slowest * to);
}
double high_end(double from, double to) {
    return from < 0 ? std::min((1 - beyond) * to, slowest * from) : (1 + beyond) * to;
}

/// Of the poles of a piece.
std::vector<Resonance> resonances_of(const std::vector<std::complex<double>> &poles, double from,
                                     double to) {
    std::vector<Resonance> out;
    for (const std::complex<double> &pole : poles)
        if (pole.real() > from && pole.real() < to)
            out.push_back({pole.real(), std::abs(pole.imag())});
    std::ranges::sort(out, {}, &Resonance::speed);
    return out;
}

} // namespace

std::vector<Resonance> resonances_about(ReducedMotion &motion, double from, double to) {
    const std::vector<double> cuts = motion.cuts(low_end(from, to), high_end(from, to));
    std::vector<Resonance> out;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
        motion.enter_piece((cuts[i] + cuts[i + 1]) / 2);
        const auto more = resonances_of(motion.poles(cuts[i], cuts[i + 1]), cuts[i], cuts[i + 1]);
        out.insert(out.end(), more.begin(), more.end());
    }
    return out;
}

PeakSearch::PeakSearch(ReducedMotion &motion, double from, double to)
    : _motion(motion), _from(from), _to(to), _low(low_end(from, to)), _high(high_end(from, to)),
      _cuts(motion.cuts(_low, _high)) {
    for (int piece = 0; piece + 1 < static_cast<int>(_cuts.size()); ++piece)
        sample_piece(piece);
    for (std::size_t quantity = 0; quantity < _samples.front().value.size(); ++quantity)
        find(quantity);
}

void PeakSearch::enter(int piece) const {
    const auto i = static_cast<std::size_t>(piece);
    _motion.enter_piece((_cuts[i] + _cuts[i + 1]) / 2);
}

PeakSearch::Sample PeakSearch::sample(int piece, double speed) const {
    Sample out{speed, piece, {}, {}, {}, {}};
    for (const Reading &reading : _motion.quickly_at(speed)) {
        out.value.push_back(reading.major());
        out.slope.push_back(reading.major_slope());
        out.phase.push_back(std::arg(reading.value.x));
        out.cancelled.push_back(reading.cancelled);
    }
    return out;
}

void PeakSearch::sample_piece(int piece) {
    enter(piece);
    const double from = _cuts[static_cast<std::size_t>(piece)];
    const double to = _cuts[static_cast<std::size_t>(piece) + 1];
    const std::vector<std::complex<double>> poles = _motion.poles(from, to);
    const std::vector<Resonance> here = resonances_of(poles, from, to);
    _resonances.insert(_resonances.end(), here.begin(), here.end());
    double start = from;
    for (const Resonance &r : here)
        if (r.undamped()) {
            const double apart = beside_pole * std::abs(r.speed);
            sample_stretch(piece, start, r.speed - apart, poles);
            start = r.speed + apart;
        }
    sample_stretch(piece, start, to, poles);
}

void PeakSearch::sample_stretch(int piece, double from, double to,
                                const std::vector<std::complex<double>> &poles) {
    if (!(from < to))
        return;
    double speed = from;
    while (true) {
        _samples.push_back(sample(piece, speed));
        if (speed >= to)
            return;
        double distance = (_high - _low) / fewest_steps / step_to_pole;
        for (const std::complex<double> &pole : poles)
            distance = std::min(distance, std::abs(pole - speed));
        const double step = std::max(step_to_pole * distance, 1e-9 * std::abs(speed));
        // No minute last step.
        speed = speed + 1.2 * step >= to ? to : speed + step;
    }
}

double PeakSearch::width_at(double speed) const {
    double best = std::max(std::abs(_low), std::abs(_high));
    double width = 0;
    for (const Resonance &r : _resonances)
        if (std::hypot(r.speed - speed, r.width) < best) {
            best = std::hypot(r.speed - speed, r.width);
            width = r.width;
        }
    return width > 0 ? width : best;
}

void PeakSearch::find(std::size_t q) {
    for (std::size_t i = 0; i + 1 < _samples.size(); ++i) {
        const Sample &a = _samples[i];
        const Sample &b = _samples[i + 1];
        const bool inside = b.speed > _from && a.speed < _to;
        if (!inside || !(a.slope[q] > 0) || !(b.slope[q] <= 0))
            continue;
        const bool pole = std::ranges::any_of(_resonances, [&](const Resonance &r) {
            return r.speed > a.speed && r.speed < b.speed && r.undamped();
        });
        if (pole && a.piece == b.piece)
            endless_peak(q, i);
        else if (stands_out(i, q))
            peak_between(q, i);
    }
}

bool PeakSearch::stands_out(std::size_t left, std::size_t quantity) const {
    // Of the top: a dip as small is rounding or a flat curve, not a valley between peaks.
    constexpr double shallow = 1e-6;
    constexpr double allowance = 1000; // over the rounding of one solution
    const Sample &a = _samples[left];
    const Sample &b = _samples[left + 1];
    enter(a.piece);
    const double unsure = allowance * _motion.rounding(a.speed);
    const double top = std::max(a.value[quantity], b.value[quantity]);
    const double cancels = unsure * a.cancelled[quantity];
    if (a.speed == b.speed) // a kink at the row of a bearing table
        return top > cancels;
    const Sample &before = _samples[left > 0 ? left - 1 : left];
    const Sample &after = _samples[std::min(left + 2, _samples.size() - 1)];
    const double least = std::max(std::max(shallow, unsure) * top, cancels);
    return std::min(before.value[quantity], after.value[quantity]) < top - least;
}

void PeakSearch::endless_peak(std::size_t q, std::size_t left) {
    // What is driven grows like the inverse of the distance: by a third at least in two steps.
    constexpr double grown = 1.2;
    // What rounding leaves of terms that cancel grows there as well.
    constexpr double more_than_rounding = 1e-12;
    const bool driven =
        left > 1 && left + 3 < _samples.size() &&
        _samples[left].value[q] * beside_pole > more_than_rounding * _samples[left].cancelled[q] &&
        _samples[left].value[q] > grown * _samples[left - 2].value[q] &&
        _samples[left + 1].value[q] > grown * _samples[left + 3].value[q];
    if (!driven)
        return;
    Peak peak;
    peak.quantity = q;
    peak.speed = (_samples[left].speed + _samples[left + 1].speed) / 2;
    for (const Resonance &r : _resonances)
        if (r.speed > _samples[left].speed && r.speed < _samples[left + 1].speed)
            peak.speed = r.speed;
    if (peak.speed <= _from || peak.speed >= _to)
        return;
    peak.value = std::numeric_limits<double>::infinity();
    peak.phase = no_phase;
    _peaks.push_back(peak);
}

void PeakSearch::peak_between(std::size_t q, std::size_t left) {
    const Sample &a = _samples[left];
    const Sample &b = _samples[left + 1];
    enter(a.piece);
    Peak peak;
    peak.quantity = q;
    peak.speed = a.speed; // at the row of a bearing table the slope jumps
    if (b.speed > a.speed)
        peak.speed = corrected(linalg::root_between([&](double at) { return slope(at, q); },
                                                    a.speed, a.slope[q], b.speed, b.slope[q]),
                               q);
    if (peak.speed <= _from || peak.speed >= _to)
        return;
    const Reading reading = _motion.at(peak.speed)[q];
    peak.value = reading.major();
    peak.phase = std::arg(reading.value.x);
    peak.width = width_at(peak.speed);
    if (reading.cancelled > 0)
        peak.rounding = _motion.rounding(peak.speed) * reading.cancelled / reading.major();
    peak.lower = half_power(peak, left, -1);
    peak.upper = half_power(peak, left + 1, 1);
    _peaks.push_back(peak);
}

double PeakSearch::corrected(double speed, std::size_t quantity) const {
    const double exact = _motion.at(speed)[quantity].major_slope();
    const double apart = 0.01 * width_at(speed);
    const double curvature =
        (slope(speed + apart, quantity) - slope(speed - apart, quantity)) / (2 * apart);
    const double step = -exact / curvature;
    // Of the speed: a smaller step changes no digit that is stated.
    constexpr double rounding = 1e-12;
    const bool usable = std::abs(step) > rounding * std::abs(speed) && std::abs(step) < apart;
    return usable ? speed + step : speed;
}

double PeakSearch::bottom_between(const Sample &a, const Sample &b, std::size_t quantity) const {
    enter(a.piece);
    const auto done = [](double low, double high, double) {
        return high - low < 1e-9 * std::max(std::abs(low), std::abs(high));
    };
    return linalg::least_between([&](double speed) { return major(speed, quantity); },
                                 std::min(a.speed, b.speed), std::max(a.speed, b.speed), done)
        .first;
}

std::optional<double> PeakSearch::half_power(const Peak &peak, std::size_t start,
                                             int direction) const {
    const std::size_t q = peak.quantity;
    const double level = peak.value / std::numbers::sqrt2;
    const auto crossing = [&](double near, double near_value, double far, double far_value) {
        return linalg::root_between([&](double speed) { return major(speed, q) - level; }, near,
                                    near_value - level, far, far_value - level);
    };
    double near = peak.speed;
    double near_value = peak.value;
    const Sample *before = nullptr;
    for (auto i = static_cast<std::ptrdiff_t>(start);
         i >= 0 && i < static_cast<std::ptrdiff_t>(_samples.size()); i += direction) {
        const Sample &s = _samples[static_cast<std::size_t>(i)];
        enter(s.piece);
        if (s.value[q] <= level)
            return crossing(near, near_value, s.speed, s.value[q]);
        // A valley between two samples may reach down to the level.
        if (before != nullptr && before->piece == s.piece && direction * before->slope[q] < 0 &&
            direction * s.slope[q] > 0) {
            const double bottom = bottom_between(*before, s, q);
            if (major(bottom, q) <= level)
                return crossing(near, near_value, bottom, major(bottom, q));
        }
        if (s.value[q] > peak.value * (1 + 1e-9)) // a higher one before
            return std::nullopt;
        near = s.speed;
        near_value = s.value[q];
        before = &s;
    }
    return std::nullopt;
}

} // namespace whirl::forced

#include "forced/peak_error.h"

#include "linalg/check.h"
#include "linalg/roots.h"
#include "mesh_error/safety.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

namespace whirl::forced {

namespace {

using Complex = std::complex<double>;
constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// (value + slope t) / (1 - t / pole) through values at t = -1, 0, 1: one resonance and what
/// changes slowly beside it.
class OneResonance {
  public:
    OneResonance(Complex before, Complex middle, Complex after) : _value(middle) {
        const Complex odd = after - before;
        const Complex even = 2.0 * middle - before - after;
        _inverse = std::abs(odd) > 0 ? even / odd : 0;
        _slope = after * (1.0 + _inverse) - middle;
    }
    [[nodiscard]] double size(double t) const {
        return std::abs((_value + _slope * t) / (1.0 + _inverse * t));
    }
    /// Real part of the pole.
    [[nodiscard]] double pole() const {
        return std::abs(_inverse) > 0 ? (-1.0 / _inverse).real()
                                      : std::numeric_limits<double>::infinity();
    }

  private:
    Complex _value, _slope, _inverse;
};

/// Semi-major axis about three speeds.
class LocalCurve {
  public:
    explicit LocalCurve(const std::array<Phasor, 3> &at)
        : _forward(part(at, &WhirlParts::a)), _backward(part(at, &WhirlParts::d)) {}

    [[nodiscard]] double operator()(double t) const { return _forward.size(t) + _backward.size(t); }

    /// Where the pole of the larger part lies, in widths.
    [[nodiscard]] double pole() const {
        return _forward.size(0) >= _backward.size(0) ? _forward.pole() : _backward.pole();
    }

    /// Place of the largest value from -reach to reach; none inside.
    [[nodiscard]] std::optional<double> top(double reach) const {
        const auto done = [](double low, double high, double) { return high - low < 1e-9; };
        const auto [place, value] =
            linalg::least_between([this](double t) { return -(*this)(t); }, -reach, reach, done);
        return std::abs(place) < 0.99 * reach ? std::optional(place) : std::nullopt;
    }

  private:
    OneResonance _forward, _backward;

    static OneResonance part(const std::array<Phasor, 3> &at, Complex WhirlParts::*sense) {
        return {WhirlParts(at[0]).*sense, WhirlParts(at[1]).*sense, WhirlParts(at[2]).*sense};
    }
};

constexpr double reach = 2; ///< in widths, of a local curve

} // namespace

PeakError::PeakError(const assembly::Discretization &coarse, results::Form form,
                     const std::vector<Quantity> &quantities, const Drive &drive)
    : _quantities(quantities), _finer(coarse, form, drive) {}

void PeakError::solve_about(double middle, double width) {
    if (middle == _middle && width == _width)
        return;
    _middle = middle;
    _width = width;
    for (int i = 0; i < 3; ++i) {
        _finer.solve(middle + (i - 1) * width);
        auto &motions = _motions[static_cast<std::size_t>(i)];
        motions.clear();
        for (const Quantity &quantity : _quantities)
            motions.push_back(_finer.finer_of(quantity));
    }
}

PeakErrors PeakError::of(const Peak &peak, double middle, double width, const CurvePeaks &curves) {
    const std::size_t q = peak.quantity;
    std::array<Phasor, 3> mine;
    for (int i = 0; i < 3; ++i) {
        const Eigen::MatrixXcd numbers = curves.at(middle + (i - 1) * width);
        const auto row = static_cast<Eigen::Index>(q);
        mine[static_cast<std::size_t>(i)] = {numbers(row, 0), numbers(row, 1)};
    }
    const LocalCurve coarse(mine);
    const auto share = [](double difference, double size) {
        return mesh_error::estimate_safety * std::abs(difference) / size;
    };
    const std::optional<double> coarse_top = coarse.top(reach);
    double centre = middle;
    for (int move = 0; coarse_top && !peak.bend && move < 8 && std::abs(centre) > 2 * width;
         ++move) {
        solve_about(centre, width);
        const LocalCurve fine({_motions[0][q], _motions[1][q], _motions[2][q]});
        if (const std::optional<double> top = fine.top(reach)) {
            const double a = coarse(*coarse_top);
            const double b = fine(*top);
            const double shift = centre - middle + (*top - *coarse_top) * width;
            return {share(a - b, std::max(a, b)), share(shift, std::abs(peak.speed))};
        }
        // Half widths in one step: farther away the curve of the pole says nothing.
        constexpr double farthest = 1000;
        centre += std::clamp(fine.pole(), -farthest, farthest) * width;
    }
    // A maximum that the finer rotor need not have: the curves at the same speed.
    solve_about(middle, width);
    const double a = coarse(0);
    const double b = LocalCurve({_motions[0][q], _motions[1][q], _motions[2][q]})(0);
    return {share(a - b, std::max(a, b)), not_known};
}

std::vector<PeakErrors> PeakError::of(const std::vector<Peak> &peaks, const CurvePeaks &curves) {
    std::vector<PeakErrors> out(peaks.size());
    if (_finer.none())
        return out;
    // By speed: peaks of one resonance use the same solutions.
    std::vector<std::size_t> order(peaks.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        order[i] = i;
    std::ranges::sort(order, {}, [&](std::size_t i) { return peaks[i].speed; });
    double middle = 0;
    double width = 0;
    for (const std::size_t i : order) {
        const Peak &peak = peaks[i];
        if (!std::isfinite(peak.value)) {
            out[i] = {not_known, not_known};
            continue;
        }
        if (peak.bend || width == 0 || !(peak.speed - middle < width)) {
            // So near that one resonance and a straight line are all there is to see.
            constexpr double part = 0.1;
            constexpr double widest = 0.01; // of the speed
            middle = peak.speed;
            width = std::min(part * peak.width, widest * std::abs(peak.speed));
        }
        try {
            out[i] = of(peak, middle, width, curves);
        } catch (const linalg::SolverError &) { // the finer rotor at a resonance
            out[i] = {not_known, not_known};
        }
    }
    return out;
}

} // namespace whirl::forced

#include "forced/response_peaks.h"

#include "forced/swept_motion.h"
#include "modes/orbits.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace whirl::forced {

namespace {

/// Differences of interpolated quantities from those of the whole rotor, over the size of these.
constexpr double agreed = 1e-9;

/// Beyond the speeds asked for, as a share of them, half-power points are looked for.
constexpr double beyond = 0.3;
/// At rest there is no force; this share of the fastest speed is the slowest looked at.
constexpr double slowest = 1e-6;

double low_end(double from, double to) {
    return from < 0 ? (1 + beyond) * from : std::max((1 - beyond) * from, slowest * to);
}
double high_end(double from, double to) {
    return from < 0 ? std::min((1 - beyond) * to, slowest * from) : (1 + beyond) * to;
}

double slope_of_modulus(std::complex<double> value, std::complex<double> slope) {
    const double size = std::abs(value);
    return size > 0 ? (std::conj(value) * slope).real() / size : std::abs(slope);
}

/// The semi-major axis of the ellipse, |a| + |d|.
double amplitude(const Eigen::RowVectorXcd &numbers) {
    return modes::ellipse_of(numbers(0), numbers(1)).major;
}

CurvePeaks::Size semi_major_axis() {
    return {amplitude, [](const Eigen::RowVectorXcd &numbers, const Eigen::RowVectorXcd &changes) {
                const WhirlParts of({numbers(0), numbers(1)});
                const WhirlParts change({changes(0), changes(1)});
                return slope_of_modulus(of.a, change.a) + slope_of_modulus(of.d, change.d);
            }};
}

/// Compares the peaks with the whole rotor, whose amplitude they get. A difference that is less
/// than the rounding of its motion is not distinguished from that: it becomes part of the rounding
/// of the peaks.
/// @returns the largest difference that is more
double compare(SweptMotion &motion, const CurvePeaks &curves, std::vector<Peak> &peaks) {
    struct Compared {
        linalg::RationalCurve::Values whole;
        Eigen::MatrixXcd numbers; // of the curves
        Eigen::VectorXd rounding; // of each quantity, relative
    };
    std::map<double, Compared> compared; // by speed
    for (const double speed : CurvePeaks::compared_speeds(peaks))
        if (auto whole = motion.solved(speed))
            compared[speed] = {*std::move(whole), curves.at(speed), motion.rounding()};
    double worst = 0;
    for (Peak &peak : peaks) {
        const auto after = compared.upper_bound(peak.speed);
        if (after == compared.begin() || !std::isfinite(peak.value))
            continue;
        const auto &[speed, at] = *std::prev(after);
        const auto i = static_cast<Eigen::Index>(peak.quantity);
        const double size = at.whole.numbers.row(i).norm();
        const double mine = amplitude(at.numbers.row(i));
        if (peak.speed - speed > peak.width || size == 0 || mine == 0)
            continue; // of another resonance
        const double apart = (at.numbers.row(i) - at.whole.numbers.row(i)).norm() / size;
        peak.rounding = at.rounding(i) + (apart > at.rounding(i) ? 0 : apart);
        peak.value *= amplitude(at.whole.numbers.row(i)) / mine;
        if (apart > at.rounding(i))
            worst = std::max(worst, apart);
    }
    return worst;
}

/// No resonance, and rounding could have made it: slow motions of rotors that are free to move are
/// what is left of K - w^2 M.
bool only_rounding(const Peak &peak) {
    constexpr double unsure = 1e-3;
    constexpr double of_fall = 0.1; // rounding is known by its size alone
    constexpr double sharp = 1e-4;  // of the speed
    return peak.rounding > std::min(unsure, of_fall * peak.fall) &&
           !(peak.lower && peak.upper && *peak.upper - *peak.lower < sharp * std::abs(peak.speed));
}

} // namespace

CertifiedPeaks response_peaks(const assembly::Discretization &discretization, results::Form form,
                              const std::vector<Quantity> &quantities, double from, double to,
                              const PeakOptions &options) {
    if (quantities.empty())
        return {};
    SweptMotion motion(discretization, form, quantities, options.drive, low_end(from, to),
                       high_end(from, to));
    const auto at = [&motion](double speed) { return motion.at(speed); };
    CurvePeaks::Range range{motion.cuts(), from, to, agreed, SweptMotion::most_solutions,
                            motion.power()};
    // A smooth curve of many rows bends at each by up to 1e-4 (model::Bearing::bends).
    if (range.cuts.size() > discretization.rotor().table_bends().size() + 2)
        range.shallow = 1e-4;
    constexpr int most_rounds = 4; // a guard
    std::optional<CurvePeaks> curves;
    for (int round = 0; round < most_rounds; ++round) {
        curves.emplace(range, at, semi_major_axis());
        if (!motion.take_in(CurvePeaks::compared_speeds(curves->peaks())))
            break;
    }
    CertifiedPeaks out;
    out.peaks = curves->peaks();
    out.interpolation_error = compare(motion, *curves, out.peaks);
    std::erase_if(out.peaks, only_rounding);
    out.unsettled = motion.unsettled();
    for (const auto &range : curves->unsettled())
        out.unsettled.push_back(range);
    out.curve = curves->drawn();
    if (options.with_errors)
        out.errors =
            PeakError(discretization, form, quantities, options.drive).of(out.peaks, *curves);
    return out;
}

} // namespace whirl::forced

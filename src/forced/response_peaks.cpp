#include "forced/response_peaks.h"

#include "forced/forced_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace whirl::forced {

namespace {

/// Differences of the reduced rotor's quantities from the whole one's, over this size of them, are
/// reason enough to take the whole rotor's motion in.
constexpr double agreed = 1e-9;

/// The whole rotor against the reduced one, at the speeds that decide.
class Comparison {
  public:
    /// Relative, of a quantity.
    struct Difference {
        double significant =
            0;               ///< largest one that is more than rounding of the whole rotor's motion
        double rounding = 0; ///< of that motion, and the largest difference that it hides
    };

    Comparison(const assembly::Discretization &discretization, results::Form form,
               const std::vector<Quantity> &quantities, const Drive &drive)
        : _quantities(quantities), _full(discretization, form, drive) {}

    /// Solves the whole rotor; false at a resonance without damping.
    bool solve(double speed) { return solves(_full, speed); }

    [[nodiscard]] Eigen::MatrixXcd motion() { return _full.planar_motion(); }

    /// At the speed solved last.
    [[nodiscard]] Difference difference(const ReducedMotion &reduced, double speed) const {
        const std::vector<Reading> readings = reduced.at(speed);
        Difference out;
        double hidden = 0;
        for (std::size_t i = 0; i < readings.size(); ++i) {
            const Phasor &mine = readings[i].value;
            const Phasor whole = _full.of(_quantities[i]);
            const double size = std::hypot(std::abs(whole.x), std::abs(whole.y));
            const double apart = std::hypot(std::abs(mine.x - whole.x), std::abs(mine.y - whole.y));
            const bool significant =
                apart > _full.rounding() * std::max(size, readings[i].cancelled);
            double &largest = significant ? out.significant : hidden;
            if (apart > 0)
                largest = std::max(largest, apart / size);
        }
        out.rounding = _full.rounding() + hidden;
        return out;
    }

  private:
    const std::vector<Quantity> &_quantities;
    ForcedMotion _full;
};

/// Where the reduced rotor is compared: the resonances, half-power points beside them, the ends,
/// and evenly between these: curves and peaks without a resonance of their own are right there too.
/// @param half_power_too  false: without the half-power points and what is between
std::vector<double> telling_speeds(const std::vector<Resonance> &resonances, double from, double to,
                                   bool half_power_too) {
    std::vector<double> speeds{from < 0 ? (2 * from + to) / 3 : (from + 2 * to) / 3,
                               from < 0 ? from : to};
    const auto add = [&](double speed) {
        if (speed > from && speed < to)
            speeds.push_back(speed);
    };
    constexpr int evenly = 6; // parts of the range, for speeds between the resonances
    for (int k = 1; half_power_too && k < evenly; ++k)
        add(from + (to - from) * k / evenly);
    for (const Resonance &r : resonances) {
        constexpr double too_damped = 0.3; // no peak of its own: between the others
        if (r.width > too_damped * std::abs(r.speed))
            continue;
        const double apart = std::max(r.width, 1e-6 * std::abs(r.speed));
        for (const double place : {-1.0, 0.0, 1.0})
            if (place == 0 ? r.width > 1e-9 * std::abs(r.speed) : half_power_too)
                add(r.speed + place * apart);
    }
    std::ranges::sort(speeds);
    speeds.erase(std::unique(speeds.begin(), speeds.end(),
                             [](double a, double b) {
                                 return b - a < 1e-9 * std::max(std::abs(a), std::abs(b));
                             }),
                 speeds.end());
    return speeds;
}

/// What rounding leaves of a motion that the shapes have already is not new.
constexpr double newness_of_rounding = 1e-8;

/// Takes motions in, all that is new of them where the most of that is not enough.
/// @returns whether any of them was news
bool widened(ReducedMotion &reduced, const Eigen::MatrixXcd &motions) {
    constexpr double most = 1e-6; // the error of the response is the square of what is left out
    const int before = reduced.size();
    for (const double newness : {most, newness_of_rounding})
        if (motions.cols() > 0 && reduced.size() == before)
            reduced.take_in(motions, newness);
    return reduced.size() > before;
}

/// The whole rotor and the reduced one compared at some speeds.
struct Compared {
    bool news = false; ///< a motion of the whole rotor widened the reduced one
    double worst = 0;  ///< largest difference that is more than rounding, before
    std::vector<std::pair<double, double>> rounding; ///< speed, rad/s, and what rounding hides
};

/// Compares at speeds and widens the reduced rotor by the motions of the whole one where the two
/// differ by more than `enough`. If the motion at the worst is no news, the rounding of the
/// matrices tells them apart, and the others are not asked.
Compared widened_at(ReducedMotion &reduced, Comparison &whole, const std::vector<double> &speeds,
                    double enough) {
    Compared out;
    if (reduced.whole())
        return out;
    constexpr double plainly = 1e-5; // no rounding
    Eigen::MatrixXcd motions;
    const auto keep = [&motions](const Eigen::MatrixXcd &motion) {
        motions.conservativeResize(motion.rows(), motions.cols() + motion.cols());
        motions.rightCols(motion.cols()) = motion;
    };
    std::vector<std::pair<double, double>> apart; // difference, speed
    for (const double speed : speeds) {
        reduced.enter_piece(speed);
        if (!whole.solve(speed))
            continue;
        const Comparison::Difference difference = whole.difference(reduced, speed);
        out.worst = std::max(out.worst, difference.significant);
        out.rounding.emplace_back(speed, difference.rounding);
        if (difference.significant > plainly)
            keep(whole.motion());
        else if (difference.significant > enough)
            apart.emplace_back(difference.significant, speed);
    }
    std::sort(apart.rbegin(), apart.rend());
    for (const auto &[difference, speed] : apart) {
        if (!whole.solve(speed))
            continue;
        const Eigen::MatrixXcd motion = whole.motion();
        if (motions.cols() == 0 && !reduced.lacks(motion, newness_of_rounding))
            return out;
        keep(motion);
    }
    out.news = widened(reduced, motions);
    return out;
}

/// What rounding hides at the speeds compared, ascending, is not distinguished from an error of the
/// peaks that they stand for.
void add_rounding(const std::vector<std::pair<double, double>> &hidden, std::vector<Peak> &peaks) {
    if (hidden.empty())
        return;
    for (Peak &peak : peaks) {
        auto at = std::upper_bound(hidden.begin(), hidden.end(), std::pair(peak.speed, 2.0));
        peak.rounding += (at == hidden.begin() ? at : std::prev(at))->second;
    }
}

/// Of the speeds looked at those that a picture needs: a quantity has changed, or some way is made.
std::vector<PeakSearch::Sample> drawn(const PeakSearch &search, double from, double to) {
    constexpr double seen = 0.03;   // of a value
    constexpr double turned = 0.15; // of a phase, rad: at a peak the value stands still
    constexpr double steps = 300;   // at least, over the range
    std::vector<PeakSearch::Sample> out;
    // A curve without limit is drawn up to 3e-4 beside it.
    const auto without_limit = [&](double speed) {
        return std::ranges::any_of(search.resonances(), [speed](const Resonance &r) {
            return r.undamped() && std::abs(r.speed - speed) < 3e-4 * std::abs(speed);
        });
    };
    for (const PeakSearch::Sample &s : search.samples()) {
        if (s.speed < from || s.speed > to || without_limit(s.speed))
            continue;
        bool keep = out.empty() || s.speed - out.back().speed > (to - from) / steps;
        for (std::size_t i = 0; !keep && i < s.value.size(); ++i)
            keep = std::abs(s.value[i] - out.back().value[i]) > seen * s.value[i] ||
                   std::abs(std::remainder(s.phase[i] - out.back().phase[i],
                                           2 * std::numbers::pi)) > turned;
        if (keep)
            out.push_back(s);
    }
    return out;
}

} // namespace

std::vector<double> compared_speeds(std::vector<Peak> peaks) {
    std::ranges::sort(peaks, {}, &Peak::speed);
    std::vector<double> out;
    constexpr double near_enough = 0.1; // of the width
    for (const Peak &peak : peaks)
        if (std::isfinite(peak.value) &&
            (out.empty() || peak.speed - out.back() > near_enough * peak.width))
            out.push_back(peak.speed);
    return out;
}

CertifiedPeaks response_peaks(const assembly::Discretization &discretization, results::Form form,
                              const std::vector<Quantity> &quantities, double from, double to,
                              const PeakOptions &options) {
    constexpr int most_rounds = 6; // a guard: each adds the motions at the worst speeds
    ReducedMotion reduced(discretization, form, std::max(std::abs(from), std::abs(to)), quantities,
                          options.drive, options.reduction);
    Comparison whole(discretization, form, quantities, options.drive);
    CertifiedPeaks out;
    // A difference at a resonance is as much as its pole is off, in widths: by so little the
    // resonances are where they are for this comparison.
    constexpr double moved = 0.1;
    std::vector<Resonance> resonances;
    for (int round = 0; round < most_rounds; ++round) {
        if (round == 0 || out.reduction_error > moved)
            resonances = resonances_about(reduced, from, to);
        // First the motions at the resonances, which decide most of those next to them.
        const Compared at =
            widened_at(reduced, whole, telling_speeds(resonances, from, to, round > 0),
                       agreed / 10); // so that peaks between agree as well
        out.reduction_error = at.worst;
        if (!at.news && round > 0)
            break;
    }
    std::optional<PeakSearch> search;
    Compared at_peaks;
    for (int round = 0;; ++round) { // and at the peaks found, which need not be at resonances
        search.emplace(reduced, from, to);
        at_peaks = widened_at(reduced, whole, compared_speeds(search->peaks()), agreed);
        if (round >= most_rounds || !at_peaks.news)
            break;
    }
    out.reduction_error = std::max(out.reduction_error, at_peaks.worst);
    out.peaks = search->peaks();
    add_rounding(at_peaks.rounding, out.peaks);
    out.curve = drawn(*search, from, to);
    out.shapes = reduced.size();
    if (options.with_errors)
        out.errors =
            PeakError(discretization, form, quantities, options.drive).of(out.peaks, reduced);
    return out;
}

} // namespace whirl::forced

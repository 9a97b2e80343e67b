#include "tracking/locked_whirl.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace whirl::tracking {

namespace {

/// A speed and how many motions are locked there.
struct Count {
    double speed = 0;
    std::ptrdiff_t motions = 0;
};

Count count_at(const modes::SpectrumSolver &solver, double speed, int wanted) {
    const modes::Spectrum spectrum = solver.at(speed, wanted);
    return {speed,
            std::count_if(spectrum.modes.begin(), spectrum.modes.end(),
                          [speed](const modes::WhirlMode &mode) { return locked(mode, speed); })};
}

/// Beside a branch point the frequency seen from the rotor grows with the square root of the
/// distance: four times as far away some motion has twice of it, at the same damping.
bool is_branch_point(const modes::SpectrumSolver &solver, const LockEnd &end, int wanted) {
    const double step = end.outside - end.speed;
    const modes::Spectrum near = solver.at(end.outside, wanted);
    const modes::Spectrum far = solver.at(end.speed + 4 * step, wanted);
    const double size = std::abs(end.speed);
    const auto parts_there = [size](const modes::WhirlMode &a, const modes::WhirlMode &b) {
        const double ratio = b.frequency_rotating / a.frequency_rotating;
        return a.frequency_rotating != 0 && std::abs(a.frequency_rotating) < 0.01 * size &&
               std::abs(ratio - 2) < 0.01 &&
               std::abs(a.eigenvalue.real() - b.eigenvalue.real()) < 1e-4 * size;
    };
    return std::any_of(near.modes.begin(), near.modes.end(), [&](const modes::WhirlMode &a) {
        return std::any_of(far.modes.begin(), far.modes.end(),
                           [&](const modes::WhirlMode &b) { return parts_there(a, b); });
    });
}

/// Halves a part over which the number changes. Of several ends in it one is found.
std::optional<LockEnd> end_between(const modes::SpectrumSolver &solver, Count a, Count b,
                                   int wanted) {
    for (int step = 0;
         step < 60 && std::abs(b.speed - a.speed) > 1e-11 * std::max(std::abs(a.speed), 1e-300);
         ++step) {
        const Count middle = count_at(solver, (a.speed + b.speed) / 2, wanted);
        (middle.motions == a.motions ? a : b) = middle;
    }
    // Far enough outside that the meeting eigenvalues are apart by much more than their rounding.
    constexpr double beside = 1e-7;
    const double outwards = (a.motions < b.motions) == (a.speed < b.speed) ? -1 : 1;
    const LockEnd end{a.motions > b.motions ? a.speed : b.speed,
                      a.speed + outwards * beside * std::abs(a.speed)};
    return is_branch_point(solver, end, wanted) ? std::optional(end) : std::nullopt;
}

} // namespace

bool locked(const modes::WhirlMode &mode, double speed) {
    return mode.frequency_rotating == 0 && speed != 0 && mode.eigenvalue.imag() == std::abs(speed);
}

std::vector<LockEnd> lock_ends(const modes::SpectrumSolver &solver, double from, double to,
                               int parts, int wanted) {
    std::vector<LockEnd> ends;
    Count last = count_at(solver, from, wanted);
    for (int part = 1; part <= parts; ++part) {
        const Count next = count_at(solver, from + (to - from) * part / parts, wanted);
        if (last.motions != next.motions)
            if (const std::optional<LockEnd> end = end_between(solver, last, next, wanted))
                ends.push_back(*end);
        last = next;
    }
    return ends;
}

std::vector<LockEnd> lock_ends_over(const modes::SpectrumSolver &solver, double from, double to,
                                    int wanted) {
    constexpr int parts = 200;
    const double low = std::min(from, to);
    const double high = std::max(from, to);
    const double margin = 1e-3 * (high - low) / parts;
    std::vector<LockEnd> all;
    for (const auto &[a, b] :
         {std::pair(low, std::min(high, -margin)), std::pair(std::max(low, margin), high)}) {
        if (!(a < b))
            continue;
        const int share = static_cast<int>(std::ceil(parts * (b - a) / (high - low)));
        const std::vector<LockEnd> ends = lock_ends(solver, a, b, share, wanted);
        all.insert(all.end(), ends.begin(), ends.end());
    }
    return all;
}

} // namespace whirl::tracking

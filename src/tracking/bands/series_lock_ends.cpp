#include "tracking/bands/branch_point.h"
#include "tracking/bands/locked_whirl.h"
#include "tracking/crossing_step.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace whirl::tracking {

namespace {

/// With a speed far enough outside that the meeting eigenvalues are apart by much more than their
/// rounding.
LockEnd at_branch_point(double speed, bool opens) {
    // Of the speed: eigenvalues differ by the root of it, 3e-4, far above rounding.
    constexpr double offset = 1e-7;
    return {speed, speed + (opens ? -1 : 1) * offset * std::abs(speed), 0, {}};
}

/// Beside a branch point the frequency seen from the rotor grows with the square root of the
/// distance: four times as far away some motion has twice of it, at the same damping. The real part
/// at the branch point, or none where there is no such motion: it is smooth on the outer side.
std::optional<double> real_at_branch_point(const modes::SpectrumSolver &solver, const LockEnd &end,
                                           int wanted) {
    const double step = end.outside - end.speed;
    const modes::Spectrum near = solver.at(end.outside, wanted, modes::Errors::of_right_vectors);
    const modes::Spectrum far =
        solver.at(end.speed + 4 * step, wanted, modes::Errors::of_right_vectors);
    const double size = std::abs(end.speed);
    const auto turn = [&](const modes::WhirlMode &mode, const modes::Spectrum &spectrum) {
        return turn_in_rotor(mode, spectrum.speed, solver.form());
    };
    const auto parts_there = [&](const modes::WhirlMode &a, const modes::WhirlMode &b) {
        const double from = turn(a, near);
        return from != 0 && from < 0.01 * size && std::abs(turn(b, far) / from - 2) < 0.05 &&
               std::abs(a.eigenvalue.real() - b.eigenvalue.real()) < 1e-4 * size;
    };
    for (const modes::WhirlMode &a : near.modes)
        for (const modes::WhirlMode &b : far.modes)
            if (parts_there(a, b))
                return (4 * a.eigenvalue.real() - b.eigenvalue.real()) / 3;
    return std::nullopt;
}

/// How fast the slowest of those that are not locked turns in the rotor, rad/s.
double slowest(const Count &count) {
    return count.others.empty()
               ? std::abs(count.speed)
               : turn_in_rotor(count.others.front(), count.speed, results::Form::hill);
}

/// Some motion turns less and less towards a speed that far away, so that it may stand before it.
/// Motions on higher multiples than these stand in the rotor as aliases that hardly deflect: they
/// are not of the bands of 1x, and fast ones pass such multiples at every few speeds.
bool slows_down(const modes::Spectrum &from, const Eigen::VectorXcd &rates, double way) {
    constexpr double farther = 1.5;        // than its slope leads
    constexpr double highest_multiple = 3; // 1x and 3x, as said above
    for (std::size_t i = 0; i < from.modes.size(); ++i) {
        if (locked(from.modes[i], from.speed))
            continue;
        const double turn = turn_in_rotor(from.modes[i], from.speed, results::Form::hill);
        // Still in the rotor is on an odd multiple of the speed in the fixed frame.
        const double frequency = from.modes[i].eigenvalue.imag();
        const double size = std::abs(from.speed);
        const double multiple = 2 * std::round((frequency / size - 1) / 2) + 1;
        if (multiple > highest_multiple)
            continue;
        const double slope =
            std::copysign(1.0, frequency - multiple * size) *
            (rates(static_cast<Eigen::Index>(i)).imag() - std::copysign(multiple, from.speed));
        if (std::isfinite(slope) ? turn + farther * slope * way < 0
                                 : turn < farther * std::abs(way))
            return true;
    }
    return false;
}

/// A band that opens and closes between two speeds: outside it a motion turns by no more than about
/// as much as the speed is away.
bool may_hide_band(const Count &a, const Count &b) {
    // A motion locked at its end moves with slope 1 in rotating axes; half as much again allows
    // for bending.
    constexpr double steepest = 1.5;
    const double width = b.speed - a.speed;
    return slowest(a) + slowest(b) < steepest * width;
}

/// Modes to ask for so that those that stand between two speeds, and those that may begin to, are
/// among them.
int modes_in_play(const Count &a, const Count &b) {
    constexpr int more = 4; // modes that may come in from above within the step
    // Of the highest one at the ends: how far others may come down within the step.
    constexpr double above = 1.5;
    const double speed = std::max(std::abs(a.speed), std::abs(b.speed));
    const double width = b.speed - a.speed;
    // In a part as wide as a good share of the speed all turn slowly.
    const double fastest = width < 0.05 * speed ? HUGE_VAL : 2 * speed;
    double highest = speed;
    for (const Count *here : {&a, &b})
        for (const modes::WhirlMode &mode : here->others)
            if (turn_in_rotor(mode, here->speed, results::Form::hill) < 2 * width &&
                mode.eigenvalue.imag() < fastest)
                highest = std::max(highest, mode.eigenvalue.imag());
    std::ptrdiff_t out = 0;
    for (const Count *here : {&a, &b})
        out = std::max(out, here->motions + std::ranges::count_if(
                                                here->others, [&](const modes::WhirlMode &mode) {
                                                    return mode.eigenvalue.imag() < above * highest;
                                                }));
    return static_cast<int>(out) + more;
}

/// All ends in a part, for a Hill series: others than one that was found are on its two sides, by
/// the numbers of locked motions, or how slow the others are.
void add_series_ends(const modes::SpectrumSolver &solver, const Count &a, const Count &b,
                     int wanted, int halves, std::vector<LockEnd> &ends) {
    // Halvings: 1/256 of a step; narrower bands are left out, as the notes say.
    constexpr int most = 8;
    if (halves > most || (a.motions == b.motions && !may_hide_band(a, b)))
        return;
    if (a.motions != b.motions)
        if (const std::optional<LockEnd> end = end_in_series(solver, a, b, wanted)) {
            ends.push_back(*end);
            const double offset = std::abs(end->outside - end->speed);
            add_series_ends(solver, a, count_at(solver, end->speed - offset, wanted), wanted,
                            halves + 1, ends);
            add_series_ends(solver, count_at(solver, end->speed + offset, wanted), b, wanted,
                            halves + 1, ends);
            return;
        }
    const Count middle = count_at(solver, a.speed + (b.speed - a.speed) / 2, wanted);
    add_series_ends(solver, a, middle, wanted, halves + 1, ends);
    add_series_ends(solver, middle, b, wanted, halves + 1, ends);
}

} // namespace

std::optional<LockEnd> end_in_series(const modes::SpectrumSolver &solver, const Count &from,
                                     const Count &to, int wanted) {
    const bool leaves = from.motions > to.motions;
    const Count &inside = leaves ? from : to;
    const Count &outside = leaves ? to : from;
    const auto square = [&](const Count &here) {
        return here.motions > outside.motions ? -here.split * here.split
                                              : slowest(here) * slowest(here);
    };
    const std::optional<BranchPoint> found =
        branch_point({inside.speed, square(inside)}, {outside.speed, square(outside)}, resolved,
                     [&](double speed) { return square(count_at(solver, speed, wanted)); });
    if (!found)
        return std::nullopt;
    LockEnd end = at_branch_point(found->inside, inside.speed > outside.speed);
    const std::optional<double> real = real_at_branch_point(solver, end, wanted);
    if (!real)
        return std::nullopt;
    end.real = *real;
    return end;
}

std::vector<LockEnd> lock_ends(const modes::SpectrumSolver &solver, const modes::Spectrum &from,
                               const Eigen::VectorXcd &rates_from, const modes::Spectrum &to,
                               const Eigen::VectorXcd &rates_to) {
    const Count a = count_of(solver, from);
    const Count b = count_of(solver, to);
    std::vector<LockEnd> ends;
    const double way = to.speed - from.speed;
    if (a.motions != b.motions ||
        (slows_down(from, rates_from, way) && slows_down(to, rates_to, -way)))
        add_series_ends(solver, a, b, modes_in_play(a, b), 0, ends);
    return ends;
}

} // namespace whirl::tracking

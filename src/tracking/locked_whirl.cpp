#include "tracking/locked_whirl.h"

#include "assembly/rotating_system.h"
#include "balancers/arrangement.h"
#include "linalg/check.h"
#include "linalg/quadratic_eigen.h"
#include "modes/zero_modes.h"
#include "results/formulation.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
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
/// distance: four times as far away some motion has twice of it, at the same damping. The real part
/// at the branch point, or none where there is no such motion: it is smooth on the outer side.
std::optional<double> real_at_branch_point(const modes::SpectrumSolver &solver, const LockEnd &end,
                                           int wanted) {
    const double step = end.outside - end.speed;
    const modes::Spectrum near = solver.at(end.outside, wanted);
    const modes::Spectrum far = solver.at(end.speed + 4 * step, wanted);
    const double size = std::abs(end.speed);
    const auto parts_there = [size](const modes::WhirlMode &a, const modes::WhirlMode &b) {
        const double ratio = b.frequency_rotating / a.frequency_rotating;
        return a.frequency_rotating != 0 && std::abs(a.frequency_rotating) < 0.01 * size &&
               std::abs(ratio - 2) < 0.05 &&
               std::abs(a.eigenvalue.real() - b.eigenvalue.real()) < 1e-4 * size;
    };
    for (const modes::WhirlMode &a : near.modes)
        for (const modes::WhirlMode &b : far.modes)
            if (parts_there(a, b))
                return (4 * a.eigenvalue.real() - b.eigenvalue.real()) / 3;
    return std::nullopt;
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
    LockEnd end{a.motions > b.motions ? a.speed : b.speed,
                a.speed + outwards * beside * std::abs(a.speed)};
    const std::optional<double> real = real_at_branch_point(solver, end, wanted);
    if (!real)
        return std::nullopt;
    end.real = *real;
    return end;
}

/// Ends among the parts between speeds of one sign, in ascending or descending order.
std::vector<LockEnd> ends_among(const modes::SpectrumSolver &solver,
                                const std::vector<double> &speeds, int wanted) {
    std::vector<LockEnd> ends;
    Count last = count_at(solver, speeds.front(), wanted);
    for (std::size_t i = 1; i < speeds.size(); ++i) {
        const Count next = count_at(solver, speeds[i], wanted);
        if (last.motions != next.motions)
            if (const std::optional<LockEnd> end = end_between(solver, last, next, wanted))
                ends.push_back(*end);
        last = next;
    }
    return ends;
}

/// Speeds near which something stands still in the rotor: with l = 0 the equations in rotating axes
/// are (K + s Ks + s^2 Kss) x = 0, whose roots s are real without damping and have the middle of a
/// band as their real part with little of it. Empty where they cannot be had.
std::vector<double> standing_speeds(const modes::SpectrumSolver &solver, int wanted) {
    const assembly::Discretization &d = solver.discretization();
    const model::Rotor &rotor = d.rotor();
    if (solver.form() != results::Form::rotating || rotor.bearings_depend_on_speed())
        return {};
    const assembly::RotatingSystem system = assembly::assemble_rotating(
        d, 0, balancers::balancer_elements(rotor, balancers::arrangement_at_balance(rotor)), true);
    linalg::QuadraticOptions options;
    options.shift = 0.3 * modes::support_scale(d);
    options.fewest = 1;
    options.wanted = std::min(2 * wanted, 2 * system.K.size());
    std::vector<double> speeds;
    try {
        for (const linalg::ComplexPair &pair :
             linalg::solve_quadratic(system.Kss, system.Ks, system.K, options).pairs)
            speeds.push_back(std::abs(pair.value.real()));
    } catch (const linalg::SolverError &) {
        speeds.clear(); // they only help
    }
    return speeds;
}

} // namespace

bool locked(const modes::WhirlMode &mode, double speed) {
    return mode.frequency_rotating == 0 && speed != 0 && mode.eigenvalue.imag() == std::abs(speed);
}

std::vector<LockEnd> lock_ends(const modes::SpectrumSolver &solver, double from, double to,
                               int parts, int wanted) {
    std::vector<double> speeds;
    for (int part = 0; part <= parts; ++part)
        speeds.push_back(from + (to - from) * part / parts);
    return ends_among(solver, speeds, wanted);
}

std::vector<LockEnd> lock_ends_over(const modes::SpectrumSolver &solver, double from, double to,
                                    int wanted) {
    constexpr int parts = 200;
    const double low = std::min(from, to);
    const double high = std::max(from, to);
    const double margin = 1e-3 * (high - low) / parts;
    const std::vector<double> standing = standing_speeds(solver, wanted);
    std::vector<LockEnd> all;
    for (const auto &[a, b] :
         {std::pair(low, std::min(high, -margin)), std::pair(std::max(low, margin), high)}) {
        if (!(a < b))
            continue;
        const int share = static_cast<int>(std::ceil(parts * (b - a) / (high - low)));
        std::set<double> speeds{b};
        for (int part = 0; part < share; ++part)
            speeds.insert(a + (b - a) * part / share);
        for (const double s : standing)
            if (const double signed_speed = std::copysign(s, b <= 0 ? -1 : 1);
                signed_speed > a && signed_speed < b)
                speeds.insert(signed_speed);
        const std::vector<LockEnd> ends =
            ends_among(solver, {speeds.begin(), speeds.end()}, wanted);
        all.insert(all.end(), ends.begin(), ends.end());
    }
    return all;
}

} // namespace whirl::tracking

#include "tracking/bands/locked_whirl.h"

#include "assembly/frequency_scales.h"
#include "assembly/rotating_system.h"
#include "balancers/arrangement.h"
#include "linalg/check.h"
#include "linalg/quadratic/quadratic_eigen.h"
#include "model/errors.h"
#include "modes/roots/double_root.h"
#include "reduction/projection.h"
#include "results/formulation.h"
#include "tracking/crossing_step.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

namespace whirl::tracking {

namespace {

using DoubleRoot = modes::DoubleRoot<double>;

/// The locked motion at an end still counts as whirl.
bool whirls(const DoubleRoot &end) {
    return std::abs(end.speed) > modes::real_axis * std::hypot(end.speed, end.value);
}

/// Ends inside a part, each once, ascending: those to which the motions lead that turn least at one
/// of its borders.
std::vector<DoubleRoot> roots_between(const modes::SpectrumSolver &solver, const Count &a,
                                      const Count &b) {
    // Slowest motions: those that may meet; each costs a Newton iteration.
    constexpr std::size_t most = 6;
    const auto problem_at = [&solver](double speed) { return solver.problem_at(speed); };
    std::vector<DoubleRoot> out;
    for (const Count *from : {&a, &b})
        for (std::size_t i = 0; i < std::min(most, from->others.size()); ++i) {
            const modes::WhirlMode &mode = from->others[i];
            const auto root =
                modes::double_root<double>(problem_at, from->speed, mode.rotating_value.real(),
                                           mode.rotating_vector.real(), b.speed - a.speed);
            if (root && root->speed > a.speed && root->speed < b.speed && whirls(*root) &&
                std::ranges::none_of(out, [&](const DoubleRoot &other) {
                    // Without damping motions that grow and die out alike meet at one speed.
                    return std::abs(other.speed - root->speed) <
                               1e-9 * std::abs(other.speed) + 2 * root->noise &&
                           std::abs(other.value - root->value) < 1e-7 * std::abs(other.speed);
                }))
                out.push_back(*root);
        }
    std::ranges::sort(out, {}, &DoubleRoot::speed);
    return out;
}

LockEnd end_of(const DoubleRoot &root) {
    // Far enough outside that the meeting eigenvalues are apart by much more than their rounding.
    constexpr double offset = 1e-7;
    const double outwards = root.opens ? -1 : 1;
    const bool undamped = std::abs(root.value) <= resolved * std::abs(root.speed);
    return {root.speed,
            root.speed + outwards * std::max(offset * std::abs(root.speed), 10 * root.noise),
            undamped ? 0 : root.value, root.shape};
}

/// The roots account for the numbers at both borders, half way between each two neighbours, and
/// next to each of them: what has left a band may be caught by another motion close by.
bool explained(const modes::SpectrumSolver &solver, const Count &a, const Count &b, int wanted,
               const std::vector<DoubleRoot> &roots) {
    constexpr double together = 1e-8;   // as where motions meet that grow and die out alike
    constexpr double next_to = 1. / 16; // of the part
    const auto opened =
        std::ranges::count_if(roots, [](const DoubleRoot &root) { return root.opens; });
    if (roots.empty() || a.motions + 2 * opened - std::ssize(roots) != b.motions)
        return false;
    const double aside = next_to * (b.speed - a.speed);
    std::ptrdiff_t expected = a.motions;
    for (std::size_t i = 0; i <= roots.size(); ++i) {
        const double from = i == 0 ? a.speed : roots[i - 1].speed;
        const double to = i == roots.size() ? b.speed : roots[i].speed;
        std::vector<double> speeds;
        if (to - from >= together * std::abs(to)) // else at one speed
            speeds.push_back((from + to) / 2);
        if (to - from > 2 * aside && i > 0)
            speeds.push_back(from + aside);
        if (to - from > 2 * aside && i < roots.size())
            speeds.push_back(to - aside);
        for (const double speed : speeds)
            if (count_at(solver, speed, wanted).motions != expected)
                return false;
        if (i < roots.size())
            expected += roots[i].opens ? 1 : -1;
    }
    return true;
}

/// All ends in a part over which the number changes: halved until the roots in it account for that.
void add_ends(const modes::SpectrumSolver &solver, const Count &a, const Count &b, int wanted,
              int halves, std::vector<LockEnd> &ends) {
    constexpr int most = 6; // beyond, it changes by rounding or by heavy damping
    if (a.motions == b.motions || halves > most)
        return;
    if (solver.form() == results::Form::hill) {
        if (const std::optional<LockEnd> end = end_in_series(solver, a, b, wanted))
            ends.push_back(*end);
        return;
    }
    const std::vector<DoubleRoot> roots = roots_between(solver, a, b);
    if (explained(solver, a, b, wanted, roots)) {
        std::transform(roots.begin(), roots.end(), std::back_inserter(ends), end_of);
        return;
    }
    const Count middle = count_at(solver, a.speed + (b.speed - a.speed) / 2, wanted);
    add_ends(solver, a, middle, wanted, halves + 1, ends);
    add_ends(solver, middle, b, wanted, halves + 1, ends);
}

/// Ends among the parts between speeds of one sign, ascending.
std::vector<LockEnd> ends_among(const modes::SpectrumSolver &solver,
                                const std::vector<double> &speeds, int wanted) {
    std::vector<LockEnd> ends;
    Count last = count_at(solver, speeds.front(), wanted);
    for (std::size_t i = 1; i < speeds.size(); ++i) {
        Count next = count_at(solver, speeds[i], wanted);
        add_ends(solver, last, next, wanted, 0, ends);
        last = std::move(next);
    }
    return ends;
}

/// Speeds near which a mode is synchronous: with l = 0 the equations in rotating axes are (K + s Ks
/// + s^2 Kss) x = 0, whose roots s are real without damping and have the middle of a band as their
/// real part with little of it. Empty where they cannot be had.
std::vector<double> synchronous_speeds(const modes::SpectrumSolver &solver, int wanted) {
    const assembly::Discretization &d = solver.discretization();
    const model::Rotor &rotor = d.rotor();
    if (solver.form() != results::Form::rotating || rotor.bearings_depend_on_speed())
        return {};
    assembly::RotatingSystem system = assembly::assemble_rotating(
        d, 0, balancers::balancer_elements(rotor, balancers::arrangement_at_balance(rotor)), true);
    if (solver.shapes() != nullptr)
        system = reduction::Projection(*solver.shapes()).of(system);
    linalg::QuadraticOptions options;
    options.shift = 0.3 * assembly::support_scale(d);
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

std::vector<LockEnd> ends_over(const modes::SpectrumSolver &solver, double low, double high,
                               int wanted) {
    // Of the range: the 200th below which the notes say that bands may be missed.
    constexpr int parts = 200;
    // Of the speed: outside the rounding of an undamped root, which is an end itself.
    constexpr double closely = 1e-7;
    const double margin = 1e-3 * (high - low) / parts;
    const std::vector<double> synchronous = synchronous_speeds(solver, wanted);
    std::vector<LockEnd> all;
    for (const auto &[a, b] :
         {std::pair(low, std::min(high, -margin)), std::pair(std::max(low, margin), high)}) {
        if (!(a < b))
            continue;
        const int share = static_cast<int>(std::ceil(parts * (b - a) / (high - low)));
        std::set<double> speeds{b};
        for (int part = 0; part < share; ++part)
            speeds.insert(a + (b - a) * part / share);
        // Next to rest the balls' motions slow down with powers of the speed, until rounding hides
        // how many are locked: the first part in halves, so that ends in it are not lost with that.
        constexpr int halves = 5;
        for (int i = 1; i <= halves; ++i) {
            const double from_rest = std::ldexp((b - a) / share, -i);
            speeds.insert(b <= 0 ? b - from_rest : a + from_rest);
        }
        // On both sides: without damping it is an end itself.
        for (const double s : synchronous)
            for (const double side : {-1.0, 1.0})
                if (const double speed = std::copysign(s * (1 + side * closely), b <= 0 ? -1 : 1);
                    speed > a && speed < b)
                    speeds.insert(speed);
        const std::vector<LockEnd> ends =
            ends_among(solver, {speeds.begin(), speeds.end()}, wanted);
        all.insert(all.end(), ends.begin(), ends.end());
    }
    return all;
}

/// Ends of the reduced rotor refined on the whole one; nothing where one of them has no
/// counterpart.
std::optional<std::vector<LockEnd>> of_whole(const modes::SpectrumSolver &whole,
                                             const modes::SpectrumSolver &reduced,
                                             const std::vector<LockEnd> &ends) {
    constexpr double near = 1e-4; // of the speed
    const auto problem_at = [&whole](double speed) { return whole.problem_at(speed); };
    std::vector<LockEnd> out;
    for (const LockEnd &end : ends) {
        const auto root =
            modes::double_root<double>(problem_at, end.speed, end.real,
                                       reduction::Projection(*reduced.shapes())
                                           .lifted(end.shape.cast<std::complex<double>>())
                                           .real(),
                                       near * std::abs(end.speed));
        if (!root || root->opens != (end.outside < end.speed))
            return std::nullopt;
        out.push_back(end_of(*root));
    }
    return out;
}

/// Ends by a search on the reduced rotor, refined on the whole one; by the whole one where there is
/// no reduced rotor.
template <class Search>
std::vector<LockEnd> by_reduced_rotor(const modes::SpectrumSolver &solver, double from, double to,
                                      int wanted, const Search &search) {
    if (const modes::SpectrumSolver *reduced = solver.reduced_for(from, to, wanted)) {
        try {
            if (auto ends = of_whole(solver, *reduced, search(*reduced)))
                return *std::move(ends);
        } catch (const model::AnalysisFailure &) { // the whole rotor decides
            return search(solver);
        }
    }
    return search(solver);
}

} // namespace

double turn_in_rotor(const modes::WhirlMode &mode, double speed, results::Form form) {
    const bool aliases = form == results::Form::hill && speed != 0;
    return std::abs(aliases ? std::remainder(mode.frequency_rotating, 2 * speed)
                            : mode.frequency_rotating);
}

bool locked(const modes::WhirlMode &mode, double speed) {
    return mode.frequency_rotating == 0 && speed != 0 && mode.eigenvalue.imag() == std::abs(speed);
}

std::ptrdiff_t locked_motions(const modes::Spectrum &spectrum) {
    return std::ranges::count_if(
        spectrum.modes, [&](const modes::WhirlMode &mode) { return locked(mode, spectrum.speed); });
}

double half_of_least_difference(std::vector<double> numbers) {
    std::ranges::sort(numbers);
    double out = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < numbers.size(); ++i)
        out = std::min(out, (numbers[i] - numbers[i - 1]) / 2);
    return out;
}

Count count_of(const modes::SpectrumSolver &solver, const modes::Spectrum &spectrum) {
    const double speed = spectrum.speed;
    Count out{speed, 0, spectrum.modes};
    const auto others =
        std::partition(out.others.begin(), out.others.end(),
                       [speed](const modes::WhirlMode &mode) { return !locked(mode, speed); });
    out.motions = std::distance(others, out.others.end());
    std::vector<double> real;
    for (auto mode = others; mode != out.others.end(); ++mode)
        real.push_back(mode->eigenvalue.real());
    out.split = half_of_least_difference(std::move(real));
    out.others.erase(others, out.others.end());
    const auto turn = [&](const modes::WhirlMode &mode) {
        return turn_in_rotor(mode, speed, solver.form());
    };
    std::ranges::sort(out.others, {}, turn);
    return out;
}

Count count_at(const modes::SpectrumSolver &solver, double speed, int wanted) {
    return count_of(solver, solver.at(speed, wanted, modes::Errors::of_right_vectors));
}

std::vector<LockEnd> lock_ends(const modes::SpectrumSolver &solver, double from, double to,
                               int wanted) {
    return by_reduced_rotor(solver, from, to, wanted, [=](const modes::SpectrumSolver &rotor) {
        return ends_among(rotor, {from, to}, wanted);
    });
}

std::vector<LockEnd> lock_ends_over(const modes::SpectrumSolver &solver, double from, double to,
                                    int wanted) {
    return by_reduced_rotor(solver, from, to, wanted, [=](const modes::SpectrumSolver &rotor) {
        return ends_over(rotor, from, to, wanted);
    });
}

} // namespace whirl::tracking

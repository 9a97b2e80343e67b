#include "synchronous/critical_speeds.h"

#include "assembly/frequency_scales.h"
#include "assembly/planes.h"
#include "linalg/check.h"
#include "modes/orbits.h"
#include "modes/solver/degenerate.h"
#include "results/formulation.h"
#include "results/whirl.h"
#include "synchronous/followed.h"
#include "synchronous/parts.h"
#include "synchronous/problem.h"
#include "synchronous/reduced.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace whirl::synchronous {

namespace {

using assembly::Discretization;

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// Modes that rounding does not distinguish have one eigenvalue, so that their mixtures are
/// separated.
/// @param modes  ascending
void join_indistinct(std::vector<modes::WhirlMode> &modes) {
    const auto noise = [](const modes::WhirlMode &mode) { return mode.residual + mode.rounding; };
    for (std::size_t i = 1; i < modes.size(); ++i) {
        modes::WhirlMode &a = modes[i - 1];
        modes::WhirlMode &b = modes[i];
        if (std::abs(a.eigenvalue - b.eigenvalue) < (noise(a) + noise(b)) * std::abs(b.eigenvalue))
            a.eigenvalue = b.eigenvalue = (a.eigenvalue + b.eigenvalue) / 2.0;
    }
}

void set_sense(const Discretization &d, bool hyperbolic, int spin,
               std::vector<modes::WhirlMode> &modes) {
    const modes::Stations stations = modes::Stations::for_orbits(d);
    const std::complex<double> factor = hyperbolic ? std::complex<double>(0, spin) : 1;
    const auto deflections = [&](const modes::WhirlMode &mode) {
        const assembly::Planes planes(mode.shape);
        return std::pair(stations.deflections(planes.x),
                         Eigen::VectorXcd(factor * stations.deflections(planes.y)));
    };
    modes::separate_degenerate(deflections, stations, hyperbolic, modes);
    for (modes::WhirlMode &mode : modes) {
        const auto [x, y] = deflections(mode);
        const modes::OrbitSense sense = modes::orbit_sense(x, y, stations, spin);
        mode.whirl = sense.whirl;
        mode.forward_fraction = sense.forward_fraction;
        mode.plane = sense.plane;
    }
}

void set_forward(std::vector<modes::WhirlMode> &modes, bool forward) {
    for (modes::WhirlMode &mode : modes) {
        mode.whirl = forward ? results::Whirl::forward : results::Whirl::backward;
        mode.forward_fraction = forward ? 1 : 0;
    }
}

void name_whirl(const Discretization &d, results::Form form, int spin,
                std::vector<modes::WhirlMode> &modes) {
    if (form == results::Form::rotating)
        set_forward(modes, true);
    else {
        join_indistinct(modes);
        set_sense(d, form == results::Form::hyperbolic, spin, modes);
    }
}

std::vector<int> senses_of(results::Form form) {
    return form == results::Form::planar ? std::vector{1, -1} : std::vector{1};
}

/// @param list  with a branch each
void sort_ascending(SynchronousModes &list) {
    std::vector<std::size_t> order(list.modes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {},
                             [&](std::size_t i) { return list.modes[i].eigenvalue.imag(); });
    SynchronousModes sorted;
    for (const std::size_t i : order) {
        sorted.modes.push_back(list.modes[i]);
        sorted.branches.push_back(list.branches[i]);
    }
    list.modes = std::move(sorted.modes);
    list.branches = std::move(sorted.branches);
}

/// Shapes up to a frequency; more where less does not hold the rotor against bearings that push
/// away.
SharedShapes shapes_up_to(const Discretization &d, double top, int modes) {
    // The last holds bearings that push away up to 256 times the first frequency.
    constexpr int most_attempts = 5;
    for (int attempt = 1;; ++attempt, top *= 4)
        try {
            return synchronous_shapes(d, top, modes);
        } catch (const linalg::SolverError &) {
            if (attempt == most_attempts)
                throw;
        }
}

/// On as many shapes as it takes to have `wanted` roots, and all up to `top`.
SynchronousModes on_shapes(const SynchronousProblem &problem, int wanted, double top,
                           const SharedShapes *shared) {
    const Discretization &d = problem.rotor();
    const WholeRoots roots(problem);
    const int unknowns = d.planar_size();
    double reach = std::max({top, problem.rows().back(), assembly::support_scale(d)});
    if (shared != nullptr && (shared->shapes.rows() != unknowns || shared->reach < reach))
        shared = nullptr;
    constexpr int most_repeats = 2; // where some roots are in doubt
    // Planar unknowns that may all be taken at last, by the dense decomposition that it needs.
    const int few = problem.conservative() ? 200 : 60;
    // In both planes a shape makes two motions, one of which gyroscopic moments may hold off.
    const int at_rest = problem.pairs() ? wanted / 2 + 4 : wanted + 2;
    for (int repeats = 0;; shared = nullptr) {
        SharedShapes own;
        if (shared == nullptr)
            own = repeats > most_repeats ? all_shapes(d, reach) : shapes_up_to(d, reach, at_rest);
        const Eigen::MatrixXd &shapes = shared != nullptr ? shared->shapes : own.shapes;
        reach = shared != nullptr ? shared->reach : own.reach;
        SynchronousModes out = followed_modes(problem, roots, shapes, wanted, top);
        if (shapes.cols() == unknowns)
            return out;
        out.complete_to = std::min(out.complete_to, reach);
        // What lies beyond the roots asked for does not matter.
        double last_asked = std::numeric_limits<double>::infinity();
        if (wanted <= 0)
            last_asked = top;
        else if (std::ssize(out.modes) >= wanted)
            last_asked =
                std::max(top, out.modes[static_cast<std::size_t>(wanted) - 1].eigenvalue.imag());
        std::erase_if(out.doubtful, [&](const auto &range) { return range.first > last_asked; });
        const auto sure = std::ranges::count_if(
            out.modes, [&](const auto &mode) { return mode.eigenvalue.imag() <= reach; });
        const bool enough = sure >= wanted && reach >= top;
        const bool last = repeats == most_repeats && unknowns > few;
        if (enough && (out.doubtful.empty() || last)) {
            out.modes.resize(static_cast<std::size_t>(sure));
            out.branches.resize(out.branches.empty() ? 0 : static_cast<std::size_t>(sure));
            return out;
        }
        repeats += enough ? 1 : 0;
        const bool known = std::ssize(out.modes) >= wanted && wanted > 0;
        const double highest =
            known ? out.modes[static_cast<std::size_t>(wanted) - 1].eigenvalue.imag() : 0;
        reach = !enough && highest > reach ? 1.05 * highest : 2 * reach;
    }
}

/// Roots on shapes in a form, with their sense of whirl.
/// @param bearing_speed  rad/s; none: the bearings as they are at each root
SynchronousModes of_shapes(const Discretization &d, results::Form form, int spin, int wanted,
                           double top, std::optional<double> bearing_speed,
                           const SharedShapes *shared = nullptr) {
    SynchronousModes out;
    out.spin = spin;
    out.complete_to = unlimited;
    for (const int sign : senses_of(form)) {
        SynchronousModes found =
            on_shapes(SynchronousProblem(d, form, spin, sign, bearing_speed), wanted, top, shared);
        if (form == results::Form::planar)
            set_forward(found.modes, sign > 0);
        else
            name_whirl(d, form, spin, found.modes);
        out.modes.insert(out.modes.end(), found.modes.begin(), found.modes.end());
        out.branches.insert(out.branches.end(), found.branches.begin(), found.branches.end());
        out.doubtful.insert(out.doubtful.end(), found.doubtful.begin(), found.doubtful.end());
        out.complete_to = std::min(out.complete_to, found.complete_to);
    }
    if (senses_of(form).size() > 1)
        sort_ascending(out);
    return out;
}

} // namespace

std::vector<modes::WhirlMode> synchronous_modes(const Discretization &d, results::Form form,
                                                double bearing_speed, int wanted) {
    return of_shapes(d, form, 1, wanted, 0, bearing_speed).modes;
}

SynchronousModes all_synchronous_modes(const Discretization &d, results::Form form, int wanted,
                                       double top, const SharedShapes *shared, int spin) {
    return of_shapes(d, form, spin, wanted, top, {}, shared);
}

SharedShapes shared_shapes(const Discretization &d, double reach, int wanted) {
    return shapes_up_to(d, reach, wanted + 2);
}

} // namespace whirl::synchronous

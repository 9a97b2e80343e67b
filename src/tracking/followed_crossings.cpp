#include "tracking/followed_crossings.h"

#include "tracking/crossing_search.h"
#include "tracking/crossing_step.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace whirl::tracking {

namespace {

/// A crossing while it is looked for, the eigenvalue of its motion as a cubic of the speed between
/// the ends of the step.
struct Search {
    FollowedCrossing found;
    StepEnd low, high;
    std::complex<double> a, b, slope_a, slope_b; ///< eigenvalues there and their slopes
    modes::WhirlMode mode;                       ///< of the nearer end, then the last one found

    [[nodiscard]] std::complex<double> guess() const {
        const double h = high.speed - low.speed;
        const double t = (found.speed - low.speed) / h;
        const std::complex<double> rise = b - a;
        return a + t * (h * slope_a + t * (3.0 * rise - h * (2.0 * slope_a + slope_b) +
                                           t * (h * (slope_a + slope_b) - 2.0 * rise)));
    }
    /// Slope of the distance from the multiple there.
    [[nodiscard]] double slope() const {
        const double t = (found.speed - low.speed) / (high.speed - low.speed);
        return low.slope + t * (high.slope - low.slope);
    }
};

/// Whether the distance changes its sign between the ends, well inside of the step, and both slopes
/// and the secant are much alike: it does not turn back.
bool plain(const StepEnd &a, const StepEnd &b) {
    const double secant = (b.distance - a.distance) / (b.speed - a.speed);
    const auto like = [secant](double slope) { // not of what is not a number
        return slope / secant > 0.5 && slope / secant < 2;
    };
    return std::abs(a.distance) > 1e3 * a.tolerance && std::abs(b.distance) > 1e3 * b.tolerance &&
           (a.distance > 0) != (b.distance > 0) && like(a.slope) && like(b.slope);
}

std::optional<Search> search_of(const SweepNodes &nodes, std::size_t k, const Link &link,
                                double multiple) {
    const modes::Spectrum &here = nodes.spectrum(k);
    const modes::Spectrum &next = nodes.spectrum(k + 1);
    const modes::WhirlMode &mode = here.modes[link.from];
    const modes::WhirlMode &later = next.modes[link.to];
    if (mode.eigenvalue.imag() == 0 || later.eigenvalue.imag() == 0 || mode.whirl != later.whirl ||
        here.speed * next.speed <= 0)
        return std::nullopt;
    const StepEnd a = end_of(here, nodes.rates(k).above, link.from, multiple);
    const StepEnd b = end_of(next, nodes.rates(k + 1).below, link.to, multiple);
    if (!plain(a, b))
        return std::nullopt;
    const double share = a.distance / (a.distance - b.distance);
    return Search{{k, link.line, a.speed + share * (b.speed - a.speed), 0},
                  a,
                  b,
                  mode.eigenvalue,
                  later.eigenvalue,
                  nodes.rates(k).above(static_cast<Eigen::Index>(link.from)),
                  nodes.rates(k + 1).below(static_cast<Eigen::Index>(link.to)),
                  share < 0.5 ? mode : later};
}

/// The root of the motion alone. The slope is known well enough for a factor of a hundred in each
/// step, and then from the last two.
/// @returns nothing where it is lost
std::optional<FollowedCrossing> settled(const modes::SpectrumSolver &solver, Search search,
                                        double multiple) {
    // With a factor of 100 each six reach rounding; twice as many for poor slopes.
    constexpr int most_steps = 12;
    constexpr double another = 0.1; // of the step's change, from where the cubic leads
    const double change = std::abs(search.b - search.a);
    double slope = search.slope();
    double last_speed = 0;
    double last_distance = 0;
    for (int step = 0; step < most_steps; ++step) {
        const double speed = search.found.speed;
        if (!(std::abs(speed - search.low.speed) < std::abs(search.high.speed - search.low.speed) &&
              std::abs(speed - search.high.speed) < std::abs(search.high.speed - search.low.speed)))
            return std::nullopt;
        const std::complex<double> expected = search.guess();
        const bool negative = search.mode.rotating_value.imag() < 0;
        search.mode.eigenvalue = expected;
        search.mode.rotating_value = negative ? std::conj(expected) : expected;
        std::vector<modes::WhirlMode> found = solver.near(speed, {search.mode});
        if (found.empty() || !(std::abs(found.front().eigenvalue - expected) <= another * change))
            return std::nullopt;
        search.mode = std::move(found.front());
        const double target = multiple * std::abs(speed);
        const double distance = search.mode.eigenvalue.imag() - target;
        if (step > 0 && speed != last_speed) {
            const double secant = (distance - last_distance) / (speed - last_speed);
            slope = std::isfinite(secant) && secant * slope > 0 ? secant : slope;
        }
        last_speed = speed;
        last_distance = distance;
        search.found.speed -= distance / slope;
        search.found.real = modes::determined_value(search.mode).real();
        if (std::abs(distance) <= std::max(resolved, search.mode.rounding) * target &&
            std::abs(search.found.speed - speed) < 1e3 * resolved * std::abs(speed))
            return search.found;
    }
    return std::nullopt;
}

} // namespace

std::vector<FollowedCrossing> followed_crossings(const SweepNodes &nodes, double multiple) {
    std::vector<FollowedCrossing> out;
    if (!nodes.solver().refines())
        return out;
    for (std::size_t k = 0; k + 1 < nodes.count(); ++k)
        for (const Link &link : nodes.links(k))
            if (const std::optional<Search> search = search_of(nodes, k, link, multiple))
                if (const auto crossing = settled(nodes.solver(), *search, multiple))
                    out.push_back(*crossing);
    return out;
}

} // namespace whirl::tracking

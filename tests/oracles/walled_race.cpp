#include "oracles/walled_race.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>

namespace whirl::oracles {

namespace {

constexpr Real half_turn = std::numbers::pi_v<Real>;

Real bisected(const std::function<Real(Real)> &f, Real low, Real high) {
    const bool above = f(low) > 0;
    for (int step = 0; step < 200; ++step) {
        const Real middle = (low + high) / 2;
        ((f(middle) > 0) == above ? low : high) = middle;
    }
    return (low + high) / 2;
}

/// Where the balls of the race are, and what pushes them.
struct Race {
    Real mass = 0, k = 0, c = 0; ///< of the rotor
    Complex imbalance = 0;
    Real ball = 0, radius = 0, half = 0; ///< half: of the diameter of a ball
    Real ellipticity = 0, long_axis = 0;
    std::vector<double> walls;
    Real speed = 0;

    [[nodiscard]] Complex place(Real a) const {
        return std::polar(radius * (1 + ellipticity * std::cos(2 * (a - long_axis))), a);
    }
    [[nodiscard]] Complex deflection(Real a, Real b) const {
        const Complex D(k - (mass + 2 * ball) * speed * speed, c * speed);
        return speed * speed * (imbalance + ball * (place(a) + place(b))) / D;
    }
    /// How the place changes, m, by differences.
    [[nodiscard]] Complex along(Real a) const {
        constexpr Real h = 1e-4L;
        return (8.0L * (place(a + h) - place(a - h)) - (place(a + 2 * h) - place(a - 2 * h))) /
               (12 * h);
    }
    /// m W^2 (w + z) along the path, N m.
    [[nodiscard]] Real torque(Real a, Real b) const {
        return ball * speed * speed * std::real(std::conj(deflection(a, b) + place(a)) * along(a));
    }
    /// From the plane of a wall to the centre of a ball, m.
    [[nodiscard]] Real distance(Real a, Real wall) const {
        return std::imag(place(a) * std::polar<Real>(1, -wall));
    }
    [[nodiscard]] bool is_free(Real a) const {
        return std::all_of(walls.begin(), walls.end(), [&](double wall) {
            return std::cos(a - wall) < 0 || std::abs(distance(a, wall)) > half;
        });
    }
};

Race race_of(const CaseRotor &rotor, Real speed) {
    if (!rotor.rigid || rotor.discs.size() != 1 || rotor.balancers.size() != 1 ||
        rotor.supports.size() != 2 || rotor.balancers[0].n != 2 || !rotor.imbalances.empty())
        throw std::runtime_error("walled race: one disc, two bearings, two balls only");
    const Balancer &balls = rotor.balancers[0];
    Race out;
    out.mass = rotor.discs[0].mass;
    for (const Support &support : rotor.supports) {
        out.k += support.k[0][0];
        out.c += support.c[0][0];
    }
    out.imbalance = balls.imbalance;
    out.ball = balls.mass;
    out.radius = balls.radius;
    out.half = balls.diameter / 2;
    out.ellipticity = balls.ellipticity;
    out.long_axis = balls.ellipticity_angle;
    out.walls = balls.walls;
    out.speed = speed;
    return out;
}

} // namespace

std::vector<WalledPair> walled_pairs(const CaseRotor &rotor, Real speed) {
    const Race race = race_of(rotor, speed);
    struct Stop {
        Real angle, wall;
        int side; ///< of the wall
    };
    std::vector<Stop> stops;
    for (const double wall : race.walls)
        for (const int side : {-1, 1})
            stops.push_back(
                {wall + side * bisected(
                                   [&](Real beside) {
                                       return std::abs(race.distance(wall + side * beside, wall)) -
                                              race.half;
                                   },
                                   0, half_turn / 2),
                 wall, side});
    const auto pushed = [&](const Stop &stop, Real other) {
        return stop.side * race.torque(stop.angle, other) < 0;
    };
    std::vector<WalledPair> one, both;
    for (std::size_t i = 0; i < stops.size(); ++i) {
        const Real at = stops[i].angle;
        const auto add = [&](std::vector<WalledPair> &to, Real other, int resting) {
            const Real arm = std::imag(race.along(at) * std::polar<Real>(1, -stops[i].wall));
            to.push_back({std::remainder(at, 2 * half_turn), std::remainder(other, 2 * half_turn),
                          resting, std::abs(race.deflection(at, other)),
                          std::abs(race.torque(at, other) / arm)});
        };
        const std::size_t known = one.size();
        constexpr int parts = 20000;
        for (int part = 0; part < parts; ++part) {
            const auto torque = [&](Real a) { return race.torque(a, at); };
            const Real low = 2 * half_turn * part / parts;
            const Real high = 2 * half_turn * (part + 1) / parts;
            if ((torque(low) > 0) == (torque(high) > 0))
                continue;
            const Real free = bisected(torque, low, high);
            if (race.is_free(free) && pushed(stops[i], free))
                add(one, free, 1);
        }
        std::sort(
            one.begin() + static_cast<std::ptrdiff_t>(known), one.end(),
            [](const WalledPair &a, const WalledPair &b) { return a.deflection < b.deflection; });
        for (std::size_t k = i; k < stops.size(); ++k)
            if (pushed(stops[i], stops[k].angle) && pushed(stops[k], at))
                add(both, stops[k].angle, 2);
    }
    one.insert(one.end(), both.begin(), both.end());
    return one;
}

int free_pairs(const CaseRotor &rotor, Real speed) {
    const Race race = race_of(rotor, speed);
    const Real size = race.ball * race.radius * race.radius * speed * speed;
    std::vector<std::array<Real, 2>> found;
    constexpr int starts = 24;
    for (int start = 0; start < starts * starts; ++start) {
        std::array<Real, 2> a{2 * half_turn * (start % starts) / starts,
                              2 * half_turn * (start / starts) / starts + 0.1L};
        const auto left = [&](Real x, Real y) {
            return std::array{race.torque(x, y) / size, race.torque(y, x) / size};
        };
        for (int step = 0; step < 40; ++step) {
            constexpr Real h = 1e-5L;
            const auto at = left(a[0], a[1]);
            const auto right = left(a[0] + h, a[1]), wrong = left(a[0] - h, a[1]);
            const auto up = left(a[0], a[1] + h), down = left(a[0], a[1] - h);
            const Real xx = (right[0] - wrong[0]) / (2 * h), xy = (up[0] - down[0]) / (2 * h);
            const Real yx = (right[1] - wrong[1]) / (2 * h), yy = (up[1] - down[1]) / (2 * h);
            const Real determinant = xx * yy - xy * yx;
            if (determinant == 0)
                break;
            a = {a[0] - (yy * at[0] - xy * at[1]) / determinant,
                 a[1] - (xx * at[1] - yx * at[0]) / determinant};
        }
        const auto at = left(a[0], a[1]);
        if (!(std::abs(at[0]) + std::abs(at[1]) < 1e-11L) || !race.is_free(a[0]) ||
            !race.is_free(a[1]))
            continue;
        const auto close = [](Real x, Real y) {
            return std::abs(std::remainder(x - y, 2 * half_turn)) < 1e-6L;
        };
        if (std::none_of(found.begin(), found.end(), [&](const auto &b) {
                return (close(a[0], b[0]) && close(a[1], b[1])) ||
                       (close(a[0], b[1]) && close(a[1], b[0]));
            }))
            found.push_back(a);
    }
    return static_cast<int>(found.size());
}

} // namespace whirl::oracles

// The error that comes with the response, against far finer models of random rotors.

#include "forced/forced_motion.h"
#include "forced/response_error.h"
#include "modes/orbits.h"
#include "results/formulation.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace {

using namespace whirl;
using forced::ForcedMotion;
using forced::Phasor;
using results::Form;

class Dice {
  public:
    explicit Dice(unsigned seed) : _engine(seed) {}
    /// Between the two, evenly in the logarithm; by the engine's own numbers, which are the same
    /// with every standard library.
    double between(double low, double high) {
        return low * std::pow(high / low, static_cast<double>(_engine()) / 4294967295.0);
    }
    int whole(int low, int high) {
        return low + static_cast<int>(_engine() % static_cast<unsigned>(high - low + 1));
    }

  private:
    std::mt19937 _engine;
};

model::Bearing random_bearing(Dice &dice, double z) {
    model::Bearing bearing = tests::isotropic_bearing(z, dice.between(1e5, 1e9));
    model::BearingCoefficients &row = bearing.rows[0];
    const double c = dice.between(1, 1e4);
    switch (dice.whole(0, 3)) {
    case 0: // undamped
        break;
    case 1:
        row.c = c * Eigen::Matrix2d::Identity();
        break;
    case 2: // orthotropic
        row.k(1, 1) *= dice.between(0.3, 3);
        row.c << c, 0, 0, 2 * c;
        break;
    default: // cross coupled
        row.k(0, 1) = row.k(0, 0) / 5;
        row.k(1, 0) = -row.k(0, 0) / 8;
        row.c << c, c / 10, -c / 10, c;
    }
    return bearing;
}

model::Rotor random_rotor(Dice &dice) {
    model::Rotor rotor;
    const int segments = dice.whole(1, 4);
    std::vector<double> places{0}; // ends and middles of the segments: no short elements
    for (int i = 0; i < segments; ++i) {
        const double outer = dice.between(0.02, 0.12);
        model::Segment segment{dice.between(0.05, 0.8), outer,           outer, 0, 0,
                               tests::steel(),          dice.whole(1, 3)};
        if (dice.whole(0, 3) == 0)
            segment.outer_end = outer * dice.between(0.6, 1.6);
        rotor.shaft.segments.push_back(segment);
        places.push_back(places.back() + segment.length / 2);
        places.push_back(rotor.shaft.length());
    }
    const auto some_place = [&] {
        return places[static_cast<std::size_t>(dice.whole(1, 2 * segments))];
    };
    rotor.bearings = {random_bearing(dice, 0), random_bearing(dice, some_place())};
    for (int i = dice.whole(1, 3); i > 0; --i) {
        const double mass = dice.between(0.5, 50);
        const double radius = dice.between(0.05, 0.25);
        rotor.discs.push_back(tests::disc_at(some_place(), mass, mass * radius * radius / 4,
                                             mass * radius * radius / 2));
        rotor.imbalances.push_back(
            tests::imbalance_at(rotor.discs.back().z, 1e-4, dice.between(0.1, 6)));
    }
    return rotor;
}

double major_of(const Phasor &u) { return modes::ellipse_of(u.x, u.y).major; }

/// Speeds at random, and at and beside the largest response in each of three ranges of speed.
std::vector<double> speeds_of(Dice &dice, const std::function<double(double)> &amplitude) {
    constexpr double first = 20;
    constexpr double ratio = 1.05;
    std::vector<double> speeds;
    double speed = first;
    for (int range = 0; range < 3; ++range) {
        double peak = 0;
        double peak_at = speed;
        for (int i = 0; i < 45; ++i, speed *= ratio) {
            const double size = amplitude(speed);
            if (size > peak) {
                peak = size;
                peak_at = speed;
            }
        }
        for (int i = 0; i < 4; ++i) // nearer and nearer
            speeds.push_back(peak_at * (1 + 0.05 * std::pow(0.2, i) * (dice.between(1, 3) - 2)));
        speeds.push_back(peak_at);
    }
    for (int i = 0; i < 6; ++i)
        speeds.push_back(dice.between(first, speed));
    return speeds;
}

/// Of all points so far.
struct Counts {
    int points = 0;
    int above = 0; ///< the true error is above the estimate
    int loose = 0; ///< the estimate is above ten times the true error
    double worst = 0;

    void add(double actual, double estimate) {
        ++points;
        above += actual > estimate ? 1 : 0;
        loose += estimate > 10 * actual ? 1 : 0;
        worst = std::max(worst, actual / estimate);
    }
};

double true_error(const Phasor &a, const Phasor &b) {
    return major_of({a.x - b.x, a.y - b.y}) / std::max(major_of(a), major_of(b));
}

void compare(Dice &dice, const model::Rotor &rotor, int order, Counts &counts) {
    const assembly::Discretization d(rotor, order);
    const assembly::Discretization exact(rotor, 13);
    const assembly::Discretization other(rotor, 11, 2);
    const Form form = rotor.bearings_isotropic() ? Form::planar : Form::general;
    ForcedMotion coarse(d, form);
    ForcedMotion reference(exact, form);
    ForcedMotion second(other, form);
    forced::ResponseError error(d, form);
    const double z = rotor.discs[0].z;
    const auto at_disc = [z](ForcedMotion &motion, double speed) {
        motion.solve(speed);
        return motion.at(z);
    };
    const auto amplitude = [&](double speed) { return major_of(at_disc(reference, speed)); };
    for (const double speed : speeds_of(dice, amplitude)) {
        coarse.solve(speed);
        error.solve(speed);
        const Phasor u = coarse.motion(d.deflection_at(z));
        const Phasor truth = at_disc(reference, speed);
        const double actual = true_error(u, truth);
        // What the two references do not agree on is not known.
        if (true_error(truth, at_disc(second, speed)) < 0.02 * actual)
            counts.add(actual, error.at(z, u) + coarse.rounding());
    }
}

TEST(ResponseError, holds_for_random_rotors_at_random_speeds_and_peaks) {
    Dice dice(20);
    Counts counts;
    for (int k = 0; k < 240; ++k) {
        const model::Rotor rotor = random_rotor(dice);
        compare(dice, rotor, dice.whole(1, 6), counts);
    }
    RecordProperty("points", counts.points);
    EXPECT_GT(counts.points, 2000);
    EXPECT_LE(counts.above, 0.01 * counts.points);
    EXPECT_LE(counts.worst, 2);
    EXPECT_LE(counts.loose, 0.1 * counts.points);
}

} // namespace

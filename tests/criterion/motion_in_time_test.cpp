// The criterion against what it is about: the steady motion of an unbalanced rotor, in time.

#include "analyses/balance.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace {

using namespace whirl;
using results::BalanceResult;

using std::numbers::pi;

/// A disc in the middle of a shaft without mass, which is stiffer in one direction, on two
/// bearings: deflections of the disc and of the bearings, in axes that do not turn, real numbers in
/// time.
struct Keyway {
    double mass = 9;
    double stiff = 4.4e5, soft = 3.6e5; ///< of the shaft at the disc, N/m
    double angle = 0.5;                 ///< of the stiff direction at time 0
    double kx = 6e5, ky = 6e5;          ///< of both bearings together, N/m
    double c = 1500;                    ///< of both together, in each direction, N s/m

    using State = std::array<double, 6>; ///< x, y of the disc, their rates, x, y of the bearings

    /// @param direction  of the imbalance at time 0; of 1 kg m
    [[nodiscard]] State rate(const State &q, double time, double speed, double direction) const {
        const double e1 = std::cos(angle + speed * time);
        const double e2 = std::sin(angle + speed * time);
        const double u = q[0] - q[4];
        const double v = q[1] - q[5];
        const double along = stiff * (e1 * u + e2 * v);
        const double across = soft * (e1 * v - e2 * u);
        const double fx = e1 * along - e2 * across; // of the shaft, on the bearings
        const double fy = e2 * along + e1 * across;
        const double F = speed * speed;
        return {q[2],
                q[3],
                (F * std::cos(direction + speed * time) - fx) / mass,
                (F * std::sin(direction + speed * time) - fy) / mass,
                (fx - kx * q[4]) / c,
                (fy - ky * q[5]) / c};
    }

    /// Mean over a turn, once the motion is steady, of the deflection of the disc along two
    /// imbalances that turn with the rotor, at `direction` and a quarter turn ahead (1/kg).
    [[nodiscard]] std::array<double, 2> work(double speed, double direction) const {
        constexpr int steps = 400; // a turn: errors of 1e-9 by the fourth order
        constexpr int turns = 250;
        const double dt = 2 * pi / speed / steps;
        State q{};
        std::array<double, 2> sum{};
        for (int n = 0; n < steps * turns; ++n) {
            const double t = dt * n;
            if (n >= steps * (turns - 1)) {
                const double phase = direction + speed * t;
                sum[0] += (q[0] * std::cos(phase) + q[1] * std::sin(phase)) / steps;
                sum[1] += (q[1] * std::cos(phase) - q[0] * std::sin(phase)) / steps;
            }
            const auto moved = [&q](const State &k, double h) {
                State out = q;
                for (std::size_t i = 0; i < out.size(); ++i)
                    out[i] += h * k[i];
                return out;
            };
            const State a = rate(q, t, speed, direction);
            const State b = rate(moved(a, dt / 2), t + dt / 2, speed, direction);
            const State d = rate(moved(b, dt / 2), t + dt / 2, speed, direction);
            const State e = rate(moved(d, dt), t + dt, speed, direction);
            for (std::size_t i = 0; i < q.size(); ++i)
                q[i] += dt / 6 * (a[i] + 2 * b[i] + 2 * d[i] + e[i]);
        }
        return sum;
    }

    /// Largest work over the directions of the imbalance: those of 0 and a quarter turn make it up.
    [[nodiscard]] double largest_work(double speed) const {
        const auto [xx, yx] = work(speed, 0);
        const auto [yy, minus_xy] = work(speed, pi / 2);
        return (xx + yy) / 2 + std::hypot((xx - yy) / 2, (yx - minus_xy) / 2);
    }

    /// The same rotor for the program.
    [[nodiscard]] model::Case scene(double from, double to, int count) const {
        model::Case out;
        out.rotor.shaft = tests::uniform_shaft(1, 0.03, tests::weightless_steel());
        model::Segment &segment = out.rotor.shaft.segments[0];
        const double mean = (stiff + soft) / 2;
        const double I = pi * std::pow(segment.outer_start, 4) / 64;
        segment.material.E = mean / (48 * I); // F L^3/(48 E I), rigid in shear
        segment.asymmetry = (stiff - soft) / (stiff + soft);
        segment.asymmetry_angle = angle;
        out.rotor.shaft.shear = model::ShearFormula::given;
        out.rotor.shaft.shear_coefficient = 1e7;
        out.rotor.discs = {tests::disc_at(0.5, mass, 1e-6, 2e-6)};
        for (const double z : {0.0, 1.0}) {
            out.rotor.bearings.push_back(tests::isotropic_bearing(z, kx / 2, c / 2));
            out.rotor.bearings.back().rows[0].k(1, 1) = ky / 2;
        }
        out.rotor.planes = {{"", 0.5}};
        out.speeds = model::SpeedRange{from, to, count};
        return out;
    }
};

/// The signs of the work in time where the program says, and its size.
void expect_work(const Keyway &rotor, double from, double to, results::Form form) {
    const BalanceResult result = analyses::balance(rotor.scene(from, to, 12));
    EXPECT_EQ(result.model.formulation.form, form);
    const results::BalancePlane &plane = result.planes[0];
    ASSERT_EQ(plane.bands.bands.size(), 1U);
    EXPECT_EQ(plane.bands.bands[0].to, to);
    int inside = 0;
    for (std::size_t k = 0; k < result.speeds.size(); ++k) {
        const double speed = result.speeds[k];
        const double work = rotor.largest_work(speed);
        // Steps in time, what is left of the start, and a shaft not quite rigid in shear.
        EXPECT_NEAR(plane.criterion[k] / work, 1, 2e-6) << speed;
        const bool balanced = speed > plane.bands.bands[0].from; // to the end of the range
        EXPECT_EQ(work < 0, balanced) << speed;
        inside += balanced ? 1 : 0;
    }
    EXPECT_GT(inside, 2);
    EXPECT_LT(inside, 10);
    // To the end of the band from both sides.
    const double end = plane.bands.bands[0].from;
    EXPECT_GT(rotor.largest_work(end * (1 - 1e-5)), 0);
    EXPECT_LT(rotor.largest_work(end * (1 + 1e-5)), 0);
}

TEST(CriterionInTime, ShaftWithTwoStiffnessesOnEqualBearings) {
    expect_work(Keyway{}, 100, 300, results::Form::rotating);
}

TEST(CriterionInTime, ShaftWithTwoStiffnessesOnUnequalBearings) {
    Keyway rotor;
    rotor.ky = 3.5e5;
    expect_work(rotor, 100, 300, results::Form::hill);
    rotor.stiff = 6e5; // strongly coupled: more terms of the series
    rotor.soft = 3e5;
    rotor.c = 3000;
    expect_work(rotor, 120, 400, results::Form::hill);
}

TEST(CriterionInTime, UnequalBearingsAreNeverJudgedWithoutANote) {
    Keyway rotor;
    rotor.ky = 3.5e5;
    const BalanceResult result = analyses::balance(rotor.scene(100, 300, 12));
    EXPECT_FALSE(result.rigid);
    EXPECT_FALSE(result.planes[0].bands.rigid_bands);
    EXPECT_TRUE(std::ranges::any_of(result.model.notes, [](const results::Sentence &note) {
        return note.find("neither the rotor nor its bearings") != std::string::npos;
    }));
}

/// Both unsymmetric by less and less: the forms for one of the two.
TEST(CriterionInTime, SeriesBecomesTheFormsForOneOfTheTwo) {
    for (const double c : {0.0, 1500.0}) {
        Keyway rotor;
        rotor.c = c;
        rotor.ky = rotor.kx * (1 + 1e-9);
        const BalanceResult nearly = analyses::balance(rotor.scene(50, 300, 12));
        rotor.ky = rotor.kx;
        const BalanceResult equal = analyses::balance(rotor.scene(50, 300, 12));
        EXPECT_EQ(nearly.model.formulation.form, results::Form::hill);
        ASSERT_EQ(nearly.joint.bands.bands.size(), equal.joint.bands.bands.size());
        for (std::size_t i = 0; i < equal.joint.bands.bands.size(); ++i)
            EXPECT_NEAR(nearly.joint.bands.bands[i].from / equal.joint.bands.bands[i].from, 1,
                        1e-8);
        rotor.ky = 3.5e5;
        rotor.stiff = rotor.soft * (1 + 1e-9);
        const BalanceResult series = analyses::balance(rotor.scene(50, 300, 12));
        model::Case round = rotor.scene(50, 300, 12);
        round.rotor.shaft.segments[0].asymmetry = 0;
        const BalanceResult general = analyses::balance(round);
        EXPECT_EQ(series.model.formulation.form, results::Form::hill);
        EXPECT_EQ(general.model.formulation.form, results::Form::general);
        for (std::size_t k = 0; k < general.speeds.size(); ++k)
            EXPECT_NEAR(series.planes[0].criterion[k] / general.planes[0].criterion[k], 1, 1e-6);
    }
}

} // namespace

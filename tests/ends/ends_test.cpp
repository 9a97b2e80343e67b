// Speeds at which the number of growing motions changes, against dense state matrices of the whole
// rotor, counted and bisected.

#include "analyses/stability.h"
#include "assembly/rotating_system.h"
#include "assembly/system.h"
#include "ends/stability_ends.h"
#include "ends/sweep.h"
#include "input/case_file.h"
#include "stability/band_finder.h"
#include "stability/motion_reach.h"
#include "support/balancer_scenes.h"
#include "support/dense_eigenvalues.h"
#include "support/random.h"
#include "support/rotating_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace whirl;

/// Two or three discs on a damped shaft, with what the draw adds: anisotropies, balls, internal
/// damping, cross coupling.
struct Drawn {
    model::Rotor rotor;
    results::Form form = results::Form::general;
};

Drawn drawn(int seed) {
    tests::Random uniform(static_cast<unsigned>(seed));
    Drawn out;
    model::Rotor &rotor = out.rotor;
    rotor.shaft = tests::uniform_shaft(1, uniform(0.03, 0.06), tests::steel());
    rotor.shaft.order = seed % 6 == 0 ? 4 : 1;
    const int discs = 1 + static_cast<int>(uniform(0, 2.999));
    for (int i = 0; i < discs; ++i) {
        const double Id = uniform(0.1, 0.4);
        rotor.discs.push_back(tests::disc_at((i + uniform(0.15, 0.85)) / discs, uniform(5, 30), Id,
                                             uniform(0.5, 1.8) * Id));
    }
    rotor.bearings = {
        tests::isotropic_bearing(0, std::exp(uniform(13, 17)), std::exp(uniform(3, 8))),
        tests::isotropic_bearing(1, std::exp(uniform(13, 17)), std::exp(uniform(3, 8)))};
    const bool rotating = seed % 3 != 0;
    out.form = rotating ? results::Form::rotating : results::Form::general;
    if (rotating && uniform(0, 1) < 0.7)
        for (const model::Disc &disc : rotor.discs)
            rotor.anisotropies.push_back(
                {"", disc.z, uniform(0.02, 0.2) * disc.Id, uniform(0, 3.1)});
    const int balancers = rotating ? static_cast<int>(uniform(0, 2.999)) : 0;
    for (int i = 0; i < std::min(balancers, discs); ++i) {
        const double mass = std::exp(uniform(-4, -1));
        const double radius = uniform(0.05, 0.2);
        rotor.balancers.push_back(tests::ball_balancer(
            rotor.discs[static_cast<std::size_t>(i)].z, 2, mass, radius,
            std::exp(uniform(-2, 4)) * mass, uniform(0.2, 0.95) * 2 * mass * radius));
    }
    if (uniform(0, 1) < 0.6)
        rotor.shaft.internal_damping = std::exp(uniform(-14, -7));
    if (uniform(0, 1) < 0.4)
        for (model::Bearing &bearing : rotor.bearings) {
            const double cross = uniform(0.02, 0.5) * bearing.rows[0].k(0, 0);
            bearing.rows[0].k(0, 1) = cross;
            bearing.rows[0].k(1, 0) = -cross;
        }
    if (!rotating && uniform(0, 1) < 0.5)
        rotor.bearings[0].rows[0].k(1, 1) *= uniform(0.5, 0.95);
    return out;
}

/// Eigenvalues of the dense state matrix of the whole rotor.
class WholeRotor {
  public:
    explicit WholeRotor(const Drawn &drawn)
        : _form(drawn.form), _d(drawn.rotor, drawn.rotor.shaft.order) {
        if (_form == results::Form::rotating)
            _rotating = assembly::assemble_rotating(
                _d, 0,
                balancers::balancer_elements(drawn.rotor,
                                             balancers::arrangement_at_balance(drawn.rotor)));
        else
            _fixed = assembly::assemble_fixed(_d, 0);
        _tables = drawn.rotor.bearings_depend_on_speed();
    }
    [[nodiscard]] std::vector<std::complex<double>> eigenvalues(double speed) const {
        if (_form == results::Form::rotating)
            return tests::dense_eigenvalues(_rotating, speed);
        return _tables ? eigenvalues(assembly::assemble_fixed(_d, speed), speed)
                       : eigenvalues(_fixed, speed);
    }
    [[nodiscard]] static std::vector<std::complex<double>>
    eigenvalues(const assembly::FixedSystem &fixed, double speed) {
        return tests::dense_eigenvalues(
            Eigen::MatrixXd(fixed.M.view()),
            Eigen::MatrixXd(fixed.C.view()) + speed * Eigen::MatrixXd(fixed.G.view()),
            Eigen::MatrixXd(fixed.K.view()) + speed * Eigen::MatrixXd(fixed.Kc.view()));
    }
    [[nodiscard]] int growing(double speed) const {
        const auto values = eigenvalues(speed);
        return static_cast<int>(std::count_if(values.begin(), values.end(),
                                              [](auto value) { return value.real() > 0; }));
    }
    /// Whether the dense solver tells of each motion whether it grows.
    [[nodiscard]] bool tells(double speed) const {
        double largest = 0;
        double least = HUGE_VAL;
        for (const std::complex<double> &value : eigenvalues(speed)) {
            largest = std::max(largest, std::abs(value));
            least = std::min(least, std::abs(value.real()));
        }
        constexpr double noise = 1e-12; // as below
        return least > noise * largest;
    }
    /// rad/s: how far from an end the sign of the real part that changes there is lost in the noise
    /// of the dense eigenvalues.
    [[nodiscard]] double blur(double end) const {
        const auto values = eigenvalues(end);
        double largest = 0;
        std::complex<double> changing = values[0];
        for (const std::complex<double> &value : values) {
            largest = std::max(largest, std::abs(value));
            if (std::abs(value.real()) < std::abs(changing.real()))
                changing = value;
        }
        constexpr double step = 1e-3;
        const auto next = eigenvalues(end * (1 + step));
        const auto moved = *std::min_element(next.begin(), next.end(), [&](auto a, auto b) {
            return std::abs(a - changing) < std::abs(b - changing);
        });
        const double rate = std::abs(moved.real() - changing.real()) / (step * end);
        constexpr double noise = 1e-12; // n eps times a condition of some tens, of the largest
        return noise * largest / rate;
    }
    [[nodiscard]] const assembly::Discretization &discretization() const { return _d; }

  private:
    results::Form _form;
    assembly::Discretization _d;
    assembly::RotatingSystem _rotating;
    assembly::FixedSystem _fixed;
    bool _tables = false;
};

struct Bisected {
    double speed;
    int below, above;
};

void bisect(const WholeRotor &rotor, double a, int grow_a, double b, int grow_b,
            std::vector<Bisected> &out) {
    if (grow_a == grow_b)
        return;
    if (b - a < 1e-9 * b) {
        out.push_back({(a + b) / 2, grow_a, grow_b});
        return;
    }
    const double middle = (a + b) / 2;
    const int grow = rotor.growing(middle);
    bisect(rotor, a, grow_a, middle, grow, out);
    bisect(rotor, middle, grow, b, grow_b, out);
}

/// Between neighbours of a grid, and of these speeds beside it.
std::vector<Bisected> bisected(const WholeRotor &rotor, double from, double to, int steps,
                               const std::vector<double> &beside) {
    std::vector<double> speeds = beside;
    for (int k = 0; k <= steps; ++k)
        speeds.push_back(from + (to - from) * k / steps);
    std::sort(speeds.begin(), speeds.end());
    std::vector<Bisected> out;
    int grow_a = rotor.growing(speeds[0]);
    for (std::size_t k = 1; k < speeds.size(); ++k) {
        const int grow_b = rotor.growing(speeds[k]);
        bisect(rotor, speeds[k - 1], grow_a, speeds[k], grow_b, out);
        grow_a = grow_b;
    }
    return out;
}

/// Where bands narrower than a step of a grid would be seen.
std::vector<double> between(const std::vector<results::StabilityEnd> &ends) {
    std::vector<double> out;
    for (std::size_t i = 1; i < ends.size(); ++i)
        out.push_back((ends[i - 1].speed + ends[i].speed) / 2);
    return out;
}

ends::EndsFound ends_of(const Drawn &drawn, const assembly::Discretization &d, double from,
                        double to) {
    const auto arrangement = balancers::arrangement_at_balance(drawn.rotor);
    stability::StabilityModel model;
    model.rotor = drawn.rotor;
    model.form = drawn.form;
    model.order = drawn.rotor.shaft.order;
    stability::BandFinder finder(model, arrangement);
    const auto shapes = finder.good_shapes(model::SpeedRange{from, to, 11}.values());
    return ends::find_ends(ends::AllMotions(d, drawn.form, arrangement, shapes, from, to));
}

// Every third rotor has no turning asymmetry; every sixth has finer elements (no ends among those
// drawn).
TEST(Ends, OfRandomRotorsAreThoseOfTheCountedStateMatrix) {
    constexpr double from = 20;
    constexpr double to = 1000;
    std::size_t ends = 0;
    for (int seed = 1; seed <= 36; ++seed) {
        const Drawn drawn = ::drawn(seed);
        const WholeRotor whole(drawn);
        const ends::EndsFound found = ends_of(drawn, whole.discretization(), from, to);
        const auto expected = bisected(whole, from, to, 200, between(found.ends));
        EXPECT_TRUE(found.doubtful.empty()) << seed;
        ASSERT_EQ(found.ends.size(), expected.size()) << seed;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            // What the dense solver leaves of a real part, over its rate. Of motions that hardly
            // grow that is more: then the number changes across the end, if not at it alone, or is
            // uncertain as far as its noise reaches.
            const double end = found.ends[i].speed;
            EXPECT_TRUE(std::abs(end - expected[i].speed) < 1e-8 * end ||
                        (whole.growing(end * (1 - 1e-6)) == expected[i].below &&
                         whole.growing(end * (1 + 1e-6)) == expected[i].above) ||
                        std::abs(end - expected[i].speed) < whole.blur(end))
                << seed << ": " << end << " for " << expected[i].speed;
            EXPECT_EQ(found.ends[i].growing_below, expected[i].below) << seed;
            EXPECT_EQ(found.ends[i].growing_above, expected[i].above) << seed;
            EXPECT_NE(found.ends[i].kind, results::EndKind::collision) << seed;
        }
        ends += expected.size();
    }
    EXPECT_GE(ends, 60U); // otherwise little was compared
}

/// Bearings with cross coupling on a table and hardly any damping, which drive motions tens of
/// times as fast as the rotor spins.
Drawn hardly_damped(int seed) {
    tests::Random uniform(static_cast<unsigned>(seed));
    Drawn out;
    model::Rotor &rotor = out.rotor;
    rotor.shaft = tests::uniform_shaft(uniform(0.3, 0.6), uniform(0.03, 0.06), tests::steel());
    rotor.shaft.segments.push_back(rotor.shaft.segments.front());
    rotor.shaft.order = 3;
    const double length = 2 * rotor.shaft.segments.front().length;
    for (const double share : {uniform(0.1, 0.4), uniform(0.5, 0.9)})
        rotor.discs.push_back(tests::disc_at(share * length, uniform(2, 12), uniform(0.005, 0.05),
                                             uniform(0.01, 0.09)));
    for (const double share : {0.1, 0.9}) {
        const double k = std::exp(uniform(12, 17));
        const double c = k * std::exp(uniform(-11.5, -9.5));
        model::Bearing bearing = tests::isotropic_bearing(share * length, k, c);
        const model::BearingCoefficients row = bearing.rows[0];
        bearing.rows.clear();
        for (const double speed : {50.0, 300.0, 550.0, 800.0, 1050.0}) {
            bearing.speeds.push_back(speed);
            bearing.rows.push_back(row);
            model::BearingCoefficients &at = bearing.rows.back();
            at.k.diagonal() *= uniform(0.6, 1.4);
            at.k(0, 1) = k * uniform(-0.4, 0.6);
            at.k(1, 0) = -at.k(0, 1) * uniform(0.3, 1);
            at.c.diagonal() *= uniform(0.3, 1.5);
        }
        rotor.bearings.push_back(bearing);
    }
    return out;
}

// All of them, fast ones too, at low speeds as well: few shapes have them where they were chosen
// for them alone.
TEST(Ends, OfFastMotionsOnHardlyDampedBearingsAreThoseOfTheCountedStateMatrix) {
    constexpr double to = 1100;
    std::size_t fast = 0;
    for (int seed = 1; seed <= 3; ++seed) {
        const Drawn drawn = hardly_damped(seed);
        model::Case scene;
        scene.rotor = drawn.rotor;
        scene.speeds = model::SpeedRange{0, to, 8};
        const WholeRotor whole(drawn);
        const std::vector<results::StabilityEnd> ends = analyses::stability(scene, {}).ends;
        ASSERT_FALSE(ends.empty()) << seed;
        std::size_t compared = 0;
        const auto expect_growing = [&](double speed) {
            int growing = ends.front().growing_below;
            for (const results::StabilityEnd &end : ends)
                growing = end.speed < speed ? end.growing_above : growing;
            if (!whole.tells(speed))
                return;
            EXPECT_EQ(growing, whole.growing(speed)) << seed << ": " << speed;
            ++compared;
        };
        constexpr int steps = 90;
        for (int k = 0; k < steps; ++k)
            expect_growing(to * (k + 0.5) / steps);
        const double reach = stability::growth_reach(drawn.rotor, results::Form::general, to);
        for (const results::StabilityEnd &end : ends) {
            for (const double side : {1 - 1e-5, 1 + 1e-5})
                expect_growing(side * end.speed);
            EXPECT_LE(end.frequency.value(), reach) << seed << ": " << end.speed;
            fast += end.frequency.value() > 4 * to ? 1 : 0;
        }
        EXPECT_GE(compared, steps + ends.size()) << seed; // most of them
    }
    EXPECT_GE(fast, 20U); // otherwise little was compared
}

// A mass on a spring with cross coupling begins to whirl where q = c w.
TEST(GrowthReach, IsTheFrequencyAtWhichAMassOnOneBearingBeginsToGrow) {
    constexpr double c = 30, w = 400;
    model::Rotor rotor;
    rotor.shaft = tests::uniform_shaft(1, 0.05, tests::steel());
    rotor.bearings = {tests::isotropic_bearing(0, 1e6, c)};
    rotor.bearings[0].rows[0].k(0, 1) = c * w;
    rotor.bearings[0].rows[0].k(1, 0) = -c * w;
    const auto reach = [&](results::Form form, double top) {
        return stability::growth_reach(rotor, form, top);
    };
    EXPECT_NEAR(reach(results::Form::general, 100), w, 1e-12 * w);
    EXPECT_NEAR(reach(results::Form::general, 500), w, 1e-12 * w);
    EXPECT_NEAR(reach(results::Form::rotating, 100), w + 100, 1e-12 * w); // against the spin
    rotor.shaft.internal_damping = 1e-5; // drives what whirls slower than it turns
    EXPECT_EQ(reach(results::Form::general, 500), 500);
    rotor.bearings[0].rows[0].c.setZero();
    EXPECT_EQ(reach(results::Form::general, 500), HUGE_VAL);
}

// S1's rotor: a real root passes zero at both ends of its band.
TEST(Ends, OfTheAnisotropicRotorAreThoseOfItsClosedForm) {
    model::Case scene = tests::scene_of(tests::tilt_rotor(0.8, 0.1, 1.25, 0.156), 0, 6, 11);
    const results::StabilityResult result = analyses::stability(scene, {});
    ASSERT_EQ(result.ends.size(), 2U);
    const double x = 0.03, y = 2 * 1.5625 * 0.2 - 0.156 * 0.156, z = 1.5625 * 1.5625;
    for (const int i : {0, 1}) { // W^2 between the roots of [(1-C)^2 - a^2] x^2 - y x + p^4
        const double root = (y + (i == 0 ? -1 : 1) * std::sqrt(y * y - 4 * x * z)) / (2 * x);
        EXPECT_NEAR(result.ends[static_cast<std::size_t>(i)].speed, std::sqrt(root), 1e-9);
    }
    EXPECT_EQ(result.ends[0].kind, results::EndKind::zero);
    EXPECT_EQ(result.ends[0].growing_below, 0);
    EXPECT_EQ(result.ends[0].growing_above, 1);
    EXPECT_EQ(result.ends[1].growing_above, 0);
    EXPECT_EQ(result.ends[0].frequency_rotating, 0);
    ASSERT_EQ(result.unstable.size(), 1U);
    EXPECT_EQ(result.unstable[0].from, result.ends[0].speed);
    EXPECT_EQ(result.unstable[0].to, result.ends[1].speed);
}

/// W^2 between the roots of [(1-C)^2 - a^2] x^2 - y x + p^4, as above: from two speeds the cubics
/// between values and rates place both ends of the band inside the steps that they lie in, not at
/// an end of them. Cubics are trusted from a misfit of 0.3 of the change on, here far less.
TEST(Swept, PlacesChangesInsideTheirSteps) {
    const model::Rotor rotor = tests::tilt_rotor(0.8, 0.1, 1.25, 0.156);
    const assembly::Discretization d(rotor, rotor.shaft.order);
    const ends::AllMotions motions(d, results::Form::rotating, {}, nullptr, 0.5, 6);
    const ends::Swept swept = ends::swept(motions, 0, {0.5, 6});
    ASSERT_EQ(swept.changes.size(), 2U);
    const double x = 0.03, y = 2 * 1.5625 * 0.2 - 0.156 * 0.156, z = 1.5625 * 1.5625;
    for (const int i : {0, 1}) {
        const double expected =
            std::sqrt((y + (i == 0 ? -1 : 1) * std::sqrt(y * y - 4 * x * z)) / (2 * x));
        const ends::Change &change = swept.changes[static_cast<std::size_t>(i)];
        EXPECT_EQ(change.gain, i == 0 ? 1 : -1);
        EXPECT_LT(change.from, expected);
        EXPECT_GT(change.to, expected);
        EXPECT_NEAR(change.speed, expected, 0.03 * (change.to - change.from));
    }
}

// A mass on a light shaft of stiffness k with damping eta k of its own and d from outside: the
// forward whirl at w grows beyond W = w (1 + d/(eta k)).
TEST(Ends, OfInternalDampingAreThoseOfTheJeffcottRotor) {
    model::Rotor rotor;
    rotor.shaft = tests::uniform_shaft(1, 0.02, {"light", 2e11, 7.7e10, 1e-3}); // 3e-7 kg
    rotor.shaft.order = 1;
    rotor.discs = {tests::disc_at(0.5, 10, 0.1, 0.1)};
    rotor.bearings = {tests::isotropic_bearing(0, 1e6, 30), tests::isotropic_bearing(1, 1e6, 30)};
    rotor.shaft.internal_damping = 2e-4;
    const model::Case scene = tests::scene_of(rotor, 5, 400, 11);
    const results::StabilityResult coarse = analyses::stability(scene, {});
    ASSERT_FALSE(coarse.ends.empty());
    const results::StabilityEnd &first = coarse.ends.front();
    EXPECT_EQ(first.kind, results::EndKind::pair);
    EXPECT_EQ(first.growing_below, 0);
    EXPECT_EQ(first.growing_above, 2);
    // Shaft (stiffness kf, damping eta (s' in rotating axes)) and bearings (kb, cb) in series at
    // the whirl frequency w: the loss of both is zero, Im[1/(1/Zf + 1/Zb)] = 0,
    // Zf = kf (1 + i eta (w - W)), Zb = kb + i cb w, and m w^2 = Re.
    const double E = 2e11, G = 7.7e10;
    const double pi = std::acos(-1.0);
    const double I = pi / 64 * std::pow(0.02, 4), A = pi / 4 * 0.02 * 0.02;
    const double nu = E / (2 * G) - 1;
    const double kappa = 6 * (1 + nu) / (7 + 6 * nu);
    const double kf = 1 / (1 / (48 * E * I) + 1 / (4 * kappa * G * A));
    const auto series = [&](double w, double W) {
        const std::complex<double> Zf(kf, kf * 2e-4 * (w - W));
        const std::complex<double> Zb(2e6, 60 * w);
        return 1.0 / (1.0 / Zf + 1.0 / Zb) - 10 * w * w;
    };
    const double w = first.frequency_rotating ? first.speed - *first.frequency_rotating : 0;
    EXPECT_NEAR(std::abs(series(w, first.speed)) / kf, 0, 1e-7); // the mass of the shaft
}

/// Of a rotor whose shaft of two stiffnesses has this density, kg/m3.
results::StabilityResult of_light_shaft(double density) {
    model::Rotor rotor;
    rotor.shaft = tests::uniform_shaft(0.8, 0.025, {"light", 2.1e11, 8.1e10, density});
    rotor.shaft.order = 4;
    rotor.shaft.segments.front().asymmetry = 0.08;
    rotor.discs = {tests::disc_at(0.3, 9, 0.05, 0.06)};
    rotor.bearings = {tests::isotropic_bearing(0, 2e6, 600),
                      tests::isotropic_bearing(0.8, 3e6, 900)};
    return analyses::stability(tests::scene_of(rotor, 10, 800, 80), {});
}

// The elastic motions of a shaft without mass are infinitely fast: rounding makes others of them at
// every speed, none of which is to be followed.
TEST(Ends, OfAShaftWithoutMassAreThoseOfALightOne) {
    const results::StabilityResult without = of_light_shaft(1e-9);
    const results::StabilityResult light = of_light_shaft(1e-3);
    ASSERT_EQ(light.ends.size(), 2);
    ASSERT_EQ(without.ends.size(), 2);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(without.ends[i].kind, results::EndKind::zero);
        EXPECT_EQ(without.ends[i].growing_below, light.ends[i].growing_below);
        EXPECT_NEAR(without.ends[i].speed, light.ends[i].speed, 1e-6 * light.ends[i].speed);
    }
    for (const auto &note : without.model.notes)
        EXPECT_EQ(note.find("doubt"), std::string::npos) << note;
}

// Two motions that lock over a thousandth of a step of the sweep grow as -d + sqrt(g^2 - (k (s -
// s0))^2), d the damping of both: the square of the width of the band falls by the square of d.
TEST(Ends, OfABandThatIsNarrowInItsStepFollowTheDamping) {
    const auto square_of_width = [](double c) {
        model::Case scene = input::load_case(WHIRL_ROOT "/cases/anisotropic_disc_flexible");
        scene.rotor.anisotropies.front().dI = 1.872e-5;
        for (model::Bearing &bearing : scene.rotor.bearings)
            bearing.rows[0].c = c * Eigen::Matrix2d::Identity();
        const results::StabilityResult result = analyses::stability(scene, {});
        for (const auto &note : result.model.notes)
            EXPECT_EQ(note.find("doubt"), std::string::npos) << note;
        for (const auto &[from, to] : result.unstable)
            if (from < 592.15 && to > 592.15)
                return (to - from) * (to - from);
        return 0.0;
    };
    const double at_2 = square_of_width(2);
    const double at_20 = square_of_width(20);
    ASSERT_GT(at_20, 0);
    for (const double c : {5.0, 10.0}) // higher powers of c: 1e-4 of the difference
        EXPECT_NEAR(square_of_width(c), at_2 + (at_20 - at_2) * (c * c - 4) / (400 - 4),
                    1e-3 * (at_2 - at_20))
            << c;
}

// Nothing depends on the grid of the user.
TEST(Ends, AreTheSameFromTwoGrids) {
    for (const int seed : {1, 4, 20}) {
        Drawn drawn = ::drawn(seed);
        drawn.rotor.anisotropies.clear(); // what is permissible is not asked for here
        if (drawn.rotor.balancers.empty())
            drawn.rotor.balancers = {tests::ball_balancer(0.5, 2, 0.1, 0.1, 0.2, 0.01)};
        const auto coarse = analyses::stability(tests::scene_of(drawn.rotor, 20, 1000, 11), {});
        const auto fine = analyses::stability(tests::scene_of(drawn.rotor, 20, 1000, 301), {});
        ASSERT_EQ(coarse.ends.size(), fine.ends.size());
        for (std::size_t i = 0; i < fine.ends.size(); ++i)
            EXPECT_NEAR(coarse.ends[i].speed, fine.ends[i].speed, 1e-9 * fine.ends[i].speed);
        ASSERT_EQ(coarse.unstable.size(), fine.unstable.size());
        std::vector<double> edges; // of bands are the ends with none growing on one side
        for (const results::StabilityEnd &end : fine.ends)
            if ((end.growing_below == 0) != (end.growing_above == 0))
                edges.push_back(end.speed);
        for (const auto &[from, to] : fine.unstable)
            for (const double edge : {from, to})
                EXPECT_TRUE(edge == 20 || edge == 1000 ||
                            std::find(edges.begin(), edges.end(), edge) != edges.end());
    }
}

} // namespace

// Response to unit weights over speed, and how a rotor is balanced, against closed forms.

#include "analyses/weights.h"
#include "model/errors.h"
#include "results/weights.h"
#include "support/rigid_jeffcott.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

namespace whirl::tests::influence {
namespace {

using results::InfluenceCurve;
using results::WeightsResult;
using std::numbers::pi;
using Complex = std::complex<double>;

const InfluenceCurve &curve_of(const WeightsResult &result, const std::string &of, double z,
                               const std::string &plane, double angle = 0) {
    for (const InfluenceCurve &curve : result.influence_curves)
        if (curve.of == of && std::abs(curve.z - z) < 1e-12 && curve.plane == plane &&
            curve.angle == angle)
            return curve;
    throw std::runtime_error("no such curve: " + of);
}

/// With what weights need: something to balance, and a speed to do it at.
model::Case with_weights(model::Case scene, double speed) {
    if (scene.rotor.imbalances.empty())
        scene.rotor.imbalances = {imbalance_at(scene.rotor.planes.front().z, 1e-4, 0.3)};
    if (scene.rotor.probes.empty())
        scene.rotor.probes = {{"p", scene.rotor.planes.front().z, 0.7}};
    scene.weights.emplace();
    scene.weights->speeds = {speed};
    return scene;
}

// A mass on springs: u = W^2/(k - m W^2 + i c W) at every place, the force in half of the springs
// over the weight's own W^2.
TEST(Influence, OfAMassOnSpringsIsItsClosedForm) {
    const RigidJeffcott of;
    for (const bool lag : {false, true}) {
        model::Case scene = of.scene();
        scene.rotor.planes = {{"disc", 0.5}};
        scene = with_weights(scene, 200);
        scene.weights->lag = lag;
        scene.weights->stations = {0.2};
        scene.speeds = model::SpeedRange{0, 800, 9};
        const WeightsResult result = analyses::correction_weights(scene);
        ASSERT_EQ(result.curve_speeds.size(), 9U);
        for (std::size_t k = 0; k < 9; ++k) {
            const double W = result.curve_speeds[k];
            const auto as_told = [lag](Complex value) { return lag ? std::conj(value) : value; };
            const Complex D(of.kx - of.mass * W * W, of.c * W);
            const double tolerance = 1e-10 * std::abs(W * W / D); // of the motion: one unknown
            EXPECT_LE(
                std::abs(*curve_of(result, "station", 0.2, "disc").values[k] - as_told(W * W / D)),
                tolerance);
            // It looks aslant: a circle passes it later by the angle.
            EXPECT_LE(std::abs(*curve_of(result, "probe", 0.5, "disc", 0.7).values[k] -
                               as_told(W * W / D * std::polar(1.0, -0.7))),
                      tolerance);
            EXPECT_LE(
                std::abs(*curve_of(result, "bearing", 1, "disc").values[k] - as_told(W * W / D)),
                tolerance);
            const auto &force = curve_of(result, "force", 0, "disc").values[k];
            EXPECT_EQ(force.has_value(), W > 0); // at rest there is no centrifugal force
            if (force) {
                EXPECT_LE(std::abs(*force - as_told(Complex(of.kx, of.c * W) / 2.0 / D)),
                          1e-10 * std::abs(of.kx / D));
            }
        }
    }
}

// Bearings that differ: each direction has its own springs, y a quarter turn behind.
TEST(Influence, OfUnequalSpringsHasTwoDirections) {
    RigidJeffcott of;
    of.ky = 4e6;
    model::Case scene = of.scene();
    scene.rotor.planes = {{"disc", 0.5}};
    scene = with_weights(scene, 200);
    scene.speeds = model::SpeedRange{100, 700, 4};
    const WeightsResult result = analyses::correction_weights(scene);
    for (std::size_t k = 0; k < 4; ++k) {
        const double W = result.curve_speeds[k];
        const Complex x = W * W / Complex(of.kx - of.mass * W * W, of.c * W);
        const Complex y = Complex(0, -1) * W * W / Complex(of.ky - of.mass * W * W, of.c * W);
        EXPECT_LE(std::abs(*curve_of(result, "bearing", 0, "disc").values[k] - x),
                  1e-10 * std::abs(x));
        EXPECT_LE(std::abs(*curve_of(result, "bearing", 0, "disc", pi / 2).values[k] - y),
                  1e-10 * std::abs(y));
        EXPECT_LE(std::abs(*curve_of(result, "probe", 0.5, "disc", 0.7).values[k] -
                           (x * std::cos(0.7) + y * std::sin(0.7))),
                  1e-10 * (std::abs(x) + std::abs(y)));
    }
}

/// A uniform shaft of 1 m, pinned: on springs far stiffer than it.
struct PinnedShaft {
    double diameter = 0.04, kappa = 0.9;
    double pins = 1e14; ///< N/m; 48 EI is 1.2e6

    [[nodiscard]] model::Case scene() const {
        model::Case scene;
        scene.rotor.shaft = uniform_shaft(1, diameter, steel());
        scene.rotor.shaft.segments[0].shear_coefficient = kappa;
        scene.rotor.shaft.segments[0].elements = 4;
        scene.rotor.shaft.order = 8;
        scene.rotor.bearings = {isotropic_bearing(0, pins), isotropic_bearing(1, pins)};
        return scene;
    }
    [[nodiscard]] double EI() const { return 2e11 * pi / 64 * std::pow(diameter, 4); }
    [[nodiscard]] double area() const { return pi / 4 * diameter * diameter; }
    /// Of a shaft with the shape sin(n pi z), its sections cos(n pi z): stiffness less W^2 mass for
    /// forces along sin(n pi z). Timoshenko's equations; turning forward with the spin, gyroscopic
    /// less rotary inertia is rho I W^2.
    [[nodiscard]] double stiffness(int n, double W) const {
        const double a = n * pi;
        const double shear = kappa * 7.7e10 * area();
        const double turning = EI() * a * a + shear + W * W * 7800 * EI() / 2e11;
        return shear * a * a - shear * a * shear * a / turning - W * W * 7800 * area();
    }
    /// Deflection at z under a unit imbalance at p.
    [[nodiscard]] double influence(double z, double p, double W) const {
        double sum = 0;
        for (int n = 200000; n >= 1; --n) // the terms fall as 1/n^2, by shear
            sum += std::sin(n * pi * z) * std::sin(n * pi * p) / stiffness(n, W);
        return 2 * W * W * sum;
    }
    /// n-th critical speed, by halves.
    [[nodiscard]] double critical(int n) const {
        double low = 0, high = 1e5;
        for (int i = 0; i < 200; ++i)
            (stiffness(n, (low + high) / 2) > 0 ? low : high) = (low + high) / 2;
        return low;
    }
};

TEST(Influence, OfAUniformShaftIsTheSumOfItsShapes) {
    const PinnedShaft of;
    model::Case scene = of.scene();
    scene.rotor.planes = {{"a", 0.3}, {"b", 0.8}};
    scene = with_weights(scene, 200);
    scene.weights->stations = {0.3, 0.55, 0.8};
    const double first = of.critical(1), second = of.critical(2);
    scene.speeds = model::SpeedRange{0.5 * first, 1.5 * second, 4};
    const WeightsResult result = analyses::correction_weights(scene);
    for (std::size_t k = 0; k < 4; ++k)
        for (const auto &[plane, p] : {std::pair("a", 0.3), {"b", 0.8}})
            for (const double z : scene.weights->stations) {
                const double expected = of.influence(z, p, result.curve_speeds[k]);
                // The pins give way by some 1e-7 of the third shape, whose critical speed is next,
                // and the series ends at 2e5.
                EXPECT_NEAR(curve_of(result, "station", z, plane).values[k]->real(), expected,
                            1e-5 * std::abs(of.influence(0.55, 0.55, result.curve_speeds[k])))
                    << z << ' ' << plane;
                EXPECT_EQ(curve_of(result, "station", z, plane).values[k]->imag(), 0);
            }
}

// Coarse elements: the error that is stated covers what they leave of the sum of the shapes, and is
// no more than ten times that; of a rigid shaft it is rounding.
TEST(Influence, ErrorsCoverWhatCoarseElementsLeave) {
    const PinnedShaft of;
    for (const int order : {1, 2, 3}) {
        model::Case scene = of.scene();
        scene.rotor.shaft.order = order;
        scene.rotor.planes = {{"a", 0.3}, {"b", 0.8}};
        scene = with_weights(scene, 200);
        scene.weights->stations = {0.3, 0.55, 0.8};
        scene.speeds = model::SpeedRange{0.5 * of.critical(1), 1.4 * of.critical(1), 4};
        const WeightsResult result = analyses::correction_weights(scene);
        for (std::size_t k = 0; k < 4; ++k)
            for (const auto &[plane, p] : {std::pair("a", 0.3), {"b", 0.8}})
                for (const double z : scene.weights->stations) {
                    const InfluenceCurve &curve = curve_of(result, "station", z, plane);
                    const double found = curve.values[k]->real();
                    const double left =
                        std::abs(found - of.influence(z, p, result.curve_speeds[k]));
                    ASSERT_TRUE(curve.errors[k]);
                    const double stated = *curve.errors[k] * std::abs(found);
                    const double series = 1e-7 * std::abs(found); // pins, and where it ends
                    EXPECT_LE(left, stated + series) << order << ' ' << z << ' ' << plane;
                    EXPECT_LE(stated, 10 * left + 10 * series) << order << ' ' << z << ' ' << plane;
                }
        for (const results::InfluenceCoefficient &one : result.influence)
            EXPECT_TRUE(one.error && *one.error > 0 && *one.error < 0.2);
    }
    model::Case rigid = RigidJeffcott().scene();
    rigid.rotor.planes = {{"disc", 0.5}};
    rigid = with_weights(rigid, 200);
    rigid.speeds = model::SpeedRange{100, 200, 2};
    const WeightsResult result = analyses::correction_weights(rigid);
    EXPECT_LT(*curve_of(result, "bearing", 0, "disc").errors[0], 1e-10);
}

// Maxwell and Betti: what a weight here does there, one there does here; with discs, gyroscopic
// effect and damping too, as long as all directions are alike.
TEST(Influence, IsTheSameThereAndBack) {
    model::Case scene;
    scene.rotor.shaft = uniform_shaft(1, 0.05, steel());
    scene.rotor.discs = {disc_at(0.45, 27, 0.155, 0.3), disc_at(1, 8, 0.05, 0.09)};
    scene.rotor.bearings = {isotropic_bearing(0.1, 2e6, 1000), isotropic_bearing(0.8, 3e6, 500)};
    scene.rotor.planes = {{"a", 0.2}, {"b", 0.6}, {"c", 1}};
    scene = with_weights(scene, 300);
    scene.weights->stations = {0.2, 0.6, 1};
    scene.speeds = model::SpeedRange{50, 2000, 14};
    const WeightsResult result = analyses::correction_weights(scene);
    const std::vector<std::pair<std::string, double>> planes{{"a", 0.2}, {"b", 0.6}, {"c", 1}};
    for (const auto &[here, from] : planes)
        for (const auto &[there, to] : planes)
            for (std::size_t k = 0; k < 14; ++k) {
                const Complex one = *curve_of(result, "station", to, here).values[k];
                const Complex other = *curve_of(result, "station", from, there).values[k];
                EXPECT_LE(std::abs(one - other), 1e-9 * std::abs(one)) << here << there;
            }
}

// The matrix from which the weights come and the curves are one.
TEST(Influence, OverSpeedIsThatOfTheWeights) {
    model::Case scene = PinnedShaft().scene();
    scene.rotor.planes = {{"a", 0.3}, {"b", 0.8}};
    scene = with_weights(scene, 100);
    scene.speeds = model::SpeedRange{100, 100, 1};
    const WeightsResult result = analyses::correction_weights(scene);
    ASSERT_EQ(result.influence.size(), 2U);
    for (const results::InfluenceCoefficient &one : result.influence)
        EXPECT_EQ(one.value, *curve_of(result, "probe", 0.3, one.plane, 0.7).values[0]);
    EXPECT_NEAR(*result.curves[0].after[0], std::abs(result.residual[0].after),
                1e-12 * std::abs(result.residual[0].before));
}

TEST(Influence, AtAResonanceWithoutDampingIsNotKnown) {
    model::Case scene = RigidJeffcott{.c = 0}.scene();
    scene.rotor.planes = {{"disc", 0.5}};
    scene = with_weights(scene, 100);
    const double resonance = RigidJeffcott().natural();
    scene.speeds = model::SpeedRange{resonance, 2 * resonance, 2};
    const WeightsResult result = analyses::correction_weights(scene);
    EXPECT_FALSE(curve_of(result, "bearing", 0, "disc").values[0]);
    EXPECT_TRUE(curve_of(result, "bearing", 0, "disc").values[1]);
}

// --- modal balancing -----------------------------------------------------------------------------

// Beside the first two critical speeds of a pinned shaft the motions are the first two shapes
// alone. Weights that take them away take away their share of the imbalance, the sum of u sin(n pi
// z), and leave the same of the shapes above.
TEST(ModalBalancing, OfAUniformShaftTakesAwayItsShapes) {
    const PinnedShaft of;
    model::Case scene = of.scene();
    scene.rotor.planes = {{"a", 0.3}, {"b", 0.6}};
    scene.rotor.imbalances = {imbalance_at(0.2, 2e-4, 0.4), imbalance_at(0.45, 1e-4, 2),
                              imbalance_at(0.9, 3e-4, -1)};
    scene.rotor.probes = {{"p", 0.35}, {"q", 0.7}};
    scene = with_weights(scene, 1);
    constexpr double beside = 1e-6; // of the speed: the other shapes move a millionth of it
    scene.weights->speeds = {of.critical(1) * (1 - beside), of.critical(2) * (1 - beside)};
    const WeightsResult result = analyses::correction_weights(scene);
    Eigen::Matrix2d shapes;
    Eigen::Vector2cd shares = Eigen::Vector2cd::Zero();
    for (int n = 1; n <= 2; ++n) {
        for (int p = 0; p < 2; ++p)
            shapes(n - 1, p) = std::sin(n * pi * scene.rotor.planes[static_cast<std::size_t>(p)].z);
        for (const model::Imbalance &own : scene.rotor.imbalances)
            shares(n - 1) += std::polar(own.mr, own.phase) * std::sin(n * pi * own.z);
    }
    const Eigen::Matrix2d inverse = shapes.inverse();
    const Eigen::Vector2cd expected = -inverse * shares;
    for (int p = 0; p < 2; ++p)
        EXPECT_LE(std::abs(result.weights[static_cast<std::size_t>(p)].weight - expected(p)),
                  1e-5 * expected.norm());
    ASSERT_TRUE(result.procedure);
    EXPECT_EQ(result.procedure->bending, 1); // the highest speed is just below the second
}

// --- how it is balanced --------------------------------------------------------------------------

TEST(Procedure, CountsTheBendingCriticalSpeedsOfAPinnedShaft) {
    const PinnedShaft of;
    for (const int below : {1, 2, 3}) {
        model::Case scene = of.scene();
        scene.rotor.planes = {{"a", 0.3}, {"b", 0.6}, {"c", 0.8}};
        const double between = (of.critical(below) + of.critical(below + 1)) / 2;
        scene = with_weights(scene, between);
        scene.campbell.modes = 1; // is for diagrams
        const auto procedure = analyses::correction_weights(scene).procedure;
        ASSERT_TRUE(procedure);
        EXPECT_TRUE(procedure->flexible);
        EXPECT_EQ(procedure->bending, below);
        EXPECT_EQ(procedure->criticals, below);
        ASSERT_TRUE(procedure->next_bending);
        EXPECT_NEAR(*procedure->next_bending / of.critical(below + 1), 1, 1e-5);
        EXPECT_EQ(procedure->body, "integral");
        EXPECT_EQ(procedure->procedures, std::vector<std::string>{"G"});
        EXPECT_EQ(procedure->planes.find("enough") != std::string::npos, below == 1)
            << procedure->planes;
    }
}

// On soft springs the same shaft moves as a whole: two critical speeds below its service speed, and
// none that bends it.
TEST(Procedure, MotionsOnSoftSpringsBendNothing) {
    PinnedShaft of;
    of.pins = 1e3;
    model::Case scene = of.scene();
    scene.rotor.planes = {{"a", 0.3}, {"b", 0.6}};
    scene = with_weights(scene, 200);
    const auto procedure = analyses::correction_weights(scene).procedure;
    ASSERT_TRUE(procedure);
    EXPECT_EQ(procedure->criticals, 2);
    EXPECT_EQ(procedure->bending, 0);
    EXPECT_FALSE(procedure->flexible);
    EXPECT_TRUE(procedure->procedures.empty());
    EXPECT_NE(procedure->why.find("ISO 21940-11"), std::string::npos) << procedure->why;
}

/// Discs on a light shaft, above its first bending critical speed.
model::Case discs(std::size_t count) {
    model::Case scene = PinnedShaft().scene();
    for (std::size_t i = 0; i < count; ++i)
        scene.rotor.discs.push_back(
            disc_at(static_cast<double>(i + 1) / static_cast<double>(count + 1), 20, 0.1, 0.2));
    scene.rotor.planes = {{"a", 0.3}};
    scene = with_weights(scene, 1);
    scene.operation = model::Operation{10, 600};
    return scene;
}

TEST(Procedure, FollowsWhatTheRotorIsMadeOf) {
    const auto of = [](const model::Case &scene) {
        return analyses::correction_weights(scene).procedure->procedures;
    };
    using Letters = std::vector<std::string>;
    EXPECT_EQ(of(discs(1)), (Letters{"A", "B"}));
    EXPECT_EQ(of(discs(2)), (Letters{"B", "G"}));
    EXPECT_EQ(of(discs(3)), Letters{"G"});
    model::Case scene = discs(3);
    scene.weights->removable = true;
    EXPECT_EQ(of(scene), (Letters{"C", "D", "E"}));
    scene.weights->body = model::RotorBody::roll;
    EXPECT_EQ(of(scene), (Letters{"F", "G"}));
    scene.weights->body = model::RotorBody::integral;
    EXPECT_EQ(of(scene), Letters{"G"});
    EXPECT_EQ(analyses::correction_weights(scene).procedure->service_speed, 600);
}

} // namespace
} // namespace whirl::tests::influence

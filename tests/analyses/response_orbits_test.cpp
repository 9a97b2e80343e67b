// Orbits, clearances and deflected shapes of the response: against closed forms of rotors of few
// unknowns.

#include "analyses/response.h"
#include "elements/section.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace response_orbits_test {

using namespace whirl;
using analyses::unbalance_response;
using results::ClearanceUse;
using results::DeflectedShape;
using results::Orbit;
using results::ResponseResult;
using Complex = std::complex<double>;

// Well-conditioned systems of a few unknowns, solved in double precision.
constexpr double rounding = 1e-10;
constexpr double mr = 4e-4; // kg m

/// A rigid rotor of 40 kg in the middle of two equal bearings on pedestals.
struct OnPedestals {
    double mass = 40, k = 2e6, c = 900, pedestal_mass = 6, pedestal_k = 8e6, pedestal_c = 1500;
    double clearance = 30e-6;

    /// Of the shaft in a bearing, along one direction, under the imbalance in the middle; all moves
    /// as one.
    [[nodiscard]] Complex against_pedestal(double speed) const {
        const Complex film(k, speed * c);
        const Complex below(pedestal_k - speed * speed * pedestal_mass, speed * pedestal_c);
        const Complex series = film * below / (film + below);
        const Complex shaft = mr * speed * speed / (2.0 * series - mass * speed * speed);
        return shaft * below / (film + below);
    }
    [[nodiscard]] model::Case scene(double from, double to) const {
        model::Case scene;
        scene.rotor.shaft = tests::uniform_shaft(1, 0.1, tests::weightless_steel());
        scene.rotor.shaft.rigid = true;
        scene.rotor.discs = {tests::disc_at(0.5, mass, 3, 1)};
        for (const double z : {0.0, 1.0}) {
            model::Bearing bearing = tests::isotropic_bearing(z, k, c);
            bearing.pedestal = model::Pedestal(pedestal_mass, pedestal_k, pedestal_c);
            bearing.clearance = clearance;
            scene.rotor.bearings.push_back(bearing);
        }
        scene.rotor.imbalances = {tests::imbalance_at(0.5, mr, 0.7)};
        scene.speeds = model::SpeedRange{from, to, 9};
        return scene;
    }
};

const Orbit &orbit_of(const results::Orbits &orbits, const std::string &of, double z) {
    for (const Orbit &orbit : orbits.stations)
        if (orbit.of == of && std::abs(orbit.z - z) < 1e-9)
            return orbit;
    throw std::runtime_error("no such orbit");
}

TEST(ResponseOrbits, are_against_the_pedestal) {
    const OnPedestals rotor;
    for (const model::FormChoice form : {model::FormChoice::planar, model::FormChoice::general}) {
        model::Case scene = rotor.scene(50, 900);
        scene.formulation = form;
        scene.response.orbits_at = {120, 300, 700};
        const ResponseResult result = unbalance_response(scene);
        ASSERT_EQ(result.orbits.size(), 3U);
        for (const results::Orbits &orbits : result.orbits) {
            const Complex u = rotor.against_pedestal(orbits.speed);
            const Orbit &orbit = orbit_of(orbits, "bearing", 1);
            EXPECT_NEAR(orbit.major / std::abs(u), 1, rounding);
            EXPECT_NEAR(orbit.minor / std::abs(u), 1, rounding) << "a circle, forward";
            EXPECT_NEAR(std::remainder(orbit.x_phase - 0.7 - std::arg(u), 2 * std::numbers::pi), 0,
                        rounding);
            EXPECT_NEAR(std::remainder(orbit.y_phase - orbit.x_phase, 2 * std::numbers::pi),
                        -std::numbers::pi / 2, rounding);
            EXPECT_NEAR(*orbit.share() / (std::abs(u) / rotor.clearance), 1, rounding);
            // The disc has no clearance, and its orbit is that of the response.
            EXPECT_FALSE(orbit_of(orbits, "station", 0.5).share());
            EXPECT_GT(orbit_of(orbits, "station", 0.5).major, orbit.major);
        }
    }
}

TEST(ResponseOrbits, in_each_direction_of_bearings_that_differ) {
    OnPedestals along_x;
    OnPedestals along_y = along_x;
    along_y.k = 3e6;
    along_y.c = 400;
    along_y.pedestal_k = 5e6;
    model::Case scene = along_x.scene(50, 900);
    for (model::Bearing &bearing : scene.rotor.bearings) {
        bearing.rows[0].k(1, 1) = along_y.k;
        bearing.rows[0].c(1, 1) = along_y.c;
        bearing.pedestal->k.y() = along_y.pedestal_k;
    }
    scene.response.orbits_at = {260, 330};
    for (const results::Orbits &orbits : unbalance_response(scene).orbits) {
        const Orbit &orbit = orbit_of(orbits, "bearing", 0);
        const Complex x = along_x.against_pedestal(orbits.speed);
        const Complex y = along_y.against_pedestal(orbits.speed);
        EXPECT_NEAR(orbit.x / std::abs(x), 1, rounding);
        EXPECT_NEAR(orbit.y / std::abs(y), 1, rounding);
        // y lags x by a quarter turn beside what their own phases are apart.
        EXPECT_NEAR(std::remainder(orbit.y_phase - orbit.x_phase -
                                       (std::arg(y) - std::arg(x) - std::numbers::pi / 2),
                                   2 * std::numbers::pi),
                    0, rounding);
        double farthest = 0; // all points looked at
        for (int i = 0; i < 100000; ++i) {
            const Complex turn = std::polar(1.0, std::numbers::pi * i / 100000);
            farthest = std::max(farthest,
                                std::hypot((x * turn).real(), (Complex(0, -1) * y * turn).real()));
        }
        EXPECT_NEAR(orbit.major / farthest, 1, 1e-9); // of so many points the best
    }
}

/// The largest value of a function on an interval, by looking at many points and then closely.
template <class Of> std::pair<double, double> largest_of(const Of &of, double from, double to) {
    double best = from;
    double step = (to - from) / 20000;
    for (double at = from; at <= to; at += step)
        best = of(at) > of(best) ? at : best;
    for (; step > 1e-13 * best; step /= 2)
        for (const double at : {best - step, best + step})
            if (at >= from && at <= to && of(at) > of(best))
                best = at;
    return {best, of(best)};
}

TEST(ResponseOrbits, the_largest_use_of_a_clearance_is_a_maximum_not_a_sample) {
    const OnPedestals rotor;
    const auto size = [&](double speed) { return std::abs(rotor.against_pedestal(speed)); };
    const ResponseResult result = unbalance_response(rotor.scene(50, 900));
    const auto [speed, value] = largest_of(size, 50, 900);
    ASSERT_EQ(result.clearances.size(), 2U);
    for (const ClearanceUse &use : result.clearances) {
        EXPECT_EQ(use.of, "bearing");
        EXPECT_NEAR(use.share / (value / rotor.clearance), 1, rounding);
        EXPECT_NEAR(use.speed / speed, 1, 1e-6); // where the curve is flat
        EXPECT_GT(use.share, 1);
    }
    int told = 0;
    for (const auto &note : result.model.notes)
        told += note.find("clearance: ") == 0 && note.find(" would touch") != std::string::npos;
    EXPECT_EQ(told, 2);
    // The peaks and curves of the result are those of the same rotor without clearances.
    model::Case without = rotor.scene(50, 900);
    for (model::Bearing &bearing : without.rotor.bearings)
        bearing.clearance.reset();
    const ResponseResult plain = unbalance_response(without);
    EXPECT_TRUE(plain.clearances.empty());
    ASSERT_EQ(plain.peaks.size(), result.peaks.size());
    EXPECT_EQ(plain.curves.values.size(), result.curves.values.size());
    for (std::size_t i = 0; i < plain.peaks.size(); ++i)
        EXPECT_NEAR(plain.peaks[i].value / result.peaks[i].value, 1, rounding);
}

// A clearance is no part of the equations: beside it peaks and what few shapes leave of them stay
// as they are, also of bearings on soft pedestals, against which the orbit in the clearance counts.
TEST(ResponseOrbits, a_clearance_changes_no_peak) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1.5, 0.1, tests::steel());
    scene.rotor.shaft.segments.front().elements = 20; // more unknowns than are taken whole
    for (const double z : {0.1, 1.4}) {
        model::Bearing bearing = tests::isotropic_bearing(z, 5e7, 2e4);
        bearing.pedestal = model::Pedestal(60, 2e8, 1e4);
        scene.rotor.bearings.push_back(bearing);
    }
    scene.rotor.imbalances = {tests::imbalance_at(0.7, mr, 0.7)};
    scene.speeds = model::SpeedRange{0, 1500, 31};
    const ResponseResult without = unbalance_response(scene);
    for (model::Bearing &bearing : scene.rotor.bearings)
        bearing.clearance = 1e-4;
    const ResponseResult with = unbalance_response(scene);
    constexpr double agreed = 1e-9; // between the whole rotor and that on few shapes
    ASSERT_FALSE(without.peaks.empty());
    ASSERT_EQ(with.peaks.size(), without.peaks.size());
    for (std::size_t i = 0; i < with.peaks.size(); ++i) {
        EXPECT_NEAR(with.peaks[i].value / without.peaks[i].value, 1, 2 * agreed);
        EXPECT_LE(without.peaks[i].error_parts.reduction, agreed);
        EXPECT_LE(with.peaks[i].error_parts.reduction, agreed);
    }
    for (const ClearanceUse &use : with.clearances)
        EXPECT_LE(use.error, 1e-6); // 20 elements of order 4, and few shapes
}

TEST(ResponseOrbits, the_largest_use_may_be_at_an_end_of_the_range) {
    const OnPedestals rotor;
    const double below =
        0.8 *
        largest_of([&](double speed) { return std::abs(rotor.against_pedestal(speed)); }, 50, 900)
            .first;
    for (const int count : {9, 1}) {
        model::Case scene = rotor.scene(count > 1 ? 50 : below, below);
        scene.speeds->count = count;
        const ResponseResult result = unbalance_response(scene);
        EXPECT_NEAR(result.clearances.at(0).share /
                        (std::abs(rotor.against_pedestal(below)) / rotor.clearance),
                    1, rounding);
        EXPECT_EQ(result.clearances.at(0).speed, below);
        ASSERT_EQ(result.orbits.size(), 1U); // without a peak, at the end
        EXPECT_EQ(result.orbits[0].speed, below);
    }
}

TEST(ResponseOrbits, no_limit_at_a_resonance_without_damping) {
    OnPedestals rotor;
    rotor.c = rotor.pedestal_c = 0;
    const ResponseResult result = unbalance_response(rotor.scene(50, 900));
    EXPECT_TRUE(std::isinf(result.clearances.at(0).share));
    bool told = false;
    for (const auto &note : result.model.notes)
        told = told || note.find("has no limit") != std::string::npos;
    EXPECT_TRUE(told);
    model::Case scene = rotor.scene(50, 900);
    scene.response.orbits_at = {result.clearances[0].speed, 100};
    const ResponseResult asked = unbalance_response(scene);
    ASSERT_EQ(asked.orbits.size(), 1U);
    EXPECT_EQ(asked.orbits[0].speed, 100);
    told = false;
    for (const auto &note : asked.model.notes)
        told = told || note.find("orbits_at: ") == 0;
    EXPECT_TRUE(told);
}

TEST(ResponseOrbits, without_being_told_where_the_machine_runs_and_at_the_resonances_between) {
    const OnPedestals rotor;
    model::Case scene = rotor.scene(50, 2500);
    const ResponseResult free = unbalance_response(scene);
    std::vector<results::ResponsePeak> peaks;
    for (const results::ResponsePeak &peak : free.peaks)
        if (peak.of == "station" && peak.z == 0.5)
            peaks.push_back(peak);
    ASSERT_EQ(peaks.size(), 2U); // the rotor, and the pedestals below it
    ASSERT_EQ(free.orbits.size(), 1U);
    const double larger = peaks[0].value > peaks[1].value ? peaks[0].speed : peaks[1].speed;
    // Of stations that move alike, each with its own peak, rounding chooses.
    EXPECT_NEAR(free.orbits[0].speed / larger, 1, 1e-10);
    // Between the operating speeds at each resonance, judged by its largest peak of a station.
    ASSERT_FALSE(free.resonances.empty());
    const double resonance = free.resonances.front().peak.speed;
    scene.operation = model::Operation{0.9 * resonance, 1.1 * resonance, {}};
    const ResponseResult held = unbalance_response(scene);
    ASSERT_EQ(held.orbits.size(), 3U);
    EXPECT_EQ(held.orbits[0].speed, scene.operation->from);
    EXPECT_NEAR(held.orbits[1].speed / resonance, 1, 1e-6);
    EXPECT_EQ(held.orbits[2].speed, scene.operation->to);
    // A flank is no resonance.
    const results::ResponsePeak &smaller = peaks[0].value > peaks[1].value ? peaks[1] : peaks[0];
    ASSERT_FALSE(smaller.resonance.has_value());
    scene.operation = model::Operation{0.9 * smaller.speed, 1.1 * smaller.speed, {}};
    EXPECT_EQ(unbalance_response(scene).orbits.size(), 2U);
    ASSERT_EQ(held.shapes.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(held.shapes[i].speed, held.orbits[i].speed);
}

/// A rigid rotor moves as u + tilt (z - 0.5), each from its own equation.
TEST(DeflectedShape, of_a_rigid_rotor) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1, 0.1, tests::weightless_steel());
    scene.rotor.shaft.rigid = true;
    scene.rotor.discs = {tests::disc_at(0.5, 60, 3, 1)};
    scene.rotor.bearings = {tests::isotropic_bearing(0, 2e6, 300),
                            tests::isotropic_bearing(1, 2e6, 300)};
    scene.rotor.imbalances = {tests::imbalance_at(0.8, 1e-3, 0.4)};
    scene.speeds = model::SpeedRange{100, 1000, 10};
    scene.response.shape_at = {150, 240, 800};
    const ResponseResult result = unbalance_response(scene);
    ASSERT_EQ(result.shapes.size(), 3U);
    for (const DeflectedShape &shape : result.shapes) {
        const double s = shape.speed;
        const Complex k(2e6, 300 * s);
        const Complex force = std::polar(1e-3 * s * s, 0.4);
        const Complex u = force / (2.0 * k - 60 * s * s);
        const Complex tilt = force * 0.3 / (2.0 * k * 0.25 - (3 - 1) * s * s);
        double largest = 0;
        for (const double z : shape.z)
            largest = std::max(largest, std::abs(u + tilt * (z - 0.5)));
        EXPECT_NEAR(shape.largest / largest, 1, rounding);
        for (std::size_t i = 0; i < shape.z.size(); ++i) {
            const Complex w = u + tilt * (shape.z[i] - 0.5);
            const Complex then = w * std::polar(1.0, shape.instant);
            EXPECT_NEAR(shape.envelope[i], std::abs(w), rounding * largest);
            EXPECT_NEAR(shape.x[i], then.real(), rounding * largest);
            EXPECT_NEAR(shape.y[i], then.imag(), rounding * largest);
            if (shape.z[i] == shape.largest_z) { // farthest out on the positive side
                EXPECT_NEAR(shape.x[i], largest, rounding * largest);
                EXPECT_NEAR(shape.y[i], 0, rounding * largest);
            }
        }
    }
}

/// Below its resonance a massless shaft between stiff supports bends under the disc in its middle
/// as under a force there: F [z (3 L^2 - 4 z^2) / 48 EI + z / 2 kappa G A] up to the middle.
TEST(DeflectedShape, of_a_massless_shaft_is_that_under_a_force) {
    constexpr double diameter = 0.03;
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1, diameter, tests::weightless_steel());
    scene.rotor.discs = {tests::disc_at(0.5, 10, 0.05, 0.1)};
    scene.rotor.bearings = {tests::isotropic_bearing(0, 1e15), tests::isotropic_bearing(1, 1e15)};
    scene.rotor.imbalances = {tests::imbalance_at(0.5, 2e-4)};
    scene.speeds = model::SpeedRange{20, 100, 5};
    const ResponseResult result = unbalance_response(scene);
    ASSERT_EQ(result.shapes.size(), 1U);
    const DeflectedShape &shape = result.shapes[0];
    const model::Material material = tests::weightless_steel();
    const double A = std::numbers::pi * diameter * diameter / 4;
    const double I = A * diameter * diameter / 16;
    const double kappa =
        elements::shear_coefficient(model::ShearFormula::cowper, material.poisson_ratio(), 0);
    const auto under_force = [&](double z) {
        return z * (3 - 4 * z * z) / (48 * material.E * I) + z / (2 * kappa * material.G * A);
    };
    EXPECT_EQ(shape.largest_z, 0.5);
    for (std::size_t i = 0; i < shape.z.size(); ++i) {
        const double z = std::min(shape.z[i], 1 - shape.z[i]);
        // Bearings of 1e15 N/m against 1e6 of the shaft give way by 1e-9.
        EXPECT_NEAR(shape.x[i] / shape.largest, under_force(z) / under_force(0.5), 1e-8);
        EXPECT_NEAR(shape.y[i], 0, 1e-8 * shape.largest);
    }
}

} // namespace response_orbits_test

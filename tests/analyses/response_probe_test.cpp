// The response in x, in y and along a probe: against closed forms and an independent dense
// solution.

#include "analyses/response.h"

#include "support/scaled_units.h"
#include "support/scenes.h"
#include "support/test_rotors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <regex>
#include <string>
#include <utility>
#include <vector>

namespace response_probe_test {
namespace {

using namespace whirl;
using analyses::unbalance_response;
using results::ResponseNode;
using results::ResponseProbe;
using results::ResponseResult;

constexpr double pi = std::numbers::pi;
// Well-conditioned systems of a few unknowns, solved in double precision.
constexpr double rounding = 1e-10;

const ResponseNode &node_at(const ResponseResult &result, double z) {
    for (const ResponseNode &node : result.nodes)
        if (std::abs(node.z - z) < 1e-9)
            return node;
    throw std::runtime_error("no such node");
}

void expect_phasor(double amplitude, double phase, std::complex<double> expected,
                   double tolerance) {
    EXPECT_LE(std::abs(std::polar(amplitude, phase) - expected), tolerance * std::abs(expected))
        << amplitude << " m at " << phase << " rad, expected " << std::abs(expected) << " at "
        << std::arg(expected);
}

/// The point of the orbit farthest from the middle, found by looking at all of them.
std::complex<double> farthest(std::complex<double> x, std::complex<double> y) {
    std::complex<double> point = 0;
    for (int i = 0; i < 20000; ++i) {
        const std::complex<double> turn = std::polar(1.0, pi * i / 20000);
        const std::complex<double> at((x * turn).real(), (y * turn).real());
        if (std::abs(at) > std::abs(point))
            point = at;
    }
    return point;
}

/// 10 kg in the middle of two bearings that differ between x and y, with damping, and probes along
/// x, y and 45 degrees.
model::Case orthotropic_jeffcott() {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1, 0.1, tests::weightless_steel());
    scene.rotor.shaft.rigid = true;
    scene.rotor.discs = {tests::disc_at(0.5, 10, 0.3, 0.1)};
    for (const double z : {0.0, 1.0}) {
        model::Bearing bearing = tests::isotropic_bearing(z, 1e5, 40);
        bearing.rows[0].k(1, 1) = 2e5;
        bearing.rows[0].c(1, 1) = 70;
        scene.rotor.bearings.push_back(bearing);
    }
    scene.rotor.imbalances = {tests::imbalance_at(0.5, 2e-4, 0.3)};
    scene.rotor.probes = {{"x", 0.5, 0},
                          {"y", 0.5, pi / 2},
                          {"between", 0.5, pi / 4},
                          {"opposite", 0.3, -3 * pi / 4}};
    scene.speeds = model::SpeedRange{20, 320, 31};
    return scene;
}

TEST(ResponseProbe, jeffcott_rotor_on_orthotropic_bearings) {
    const model::Case scene = orthotropic_jeffcott();
    const ResponseResult result = unbalance_response(scene);
    ASSERT_EQ(result.probes.size(), 4U);
    EXPECT_EQ(result.probes[2].name, "between");
    const ResponseNode &disc = node_at(result, 0.5);
    for (std::size_t i = 0; i < result.speeds.size(); ++i) {
        const double s = result.speeds[i];
        const std::complex<double> force = std::polar(2e-4 * s * s, 0.3);
        const std::complex<double> j(0, 1);
        const std::complex<double> x = force / (2e5 - 10 * s * s + j * s * 80.0);
        const std::complex<double> y = -j * force / (4e5 - 10 * s * s + j * s * 140.0);
        expect_phasor(disc.x[i], disc.x_phase[i], x, rounding);
        expect_phasor(disc.y[i], disc.y_phase[i], y, rounding);
        EXPECT_EQ(disc.phase[i], disc.x_phase[i]);
        EXPECT_EQ(disc.amplitude[i], disc.major[i]);
        expect_phasor(result.probes[0].amplitude[i], result.probes[0].phase[i], x, rounding);
        expect_phasor(result.probes[1].amplitude[i], result.probes[1].phase[i], y, rounding);
        const std::complex<double> between = (x + y) / std::numbers::sqrt2;
        // Where x and y nearly cancel each other, rounding is that of the larger.
        const double size = std::max(std::abs(x), std::abs(y)) / std::abs(between);
        for (const std::size_t probe : {2U, 3U}) {
            const ResponseProbe &at = result.probes[probe];
            expect_phasor(at.amplitude[i], at.phase[i], probe == 2 ? between : -between,
                          rounding * size);
        }
        const std::complex<double> end = farthest(x, y);
        // Steps of pi / 20000 along the orbit: its end is missed by less than their square.
        EXPECT_NEAR(disc.major[i] / std::abs(end), 1, 1e-7);
        if (std::abs(disc.minor[i]) < 0.99 * disc.major[i]) {
            EXPECT_NEAR(std::sin(disc.inclination[i] - std::arg(end)), 0, 0.02) << s;
        }
        EXPECT_GT(disc.inclination[i], -pi / 2);
        EXPECT_LE(disc.inclination[i], pi / 2);
    }
}

TEST(ResponseProbe, circles_have_no_inclination) {
    model::Case scene = orthotropic_jeffcott();
    for (model::Bearing &bearing : scene.rotor.bearings)
        bearing.rows[0] = scene.rotor.bearings[0].rows[0];
    for (model::Bearing &bearing : scene.rotor.bearings) {
        bearing.rows[0].k(1, 1) = 1e5;
        bearing.rows[0].c(1, 1) = 40;
    }
    for (const model::FormChoice form : {model::FormChoice::planar, model::FormChoice::general}) {
        scene.formulation = form;
        const ResponseResult result = unbalance_response(scene);
        for (std::size_t i = 0; i < result.speeds.size(); ++i) {
            EXPECT_TRUE(std::isnan(node_at(result, 0.5).inclination[i])) << result.speeds[i];
            EXPECT_NEAR(result.probes[2].amplitude[i] / node_at(result, 0.5).amplitude[i], 1,
                        rounding);
        }
    }
}

/// Dense complex solution by a program of its own (numpy; two-node Timoshenko elements with the
/// shear parameter of Przemieniecki, Cowper's coefficient): speed, z, |x|, phase, |y|, phase, the
/// reading at 45 degrees; the largest radius and its direction among 200,001 points of the orbit.
struct Dense {
    double speed, z, x, x_phase, y, y_phase, probe, probe_phase, major, inclination;
};

TEST(ResponseProbe, flexible_damped_rotor_on_cross_coupled_bearings) {
    const std::vector<Dense> expected{
        {60, 0.25, 1.118074441097e-06, 0.104856971357, 1.331186386284e-06, -1.618369554091,
         1.133613479209e-06, -0.857809098990, 1.362463471e-06, -1.21397},
        {60, 1, 1.284107354825e-06, -0.086520452763, 1.515741226348e-06, -1.788513986399,
         1.310944174711e-06, -1.031603384752, 1.544504767e-06, -1.23795},
        {87, 0.25, 3.544428399685e-05, 1.993622632530, 1.243563854260e-05, -0.164223761056,
         2.147845786085e-05, 1.645791906721, 3.616600931e-05, -0.20861},
        {150, 1, 2.779843714125e-06, 3.101485622631, 2.896663419058e-06, 1.549691276413,
         2.865675299093e-06, 2.305399070945, 2.902457144e-06, 1.35462},
        {400, 0.25, 1.082646455775e-05, -2.771176994280, 1.021260853566e-05, 1.963129131992,
         1.063851309381e-05, 2.766105356796, 1.084675027e-05, 0.17949},
    };
    model::Case scene;
    scene.rotor = tests::two_disc_rotor(0, 0);
    scene.rotor.shaft.order = 1;
    for (model::Segment &segment : scene.rotor.shaft.segments)
        segment.elements = 2;
    for (model::Bearing &bearing : scene.rotor.bearings) {
        bearing.rows[0].k << 1e6, 2e5, -1e5, 8e5;
        bearing.rows[0].c << 100, 20, -30, 300;
    }
    scene.rotor.imbalances = {tests::imbalance_at(0.5, 2e-4, 0.3),
                              tests::imbalance_at(1, 1e-4, -2)};
    for (const Dense &dense : expected) {
        scene.rotor.probes = {{"", dense.z, pi / 4}};
        scene.speeds = model::SpeedRange{dense.speed, dense.speed, 1};
        const ResponseResult result = unbalance_response(scene);
        const ResponseNode &node = node_at(result, dense.z);
        // Twelve digits are given; both round by 1e-13 times the condition near a resonance.
        constexpr double digits = 1e-9;
        expect_phasor(node.x[0], node.x_phase[0], std::polar(dense.x, dense.x_phase), digits);
        expect_phasor(node.y[0], node.y_phase[0], std::polar(dense.y, dense.y_phase), digits);
        expect_phasor(result.probes[0].amplitude[0], result.probes[0].phase[0],
                      std::polar(dense.probe, dense.probe_phase), digits);
        EXPECT_NEAR(node.major[0] / dense.major, 1, 1e-8);
        EXPECT_NEAR(node.inclination[0], dense.inclination, 1e-4);
    }
}

TEST(ResponseProbe, resonance_without_damping_has_no_amplitude_and_the_other_speeds_have) {
    model::Case scene = orthotropic_jeffcott();
    for (model::Bearing &bearing : scene.rotor.bearings)
        bearing.rows[0].c.setZero();
    for (const bool rigid : {true, false}) {
        scene.rotor.shaft.rigid = rigid;
        const double critical = std::sqrt(2e5 / 10.0);
        scene.speeds = model::SpeedRange{critical, 2 * critical, 3};
        if (!rigid) { // found first, to its last digits
            double low = 100;
            double high = 143;
            for (int i = 0; i < 200 && low < high; ++i) {
                const double middle = (low + high) / 2;
                scene.speeds = model::SpeedRange{middle, middle, 1};
                const ResponseResult at = unbalance_response(scene);
                if (std::isinf(node_at(at, 0.5).amplitude[0]))
                    break;
                // Below the resonance x moves with the imbalance.
                (std::abs(std::remainder(node_at(at, 0.5).x_phase[0] - 0.3, 2 * pi)) < 1 ? low
                                                                                         : high) =
                    middle;
                ASSERT_LT(i, 199);
            }
            scene.speeds->to = 2 * scene.speeds->from;
            scene.speeds->count = 3;
        }
        const ResponseResult result = unbalance_response(scene);
        const ResponseNode &disc = node_at(result, 0.5);
        EXPECT_TRUE(std::isinf(disc.amplitude[0]));
        EXPECT_TRUE(std::isnan(disc.phase[0]));
        EXPECT_TRUE(std::isinf(result.probes[0].amplitude[0]));
        EXPECT_TRUE(std::isinf(result.bearings[0].force[0]));
        ASSERT_EQ(result.model.notes.size(), 1U);
        EXPECT_NE(result.model.notes[0].find("no limit"), std::string::npos);
        for (const std::size_t i : {1U, 2U}) {
            EXPECT_LT(disc.amplitude[i], 1e-3);
            EXPECT_GT(disc.amplitude[i], 0);
            EXPECT_LT(disc.error[i], 1e-6);
        }
    }
}

TEST(ResponseProbe, the_error_is_that_of_the_elements) {
    model::Case scene;
    scene.rotor = tests::two_disc_rotor(1e6, 7e5, 1e5, 80);
    scene.rotor.imbalances = {tests::imbalance_at(0.5, 2e-4, 0.3)};
    scene.rotor.probes = {{"", 0.7, 0.4}, {"", 1.3, 2.1}};
    scene.speeds = model::SpeedRange{50, 950, 61};
    scene.rotor.shaft.order = 12;
    const ResponseResult exact = unbalance_response(scene);
    for (const int order : {1, 2, 4}) {
        scene.rotor.shaft.order = order;
        const ResponseResult result = unbalance_response(scene);
        const auto expect_held = [&](double value, double truth, double error, double speed) {
            // The one of the finer model is below 1e-9; what is smaller than that says nothing.
            EXPECT_LE(std::abs(value - truth), error * std::max(value, truth) + 1e-9 * truth)
                << "order " << order << " at " << speed;
        };
        double largest = 0;
        for (std::size_t i = 0; i < result.speeds.size(); ++i) {
            const double s = result.speeds[i];
            for (std::size_t n = 0; n < result.nodes.size(); ++n) {
                const ResponseNode &node = result.nodes[n];
                expect_held(node.amplitude[i], exact.nodes[n].amplitude[i], node.error[i], s);
                // |x| is off by a share of the amplitude.
                EXPECT_LE(std::abs(node.x[i] - exact.nodes[n].x[i]),
                          (node.error[i] + 1e-9) *
                              std::max(node.amplitude[i], exact.nodes[n].amplitude[i]));
                largest = std::max(largest, node.error[i]);
            }
            for (std::size_t b = 0; b < result.bearings.size(); ++b)
                expect_held(result.bearings[b].force[i], exact.bearings[b].force[i],
                            result.bearings[b].error[i], s);
            for (std::size_t p = 0; p < result.probes.size(); ++p)
                expect_held(result.probes[p].amplitude[i], exact.probes[p].amplitude[i],
                            result.probes[p].error[i], s);
        }
        EXPECT_GT(largest, order == 1 ? 1e-2 : order == 2 ? 1e-3 : 1e-7);
    }
}

namespace {

/// A text and the numbers in it, apart.
std::pair<std::string, std::vector<double>> words_and_numbers(const std::string &text) {
    static const std::regex number(R"([0-9]+(\.[0-9]+)?(e[+-]?[0-9]+)?)");
    std::vector<double> numbers;
    for (std::sregex_iterator it(text.begin(), text.end(), number), end; it != end; ++it)
        numbers.push_back(std::stod(it->str()));
    return {std::regex_replace(text, number, "#"), numbers};
}

/// The same notes: their words, their counts, and speeds and growth (1/s) in the other unit, to the
/// four digits that are printed of some.
void expect_notes_in(const tests::Units &u, const std::vector<results::Sentence> &notes,
                     const std::vector<results::Sentence> &expected) {
    ASSERT_EQ(notes.size(), expected.size());
    for (std::size_t i = 0; i < notes.size(); ++i) {
        const auto [words, numbers] = words_and_numbers(notes[i]);
        const auto [expected_words, expected_numbers] = words_and_numbers(expected[i]);
        EXPECT_EQ(words, expected_words);
        ASSERT_EQ(numbers.size(), expected_numbers.size());
        for (std::size_t k = 0; k < numbers.size(); ++k)
            if (numbers[k] != expected_numbers[k]) {
                EXPECT_NEAR(numbers[k] * u.time, expected_numbers[k], 5e-4 * expected_numbers[k])
                    << notes[i];
            }
    }
}

} // namespace

TEST(ResponseProbe, other_units_give_the_same_digits) {
    model::Case scene;
    scene.rotor = tests::two_disc_rotor(1e6, 7e5, 1e5, 80);
    scene.rotor.bearings[0].rows[0].kt << 4e3, 0, 0, 9e3;
    scene.rotor.bearings[1].pedestal = model::Pedestal{12, 5e6, 200};
    scene.rotor.imbalances = {tests::imbalance_at(0.5, 2e-4, 0.3)};
    scene.rotor.probes = {{"", 0.7, 0.4}};
    scene.speeds = model::SpeedRange{0, 950, 41};
    model::Case isotropic = scene;
    for (model::Bearing &bearing : isotropic.rotor.bearings)
        bearing.rows[0].k = 1e6 * Eigen::Matrix2d::Identity();
    isotropic.rotor.bearings[0].rows[0].kt.setZero();
    model::Case asymmetric = isotropic;
    asymmetric.rotor.shaft.segments[1].asymmetry = 0.2;
    for (const model::Case &one : {scene, isotropic, asymmetric}) {
        const ResponseResult expected = unbalance_response(one);
        for (const auto &[length, mass, time] : {std::tuple(-20, 0, 0),
                                                 {20, 0, 0},
                                                 {0, 20, 0},
                                                 {0, -20, 0},
                                                 {0, 0, 20},
                                                 {0, 0, -20},
                                                 {-10, 7, 3}}) {
            const tests::Units u{std::ldexp(1.0, length), std::ldexp(1.0, mass),
                                 std::ldexp(1.0, time)};
            const ResponseResult result = unbalance_response(tests::scaled(one, u));
            expect_notes_in(u, result.model.notes, expected.model.notes);
            for (std::size_t i = 0; i < expected.speeds.size(); ++i) {
                const ResponseNode &a = expected.nodes[1];
                const ResponseNode &b = result.nodes[1];
                EXPECT_EQ(b.amplitude[i], a.amplitude[i] * u.length) << length << mass << time;
                EXPECT_EQ(b.x_phase[i], a.x_phase[i]);
                EXPECT_EQ(b.error[i], a.error[i]);
                EXPECT_EQ(result.bearings[1].force[i], expected.bearings[1].force[i] * u.force());
                EXPECT_EQ(result.probes[0].amplitude[i],
                          expected.probes[0].amplitude[i] * u.length);
            }
        }
    }
}

} // namespace

} // namespace response_probe_test

#include "analyses/response.h"
#include "closed_form/jeffcott.h"
#include "elements/section.h"
#include "input/case_file.h"
#include "model/errors.h"
#include "results/formulation.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using namespace whirl;
using analyses::unbalance_response;
using results::ResponseResult;

// Well-conditioned systems of a few unknowns, solved in double precision.
constexpr double rounding = 1e-10;

const results::ResponseNode &node_at(const ResponseResult &result, double z) {
    for (const results::ResponseNode &node : result.nodes)
        if (std::abs(node.z - z) < 1e-9)
            return node;
    throw std::runtime_error("no such node");
}

/// 10 kg in the middle of 1 m of weightless shaft, 1e8 N/m bearings, a damper at the disc.
struct Jeffcott {
    model::Case scene;
    closed_form::JeffcottRotor closed;

    Jeffcott() {
        const double length = 1;
        const double diameter = 0.03;
        const double kb = 1e8;
        scene.rotor.shaft = tests::uniform_shaft(length, diameter, tests::weightless_steel());
        scene.rotor.discs = {tests::disc_at(0.5, 10, 0.05, 0.1)};
        scene.rotor.bearings = {tests::isotropic_bearing(0, kb), tests::isotropic_bearing(1, kb),
                                tests::isotropic_bearing(0.5, 0, 80)};
        scene.rotor.imbalances = {tests::imbalance_at(0.5, 2e-4, 0.3)};
        scene.speeds = model::SpeedRange{20, 320, 16};
        const double A = std::numbers::pi * diameter * diameter / 4;
        const double I = A * diameter * diameter / 16;
        const model::Material material = tests::weightless_steel();
        const double kappa =
            elements::shear_coefficient(model::ShearFormula::cowper, material.poisson_ratio(), 0);
        // Mid-span deflection of a simply supported Timoshenko beam under a unit force, and of the
        // two bearings in parallel.
        const double flexibility = std::pow(length, 3) / (48 * material.E * I) +
                                   length / (4 * kappa * material.G * A) + 1 / (2 * kb);
        closed = {10, 1 / flexibility, 80, 0, 2e-4 / 10};
    }
};

TEST(UnbalanceResponse, jeffcott_rotor) {
    Jeffcott jeffcott;
    for (const int order : {1, 4, 8}) {
        jeffcott.scene.rotor.shaft.order = order;
        const ResponseResult result = unbalance_response(jeffcott.scene);
        EXPECT_EQ(result.model.formulation.form, results::Form::planar);
        const results::ResponseNode &disc = node_at(result, 0.5);
        ASSERT_EQ(result.speeds.size(), 16U);
        for (std::size_t i = 0; i < result.speeds.size(); ++i) {
            const std::complex<double> u =
                closed_form::jeffcott_response(jeffcott.closed, result.speeds[i]);
            // Near the peak the difference of stiffness and inertia has lost two digits more.
            EXPECT_NEAR(disc.amplitude[i] / std::abs(u), 1, 100 * rounding) << result.speeds[i];
            EXPECT_NEAR(std::remainder(disc.phase[i] - 0.3 - std::arg(u), 2 * std::numbers::pi), 0,
                        100 * rounding);
            EXPECT_NEAR(disc.minor[i] / disc.major[i], 1, rounding) << "a forward circle";
            EXPECT_NEAR(result.bearings[2].force[i], 80 * result.speeds[i] * disc.amplitude[i],
                        rounding * result.bearings[2].force[i]);
        }
    }
}

TEST(UnbalanceResponse, internal_damping_does_not_act) {
    Jeffcott jeffcott;
    const ResponseResult without = unbalance_response(jeffcott.scene);
    jeffcott.scene.rotor.shaft.internal_damping = 1e-3;
    for (const model::FormChoice form : {model::FormChoice::planar, model::FormChoice::general}) {
        jeffcott.scene.formulation = form;
        const ResponseResult with = unbalance_response(jeffcott.scene);
        for (std::size_t i = 0; i < with.speeds.size(); ++i)
            EXPECT_NEAR(with.nodes[1].amplitude[i] / without.nodes[1].amplitude[i], 1,
                        1000 * rounding);
    }
}

/// Rigid bar of 60 kg with its centre of mass in the middle of two springs.
model::Case rigid_scene() {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1, 0.1, tests::weightless_steel());
    scene.rotor.shaft.rigid = true;
    scene.rotor.discs = {tests::disc_at(0.5, 60, 3, 1)};
    scene.rotor.bearings = {tests::isotropic_bearing(0, 2e6), tests::isotropic_bearing(1, 2e6)};
    scene.rotor.imbalances = {tests::imbalance_at(0.8, 1e-3)};
    scene.speeds = model::SpeedRange{100, 1000, 10};
    return scene;
}

TEST(UnbalanceResponse, rigid_rotor_translates_and_tilts) {
    const ResponseResult result = unbalance_response(rigid_scene());
    for (std::size_t i = 0; i < result.speeds.size(); ++i) {
        const double s2 = result.speeds[i] * result.speeds[i];
        // (k11 - M s^2) u = mr s^2, (k33 - (Id - Ip) s^2) tilt = mr s^2 * 0.3 m
        const double u = 1e-3 * s2 / (4e6 - 60 * s2);
        const double tilt = 1e-3 * s2 * 0.3 / (2 * 2e6 * 0.25 - (3 - 1) * s2);
        for (const double z : {0.0, 0.5, 0.8, 1.0}) {
            const double expected = u + tilt * (z - 0.5);
            EXPECT_NEAR(node_at(result, z).amplitude[i], std::abs(expected),
                        rounding * std::abs(expected));
            EXPECT_NEAR(std::cos(node_at(result, z).phase[i]), expected > 0 ? 1 : -1, rounding);
        }
        EXPECT_NEAR(result.bearings[0].force[i] / (2e6 * std::abs(u - tilt / 2)), 1, rounding);
        EXPECT_NEAR(result.bearings[1].force[i] / (2e6 * std::abs(u + tilt / 2)), 1, rounding);
    }
}

TEST(UnbalanceResponse, pedestals_are_in_series_with_the_film) {
    model::Case scene = rigid_scene();
    scene.rotor.imbalances = {tests::imbalance_at(0.5, 1e-3)};
    for (model::Bearing &bearing : scene.rotor.bearings)
        bearing.pedestal = model::Pedestal{4, 3e6, 0};
    const ResponseResult result = unbalance_response(scene);
    for (std::size_t i = 0; i < result.speeds.size(); ++i) {
        const double s2 = result.speeds[i] * result.speeds[i];
        const double below = 3e6 - 4 * s2;
        const double k = 2e6 * below / (2e6 + below);
        const double u = 1e-3 * s2 / (2 * k - 60 * s2);
        EXPECT_NEAR(node_at(result, 0.5).amplitude[i] / std::abs(u), 1, rounding);
        EXPECT_NEAR(result.bearings[1].force[i] / std::abs(k * u), 1, rounding);
    }
}

TEST(UnbalanceResponse, orthotropic_bearings_give_backward_orbits_between_the_critical_speeds) {
    model::Case scene = rigid_scene();
    scene.rotor.imbalances = {tests::imbalance_at(0.5, 1e-3)};
    for (model::Bearing &bearing : scene.rotor.bearings)
        bearing.rows[0].k(1, 1) = 8e6;
    const ResponseResult result = unbalance_response(scene);
    EXPECT_EQ(result.model.formulation.form, results::Form::general);
    int backward = 0;
    for (std::size_t i = 0; i < result.speeds.size(); ++i) {
        const double s2 = result.speeds[i] * result.speeds[i];
        const double x = 1e-3 * s2 / (4e6 - 60 * s2);
        const double y = 1e-3 * s2 / (16e6 - 60 * s2);
        const results::ResponseNode &middle = node_at(result, 0.5);
        EXPECT_NEAR(middle.major[i] / std::max(std::abs(x), std::abs(y)), 1, rounding);
        const double minor = std::min(std::abs(x), std::abs(y)) * (x * y > 0 ? 1 : -1);
        EXPECT_NEAR(middle.minor[i] / minor, 1, 10 * rounding);
        backward += middle.minor[i] < 0 ? 1 : 0;
        EXPECT_NEAR(result.bearings[0].force[i] / std::max(2e6 * std::abs(x), 8e6 * std::abs(y)), 1,
                    rounding);
    }
    EXPECT_EQ(backward, 3); // 300, 400 and 500 rad/s lie between 258 and 516
}

TEST(UnbalanceResponse, bearing_tables_are_read_at_each_speed) {
    model::Case scene = rigid_scene();
    scene.rotor.imbalances = {tests::imbalance_at(0.5, 1e-3)};
    for (model::Bearing &bearing : scene.rotor.bearings) {
        bearing.speeds = {0, 1000};
        bearing.rows.push_back(bearing.rows[0]);
        bearing.rows[1].k *= 6;
        bearing.rows[1].c = 500 * Eigen::Matrix2d::Identity();
    }
    const ResponseResult result = unbalance_response(scene);
    for (std::size_t i = 0; i < result.speeds.size(); ++i) {
        const double s = result.speeds[i];
        const std::complex<double> film(2e6 * (1 + 5 * s / 1000), s * 500 * s / 1000);
        const std::complex<double> u = 1e-3 * s * s / (2.0 * film - 60 * s * s);
        EXPECT_NEAR(node_at(result, 0.5).amplitude[i] / std::abs(u), 1, rounding);
        EXPECT_NEAR(result.bearings[0].force[i] / std::abs(film * u), 1, rounding);
    }
}

TEST(UnbalanceResponse, peaks_where_a_bearing_table_bends_are_said) {
    model::Case scene = rigid_scene();
    scene.rotor.imbalances = {tests::imbalance_at(0.5, 1e-3)};
    scene.speeds = model::SpeedRange{20, 200, 10};
    for (model::Bearing &bearing : scene.rotor.bearings) {
        bearing.rows[0].c = 500 * Eigen::Matrix2d::Identity();
        bearing.speeds = {0, 100, 150};
        bearing.rows.resize(3, bearing.rows[0]);
        bearing.rows[2].k *= 100; // resonance, at 258 rad/s, runs away from the spin speed
    }
    const auto said = [](const ResponseResult &result) {
        return std::any_of(result.model.notes.begin(), result.model.notes.end(),
                           [](const std::string &note) {
                               return note.starts_with("peaks at 100 rad/s are at rows");
                           });
    };
    const ResponseResult bent = unbalance_response(scene);
    ASSERT_FALSE(bent.peaks.empty());
    EXPECT_NEAR(bent.peaks.front().speed, 100, 1e-5);
    EXPECT_TRUE(said(bent));
    for (model::Bearing &bearing : scene.rotor.bearings)
        bearing.rows[2].k /= 100; // the same over all speeds: no bend, and the resonance beyond
    EXPECT_FALSE(said(unbalance_response(scene)));
}

TEST(UnbalanceResponse, undamped_resonance_has_no_amplitude) {
    model::Case scene = rigid_scene();
    scene.rotor.imbalances = {tests::imbalance_at(0.5, 1e-3)};
    scene.speeds = model::SpeedRange{std::sqrt(4e6 / 60), 0, 1};
    const ResponseResult result = unbalance_response(scene);
    EXPECT_TRUE(std::isinf(node_at(result, 0.5).amplitude[0]));
    ASSERT_EQ(result.model.notes.size(), 1U);
    EXPECT_NE(result.model.notes[0].find("258.199"), std::string::npos);
}

TEST(UnbalanceResponse, at_rest_nothing_moves_even_without_supports) {
    model::Case scene = rigid_scene();
    scene.rotor.bearings.clear();
    scene.rotor.shaft.rigid = false;
    scene.speeds = model::SpeedRange{0, 0, 1};
    EXPECT_EQ(node_at(unbalance_response(scene), 0.8).amplitude[0], 0);
}

TEST(UnbalanceResponse, lists_every_place_where_something_is_attached) {
    model::Case scene = Jeffcott().scene;
    scene.rotor.bearings[0].name = "left";
    scene.rotor.anisotropies = {{"keyway", 0.3, 1e-4, 0}};
    scene.rotor.planes = {{"", 0.7}};
    const ResponseResult result = unbalance_response(scene);
    std::vector<std::pair<double, std::string>> places; // and the disc, the other bearing
    for (const results::ResponseNode &node : result.nodes)
        places.emplace_back(node.z, node.name);
    EXPECT_EQ(places, (std::vector<std::pair<double, std::string>>{
                          {0, "left"}, {0.3, "keyway"}, {0.5, ""}, {0.7, ""}, {1, ""}}));
}

TEST(UnbalanceResponse, says_what_the_case_lacks) {
    const auto message = [](const model::Case &scene) -> std::string {
        try {
            (void)unbalance_response(scene);
        } catch (const model::BadInput &error) {
            return error.what();
        }
        return "no error";
    };
    model::Case scene = rigid_scene();
    scene.rotor.imbalances.clear();
    EXPECT_NE(message(scene).find("[[imbalance]]"), std::string::npos);
    scene = rigid_scene();
    scene.speeds.reset();
    EXPECT_NE(message(scene).find("[speeds]"), std::string::npos);
}

/// Lalanne and Ferraris, Rotordynamics Prediction in Engineering, pp 68-75: semi-major axis at
/// disc 2 (m), and the same from an independent program with 13 classical elements.
TEST(UnbalanceResponse, published_peaks_of_the_rotor_with_three_discs) {
    struct Peak {
        const char *speed;
        double published;
        double computed;
    };
    for (const Peak &peak :
         {Peak{"3620.5 rpm", 9.380e-4, 9.3514e-4}, Peak{"3798.3 rpm", 2.100e-3, 2.07639e-3},
          Peak{"10018 rpm", 4.99e-5, 4.9965e-5}, Peak{"11281 rpm", 1.30e-4, 1.30075e-4}}) {
        const std::string from = std::string("speeds.from=") + peak.speed;
        const auto major = [&](const std::string &order) {
            const model::Case scene = input::load_case(WHIRL_ROOT "/cases/lalanne_three_discs",
                                                       {from, "speeds.count=1", order});
            return node_at(unbalance_response(scene), 0.5).major[0];
        };
        // Sharp peaks: the published value depends on 0.1 rpm; the computed one on its digits.
        EXPECT_NEAR(major("shaft.order=4") / peak.published, 1, 0.015);
        EXPECT_NEAR(major("shaft.order=1") / peak.computed, 1, 2e-5);
    }
}

TEST(Response, ImbalanceOfABalancerDrivesLikeAnyOther) {
    Jeffcott rotor;
    model::Case &scene = rotor.scene;
    scene.speeds = model::SpeedRange{50, 300, 6};
    scene.rotor.imbalances = {tests::imbalance_at(0.5, 2e-3, 0.7), tests::imbalance_at(0.3, 1e-3)};
    const ResponseResult expected = unbalance_response(scene);
    scene.rotor.imbalances.pop_back();
    model::Balancer balancer;
    balancer.z = 0.3;
    balancer.imbalance = 1e-3;
    scene.rotor.balancers = {balancer};
    const ResponseResult found = unbalance_response(scene);
    for (std::size_t i = 0; i < 6; ++i)
        EXPECT_DOUBLE_EQ(node_at(found, 0.5).major[i], node_at(expected, 0.5).major[i]);
    scene.rotor.imbalances.clear();
    EXPECT_GT(node_at(unbalance_response(scene), 0.5).major[0], 0);
}

} // namespace

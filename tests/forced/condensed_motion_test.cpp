#include "forced/condensed_motion.h"
#include "forced/forced_motion.h"
#include "results/formulation.h"
#include "support/scenes.h"
#include "support/test_rotors.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace whirl;
using forced::CondensedMotion;
using forced::ForcedMotion;
using forced::Phasor;
using results::Form;

double size_of(const Phasor &u) { return std::hypot(std::abs(u.x), std::abs(u.y)); }

double distance(const Phasor &a, const Phasor &b) { return size_of({a.x - b.x, a.y - b.y}); }

/// Elimination element by element must give what the whole system gives: at every node and bearing.
void expect_same(const model::Rotor &rotor, Form form, int order) {
    const assembly::Discretization d(rotor, order);
    ForcedMotion whole(d, form);
    CondensedMotion condensed(d, form);
    for (const double speed : {0.0, 37.0, 160.0, -410.0, 905.0, 2300.0}) {
        whole.solve(speed);
        condensed.solve(speed);
        double largest = 0;
        for (std::size_t node = 0; node < d.shaft_mesh().nodes.size(); ++node)
            largest = std::max(largest,
                               size_of(whole.motion(d.deflection_at_node(static_cast<int>(node)))));
        for (std::size_t i = 0; i < d.shaft_mesh().nodes.size(); ++i) {
            const int node = static_cast<int>(i);
            // Both round alike: eps times the condition at these speeds.
            EXPECT_LE(distance(whole.motion(d.deflection_at_node(node)), condensed.at_node(node)),
                      1e-9 * largest)
                << "node " << node << " at " << speed << ", order " << order;
        }
        for (int b = 0; b < static_cast<int>(rotor.bearings.size()); ++b) {
            const Phasor force = whole.bearing_force(b);
            EXPECT_LE(distance(force, condensed.bearing_force(b)),
                      1e-9 * size_of(force) + 1e-9 * largest * 1e6)
                << "bearing " << b << " at " << speed;
        }
    }
}

model::Rotor rotor_with_imbalances() {
    model::Rotor rotor = tests::two_disc_rotor(1e6, 1e6, 0, 90);
    rotor.shaft.segments[1].elements = 3; // a group of equal elements
    rotor.shaft.segments[2].outer_end = 0.04;
    rotor.shaft.axial_force = 2e4;
    rotor.imbalances = {tests::imbalance_at(0.5, 2e-4, 0.3), tests::imbalance_at(1.2, 1e-4, -2)};
    return rotor;
}

TEST(CondensedMotion, planar) {
    for (const int order : {1, 2, 4, 7})
        expect_same(rotor_with_imbalances(), Form::planar, order);
}

TEST(CondensedMotion, general_with_all_that_supports_can_have) {
    model::Rotor rotor = rotor_with_imbalances();
    rotor.shaft.internal_damping = 2e-5;
    model::BearingCoefficients &film = rotor.bearings[0].rows[0];
    film.k << 8e5, 3e5, -2e5, 2e6;
    film.c << 300, -50, 80, 120;
    film.kt << 4e3, 0, 0, 9e3;
    film.ct << 5, 0, 0, 0;
    rotor.bearings[1].pedestal = model::Pedestal{12, 5e6, 200};
    for (const int order : {1, 3, 5})
        expect_same(rotor, Form::general, order);
    rotor.bearings[0].speeds = {0, 2000};
    rotor.bearings[0].rows.push_back(film);
    rotor.bearings[0].rows[1].k *= 3;
    expect_same(rotor, Form::general, 4);
}

TEST(CondensedMotion, asymmetric_rotor_in_its_own_axes) {
    model::Rotor rotor = rotor_with_imbalances();
    rotor.bearings[0].rows[0].k << 1e6, 2e5, -2e5, 1e6;
    rotor.shaft.segments[1].asymmetry = 0.3;
    rotor.shaft.segments[1].asymmetry_angle = 0.7;
    rotor.anisotropies = {{"", 0.5, 0.05, 1.1}};
    for (const int order : {1, 4})
        expect_same(rotor, Form::rotating, order);
}

} // namespace

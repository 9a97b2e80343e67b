#include "forced/condensed/condensed_motion.h"
#include "forced/forced_motion.h"
#include "forced/response_places.h"
#include "results/formulation.h"
#include "support/scenes.h"
#include "support/test_rotors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

using namespace whirl;
using forced::CondensedMotion;
using forced::ForcedMotion;
using forced::Phasor;
using results::Form;

double size_of(const Phasor &u) { return std::hypot(std::abs(u.x), std::abs(u.y)); }

double distance(const Phasor &a, const Phasor &b) { return size_of({a.x - b.x, a.y - b.y}); }

/// With something attached to every node, so that all of them stay.
model::Rotor with_probes(model::Rotor rotor, int order) {
    const std::vector<double> nodes = assembly::Discretization(rotor, order).shaft_mesh().nodes;
    for (const double z : nodes)
        rotor.probes.push_back({"", z, 0});
    return rotor;
}

/// Elimination element by element must give what the whole system gives: at every node that
/// something is attached to, and bearing.
void expect_same_where_attached(const model::Rotor &rotor, Form form, int order) {
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
        for (const auto &[node, name] : forced::attached_nodes(d)) {
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

void expect_same(const model::Rotor &rotor, Form form, int order) {
    expect_same_where_attached(with_probes(rotor, order), form, order);
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

/// Nodes beside a short span move with unknowns of their neighbours in the whole system.
TEST(CondensedMotion, short_spans) {
    model::Rotor rotor = rotor_with_imbalances();
    rotor.planes.push_back({"", rotor.bearings[0].z + 1e-3});
    rotor.planes.push_back({"", rotor.discs[0].z + 2e-4});
    for (const int order : {1, 2, 4})
        expect_same(rotor, Form::planar, order);
    rotor.bearings[0].rows[0].k << 8e5, 3e5, -2e5, 2e6;
    expect_same(rotor, Form::general, 2);
}

/// Many equal elements in a row become one.
TEST(CondensedMotion, fine_meshes_on_the_nodes_that_something_is_attached_to) {
    model::Rotor rotor = rotor_with_imbalances();
    for (const int elements : {3, 22}) {
        rotor.shaft.segments[0].elements = elements + 1;
        rotor.shaft.segments[1].elements = elements;
        rotor.shaft.internal_damping = 0;
        for (const int order : {1, 3})
            expect_same_where_attached(rotor, Form::planar, order);
        rotor.shaft.internal_damping = 2e-5;
        rotor.bearings[0].rows[0].k << 8e5, 3e5, -2e5, 2e6;
        expect_same_where_attached(rotor, Form::general, 2);
        rotor.bearings[0].rows[0].k << 1e6, 2e5, -2e5, 1e6;
        rotor.shaft.segments[1].asymmetry = 0.3;
        expect_same_where_attached(rotor, Form::rotating, 2);
        rotor.shaft.segments[1].asymmetry = 0;
        rotor.bearings[0].rows[0].k << 1e6, 0, 0, 1e6;
    }
}

/// The estimate of rounding against what it is of: the distance between two ways that round
/// differently, near a resonance too.
TEST(CondensedMotion, rounding_is_no_less_than_what_is_seen) {
    model::Rotor rotor = rotor_with_imbalances();
    for (model::Segment &segment : rotor.shaft.segments)
        segment.elements = 40;
    const assembly::Discretization d(rotor, 1);
    ForcedMotion whole(d, Form::planar);
    CondensedMotion condensed(d, Form::planar);
    for (double speed = 20; speed < 1000; speed *= 1.07) {
        whole.solve(speed);
        condensed.solve(speed);
        double apart = 0;
        double size = 0;
        for (const auto &[node, name] : forced::attached_nodes(d)) {
            const Phasor u = whole.motion(d.deflection_at_node(node));
            apart = std::max(apart, distance(u, condensed.at_node(node)));
            size = std::max(size, size_of(u));
        }
        EXPECT_LE(apart, 3 * (whole.rounding() + condensed.rounding()) * size) << speed;
        // No idle number: moduli of all elements added up, not with random signs.
        EXPECT_LT(condensed.rounding(), 1000 * whole.rounding()) << speed;
    }
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

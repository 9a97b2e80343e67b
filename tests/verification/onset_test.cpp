// Internal damping on undamped, isotropic bearings: forward whirl at w loses energy by the damping
// of the shaft as long as the rotor turns more slowly, and gains it beyond. Instability begins
// exactly at the first forward critical speed, at whatever mesh, and however small the growth.

#include "analyses/critical.h"
#include "analyses/stability.h"
#include "oracles/continuum_roots.h"
#include "results/critical.h"
#include "results/formulation.h"
#include "results/stability.h"
#include "results/whirl.h"
#include "support/rotating_scenes.h"

#include <gtest/gtest.h>

namespace {

using namespace whirl;

struct Mesh {
    double z = 0; ///< of the disc, m
    int elements = 1, order = 4;
};

void PrintTo(const Mesh &mesh, std::ostream *out) {
    *out << mesh.z << " m, " << mesh.elements << " elements of order " << mesh.order;
}

model::Rotor jeffcott_rotor(const Mesh &mesh, double internal_damping) {
    model::Rotor rotor;
    const model::Material steel{"steel", 2.1e11, 2.1e11 / 2.6, 7850};
    const model::Segment half{0.5, 0.05, 0.05, 0, 0, steel, mesh.elements};
    rotor.shaft.segments = {half, half};
    rotor.shaft.order = mesh.order;
    rotor.shaft.internal_damping = internal_damping;
    rotor.discs = {tests::disc(mesh.z, 20, 0.2, 0.3)};
    rotor.bearings = {tests::round_bearing(0, 1e6), tests::round_bearing(1, 1e6)};
    return rotor;
}

/// Of the same mesh without damping, by the definite symmetric form.
double first_forward_critical_speed(const Mesh &mesh) {
    const auto result =
        analyses::critical_speeds(tests::scene_of(jeffcott_rotor(mesh, 0), 0, 400, 3));
    for (const results::CriticalSpeed &critical : result.critical_speeds)
        if (critical.whirl == results::Whirl::forward)
            return critical.speed;
    return 0;
}

/// Of the continuum, by transfer matrices.
double critical_speed_of_the_continuum(const Mesh &mesh) {
    const oracles::Cylinder shaft{1, 0.05, 0, 2.1e11, 2.1e11 / 2.6, 7850, 0};
    const oracles::Block k{{{1e6, 0}, {0, 1e6}}};
    oracles::SteppedRotor rotor;
    rotor.shaft = {shaft};
    rotor.discs = {{mesh.z, 20, 0.2, 0.3}};
    rotor.supports = {{0, k, {}, {}, {}}, {1, k, {}, {}, {}}};
    const oracles::Question forward{oracles::Motion::forward, 0, true};
    return static_cast<double>(
        oracles::frequencies(oracles::Continuum(rotor), forward, 1, 1e4).at(0));
}

class Onset : public testing::TestWithParam<Mesh> {};

TEST_P(Onset, OfTheAnalysisLiesWithinItsError) {
    // Rounding of fine meshes moves the end by up to 57 rad/s with so little damping, says its
    // error. Growth is eta / 2 (Omega - critical) there: in fact rounding mistakes it by up to
    // 3e-11 rad/s, 1.5e-13 of the frequency, with what any of six kinds of processors sums.
    const double critical = first_forward_critical_speed(GetParam());
    for (const double eta : {1e-6, 1e-8}) {
        const results::StabilityResult result =
            analyses::stability(tests::scene_of(jeffcott_rotor(GetParam(), eta), 150, 400, 6),
                                [](const std::vector<std::string> &) { return model::Case{}; });
        ASSERT_EQ(result.unstable.size(), 1U);
        ASSERT_EQ(result.unstable_error.size(), 1U);
        const double off = std::abs(result.unstable[0].from - critical);
        EXPECT_LE(off, result.unstable_error[0].first);
        EXPECT_LE(off * eta / 2, 1e-10);
        EXPECT_EQ(result.unstable[0].to, 400);
    }
    // Meshes of the classical element leave up to 0.3 rad/s.
    EXPECT_NEAR(critical, critical_speed_of_the_continuum(GetParam()),
                GetParam().order == 1 ? 0.3 : 0.01);
}

INSTANTIATE_TEST_SUITE_P(Meshes, Onset,
                         testing::Values(Mesh{0.5, 1, 1}, Mesh{0.5, 1, 4}, Mesh{0.5, 20, 4},
                                         Mesh{0.5, 50, 2}, Mesh{0.5, 100, 1}, Mesh{0.5, 5, 10},
                                         Mesh{0.501, 1, 4}, Mesh{0.501, 2, 6}, Mesh{0.501, 20, 1},
                                         Mesh{0.5003, 1, 4}, Mesh{0.5003, 1, 10},
                                         Mesh{0.5003, 10, 3}));

} // namespace

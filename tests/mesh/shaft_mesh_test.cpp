#include "mesh/shaft_mesh.h"
#include "support/test_rotors.h"

#include <gtest/gtest.h>

namespace {

using namespace whirl;

TEST(ShaftMesh, HasNodesAtSegmentEndsElementsAndAttachments) {
    model::Rotor rotor;
    rotor.shaft.segments = {tests::cylinder(0.4, 0.05, 2), tests::cylinder(0.6, 0.04, 1)};
    rotor.bearings = {tests::bearing(0, 1e6, 1e6), tests::bearing(0.95, 1e6, 1e6)};
    rotor.discs = {tests::disc(0.3, 1, 1, 1), tests::disc(0.2, 1, 1, 1)};
    rotor.planes = {{"", 0.5}};
    rotor.imbalances = {{"", 0.6, 1e-4, 0}};
    const mesh::ShaftMesh made = mesh::make_mesh(rotor);
    const std::vector<double> expected{0, 0.2, 0.3, 0.4, 0.5, 0.6, 0.95, 1.0};
    ASSERT_EQ(made.nodes.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(made.nodes[i], expected[i], 1e-15);
    ASSERT_EQ(made.spans.size(), expected.size() - 1);
    EXPECT_EQ(made.spans[2].segment, 0);
    EXPECT_EQ(made.spans[3].segment, 1);
    EXPECT_EQ(made.node_at(0.95), 6);
    EXPECT_EQ(made.node_at(0.3), 2);
}

TEST(ShaftMesh, SpansFollowEachOtherAndRefinementKeepsTheOldNodes) {
    model::Rotor rotor = tests::two_disc_rotor(1e6, 1e6);
    rotor.bearings.push_back(tests::bearing(0.7, 1e6, 1e6));
    const mesh::ShaftMesh coarse = mesh::make_mesh(rotor);
    const mesh::ShaftMesh fine = mesh::make_mesh(rotor, 3);
    ASSERT_EQ(fine.spans.size(), 3 * coarse.spans.size());
    for (std::size_t i = 0; i < coarse.nodes.size(); ++i)
        EXPECT_DOUBLE_EQ(fine.nodes[3 * i], coarse.nodes[i]);
    for (std::size_t i = 0; i < fine.spans.size(); ++i) {
        EXPECT_DOUBLE_EQ(fine.spans[i].z, fine.nodes[i]);
        EXPECT_NEAR(fine.spans[i].z + fine.spans[i].length, fine.nodes[i + 1], 1e-15);
    }
    EXPECT_DOUBLE_EQ(fine.nodes.back(), rotor.shaft.length());
}

TEST(ShaftMesh, PositionsEqualToNineDigitsShareANode) {
    model::Rotor rotor = tests::uniform_shaft(1, 0.05);
    rotor.discs = {tests::disc(0.5, 1, 1, 1), tests::disc(0.5 + 1e-12, 1, 1, 1)};
    EXPECT_EQ(mesh::make_mesh(rotor).nodes.size(), 3U);
    rotor.discs[1].z = 0.5 + 1e-6;
    EXPECT_EQ(mesh::make_mesh(rotor).nodes.size(), 4U);
}

TEST(ShaftMesh, ConeKeepsItsDiametersWhereItIsCut) {
    model::Rotor rotor;
    model::Segment cone = tests::cylinder(1, 0.1, 4);
    cone.outer_end = 0.06;
    cone.inner_start = 0.02;
    cone.inner_end = 0.04;
    rotor.shaft.segments = {tests::cylinder(0.5, 0.1), cone};
    rotor.discs = {tests::disc(1.1, 1, 1, 1)}; // 0.6 of the cone
    const mesh::ShaftMesh made = mesh::make_mesh(rotor);
    const auto &span = made.spans[static_cast<std::size_t>(made.node_at(1.1))];
    EXPECT_NEAR(span.outer_start, 0.1 - 0.6 * 0.04, 1e-15);
    EXPECT_NEAR(span.inner_start, 0.02 + 0.6 * 0.02, 1e-15);
    for (std::size_t i = 1; i + 1 < made.spans.size(); ++i) {
        EXPECT_DOUBLE_EQ(made.spans[i].outer_end, made.spans[i + 1].outer_start);
        EXPECT_DOUBLE_EQ(made.spans[i].inner_end, made.spans[i + 1].inner_start);
    }
    EXPECT_DOUBLE_EQ(made.spans.back().outer_end, 0.06);
}

} // namespace

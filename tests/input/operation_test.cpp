#include "scratch_case.h"

#include <numbers>

namespace whirl::tests {
namespace {

constexpr double rpm = std::numbers::pi / 30;

TEST(Operation, IsReadInAnyUnit) {
    const model::Case scene = load_text(
        sound_case + "[operation]\nfrom = \"3000 rpm\"\nto = 400\ntrip = \"70 Hz\"\n"
                     "[level1]\nz = \"20 cm\"\nto = \"2 MN/m\"\ncount = 5\nanticipated = 1e5\n");
    ASSERT_TRUE(scene.operation.has_value());
    // Units are exact factors; the numbers are rounded once or twice.
    EXPECT_DOUBLE_EQ(scene.operation->from, 3000 * rpm);
    EXPECT_DOUBLE_EQ(scene.operation->to, 400);
    EXPECT_DOUBLE_EQ(*scene.operation->trip, 140 * std::numbers::pi);
    ASSERT_TRUE(scene.level1.has_value());
    EXPECT_DOUBLE_EQ(scene.level1->z, 0.2);
    EXPECT_DOUBLE_EQ(*scene.level1->to, 2e6);
    EXPECT_EQ(scene.level1->count, 5);
    EXPECT_DOUBLE_EQ(*scene.level1->anticipated, 1e5);
}

TEST(Operation, NormalSpeedAndLimits) {
    const model::Case scene = load_text(
        sound_case +
        "[operation]\nfrom = 100\nto = 200\nnormal = 150\n[limits]\nshaft = \"2 mil\"\n"
        "shaft_reading = \"peak\"\nshaft_standard = \"api617\"\nvelocity = \"0.18 in/s\"\n"
        "velocity_reading = \"peak\"\npedestal_standard = \"iso20816-3\"\nzone = \"C/D\"\n"
        "group = 2\nsupport = \"flexible\"\nclearance = \"75 %\"\nscale_most = 6\n");
    EXPECT_EQ(scene.operation->normal, 150);
    const model::Limits &limits = scene.limits.value();
    EXPECT_DOUBLE_EQ(*limits.shaft, 50.8e-6);
    EXPECT_EQ(limits.shaft_reading, model::Reading::peak);
    EXPECT_EQ(limits.shaft_standard, model::ShaftStandard::api617);
    EXPECT_DOUBLE_EQ(*limits.velocity, 0.18 * 0.0254);
    EXPECT_EQ(limits.velocity_reading, model::Reading::peak);
    EXPECT_EQ(limits.pedestals->group, 2);
    EXPECT_TRUE(limits.pedestals->flexible);
    EXPECT_EQ(limits.zone, model::Zone::c_d);
    EXPECT_DOUBLE_EQ(*limits.clearance, 0.75);
    EXPECT_TRUE(limits.scaled);
    EXPECT_EQ(limits.scale_most, 6);
}

TEST(Operation, ProbesOnPedestalsAndAgainstThem) {
    const model::Rotor rotor =
        load_text(sound_case +
                  "[[bearing]]\nname = \"DE\"\nz = 0.1\nk = 1\npedestal_k = 2\n"
                  "[[bearing]]\nz = 0.9\nk = 1\n"
                  "[[probe]]\non = \"pedestal\"\nbearing = \"DE\"\nangle = \"90 deg\"\n"
                  "[[probe]]\nz = 0.2\nrelative = true\n[[probe]]\nz = 0.2\nbearing = 1\n"
                  "[[probe]]\nz = 0.8\n[[probe]]\nz = 0.1\non = \"pedestal\"\n")
            .rotor;
    ASSERT_EQ(rotor.probes.size(), 5U);
    EXPECT_TRUE(rotor.probes[0].on_pedestal);
    EXPECT_EQ(rotor.probes[0].z, 0.1);
    EXPECT_EQ(rotor.probes[1].relative, true);
    EXPECT_EQ(rotor.probes[2].relative, std::nullopt);
    using Found = std::optional<std::size_t>;
    EXPECT_EQ(rotor.pedestal_of(rotor.probes[0]), Found(0)); // named
    EXPECT_EQ(rotor.pedestal_of(rotor.probes[1]), Found(0)); // the nearest
    EXPECT_EQ(rotor.pedestal_of(rotor.probes[2]), Found());  // the one named stands still
    EXPECT_EQ(rotor.pedestal_of(rotor.probes[3]), Found());
    EXPECT_EQ(rotor.pedestal_of(rotor.probes[4]), Found(0));
}

TEST(Operation, IsNotThereUnlessNamed) {
    EXPECT_FALSE(load_text(sound_case).operation.has_value());
    EXPECT_FALSE(load_text(sound_case).level1.has_value());
    const model::Case scene = load_text(sound_case + "[operation]\nfrom = 0\nto = 1\ntrip = 1\n");
    EXPECT_EQ(scene.operation->trip, 1);
    EXPECT_FALSE(load_text(sound_case + "[operation]\nfrom = 0\nto = 1\n").operation->trip);
}

TEST(Seals, StandBehindTheBearingsInTheOrderOfTheFile) {
    const model::Rotor rotor =
        load_text(sound_case + "[[seal]]\nname = \"eye\"\nz = 0.25\nkxx = 5\nkxy = 3\nkyx = -1\n"
                               "c = 2\nm = \"500 g\"\n[[bearing]]\nz = 0\nk = 1\n"
                               "[[seal]]\nz = 0.75\ntable = \"s.csv\"\nm = 2\n"
                               "[[bearing]]\nz = 1\nk = 2\n",
                  {}, {{"s.csv", "speed, kxx, kxy, cxx\n100, 1, 2, 3\n200, 3, 4, 5\n"}})
            .rotor;
    ASSERT_EQ(rotor.supports().size(), 2U);
    EXPECT_EQ(rotor.supports()[1].rows[0].k(1, 1), 2);
    ASSERT_EQ(rotor.seals().size(), 2U);
    const model::Bearing &eye = rotor.seals()[0];
    EXPECT_EQ(eye.name, "eye");
    EXPECT_EQ(eye.z, 0.25);
    EXPECT_EQ(eye.rows[0].m, (0.5 * Eigen::Matrix2d::Identity()));
    EXPECT_EQ(eye.rows[0].k, (Eigen::Matrix2d() << 5, 3, -1, 0).finished());
    EXPECT_EQ(eye.rows[0].c, (2 * Eigen::Matrix2d::Identity()));
    const model::Bearing &other = rotor.seals()[1];
    EXPECT_EQ(other.at(150).m, (2 * Eigen::Matrix2d::Identity()));
    EXPECT_EQ(other.at(150).k, (Eigen::Matrix2d() << 2, 3, -3, 0).finished());
}

TEST(Seals, AreTheSameFromEveryDirectionUnlessTheySayOtherwise) {
    const model::Rotor rotor =
        load_text(sound_case + "[[seal]]\nz = 0.25\nk = 5\nkxy = 3\nc = 2\ncxy = 1\n").rotor;
    EXPECT_EQ(rotor.seals()[0].rows[0].k, (Eigen::Matrix2d() << 5, 3, -3, 5).finished());
    EXPECT_EQ(rotor.seals()[0].rows[0].c, (Eigen::Matrix2d() << 2, 1, -1, 2).finished());
    EXPECT_TRUE(rotor.bearings_rotation_invariant());
}

} // namespace
} // namespace whirl::tests

#include "scratch_case.h"
#include "support/balancer_parts.h"

#include <cmath>
#include <numbers>

namespace whirl::tests {
namespace {

constexpr double pi = std::numbers::pi;

/// Every section and nearly every key that a case can have.
const std::string full_case = R"(format = 1
title = "everything"
formulation = "general"
[material.steel]
E = "211 GPa"
G = 8.12e10
rho = 7810
[material.brass]
E = 1e11
nu = 0.25
rho = 8500
[shaft]
table = "s.csv"
order = "auto"
elements = 3
tolerance = 1e-9
shear = 0.85
rigid = true
internal_damping = "0.2 ms"
axial_force = "100 kN"
[[disc]]
name = "impeller"
z = 0.5
mass = 32.59
Id = 0.1778
Ip = 0.3295
[[disc]]
z = "1 m"
outer = 0.3
inner = 0.1
width = 0.02
material = "brass"
[[bearing]]
z = 0
k = "1e5 lbf/in"
c = 100
kt = 7
ct = 8
pedestal_mass = 5
pedestal_k = 1e8
pedestal_c = 6
[[bearing]]
z = 1.5000000001
kxx = 1
kxy = 2
kyx = 3
kyy = 4
cxx = 5
cxy = 6
cyx = 7
cyy = 8
[[bearing]]
z = 1
table = "b.csv"
kt = 9
[[anisotropy]]
z = 0.5
dI = 0.01
angle = "45 deg"
[[balancer]]
z = 0.5
kind = "ball"
n = 2
mass = 0.05
radius = 0.1
damping = 0.02
imbalance = "2.5 kg mm"
imbalance_radius = 0.1
position = [1.8234765819369754, "-104.47751218592992 deg"]
[[balancer]]
z = 1
kind = "pendulum4"
mass = 0.2
arm = 0.03
pivot = 0.04
damping = 0.01
[[plane]]
z = 0.2
[[imbalance]]
z = 0.5
mr = "100 g mm"
phase = "30 deg"
[[probe]]
name = "horizontal"
z = 0.1
[[probe]]
z = "900 mm"
angle = "45 deg"
[speeds]
to = "12000 rpm"
[simulate]
time = 20
run_up = [[0, 0], ["1 min", "600 rpm"]]
ball_angles = [[1.5, -1.5], [0, 1]]
tolerance = 1e-7
[response]
gravity = "9810 mm/s2"

[campbell]
modes = 12
multiples = [1, 0.5]
[map]
x = {path = "speed", from = 0, to = "9000 rpm", count = 100}
y = {path = "bearing[0].k", from = 1e5, to = "1 kN/mm", count = 3}
)";
const std::vector<std::pair<std::string, std::string>> full_files{
    {"s.csv", "\xEF\xBB\xBF# two pieces\r\n"
              "outer [mm], length, inner [mm], material, outer_end [mm], elements\r\n"
              "50, 0.5, , steel, , \r\n\r\n"
              "60, 100 cm, 10, \"brass\", 40, 7 # the second\r\n"},
    {"b.csv", "speed [rpm],kxx,kyy [N/mm],cxy\n0,1,2,3\n3000,4,5,6\n"}};

class FullCase : public testing::Test {
  protected:
    static const model::Case &scene() {
        static const model::Case loaded = load_text(full_case, {}, full_files);
        return loaded;
    }
};

TEST_F(FullCase, Top) {
    EXPECT_EQ(scene().name, "scene"); // its folder
    EXPECT_EQ(scene().title, "everything");
    EXPECT_EQ(scene().file, scratch_folder() / "case.toml");
    EXPECT_EQ(scene().formulation, model::FormChoice::general);
}

TEST_F(FullCase, Shaft) {
    const model::Shaft &shaft = scene().rotor.shaft;
    EXPECT_TRUE(shaft.order_auto);
    EXPECT_TRUE(shaft.rigid);
    EXPECT_EQ(shaft.tolerance, 1e-9);
    EXPECT_EQ(shaft.shear, model::ShearFormula::given);
    EXPECT_EQ(shaft.shear_coefficient, 0.85);
    EXPECT_EQ(shaft.internal_damping, 0.0002);
    EXPECT_EQ(shaft.axial_force, 1e5);
    ASSERT_EQ(shaft.segments.size(), 2U);
    const model::Segment &first = shaft.segments[0];
    EXPECT_EQ(first.length, 0.5);
    EXPECT_EQ(first.outer_start, 0.05);
    EXPECT_EQ(first.outer_end, 0.05);
    EXPECT_EQ(first.inner_start, 0);
    EXPECT_EQ(first.inner_end, 0);
    EXPECT_EQ(first.elements, 3);
    EXPECT_EQ(first.material.name, "steel");
    EXPECT_EQ(first.material.E, 211e9);
    EXPECT_EQ(first.material.G, 8.12e10);
    EXPECT_EQ(first.material.rho, 7810);
    const model::Segment &second = shaft.segments[1];
    EXPECT_EQ(second.length, 1.0);       // the cell's own unit
    EXPECT_EQ(second.outer_start, 0.06); // a plain number has the header's unit, mm
    EXPECT_EQ(second.outer_end, 0.04);
    EXPECT_EQ(second.inner_end, 0.01);
    EXPECT_EQ(second.elements, 7);
    EXPECT_EQ(second.material.name, "brass");
    EXPECT_DOUBLE_EQ(second.material.G, 1e11 / 2.5); // E / (2 (1 + nu))
}

TEST_F(FullCase, Discs) {
    const auto &discs = scene().rotor.discs;
    ASSERT_EQ(discs.size(), 2U);
    EXPECT_EQ(discs[0].name, "impeller");
    EXPECT_EQ(discs[0].z, 0.5);
    EXPECT_EQ(discs[0].mass, 32.59);
    EXPECT_EQ(discs[0].Id, 0.1778);
    EXPECT_EQ(discs[0].Ip, 0.3295);
    const double mass = 8500 * pi * (0.15 * 0.15 - 0.05 * 0.05) * 0.02;
    EXPECT_EQ(discs[1].z, 1.0);
    EXPECT_DOUBLE_EQ(discs[1].mass, mass);
    EXPECT_DOUBLE_EQ(discs[1].Ip, mass * (0.15 * 0.15 + 0.05 * 0.05) / 2);
}

TEST_F(FullCase, Bearings) {
    const auto &bearings = scene().rotor.bearings;
    ASSERT_EQ(bearings.size(), 3U);
    const double stiffness = 1e5 * 0.45359237 * 9.80665 / 0.0254; // lbf/in, all exact
    const auto &isotropic = bearings[0].rows.at(0);
    EXPECT_NEAR(isotropic.k(0, 0) / stiffness, 1, 1e-15);
    EXPECT_EQ(isotropic.k(0, 0), isotropic.k(1, 1));
    EXPECT_EQ(isotropic.k(0, 1), 0);
    EXPECT_EQ(isotropic.c, 100 * Eigen::Matrix2d::Identity());
    EXPECT_EQ(isotropic.kt, 7 * Eigen::Matrix2d::Identity());
    EXPECT_EQ(isotropic.ct, 8 * Eigen::Matrix2d::Identity());
    ASSERT_TRUE(bearings[0].pedestal);
    EXPECT_EQ(bearings[0].pedestal->mass, Eigen::Vector2d(5, 5));
    EXPECT_EQ(bearings[0].pedestal->k, Eigen::Vector2d(1e8, 1e8));
    EXPECT_EQ(bearings[0].pedestal->c, Eigen::Vector2d(6, 6));
    EXPECT_EQ(bearings[1].z, 1.5); // 1e-10 beyond the end is rounding
    EXPECT_FALSE(bearings[1].pedestal);
    EXPECT_EQ(bearings[1].rows.at(0).k, (Eigen::Matrix2d() << 1, 2, 3, 4).finished());
    EXPECT_EQ(bearings[1].rows.at(0).c, (Eigen::Matrix2d() << 5, 6, 7, 8).finished());
    EXPECT_TRUE(bearings[1].speeds.empty());
    ASSERT_EQ(bearings[2].rows.size(), 2U);
    ASSERT_EQ(bearings[2].speeds.size(), 2U);
    EXPECT_DOUBLE_EQ(bearings[2].speeds[1], 100 * pi);
    EXPECT_EQ(bearings[2].rows[1].k, (Eigen::Matrix2d() << 4, 0, 0, 5000).finished());
    EXPECT_EQ(bearings[2].rows[1].c, (Eigen::Matrix2d() << 0, 6, 0, 0).finished());
    EXPECT_EQ(bearings[2].rows[1].kt, 9 * Eigen::Matrix2d::Identity());
}

TEST_F(FullCase, RotatingParts) {
    const model::Rotor &rotor = scene().rotor;
    EXPECT_EQ(rotor.anisotropies.at(0).dI, 0.01);
    EXPECT_DOUBLE_EQ(rotor.anisotropies.at(0).angle, pi / 4);
    ASSERT_EQ(rotor.balancers.size(), 2U);
    const model::Balancer &ball = rotor.balancers[0];
    ASSERT_TRUE(std::holds_alternative<model::Balls>(ball.parts));
    EXPECT_EQ(tests::row(ball).n, 2);
    EXPECT_EQ(tests::row(ball).mass, 0.05);
    EXPECT_EQ(tests::row(ball).radius, 0.1);
    EXPECT_EQ(tests::row(ball).damping, 0.02);
    EXPECT_EQ(ball.imbalance, 0.0025);
    EXPECT_EQ(ball.imbalance_radius, 0.1);
    ASSERT_EQ(ball.position.size(), 2U);
    EXPECT_DOUBLE_EQ(ball.position[1], -std::acos(-0.25)); // E = 4
    const model::Balancer &pendulum = rotor.balancers[1];
    ASSERT_TRUE(std::holds_alternative<model::Pendulums>(pendulum.parts));
    EXPECT_EQ(std::get<model::Pendulums>(pendulum.parts).arm, 0.03);
    EXPECT_EQ(std::get<model::Pendulums>(pendulum.parts).pivot, 0.04);
    EXPECT_EQ(std::get<model::Pendulums>(pendulum.parts).damping, 0.01);
    EXPECT_FALSE(pendulum.imbalance_radius);
    EXPECT_EQ(rotor.planes.at(0).z, 0.2);
    EXPECT_DOUBLE_EQ(rotor.imbalances.at(0).mr, 1e-4);
    EXPECT_DOUBLE_EQ(rotor.imbalances.at(0).phase, pi / 6);
    ASSERT_EQ(rotor.probes.size(), 2U);
    EXPECT_EQ(rotor.probes[0].name, "horizontal");
    EXPECT_EQ(rotor.probes[0].angle, 0);
    EXPECT_DOUBLE_EQ(rotor.probes[1].z, 0.9);
    EXPECT_DOUBLE_EQ(rotor.probes[1].angle, pi / 4);
}

TEST_F(FullCase, Settings) {
    ASSERT_TRUE(scene().speeds);
    EXPECT_EQ(scene().speeds->from, 0);
    EXPECT_DOUBLE_EQ(scene().speeds->to, 400 * pi);
    EXPECT_EQ(scene().speeds->count, 101);
    EXPECT_EQ(scene().campbell.modes, 12);
    EXPECT_EQ(scene().response.gravity, 9.81);
    EXPECT_EQ(scene().campbell.multiples, (std::vector<double>{1, 0.5}));
    EXPECT_EQ(scene().simulate.time, 20);
    EXPECT_EQ(scene().simulate.tolerance, 1e-7);
    ASSERT_EQ(scene().simulate.run_up.size(), 2U);
    EXPECT_EQ(scene().simulate.run_up[1].first, 60);
    EXPECT_DOUBLE_EQ(scene().simulate.run_up[1].second, 20 * pi);
    EXPECT_EQ(scene().simulate.ball_angles.at(0), (std::vector<double>{1.5, -1.5}));
    ASSERT_TRUE(scene().map);
    EXPECT_EQ(scene().map->x.label, "speed");
    EXPECT_TRUE(scene().map->x.is_speed());
    EXPECT_DOUBLE_EQ(scene().map->x.values.back(), 300 * pi);
    EXPECT_EQ(scene().map->x.values.size(), 100);
    ASSERT_EQ(scene().map->y.entries.size(), 1);
    EXPECT_EQ(scene().map->y.entries[0].path, "bearing[0].k");
    EXPECT_EQ(scene().map->y.values.back(), 1e6); // in the unit of what is varied
}

TEST(CaseDefaults, AreThoseOfTheReference) {
    const model::Case scene = load_text(sound_case);
    EXPECT_FALSE(scene.speeds);
    EXPECT_FALSE(scene.map);
    EXPECT_EQ(scene.formulation, model::FormChoice::automatic);
    EXPECT_EQ(scene.campbell.modes, 8);
    EXPECT_EQ(scene.response.gravity, 0);
    EXPECT_EQ(scene.campbell.multiples, std::vector<double>{1});
    const model::Shaft &shaft = scene.rotor.shaft;
    EXPECT_EQ(shaft.order, 4);
    EXPECT_FALSE(shaft.order_auto);
    EXPECT_EQ(shaft.shear, model::ShearFormula::cowper);
    EXPECT_EQ(shaft.segments.at(0).elements, 1);
    EXPECT_EQ(shaft.segments.at(0).material.name, "steel"); // the only one there is
    EXPECT_TRUE(scene.rotor.bearings.empty());
}

TEST(CaseDefaults, SpeedsWithoutEndAreOneSpeed) {
    const model::Case scene = load_text(sound_case + "[speeds]\nfrom = 5\n");
    ASSERT_TRUE(scene.speeds);
    EXPECT_EQ(scene.speeds->count, 1);
    EXPECT_EQ(scene.speeds->values(), std::vector<double>{5});
}

TEST(DiscInertia, ThinAndRoundedDiscsAreAccepted) {
    const std::string disc = sound_case + "[[disc]]\nz = 0\n";
    // A disc of no thickness has Id = Ip/2; a width of 1e-6 of the diameter is lost in rounding.
    const model::Case thin = load_text(disc + "outer = 1\nwidth = 1e-6\n");
    EXPECT_NEAR(thin.rotor.discs.at(0).Id / thin.rotor.discs.at(0).Ip, 0.5, 1e-11);
    // Inertias printed to seven digits may fall short of Ip/2 in the last one.
    EXPECT_EQ(load_text(disc + "mass = 1\nId = 0.4999999\nIp = 1.0\n").rotor.discs.at(0).Id,
              0.4999999);
    EXPECT_THROW((void)load_text(disc + "mass = 1\nId = 0.499998\nIp = 1.0\n"), model::BadInput);
    // A point mass has neither.
    EXPECT_EQ(load_text(disc + "mass = 2\n").rotor.discs.at(0).mass, 2);
}

TEST(RotatingParts, OnTheLimitsAreAccepted) {
    // 2 dI = Ip exactly; anisotropies across each other cancel; a bare shaft of Ip = 0.0047860.
    const std::string disc = "[[disc]]\nz = 0.5\nmass = 5\nId = 0.02\nIp = 0.03\n";
    const std::string skew = "[[anisotropy]]\nz = 0.5\n";
    (void)load_text(sound_case + disc + skew + "dI = 0.015\n");
    (void)load_text(sound_case + disc + skew + "dI = 0.1\n" + skew +
                    "dI = 0.1\nangle = \"90 deg\"\n");
    (void)load_text(sound_case + skew + "dI = 0.00239\n");
    // Balls rounded to seven digits; one ball of just the imbalance; too little capacity to
    // balance, which simulate may still follow in time.
    const std::string balls = "[[balancer]]\nz = 0.5\nmass = 0.1\nradius = 0.1\nimbalance = 0.01\n";
    (void)load_text(sound_case + balls + "position = [2.094395, -2.094396]\nn = 2\n");
    (void)load_text(sound_case + balls + "n = 1\n");
    (void)load_text(sound_case + balls + "n = 2\n", {"balancer[0].imbalance=0.03"});
    // The same two balls with the imbalance at 60 deg: angles in the rotor.
    const model::Case turned =
        load_text(sound_case + balls +
                  "n = 2\nimbalance_phase = \"60 deg\"\nposition = [\"180 deg\", \"-60 deg\"]\n");
    EXPECT_NEAR(turned.rotor.balancers.at(0).imbalance_phase, std::acos(0.5), 1e-15);
}

// What is held is put among discs, anisotropies and imbalances; what is left keeps its place in
// messages, and the starts of what is held are gone.
TEST(HeldBalancers, BecomePartsOfTheRotor) {
    const std::string balls = "[[balancer]]\nz = 0.5\nmass = 0.1\nradius = 0.1\nimbalance = 0.01\n";
    const std::string start = "[simulate]\ntime = 1\nball_angles = [[0, 1], [2, 3]]\n"
                              "other_starts = [[[4, 5], [6, 7]]]\n";
    const model::Case free = load_text(sound_case + balls + balls + start);
    EXPECT_TRUE(free.rotor.held.empty());
    ASSERT_EQ(free.rotor.balancers.size(), 2U);
    EXPECT_EQ(free.rotor.balancer_path(1), "balancer[1]");

    const model::Case one =
        load_text(sound_case + balls + balls + start, {"balancer[0].held=true"});
    ASSERT_EQ(one.rotor.held.size(), 1U);
    ASSERT_EQ(one.rotor.balancers.size(), 1U);
    EXPECT_EQ(one.rotor.balancer_path(0), "balancer[1]");
    EXPECT_EQ(one.rotor.balancer_planes().size(), 2U);
    EXPECT_EQ(one.rotor.held[0].angles, (std::vector<double>{0, 1}));
    EXPECT_EQ(one.simulate.ball_angles, (std::vector<std::vector<double>>{{2, 3}}));
    ASSERT_EQ(one.simulate.other_starts.size(), 1U);
    EXPECT_EQ(one.simulate.other_starts[0], (std::vector<std::vector<double>>{{6, 7}}));
    ASSERT_EQ(one.rotor.discs.size(), free.rotor.discs.size() + 1);
    EXPECT_NEAR(one.rotor.discs.back().mass, 0.2, 1e-15);
    // Two balls at 0 and 1 rad: 0.01 (1 + cos 1) and 0.01 sin 1 kg m with the imbalance at 0.
    ASSERT_EQ(one.rotor.imbalances.size(), free.rotor.imbalances.size() + 1);
    EXPECT_NEAR(one.rotor.imbalances.back().mr,
                std::hypot(0.02 + 0.01 * std::cos(1), 0.01 * std::sin(1)), 1e-15);
    EXPECT_TRUE(std::ranges::any_of(one.remarks, [](const model::Sentence &remark) {
        return remark.find("balancer[0]: its balls are held off balance") == 0;
    }));
    EXPECT_EQ(one.rotor.with_held_among_balancers().imbalances.size(),
              free.rotor.imbalances.size());

    const model::Case all =
        load_text(sound_case + balls + balls + start, {"balancer[*].held=true"});
    EXPECT_TRUE(all.rotor.balancers.empty());
    EXPECT_TRUE(all.simulate.ball_angles.empty());
    EXPECT_TRUE(all.simulate.other_starts.empty());
    // Without a start at their balanced position, where nothing is left of the imbalance.
    const model::Case balanced = load_text(sound_case + balls + balls, {"balancer[*].held=true"});
    EXPECT_EQ(balanced.rotor.imbalances.size(), free.rotor.imbalances.size());
    EXPECT_NEAR(std::abs(std::cos(balanced.rotor.held.at(1).angles.at(0))), 0.5, 1e-15);
}

TEST(RotatingParts, InertiasLeftOutCarryNoAnisotropy) {
    // Ip/2 of the bare shaft is 0.0023930, with two balls of m R^2 = 0.001 it is 0.0033930, with
    // their point mass of m0 R0^2 = 0.02 as well 0.0133930.
    const std::string skew = "[[anisotropy]]\nz = 0.5\ndI = ";
    const std::string balls = "[[balancer]]\nz = 0.5\nmass = 0.1\nradius = 0.1\nimbalance = 0.01\n";
    const std::string pendulums = "[[balancer]]\nz = 0.5\nkind = \"pendulum4\"\nmass = 0.1\n"
                                  "arm = 0.06\npivot = 0.04\n"; // the same radius, twice as many
    const std::string left_out = "balancer[0].tilt_inertia=false";
    for (const std::string &text : {balls + skew + "0.00339\n", pendulums + skew + "0.00439\n",
                                    balls + "imbalance_radius = 2\n" + skew + "0.01339\n"}) {
        (void)load_text(sound_case + text);
        EXPECT_NE(refusal(sound_case + text, {left_out}).find("place), 0.0023930"),
                  std::string::npos)
            << text;
    }
    (void)load_text(sound_case + balls + skew + "0.00239\n", {left_out});
}

TEST(ShearModulus, BothKeysMayAgreeAndGCounts) {
    const std::string start = "format = 1\n[shaft]\nsegments = [{length = 1, outer = 0.1}]\n"
                              "[material.a]\nrho = 1\nE = 2.0e11\nnu = 0.3\n";
    const model::Case scene = load_text(start + "G = 7.69e10\n"); // nu = 0.30039
    EXPECT_EQ(scene.rotor.shaft.segments.at(0).material.G, 7.69e10);
    EXPECT_THROW((void)load_text(start + "G = 7.67e10\n"), model::BadInput); // nu = 0.30378
}

TEST(CaseName, OfAFileIsItsStem) {
    (void)load_text(sound_case);
    const auto renamed = scratch_folder() / "other.toml";
    std::filesystem::rename(scratch_folder() / "case.toml", renamed);
    EXPECT_EQ(input::load_case(renamed).name, "other");
}

} // namespace
} // namespace whirl::tests

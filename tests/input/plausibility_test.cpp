#include "scratch_case.h"

namespace whirl::tests::plausibility_test {
namespace {

const std::string base = sound_case + "[[bearing]]\nz = 0\nk = 1e6\n";

/// Remarks of a case, in one text.
std::string remarks_of(const std::string &text, const std::vector<std::string> &overrides = {},
                       std::vector<std::pair<std::string, std::string>> files = {}) {
    std::string out;
    for (const model::Sentence &remark : load_text(text, overrides, std::move(files)).remarks)
        out += remark.text() + "\n";
    return out;
}

TEST(Plausibility, NothingIsSaidOfAnOrdinaryRotor) {
    EXPECT_EQ(remarks_of(base, {"speeds.to=\"12000 rpm\""}), "");
    // Made rigid or massless on purpose.
    EXPECT_EQ(remarks_of(base, {"material.steel.E=1e18", "material.steel.rho=1e-9"}), "");
}

TEST(Plausibility, NumbersAPowerOfTenFromAnyMachineAreNamed) {
    const std::string ball = "balancer=[{z = 0.5, n = 2, mass = 0.1, radius = 0.02}]";
    const std::vector<std::pair<std::vector<std::string>, std::string>> slips{
        {{"material.steel.E=211"}, "a modulus E of 211 Pa"},
        {{"material.steel.rho=7.81"}, "a density of 7.81 kg/m3"},
        {{"material.steel.rho=7.85e-9"}, "a density of 7.85e-09 kg/m3 makes the shaft massless"},
        {{"material.steel.E=211e6"}, "a modulus E of 2.11e+08 Pa"},
        {{"material.steel.E=2.11e12"}, "a modulus E of 2.11e+12 Pa"},
        {{"material.steel.E=\"21100 GPa\""}, "a modulus E of 2.11e+13 Pa"},
        {{"disc=[{z = 0.5, mass = 10, Id = 0.1, Ip = 0.2}]", "operation.from=300",
          "operation.to=11000"},
         "operation.to = 11000 is in rad/s, 105042 rpm"},
        {{"shaft.segments[0].length=1200"}, "a shaft length of 1200 m"},
        {{"shaft.segments[0].outer=50"}, "a shaft diameter of 50 m"},
        {{"disc=[{z = 0.5, mass = 10, Id = 0.1, Ip = 0.2}]", "speeds.to=12000"},
         "speeds.to = 12000 is in rad/s, 114592 rpm"},
        {{"imbalance=[{z = 0.5, mr = 1e-4, phase = 90}]"}, "imbalance[0].phase = 90 is in rad"},
        {{"speeds.to=\"900 rpm\"", "modes.speed=300"},
         "modes.speed = 300 is in rad/s, 2864.79 rpm"},
        {{"speeds.to=\"900 rpm\"", "modes.speed=1e6"},
         "modes.speed = 1e+06 is in rad/s, 9.5493e+06 rpm, where"},
        {{"disc=[{z = 0.5, mass = 10, Id = 0.1, Ip = 0.2}]", "speeds.to=90", "modes.speed=12000"},
         "modes.speed = 12000 is in rad/s, 114592 rpm: the rotor's surface"},
        {{"imbalance=[{z = 0.5, mr = 0}]"}, "every imbalance is 0"},
        {{"bearing="}, "the rotor has no bearings"},
        {{"imbalance=[{z = 0.5, mr = 50}]"}, "an imbalance of 50 kg m moves"},
        {{"disc=[{z = 0.5, mass = 10, Id = 70, Ip = 0.2}]"},
         "disc[0]: 70 kg m2 of 10 kg is a radius of gyration of 2.646 m"},
        {{"bearing[0].k=100", "speeds.to=\"12000 rpm\""},
         "bearings of 100 N/m together let a rotor"},
        {{ball, "balancer[0].rolling_resistance=8"},
         "a lever arm of the resistance to rolling of 8 m"},
        {{ball, "balancer[0].position=[9.42477796076938, 0]"},
         "balancer[0].position[0] = 9.42478 is in rad"},
        {{ball, "simulate={time = 1, ball_angles = [[90, 1]]}", "speeds={from = 9, count = 1}"},
         "simulate.ball_angles[0][0] = 90 is in rad"},
        {{"disc=[{name = \"fan\", z = 0.2, mass = 1}, {name = \"fan\", z = 0.5, mass = 1}]"},
         "disc \"fan\" stands more than once"}};
    for (const auto &[overrides, start] : slips) {
        const std::string said = remarks_of(base, overrides);
        EXPECT_EQ(said.find(start), 0U) << start << ": " << said;
        EXPECT_EQ(said.find('\n'), said.size() - 1) << said;
    }
    EXPECT_EQ(remarks_of(base, {"imbalance=[{z = 0.5, mr = 1e-4, phase = \"90 deg\"}]"}), "");
    EXPECT_EQ(remarks_of(base, {"bearing[0].k=100", "speeds.to=5"}), ""); // without dimension
    for (const char *to : {"speeds.to=90", "speeds.to=\"90 rad/s\""})
        EXPECT_EQ(remarks_of(base, {to, "modes.speed=30"}), "") << to;
    EXPECT_EQ(remarks_of(base, {"speeds.to=\"900 rpm\"", "modes.speed=\"300 rpm\""}), "");
}

const std::string on_a_table =
    sound_case + "[[bearing]]\nz = 0\ntable = \"t.csv\"\n[speeds]\nfrom = 10\nto = 90\n";

TEST(Plausibility, TablesWithoutAUnitOrTooShortAreNamed) {
    EXPECT_EQ(remarks_of(on_a_table, {}, {{"t.csv", "speed [rad/s],k\n10,1e6\n90,2e6\n"}}), "");
    EXPECT_EQ(remarks_of(on_a_table, {}, {{"t.csv", "speed,k\n10 rad/s,1e6\n90 rad/s,2e6\n"}}), "");
    const std::string bare = remarks_of(on_a_table, {}, {{"t.csv", "speed,k\n10,1e6\n90,2e6\n"}});
    EXPECT_EQ(bare.find("the speeds of t.csv have no unit"), 0U) << bare;
    const std::string few =
        remarks_of(on_a_table, {}, {{"t.csv", "speed [rad/s],k\n20,1e6\n80,2e6\n"}});
    EXPECT_NE(few.find("the table of bearing[0] from 20 to 80"), std::string::npos) << few;
}

std::string refusal_with(const std::string &table) {
    try {
        (void)load_text(on_a_table, {}, {{"t.csv", table}});
    } catch (const model::BadInput &error) {
        return error.what();
    }
    return "accepted";
}

TEST(Plausibility, EmptyCellsAndDecimalCommasAreRefusedWithAHint) {
    const std::string empty = refusal_with("speed [rad/s],k,c\n10,1e6,5\n90,2e6,\n");
    EXPECT_NE(empty.find("t.csv:3: c: expected a damping in N s/m"), std::string::npos) << empty;
    EXPECT_NE(empty.find("got an empty cell"), std::string::npos) << empty;
    const std::string comma = refusal_with("speed [rad/s],k\n10,1,5e6\n90,2e6\n");
    EXPECT_NE(comma.find("a decimal comma?"), std::string::npos) << comma;
    const std::string text = refusal(base, {"bearing.z=\"0,5 m\""});
    EXPECT_NE(text.find("write the decimal point as"), std::string::npos) << text;
}

} // namespace
} // namespace whirl::tests::plausibility_test

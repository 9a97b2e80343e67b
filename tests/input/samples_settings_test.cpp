#include "scratch_case.h"

#include <numbers>

namespace whirl::tests::samples_settings_test {
namespace {

const std::string base = sound_case + "[[bearing]]\nz = 0\nk = \"10 kN/mm\"\nc = 200\n"
                                      "[[imbalance]]\nz = 0.5\nmr = 1e-4\nphase = \"90 deg\"\n";

TEST(SamplesSettings, AreReadInTheUnitsOfTheirEntries) {
    const model::Case scene = load_text(base + R"(
[samples]
count = 50
seed = 3
of = ["peaks", "ends"]
quantiles = [0.9, 0.1]
vary = [
  {path = "bearing[0].k", distribution = "normal", relative = true, deviation = "5 %"},
  {path = "bearing[0].c", distribution = "uniform", from = 100, to = "0.3 kN s/m"},
  {path = "imbalance[0].phase", distribution = "values", values = [0, "180 deg"]},
  {path = "shaft.segments[0].outer", distribution = "normal", mean = "52 mm", deviation = "1 mm"},
  {path = "material.steel.E", distribution = "normal", deviation = "1 GPa"},
]
)");
    ASSERT_TRUE(scene.samples);
    const model::SamplesSettings &samples = *scene.samples;
    EXPECT_EQ(samples.count, 50);
    EXPECT_EQ(samples.seed, 3);
    EXPECT_FALSE(samples.of.critical);
    EXPECT_TRUE(samples.of.peaks);
    EXPECT_TRUE(samples.of.ends);
    EXPECT_EQ(samples.quantiles, (std::vector<double>{0.1, 0.9}));
    ASSERT_EQ(samples.vary.size(), 5U);
    EXPECT_EQ(samples.vary[0].path, "bearing[0].k");
    EXPECT_EQ(samples.vary[0].quantity, model::Quantity::stiffness);
    EXPECT_DOUBLE_EQ(samples.vary[0].mean, 1e7); // of the case
    EXPECT_DOUBLE_EQ(samples.vary[0].deviation, 5e5);
    EXPECT_EQ(samples.vary[1].distribution, model::Distribution::uniform);
    EXPECT_EQ(samples.vary[1].from, 100);
    EXPECT_DOUBLE_EQ(samples.vary[1].to, 300);
    EXPECT_EQ(samples.vary[2].distribution, model::Distribution::values);
    ASSERT_EQ(samples.vary[2].values.size(), 2U);
    EXPECT_DOUBLE_EQ(samples.vary[2].values[1], std::numbers::pi);
    EXPECT_EQ(samples.vary[3].mean, 0.052);
    EXPECT_EQ(samples.vary[3].deviation, 0.001);
    EXPECT_EQ(samples.vary[4].mean, 2e11);
    EXPECT_EQ(samples.vary[4].deviation, 1e9);
}

TEST(SamplesSettings, HaveDefaults) {
    EXPECT_FALSE(load_text(base).samples);
    const model::Case scene = load_text(
        base + "[samples]\ncount = 5\n"
               "vary = [{path = \"bearing[0].c\", distribution = \"values\", values = [1]}]\n");
    ASSERT_TRUE(scene.samples);
    EXPECT_EQ(scene.samples->seed, 1);
    EXPECT_TRUE(scene.samples->of.critical);
    EXPECT_FALSE(scene.samples->of.peaks);
    EXPECT_FALSE(scene.samples->of.ends);
    EXPECT_EQ(scene.samples->quantiles, (std::vector<double>{0.05, 0.5, 0.95}));
}

TEST(SamplesSettings, AllMistakesAreListedAtOnce) {
    const std::string message =
        refusal(base + "[samples]\ncount = 0\nof = [\"peak\"]\nvary = [\n"
                       "{path = \"bearing[1].k\", distribution = \"gauss\"},\n"
                       "{path = \"bearing[0].c\", distribution = \"normal\", deviation = -1}]\n");
    for (const char *part :
         {"case.toml:17: samples.count: ", "case.toml:18: samples.of[0]: ",
          "case.toml:20: samples.vary[0].path: ", "case.toml:20: samples.vary[0].distribution: ",
          "case.toml:21: samples.vary[1].deviation: "})
        EXPECT_NE(message.find(part), std::string::npos) << part << " in\n" << message;
    EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 4) << message;
}

} // namespace
} // namespace whirl::tests::samples_settings_test

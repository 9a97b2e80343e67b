// Published balancing problems (published.json, each with its source): the answers computed anew by
// others, to the digits that are given. Where a source prints another one, `remarks` says why.

#include "analyses/weights.h"
#include "balancing/measured_case.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace whirl::tests::published {

namespace {

using nlohmann::json;

/// Half a unit of the last of five digits, and of the third decimal of a phase in degrees.
constexpr double five_digits = 5e-5;
constexpr double of_phase = 5e-4 * std::numbers::pi / 180;

json all_problems() {
    return json::parse(std::ifstream(WHIRL_ROOT "/tests/balancing/published.json"));
}

Phasor number_of(const json &pair) {
    return polar_degrees(pair.at(0).get<double>(), pair.at(1).get<double>());
}
std::vector<Phasor> numbers_of(const json &list) {
    std::vector<Phasor> out;
    for (const json &pair : list)
        out.push_back(number_of(pair));
    return out;
}

void expect_same(Phasor found, Phasor given, const std::string &what) {
    EXPECT_LE(std::abs(found - given), (five_digits + of_phase) * std::abs(given) + 1e-12)
        << what << ": " << std::abs(found) << " at " << std::arg(found) * 180 / std::numbers::pi
        << " deg in place of " << std::abs(given) << " at "
        << std::arg(given) * 180 / std::numbers::pi;
}

/// Readings and coefficients of a problem at one speed, as tables: in µm and g mm.
struct Tables {
    std::string readings = "speed [rpm],probe,run,amplitude [um],phase [deg]\n";
    std::string influence = "speed [rpm],probe,plane,amplitude [um/(g mm)],phase [deg]\n";
    std::string trials;
    std::size_t planes = 0;

    void add(const json &data, const std::string &speed) {
        const auto line = [&](std::size_t probe, const std::string &run, const json &value) {
            readings += fmt::format("{},{},{},{},{}\n", speed, probe + 1, run,
                                    value.at(0).get<double>(), value.at(1).get<double>());
        };
        for (std::size_t i = 0; i < data.at("initial").size(); ++i) {
            line(i, "initial", data.at("initial")[i]);
            if (data.contains("slow_roll"))
                line(i, "runout", data.at("slow_roll")[i]);
            for (std::size_t p = 0; data.contains("trial") && p < data.at("trial")[i].size(); ++p)
                line(i, fmt::format("t{}", p + 1), data.at("trial")[i][p]);
            for (std::size_t p = 0;
                 data.contains("influence") && p < data.at("influence")[i].size(); ++p) {
                planes = data.at("influence")[i].size();
                const json &value = data.at("influence")[i][p];
                influence += fmt::format("{},{},p{},{},{}\n", speed, i + 1, p + 1,
                                         value.at(0).get<double>(), value.at(1).get<double>());
            }
        }
    }
};

/// @param minimax  the method; @param caps  bounds of the planes, or empty
model::Case case_of(const json &problem, bool minimax, const std::string &phase = "lead") {
    const json &data = problem.at("data");
    Tables tables;
    if (data.contains("speeds_rpm"))
        for (const auto &[speed, own] : data.at("speeds_rpm").items())
            tables.add(own, speed);
    else
        tables.add(data, "3000");
    std::string text = fmt::format("format = 1\n[weights]\nreadings = \"runs.csv\"\n"
                                   "method = \"{}\"\nphase = \"{}\"\n",
                                   minimax ? "minimax" : "least-squares", phase);
    if (data.contains("trial_weights")) {
        const bool kept = !data.value("trial_removed", true);
        for (std::size_t p = 0; p < data.at("trial_weights").size(); ++p) {
            const json &weight = data.at("trial_weights")[p];
            tables.trials +=
                fmt::format("[[trial]]\nrun = \"t{0}\"\nplane = \"p{0}\"\nmr = \"{1} g mm\"\n"
                            "phase = \"{2} deg\"\nkept = {3}\n",
                            p + 1, weight.at(0).get<double>(), weight.at(1).get<double>(), kept);
        }
        tables.planes = data.at("trial_weights").size();
    } else {
        text += "influence = \"influence.csv\"\n";
    }
    for (std::size_t p = 0; p < tables.planes; ++p) {
        text += fmt::format("[[plane]]\nname = \"p{}\"\n", p + 1);
        if (data.contains("cap") && data.at("cap").is_array())
            text += fmt::format("max = \"{} g mm\"\n", data.at("cap")[p].get<double>());
    }
    return measured_case(text + tables.trials,
                         {{"runs.csv", tables.readings}, {"influence.csv", tables.influence}});
}

std::vector<Phasor> weights_of(const results::WeightsResult &result) {
    std::vector<Phasor> out;
    for (const results::CorrectionWeight &weight : result.weights)
        out.push_back(weight.weight * 1e6); // g mm
    return out;
}

void expect_weights(const std::vector<Phasor> &found, const json &given, const std::string &what) {
    const std::vector<Phasor> expected = numbers_of(given);
    ASSERT_EQ(found.size(), expected.size()) << what;
    for (std::size_t p = 0; p < found.size(); ++p)
        expect_same(found[p], expected[p], fmt::format("{} {}", what, p + 1));
}

/// Of a key that the answer may have.
void expect_number(double found, const json &answer, const char *key) {
    if (answer.contains(key))
        EXPECT_NEAR(found, answer.at(key).get<double>(),
                    five_digits * answer.at(key).get<double>() + 1e-12)
            << key;
}

void expect_left(const results::WeightsResult &result, const json &answer) {
    constexpr double micro = 1e6;
    expect_number(micro * result.rms, answer, "rms");
    expect_number(micro * result.max, answer, "max");
    if (!answer.contains("residual"))
        return;
    double sum = 0;
    ASSERT_EQ(result.residual.size(), answer.at("residual").size());
    for (std::size_t i = 0; i < result.residual.size(); ++i) {
        const Phasor after = micro * result.residual[i].after;
        sum += std::abs(after);
        const Phasor given = number_of(answer.at("residual")[i]);
        if (std::abs(given) > 1e-10) // else rounding of whoever computed it
            expect_same(after, given, fmt::format("residual {}", i + 1));
        else
            EXPECT_LE(std::abs(after), 1e-10);
    }
    expect_number(sum / static_cast<double>(result.residual.size()), answer, "mean_abs");
}

class PublishedWeights : public testing::TestWithParam<json> {};

TEST_P(PublishedWeights, AreFoundToTheDigitsGiven) {
    const json &problem = GetParam();
    const json &answer = problem.at("recomputed");
    const bool minimax = problem.at("data").contains("cap");
    // Bounds are of the min-max problem alone.
    json free = problem;
    free["data"].erase("cap");
    const results::WeightsResult squares = analyses::correction_weights(case_of(free, false));
    const json &of_squares = minimax ? answer.at("least_squares") : answer;
    if (of_squares.contains("weights"))
        expect_weights(weights_of(squares), of_squares.at("weights"), "weight");
    expect_left(squares, of_squares);
    if (answer.contains("weights_besides_trials")) {
        expect_weights(weights_of(squares), answer.at("weights_besides_trials"), "beside trials");
        std::vector<Phasor> instead;
        for (const results::CorrectionWeight &weight : squares.weights)
            instead.push_back(1e6 * (weight.weight + weight.on));
        expect_weights(instead, answer.at("weights_instead_of_trials"), "in place of trials");
    }
    if (answer.contains("influence"))
        for (std::size_t i = 0, k = 0; i < answer.at("influence").size(); ++i)
            for (const json &coefficient : answer.at("influence")[i])
                expect_same(squares.influence.at(k++).value, number_of(coefficient),
                            fmt::format("coefficient {}", k));
    if (answer.contains("condition")) {
        // Printed with four digits.
        EXPECT_NEAR(squares.condition.value_or(0), answer.at("condition").get<double>(), 5e-3);
        for (std::size_t p = 0; p < squares.weights.size(); ++p)
            EXPECT_NEAR(squares.weights[p].significance, answer.at("significance")[p].get<double>(),
                        5e-5);
    }
}

/// The least largest residual of those that give it. The optimum is flat: weights of others agree
/// to what their solver left, the value to its digits.
TEST_P(PublishedWeights, OfMinMaxAreOptimal) {
    const json &problem = GetParam();
    const json &recomputed = problem.at("recomputed");
    const bool own = problem.at("data").contains("cap");
    if (!own && !recomputed.contains("min_max"))
        GTEST_SKIP() << "least squares alone";
    const json &answer = own ? recomputed : recomputed.at("min_max");
    const results::WeightsResult result = analyses::correction_weights(case_of(problem, true));
    expect_number(1e6 * result.max, answer, "max");
    EXPECT_LE(result.max, result.bound * (1 + 1e-6)) << "the dual bound";
    EXPECT_LE(result.bound, result.max * (1 + 1e-12));
    const std::vector<Phasor> weights = weights_of(result);
    constexpr double flat = 2e-4;
    for (std::size_t p = 0; p < weights.size(); ++p)
        EXPECT_NEAR(std::abs(weights[p] - number_of(answer.at("weights")[p])), 0,
                    flat * std::abs(weights[p]))
            << "weight " << p + 1;
    if (own && problem.at("data").at("cap").is_array())
        for (std::size_t p = 0; p < weights.size(); ++p)
            EXPECT_LE(std::abs(weights[p]),
                      problem.at("data").at("cap")[p].get<double>() * (1 + 1e-12));
}

/// Phases of readings and weights alike: the numbers are the same ones.
TEST_P(PublishedWeights, AreTheSameInLeadAndLag) {
    const results::WeightsResult lead =
        analyses::correction_weights(case_of(GetParam(), false, "lead"));
    const results::WeightsResult lag =
        analyses::correction_weights(case_of(GetParam(), false, "lag"));
    for (std::size_t p = 0; p < lead.weights.size(); ++p)
        EXPECT_EQ(lead.weights[p].weight, lag.weights[p].weight);
}

INSTANTIATE_TEST_SUITE_P(Problems, PublishedWeights, testing::ValuesIn(all_problems()),
                         [](const auto &problem) {
                             return problem.param.at("id").template get<std::string>();
                         });

/// Two numbers of small whole parts, printed rounded: with the numbers themselves the answers of
/// Darlow (1982) agree to all digits printed.
TEST(PublishedWeightsInPrint, OfDarlowComeFromWholeNumbers) {
    for (const json &problem : all_problems()) {
        if (!problem.at("recomputed").contains("weights_of_exact_integers"))
            continue;
        json exact = problem;
        const auto whole = [](json &pair) {
            const Phasor value = number_of(pair);
            const Phasor rounded(std::round(value.real()), std::round(value.imag()));
            pair = {std::abs(rounded), std::arg(rounded) * 180 / std::numbers::pi};
        };
        for (json &row : exact["data"]["influence"])
            for (json &pair : row)
                whole(pair);
        for (json &pair : exact["data"]["initial"])
            whole(pair);
        const auto found = weights_of(analyses::correction_weights(case_of(exact, false)));
        expect_weights(found, problem.at("recomputed").at("weights_of_exact_integers"),
                       problem.at("id").get<std::string>());
        for (std::size_t p = 0; p < found.size(); ++p) {
            EXPECT_NEAR(std::abs(found[p]), problem.at("answer")[p][0].get<double>(), 5.1e-3);
            const double turned = std::arg(found[p]) * 180 / std::numbers::pi -
                                  problem.at("answer")[p][1].get<double>();
            EXPECT_NEAR(std::remainder(turned, 360), 0, 0.51);
        }
    }
}

/// Planes 2 and 3 of the second problem of Darlow (1982) nearly do the same; of the first none do.
TEST(PublishedWeightsInPrint, DependentPlanesAreNamed) {
    for (const json &problem : all_problems()) {
        const auto id = problem.at("id").get<std::string>();
        if (!id.starts_with("darlow"))
            continue;
        const auto result = analyses::correction_weights(case_of(problem, false));
        if (id == "darlow_1982_1") {
            EXPECT_TRUE(result.dependent.empty());
            continue;
        }
        ASSERT_EQ(result.dependent.size(), 1U);
        EXPECT_EQ(result.dependent[0].planes, (std::vector<std::string>{"p2", "p3"}));
        EXPECT_LT(result.dependent[0].largest_without, result.dependent[0].largest_weight / 2);
        EXPECT_GE(result.dependent[0].rms, result.rms);
    }
}

} // namespace

} // namespace whirl::tests::published

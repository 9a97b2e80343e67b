// Correction weights from readings that a known matrix makes, exactly or with noise.

#include "analyses/weights.h"
#include "balancing/measured_case.h"
#include "model/errors.h"
#include "support/random.h"

#include <algorithm>
#include <cmath>

namespace whirl::tests::simulated {

namespace {

constexpr std::size_t probes = 4, planes = 2, speeds = 2;
constexpr std::size_t places = probes * speeds;

/// A machine: vibration a + H w of every probe and speed, µm and g mm.
struct Machine {
    std::vector<Phasor> a;
    std::vector<std::vector<Phasor>> H;

    explicit Machine(unsigned seed) {
        Random random(seed);
        const auto drawn = [&](double size) {
            return std::polar(size * random(0.5, 1.5), random(0, 6.28));
        };
        for (std::size_t i = 0; i < places; ++i) {
            a.push_back(drawn(40));
            H.push_back({drawn(0.5), drawn(0.4)});
        }
    }
    [[nodiscard]] Phasor reading(std::size_t place, const std::vector<Phasor> &w) const {
        return a[place] + H[place][0] * w[0] + H[place][1] * w[1];
    }
};

/// Normal, of standard deviation 1 a component over the square root of 2: |z|^2 has the mean 1.
Phasor noise(Random &random) {
    const double r = std::sqrt(-std::log(1 - random(0, 1)));
    return std::polar(r, random(0, 2 * std::numbers::pi));
}

const std::vector<Phasor> trial{polar_degrees(50, 20), polar_degrees(60, 250)};

const std::string two_trials =
    "[[plane]]\nname = \"aft\"\n[[plane]]\nname = \"fwd\"\n"
    "[[trial]]\nrun = \"t1\"\nplane = \"aft\"\nmr = \"50 g mm\"\nphase = \"20 deg\"\n"
    "[[trial]]\nrun = \"t2\"\nplane = \"fwd\"\nmr = \"60 g mm\"\nphase = \"250 deg\"\n";
const std::string head = "format = 1\n[weights]\nreadings = \"runs.csv\"\n";
const std::string columns = "speed [rpm],probe,run,amplitude [um],phase [deg]\n";

std::string line_of(std::size_t place, const std::string &run, Phasor value) {
    return fmt::format("{},p{},{},{}\n", 1000 * (1 + place / probes), place % probes, run,
                       cells_of(value));
}

/// Lines of the table. @param share  of every reading, its noise
std::vector<std::string> readings_of(const Machine &machine, Random *random = nullptr,
                                     double share = 0, int times = 1) {
    std::vector<std::string> lines;
    const std::vector<std::pair<std::string, std::vector<Phasor>>> runs{
        {"initial", {0, 0}}, {"t1", {trial[0], 0}}, {"t2", {0, trial[1]}}};
    for (const auto &[run, weights] : runs)
        for (std::size_t i = 0; i < places; ++i)
            for (int k = 0; k < times; ++k) {
                Phasor value = machine.reading(i, weights);
                if (random)
                    value += share * std::abs(value) * noise(*random);
                lines.push_back(line_of(i, run, value));
            }
    return lines;
}

std::string joined(const std::vector<std::string> &lines) {
    std::string text = columns;
    for (const std::string &line : lines)
        text += line;
    return text;
}

results::WeightsResult answer(const std::string &text, const std::string &readings) {
    return analyses::correction_weights(measured_case(text, {{"runs.csv", readings}}));
}

void expect_alike(const results::WeightsResult &a, const results::WeightsResult &b, double share) {
    for (std::size_t p = 0; p < planes; ++p)
        EXPECT_LE(std::abs(a.weights[p].weight - b.weights[p].weight),
                  share * std::abs(a.weights[p].weight));
    EXPECT_NEAR(a.rms, b.rms, share * a.rms);
    EXPECT_NEAR(a.max, b.max, share * a.max);
}

TEST(SimulatedReadings, GiveTheMatrixBack) {
    const Machine machine(1);
    const auto result = answer(head + two_trials, joined(readings_of(machine)));
    for (std::size_t i = 0; i < places; ++i)
        for (std::size_t p = 0; p < planes; ++p)
            EXPECT_LE(std::abs(result.influence[i * planes + p].value - machine.H[i][p]), 1e-12);
    // What is left is what the machine does with the weights.
    const std::vector<Phasor> w{1e6 * result.weights[0].weight, 1e6 * result.weights[1].weight};
    for (std::size_t i = 0; i < places; ++i)
        EXPECT_LE(std::abs(1e6 * result.residual[i].after - machine.reading(i, w)), 1e-10);
    EXPECT_TRUE(result.outliers.empty());
    EXPECT_FALSE(result.weights[0].scatter) << "nothing is known of it";
}

TEST(SimulatedReadings, InAnyOrderGiveTheSame) {
    std::vector<std::string> lines = readings_of(Machine(2));
    const auto before = answer(head + two_trials, joined(lines));
    std::mt19937 engine(4);
    for (int i = 0; i < 5; ++i) {
        std::shuffle(lines.begin(), lines.end(), engine);
        expect_alike(before, answer(head + two_trials, joined(lines)), 1e-12);
    }
}

TEST(SimulatedReadings, WithoutTheRunoutOfOneProbeAreRemarkedOn) {
    std::vector<std::string> lines = readings_of(Machine(2));
    const auto remarks = [&] {
        std::size_t of_runout = 0;
        for (const model::Sentence &one :
             measured_case(head + two_trials, {{"runs.csv", joined(lines)}}).remarks)
            of_runout += one.text().find("no runout of probe p1") != std::string::npos ? 1 : 0;
        return of_runout;
    };
    EXPECT_EQ(remarks(), 0U) << "nobody took any";
    lines.push_back("250,p0,runout,1,2\n");
    EXPECT_EQ(remarks(), 1U);
    for (std::size_t i = 1; i < probes; ++i)
        lines.push_back(fmt::format("250,p{},runout,1,2\n", i));
    EXPECT_EQ(remarks(), 0U);
}

/// A harmonic vibration of amplitude 1 is 2 from peak to peak and 1/sqrt(2) root mean square.
TEST(SimulatedReadings, FromPeakToPeakGiveTheSame) {
    const Machine machine(3);
    const auto before = answer(head + two_trials, joined(readings_of(machine)));
    const std::vector<std::pair<std::string, std::vector<Phasor>>> runs{
        {"initial", {0, 0}}, {"t1", {trial[0], 0}}, {"t2", {0, trial[1]}}};
    for (const auto &[unit, factor] : std::vector<std::pair<std::string, double>>{
             {"um pk-pk", 2}, {"um pp", 2}, {"um peak", 1}, {"um rms", 1 / std::numbers::sqrt2}})
        for (const bool below : {false, true}) {
            std::string text = below
                                   ? "speed,probe,run,amplitude,phase\nrpm,,," + unit + ",deg\n"
                                   : "speed [rpm],probe,run,amplitude [" + unit + "],phase [deg]\n";
            for (const auto &[run, weights] : runs)
                for (std::size_t i = 0; i < places; ++i)
                    text += line_of(i, run, factor * machine.reading(i, weights));
            SCOPED_TRACE(text.substr(0, 80));
            expect_alike(before, answer(head + two_trials, text), 1e-12);
        }
}

TEST(SimulatedReadings, InOtherUnitsGiveTheSame) {
    const Machine machine(3);
    const auto before = answer(head + two_trials, joined(readings_of(machine)));
    std::string text = "speed [Hz];probe;run;amplitude [mil];phase [rad]\n";
    const std::vector<std::pair<std::string, std::vector<Phasor>>> runs{
        {"initial", {0, 0}}, {"t1", {trial[0], 0}}, {"t2", {0, trial[1]}}};
    for (const auto &[run, weights] : runs)
        for (std::size_t i = 0; i < places; ++i) {
            const Phasor value = machine.reading(i, weights);
            text += fmt::format("{:.17g};p{};{};{:.17g};{:.17g}\n",
                                1000.0 * static_cast<double>(1 + i / probes) / 60, i % probes, run,
                                std::abs(value) / 25.4, std::arg(value));
        }
    expect_alike(before, answer(head + two_trials, text), 1e-12);
}

/// A trial weight that stays on for the next run, and both weights in one run: other ways to the
/// same matrix.
TEST(SimulatedReadings, WithTrialWeightsKeptOrTogetherGiveTheSame) {
    const Machine machine(4);
    const auto before = answer(head + two_trials, joined(readings_of(machine)));
    std::vector<std::string> lines;
    for (const auto &[run, weights] : std::vector<std::pair<std::string, std::vector<Phasor>>>{
             {"initial", {0, 0}}, {"t1", {trial[0], 0}}, {"t2", trial}})
        for (std::size_t i = 0; i < places; ++i)
            lines.push_back(line_of(i, run, machine.reading(i, weights)));
    std::string kept = head + two_trials;
    kept.insert(kept.find("[[trial]]\nrun = \"t2\""), "kept = true\n");
    const auto with_kept = answer(kept, joined(lines));
    // To be added beside the weight that stays on.
    EXPECT_LE(std::abs(with_kept.weights[0].weight + 1e-6 * trial[0] - before.weights[0].weight),
              1e-12 * std::abs(before.weights[0].weight));
    EXPECT_LE(std::abs(with_kept.weights[1].weight - before.weights[1].weight),
              1e-12 * std::abs(before.weights[1].weight));
    EXPECT_NEAR(with_kept.rms, before.rms, 1e-12 * before.rms);
    const std::string together =
        head + two_trials +
        "[[trial]]\nrun = \"t2\"\nplane = \"aft\"\nmr = \"50 g mm\"\nphase = \"20 deg\"\n";
    expect_alike(before, answer(together, joined(lines)), 1e-12);
}

/// Slow roll adds the same vector to every reading; as a run it is taken off again, at every speed
/// or at that of slow roll alone.
TEST(SimulatedReadings, WithRunoutGiveTheSame) {
    const Machine machine(5);
    const auto before = answer(head + two_trials, joined(readings_of(machine)));
    for (const bool once : {false, true}) {
        std::vector<std::string> lines;
        std::vector<Phasor> runout;
        for (std::size_t i = 0; i < probes; ++i)
            runout.push_back(
                polar_degrees(5 + static_cast<double>(i), 40.0 * static_cast<double>(i)));
        const std::vector<std::pair<std::string, std::vector<Phasor>>> runs{
            {"initial", {0, 0}}, {"t1", {trial[0], 0}}, {"t2", {0, trial[1]}}};
        for (const auto &[run, weights] : runs)
            for (std::size_t i = 0; i < places; ++i)
                lines.push_back(line_of(i, run, machine.reading(i, weights) + runout[i % probes]));
        for (std::size_t i = 0; i < (once ? probes : places); ++i)
            lines.push_back(once ? fmt::format("250,p{},runout,{}\n", i, cells_of(runout[i]))
                                 : line_of(i, "runout", runout[i % probes]));
        expect_alike(before, answer(head + two_trials, joined(lines)), 1e-11);
    }
}

/// Coefficients that a run of trials gave, in a table for the next time.
TEST(SimulatedReadings, TrimFromAnEarlierMatrix) {
    const Machine machine(6);
    const auto before = answer(head + two_trials, joined(readings_of(machine)));
    std::string influence = "speed [rpm],probe,plane,amplitude [um/(g mm)],phase [deg]\n";
    for (std::size_t i = 0; i < places; ++i)
        for (std::size_t p = 0; p < planes; ++p)
            influence += fmt::format("{},p{},{},{}\n", 1000 * (1 + i / probes), i % probes,
                                     p == 0 ? "aft" : "fwd", cells_of(machine.H[i][p]));
    std::vector<std::string> initial = readings_of(machine);
    initial.resize(places);
    const std::string text = head + "influence = \"influence.csv\"\n" +
                             two_trials.substr(0, two_trials.find("[[trial]]"));
    expect_alike(before,
                 analyses::correction_weights(measured_case(
                     text, {{"runs.csv", joined(initial)}, {"influence.csv", influence}})),
                 1e-12);
}

/// How often the weights that are best without noise, and what is then left, lie within the circles
/// of 95 in 100.
struct Coverage {
    int weights = 0, weights_within = 0, left = 0, left_within = 0;
};

Coverage coverage(int draws, const std::string &settings, int times) {
    Coverage out;
    Random random(99);
    for (int draw = 0; draw < draws; ++draw) {
        const Machine machine(1000 + static_cast<unsigned>(draw));
        const auto exact = answer(head + two_trials, joined(readings_of(machine)));
        const auto found = answer(head + settings + two_trials,
                                  joined(readings_of(machine, &random, 0.02, times)));
        std::vector<Phasor> w;
        for (std::size_t p = 0; p < planes; ++p) {
            ++out.weights;
            out.weights_within += std::abs(found.weights[p].weight - exact.weights[p].weight) <=
                                          *found.weights[p].scatter
                                      ? 1
                                      : 0;
            w.push_back(1e6 * found.weights[p].weight);
        }
        for (std::size_t i = 0; i < places; ++i) {
            ++out.left;
            out.left_within += std::abs(found.residual[i].after - 1e-6 * machine.reading(i, w)) <=
                                       *found.residual[i].scatter
                                   ? 1
                                   : 0;
        }
    }
    return out;
}

/// 95 in 100, less three standard deviations of so many draws; readings of one machine depend on
/// one another, so that fewer count.
constexpr double least_share = 0.92;

TEST(NoisyReadings, StayWithinTheScatterThatIsGiven) {
    const Coverage found = coverage(150, "scatter = 0.02\n", 1);
    EXPECT_GE(found.weights_within, least_share * found.weights);
    EXPECT_GE(found.left_within, least_share * found.left);
    EXPECT_LT(found.left_within, found.left) << "circles that say something";
}

TEST(NoisyReadings, StayWithinTheScatterThatRepeatedReadingsShow) {
    const Coverage found = coverage(100, "", 4);
    EXPECT_GE(found.weights_within, least_share * found.weights);
    EXPECT_GE(found.left_within, least_share * found.left);
    EXPECT_LT(found.left_within, found.left);
}

TEST(NoisyReadings, NameTheOneThatIsFarOff) {
    Random random(8);
    const Machine machine(7);
    std::vector<std::string> lines = readings_of(machine, &random, 0.01, 4);
    const auto sound = answer(head + two_trials, joined(lines));
    EXPECT_TRUE(sound.outliers.empty());
    // The third reading of place 1 in the run t1, misread by 90 degrees.
    const std::size_t at = (places + 1) * 4 + 2;
    lines[at] = line_of(1, "t1", machine.reading(1, {trial[0], 0}) * Phasor(0, 1));
    const auto found = answer(head + two_trials, joined(lines));
    ASSERT_EQ(found.outliers.size(), 1U);
    EXPECT_EQ(found.outliers[0].line, static_cast<int>(at) + 2);
    EXPECT_EQ(found.outliers[0].run, "t1");
    EXPECT_EQ(found.outliers[0].probe, "p1");
    EXPECT_LT(found.outliers[0].probability, 1e-4);
}

TEST(SimulatedReadings, OfMorePlanesThanReadingsGiveTheSmallestWeights) {
    const std::string text = head + "influence = \"influence.csv\"\n[[plane]]\nname = \"a\"\n"
                                    "[[plane]]\nname = \"b\"\n";
    const auto result = analyses::correction_weights(measured_case(
        text, {{"runs.csv", "probe,run,amplitude [um],phase [deg]\n1,initial,10,0\n"},
               {"influence.csv", "probe,plane,amplitude [um/(g mm)],phase [deg]\n1,a,3,0\n"
                                 "1,b,4,0\n"}}));
    // The foot of the perpendicular from 0 on 3 a + 4 b = -10.
    EXPECT_NEAR(result.weights[0].weight.real() * 1e6, -1.2, 1e-12);
    EXPECT_NEAR(result.weights[1].weight.real() * 1e6, -1.6, 1e-12);
    EXPECT_NEAR(result.rms, 0, 1e-18);
    EXPECT_FALSE(result.residual[0].speed);
    EXPECT_TRUE(std::ranges::any_of(result.model.notes, [](const auto &note) {
        return note.text().find("more planes than readings") != std::string::npos;
    }));
}

TEST(SimulatedReadings, WithWeightsThatDoNotTellPlanesApartAreRefused) {
    // Both planes in both runs, in one ratio.
    std::string text = head + two_trials.substr(0, two_trials.find("[[trial]]"));
    for (const char *run : {"t1", "t2"})
        for (const char *plane : {"aft", "fwd"})
            text += fmt::format("[[trial]]\nrun = \"{}\"\nplane = \"{}\"\nmr = \"50 g mm\"\n", run,
                                plane);
    try {
        (void)answer(text, joined(readings_of(Machine(1))));
        ADD_FAILURE() << "accepted";
    } catch (const model::BadInput &error) {
        EXPECT_NE(std::string(error.what()).find("tell the planes apart"), std::string::npos);
    }
}

// Else rounding of the readings would be divided by: weights without limit.
TEST(SimulatedReadings, WithATrialWeightThatChangesNothingAreRefused) {
    Machine machine(2);
    for (auto &row : machine.H)
        row[1] = 0;
    for (const char *method : {"", "method = \"minimax\"\n"})
        try {
            (void)answer(head + method + two_trials, joined(readings_of(machine)));
            ADD_FAILURE() << "accepted";
        } catch (const model::BadInput &error) {
            EXPECT_NE(std::string(error.what()).find("\"fwd\" that changes a reading"),
                      std::string::npos)
                << error.what();
        }
}

// It moves the probes by a thousandth of what the other does.
TEST(SimulatedReadings, OfAPlaneThatDoesLittleAreSaidToBe) {
    Machine machine(3);
    for (auto &row : machine.H)
        row[1] *= 1e-3;
    const results::WeightsResult result = answer(head + two_trials, joined(readings_of(machine)));
    EXPECT_TRUE(std::ranges::any_of(result.model.notes, [](const auto &note) {
        return note.text().find("plane fwd moves the probes little") != std::string::npos;
    }));
}

/// A grade for a rotor of 100 kg at 3000 rpm: G 2.5 gives 2.5e-3 * 100 / 314.16 kg m, half of it in
/// each of two planes.
TEST(SimulatedReadings, WithAGradeSayWhatMayStay) {
    const auto result =
        answer(head + "grade = \"G 2.5\"\nmass = 100\ngrade_speed = \"3000 rpm\"\n" + two_trials,
               joined(readings_of(Machine(1))));
    EXPECT_NEAR(*result.weights[0].permissible, 2.5e-3 * 100 / (100 * std::numbers::pi) / 2, 1e-15);
}

} // namespace

} // namespace whirl::tests::simulated

// What is written in other units: headings, tables, files and sentences. The numbers by hand.

#include "report/common/csv.h"
#include "report/common/words.h"
#include "sample_results.h"

#include <gtest/gtest.h>

namespace whirl::report::units_test {

namespace {

/// Unlike the usual ones in everything: speeds in Hz, frequencies in rpm.
model::OutputUnits american() {
    model::OutputUnits units;
    units.of = {{"length", {"in", 0.0254}},          {"amplitude", {"mil", 2.54e-5}},
                {"speed", {"Hz", 2 * pi}},           {"frequency", {"rpm", pi / 30}},
                {"force", {"lbf", 4.4482216152605}}, {"stiffness", {"lbf/in", 175.12683524647636}}};
    return units;
}

struct Row {
    double speed, z, amplitude, deflection;
};
const Columns<Row> columns{
    {"speed", InCsv("speed"), OnPage("Speed", "{:.4g}").and_si("{:.8g}"),
     InText("").and_si(precise), Quantity::speed, &Row::speed},
    {"z", InCsv("z"), ForReaders("z"), Quantity::length, &Row::z},
    {"amplitude", InCsv("amplitude"), ForReaders("amplitude"), Quantity::amplitude,
     &Row::amplitude},
    {"static", InCsv("static"), ForReaders("static"), Quantity::deflection, &Row::deflection}};
const std::vector<Row> rows{{20 * pi, 0.508, 2.54e-4, 2.54e-4}};

Texts shown_to(const Units &units, Shown Column<Row>::*reader) {
    return texts_of(columns, rows, reader, "-", units);
}

} // namespace

TEST(Units, WithoutAnyAskedForAreThoseOfTheReader) {
    const Units usual = Units::of_readers({});
    EXPECT_EQ(shown_to(usual, &Column<Row>::page),
              (Texts{{"Speed (rpm)", "Speed (rad/s)", "z (m)", "amplitude (µm)", "static (µm)"},
                     {"600", "62.831853", "0.508", "254", "254"}}));
    // On the terminal the second column stands only with more than five digits.
    EXPECT_EQ(shown_to(usual, &Column<Row>::text)[0],
              (std::vector<std::string>{"rpm", "z m", "amplitude µm", "static µm"}));
    EXPECT_EQ(shown_to(usual.styled({.digits = 10}), &Column<Row>::text)[0],
              (std::vector<std::string>{"rpm", "rad/s", "z m", "amplitude µm", "static µm"}));
    EXPECT_EQ(csv_table(columns, rows, Units::of_files({})),
              "speed [rad/s],z [m],amplitude [m],static [m]\n"
              "62.83185307179586,0.508,0.000254,0.000254\n");
}

// A second column in SI is the first one once more: it goes, and leaves its digits.
TEST(Units, AskedForAreThoseOfAllColumnsAndTwoOfOneQuantityAreOne) {
    EXPECT_EQ(shown_to(Units::of_readers(american()), &Column<Row>::page),
              (Texts{{"Speed (Hz)", "z (in)", "amplitude (mil)", "static (mil)"},
                     {"10", "20", "10", "10"}}));
    EXPECT_EQ(
        shown_to(Units::of_readers(american()).styled({.digits = 10}), &Column<Row>::text)[1][0],
        "10");
    EXPECT_EQ(csv_table(columns, rows, Units::of_files(american())),
              "speed [Hz],z [in],amplitude [mil],static [mil]\n10,20,10,10\n");
}

TEST(Units, FromPeakToPeakAreTwiceThoseFromZeroOfWhatVibrates) {
    model::OutputUnits asked = american();
    asked.peak_to_peak = true;
    EXPECT_EQ(csv_table(columns, rows, Units::of_files(asked)),
              "speed [Hz],z [in],amplitude pk-pk [mil],static [mil]\n10,20,20,10\n");
    const Units units = Units::of_readers(asked);
    EXPECT_EQ(units.label("Amplitude", Quantity::amplitude), "Amplitude pk-pk (mil)");
    EXPECT_EQ(units.text(Quantity::amplitude, 2.54e-5), "2 mil pk-pk");
    EXPECT_EQ(units.text(Quantity::deflection, 2.54e-5), "1 mil");
    model::OutputUnits alone;
    alone.peak_to_peak = true;
    EXPECT_EQ(Units::of_readers(alone).text(Quantity::amplitude, 1e-6), "2 µm pk-pk");
}

TEST(Units, OfASentenceAreThoseOfItsValues) {
    using model::Sentence;
    namespace as = model::as;
    const Sentence note("{} of {} at {}, z = {}: {}", 3, "bearing 2 (5 m)", as::speed(2 * pi),
                        as::length(0.508), as::speed.range(2 * pi, 4 * pi));
    EXPECT_EQ(note.text(), "3 of bearing 2 (5 m) at 6.28319 rad/s, z = 0.508 m: 6.28319 to 12.5664 "
                           "rad/s");
    EXPECT_EQ(Units::of_readers({}).text(note),
              "3 of bearing 2 (5 m) at 60 rpm, z = 0.508 m: 60 to 120 rpm");
    EXPECT_EQ(Units::of_readers(american()).text(note),
              "3 of bearing 2 (5 m) at 1 Hz, z = 20 in: 1 to 2 Hz");
    EXPECT_EQ(note.pattern(), "3 of bearing 2 (5 m) at {}, z = {}: {}");
    EXPECT_EQ(Units::of_readers(american())
                  .text(Sentence("{}", as::frequency.list({pi / 30, pi / 15, pi / 10}))),
              "1, 2 and 3 rpm");
    EXPECT_EQ(Sentence("{}", as::number(0.5).with_sign()).text(), "+0.5");
}

TEST(Units, OfJsonAreSiUnlessAskedFor) {
    model::Case scene = sample_case();
    scene.units = american();
    const results::ModesResult result = sample_modes(); // at 100 rad/s
    const Json si = Json::parse(to_json(scene, result));
    EXPECT_EQ(si["speed"], 100.0);
    EXPECT_FALSE(si.contains("units"));
    scene.units.json = true;
    const Json asked = Json::parse(to_json(scene, result));
    EXPECT_NEAR(asked["speed"].get<double>(), 100 / (2 * pi), 1e-13);
    EXPECT_NEAR(asked["z"][1].get<double>(), 0.75 / 0.0254, 1e-13);
    EXPECT_NEAR(asked["modes"][0]["frequency"].get<double>(), 80 * 30 / pi, 1e-11);
    EXPECT_EQ(asked["modes"][1]["real"], -2.0); // 1/s
    EXPECT_EQ(asked["units"]["speed"], "Hz");
    EXPECT_EQ(asked["units"]["rate"], "1/s");
}

} // namespace whirl::report::units_test

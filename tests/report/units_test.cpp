// What is written in other units: headings, tables, text and pictures. The numbers by hand.

#include "report/common/csv.h"
#include "report/common/json.h"
#include "report/common/units.h"

#include "report/common/table.h"
#include "report/common/words.h"
#include "written_in.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <sstream>

namespace whirl::report::units_test {

namespace {

model::OutputUnits american() {
    model::OutputUnits units;
    units.of = {{"length", {"in", 0.0254}},          {"amplitude", {"mil", 2.54e-5}},
                {"speed", {"Hz", 2 * pi}},           {"frequency", {"rpm", pi / 30}},
                {"force", {"lbf", 4.4482216152605}}, {"stiffness", {"lbf/in", 175.12683524647636}}};
    return units;
}

struct Row {
    double speed, z;
};
const Columns<Row> columns{{OnPage("rpm", "{:.10g}"), InText("rpm"), in(rpm, &Row::speed)},
                           {"speed", InCsv("speed [rad/s]"), OnPage("rad/s", "{:.10g}"),
                            InText("rad/s", precise), &Row::speed},
                           {"z", InCsv("z [m]"), ForReaders("z (m)"), &Row::z}};
const std::vector<Row> rows{{20 * pi, 0.508}};

/// A file of one row: headings and cells.
std::string file_of(const std::vector<std::pair<std::string, Json>> &cells) {
    Columns<int> all;
    for (const auto &[heading, cell] : cells)
        all.push_back({InCsv(heading), [value = cell](int) { return value; }});
    return csv_table(all, std::vector{0});
}

/// Cell by cell, numbers within the rounding of a factor.
void expect_same_table(const std::string &found, const std::string &expected) {
    std::istringstream left(found);
    std::istringstream right(expected);
    std::string a;
    std::string b;
    while (std::getline(right, b, ',')) {
        ASSERT_TRUE(std::getline(left, a, ','));
        std::istringstream of_a(a);
        std::istringstream of_b(b);
        std::string x;
        std::string y;
        while (std::getline(of_b, y)) {
            ASSERT_TRUE(std::getline(of_a, x));
            char *end = nullptr;
            const double value = std::strtod(y.c_str(), &end);
            if (*end == '\0' && !y.empty())
                EXPECT_NEAR(std::strtod(x.c_str(), nullptr), value, 1e-14 * std::abs(value));
            else
                EXPECT_EQ(x, y);
        }
    }
    EXPECT_FALSE(std::getline(left, a, ','));
}

} // namespace

TEST(WrittenUnits, AreTheUsualOnesWhereNoneAreGiven) {
    EXPECT_EQ(double(rpm), 30 / pi);
    EXPECT_EQ(in_written_units("at 3000 rpm, z = 0.5 m"), "at 3000 rpm, z = 0.5 m");
    EXPECT_EQ(note_in_written_units("from 3.14159265359 to 6.28318530718 rad/s, z = 0.5 m"),
              "from 30 to 60 rpm, z = 0.5 m"); // as the text around it
    EXPECT_EQ(file_of({{"z [m]", 0.508}}), "z [m]\n0.508\n");
    EXPECT_EQ(texts_of(columns, rows, &Column<Row>::text, "-")[0],
              (std::vector<std::string>{"rpm", "rad/s", "z (m)"}));
}

TEST(WrittenUnits, OfATableFollowFromItsHeadingsAndEqualColumnsAreOne) {
    const WrittenIn units(american());
    const Texts table = texts_of(columns, rows, &Column<Row>::page, "-");
    EXPECT_EQ(table[0], (std::vector<std::string>{"Hz", "z (in)"}));
    EXPECT_EQ(table[1], (std::vector<std::string>{"10", "20"}));
}

TEST(WrittenUnits, OfAFileAreThoseInBrackets) {
    const WrittenIn units(american());
    expect_same_table(file_of({{"speed [rad/s]", 6.283185307179586},
                               {"\"a, b\"", "1,2"},
                               {"amplitude [m]", 2.54e-05},
                               {"force [N]", 4.4482216152605},
                               {"real [1/s]", 3},
                               {"frequency [rad/s]", 3.141592653589793},
                               {"N", 7},
                               {"z [m]", 0.0254}}),
                      "speed [Hz],\"a, b\",amplitude [mil],force [lbf],real [1/s],frequency "
                      "[rpm],N,z [in]\n1,\"1,2\",1,1,3,30,7,1\n");
}

TEST(WrittenUnits, FromPeakToPeakAreTwiceThoseFromZero) {
    model::OutputUnits units = american();
    units.peak_to_peak = true;
    const WrittenIn peak_to_peak(units);
    expect_same_table(file_of({{"amplitude [m]", 0.000254},
                               {"x [m]", 0.000254},
                               {"x_0 [m]", 0.000254},
                               {"force [N]", 4.4482216152605}}),
                      "amplitude pk-pk [mil],x pk-pk [mil],x_0 [mil],force [lbf]\n20,20,10,1\n");
    EXPECT_DOUBLE_EQ(double(micrometres), 2 / 2.54e-5);
    EXPECT_DOUBLE_EQ(double(still_micrometres), 1 / 2.54e-5); // a deflection that stands still
}

TEST(WrittenUnits, OfTextFollowTheirNumbers) {
    const WrittenIn units(american());
    EXPECT_EQ(in_written_units("z = 0.508 m, F = 8.896443231 N"), "z = 20 in, F = 2 lbf");
    EXPECT_EQ(in_written_units("from 6.28318530718 to 12.56637061436 rad/s"), "from 1 to 2 Hz");
    EXPECT_EQ(in_written_units("1.5 m/s2, 3 Nm, 12 mm2, 5 modes, 4 N m"),
              "1.5 m/s2, 3 Nm, 12 mm2, 5 modes, 4 N m");
    // A title is the user's own, and numbers beside rpm come from the factor `rpm`.
    EXPECT_EQ(in_written_units(kept_as_written("shaft of 2 m") + "\nat 50 rpm"),
              "shaft of 2 m\nat 50 Hz");
    // An analysis has no such factors; what it says is converted once.
    EXPECT_EQ(note_in_written_units("above 3000 rpm"), "above 50 Hz");
    EXPECT_EQ(note_in_written_units("at 6.28318530718 rad/s, of frequency 3.14159265359 rad/s"),
              "at 1 Hz, of frequency 30 rpm");
}

TEST(WrittenUnits, OfAPictureAreThoseOfItsAxes) {
    const WrittenIn units(american());
    EXPECT_EQ(script_in_written_units("set xlabel 'Spin speed (rpm)'\nset ylabel 'Amplitude "
                                      "(µm)'\nset label 'z = 0.508 m'\n0.5 2\n"),
              "set xlabel 'Spin speed (Hz)'\nset ylabel 'Amplitude (mil)'\nset label 'z = 20 "
              "in'\n0.5 2\n");
}

TEST(WrittenUnits, OfJsonAreNamedInIt) {
    const WrittenIn units(american());
    Json json{{"speeds", {2 * pi, 4 * pi}},
              {"nodes", {{{"z", 0.0254}, {"amplitude", {2.54e-5, nullptr}}, {"phase", 1.5}}}}};
    convert_json(json);
    EXPECT_EQ(json["speeds"], (Json{1.0, 2.0}));
    EXPECT_EQ(json["nodes"][0]["z"], 1.0);
    EXPECT_EQ(json["nodes"][0]["amplitude"], (Json{1.0, nullptr}));
    EXPECT_EQ(json["nodes"][0]["phase"], 1.5);
    EXPECT_EQ(json["units"], (Json{{"amplitude", "mil"}, {"speeds", "Hz"}, {"z", "in"}}));
}

} // namespace whirl::report::units_test

#include "report/common/csv.h"

#include <gtest/gtest.h>
#include <pugixml.hpp>

#include <cmath>
#include <limits>

namespace whirl::report {

namespace {

struct Row {
    std::string name;
    std::optional<double> value;
    std::vector<std::optional<double>> list;
};

const Columns<Row> columns{
    {"name", InCsv("name"), OnPage("Name"), InText("mode"), &Row::name},
    {"value", InCsv("value"), OnPage("Value", "{:.3g}", "no limit"), InText(""),
     Quantity::amplitude, &Row::value},
    {"list", Quantity::number, &Row::list},
    {OnPage("No."), [](const Row &, std::size_t index) { return index + 1; }}};

const double infinite = std::numeric_limits<double>::infinity();
const std::vector<Row> rows{{"1F", 13.5, {1.5, std::nullopt}},
                            {"a, \"b\" <c>", std::nullopt, {}},
                            {"10B", infinite, {}},
                            {"", std::nan(""), {}}};

} // namespace

TEST(Table, WhatIsRoundedToNothingHasNoSign) {
    EXPECT_EQ(shown(Json(-0.04), {"", "{:.1f}"}, "-"), "0.0");
    EXPECT_EQ(shown(Json(-0.06), {"", "{:.1f}"}, "-"), "-0.1");
    EXPECT_EQ(shown(Json(-0.0), {"", "{:.3g}"}, "-"), "0");
    EXPECT_EQ(shown(Json(-3e-10), {"", "{:.3g}"}, "-"), "-3e-10");
}

TEST(Table, EachReaderSeesItsColumnsAndItsOwnWordForWhatIsMissing) {
    EXPECT_EQ(csv_table(columns, rows, {}), "name,value [m]\n"
                                            "1F,13.5\n"
                                            "\"a, \"\"b\"\" <c>\",\n"
                                            "10B,\n"
                                            ",\n");
    EXPECT_EQ(text_table(columns, rows, {}), "  mode            m\n"
                                             "  1F           13.5\n"
                                             "  a, \"b\" <c>      -\n"
                                             "  10B             -\n"
                                             "                  -\n");
    EXPECT_EQ(json_rows(columns, rows, {}).dump(),
              R"([{"name":"1F","value":13.5,"list":[1.5,null]},)"
              R"({"name":"a, \"b\" <c>","value":null,"list":[]},)"
              R"({"name":"10B","value":null,"list":[]},{"name":"","value":null,"list":[]}])");
    EXPECT_EQ(json_lists(columns, rows, {}).at("name").dump(), R"(["1F","a, \"b\" <c>","10B",""])");
}

struct Measured {
    double speed = 0, factor = 0, error = 0;
};
const Columns<Measured> measured{
    {"speed", InText("speed", "{:.8g}").and_si(precise), Quantity::speed, &Measured::speed},
    {"factor", InText("AF", "{:.4g}"), Quantity::number, &Measured::factor},
    {"error", InText("error", rough), Quantity::speed, &Measured::error}};

/// What stands for several places says the same as each of them.
TEST(Table, PartsForSeveralPlacesAreThoseWrittenOut) {
    const Columns<Measured> short_ones = and_then(
        Columns<Measured>{
            {InFiles("speed"), AllDigits("Spin speed"), Quantity::speed, &Measured::speed},
            {InFiles("factor"), Titled("Factor", "{:.4g}"), Quantity::number, &Measured::factor}},
        {{"error", RelativeError(), &Measured::error}});
    const Columns<Measured> in_full{
        {"speed", InCsv("speed"), OnPage("Spin speed", "{:.10g}").and_si("{:.10g}"),
         InText("spin speed").and_si(precise), Quantity::speed, &Measured::speed},
        {"factor", InCsv("factor"), OnPage("Factor", "{:.4g}"), InText("factor", "{:.4g}"),
         Quantity::number, &Measured::factor},
        {"error", OnPage("Relative error", "{:.2g}"), InText("error", rough), Quantity::number,
         &Measured::error}};
    const std::vector<Measured> some{{1234.56789012, 1.23456, 1e-3}, {0, 2, 1e-9}};
    const Units readers = Units::of_readers({});
    for (const TextStyle &style : {TextStyle{}, TextStyle{0, true, 0}}) {
        const Units units = readers.styled(style);
        EXPECT_EQ(text_table(short_ones, some, units), text_table(in_full, some, units));
    }
    EXPECT_EQ(page_table(short_ones, some, readers), page_table(in_full, some, readers));
    EXPECT_EQ(csv_table(short_ones, some, {}), csv_table(in_full, some, {}));
    EXPECT_EQ(json_rows(short_ones, some, {}), json_rows(in_full, some, {}));
}

/// Five digits, or as many as are asked for; errors only where they change these, or on request.
TEST(Table, TheTerminalHasAsManyDigitsAsAreAskedFor) {
    const std::vector<Measured> sure{{1234.56789012, 1.23456, 1e-3}};
    EXPECT_EQ(text_table(measured, sure, {}), "  speed rad/s      AF\n"
                                              "  1234.6        1.235\n");
    const std::string ten = text_table(measured, sure, Units().styled({10, false, 0}));
    for (const char *part : {"  1234.56789    ", "  1.23456  ", "error rad/s", "  1.0e-03\n"})
        EXPECT_NE(ten.find(part), std::string::npos) << part << "\n" << ten;
    // A thousandth is below the five digits of 1234.6, which stand for 0.05 and more.
    EXPECT_EQ(text_table(measured, sure, Units().styled({5, true, 0})),
              "  speed rad/s      AF   error rad/s\n"
              "  1234.6        1.235       1.0e-03\n");
    const std::vector<Measured> unsure{{1234.5, 1, 0.5}};
    EXPECT_NE(text_table(measured, unsure, {}).find("5.0e-01"), std::string::npos);
}

TEST(Table, PageIsMarkupWithEveryCellEscaped) {
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(page_table(columns, rows, {}).c_str()));
    std::vector<std::string> cells;
    for (const auto &cell : document.select_nodes("//tbody/tr/td"))
        cells.emplace_back(cell.node().text().get());
    EXPECT_EQ(cells, (std::vector<std::string>{"1F", "13.5", "1", "a, \"b\" <c>", "–", "2", "10B",
                                               "no limit", "3", "", "–", "4"}));
}

TEST(Table, LinesOfSeveralKindsShareOneHead) {
    EXPECT_EQ(csv_rows({{"kind"}, {"value", Quantity::amplitude}, {"name"}}, columns,
                       std::vector{rows[0]}, {}),
              ",13.5,1F\n");
}

} // namespace whirl::report

#include "input/csv_table.h"
#include "model/errors.h"
#include "scratch_case.h"

#include <cmath>

namespace whirl::tests {
namespace {

using input::Quantity;

const std::vector<input::CsvRule> rules{
    {"speed", Quantity::speed}, {"k", Quantity::stiffness}, {"label", {}}};

/// An entry `table = "t.csv"` of a case.
struct Asked {
    input::Node entry;
    input::FileTexts files;
    input::ReadContext context{entry, files};
    input::Problems &problems = context.problems;

    /// The table of that text; its mistakes go to `problems`.
    input::CsvTable read(const std::string &text) {
        write_case(scratch_folder(), {"", 0, "", "", "", {{"t.csv", text}}});
        context.folder = scratch_folder();
        entry.kind = input::Node::Kind::text;
        entry.text = "t.csv";
        return {{entry, "table", context}, rules};
    }
};

std::string message(const input::Problems &problems) {
    try {
        problems.throw_if_any();
    } catch (const model::BadInput &error) {
        return error.what();
    }
    return "";
}

TEST(CsvTable, UnitsOfHeaderAndCell) {
    Asked asked;
    auto table = asked.read("label , k [kN/mm],speed [rpm]\na,2,60\n\n# note\nb,3 N/m,2 rad/s\n");
    ASSERT_TRUE(table.usable()) << message(asked.problems);
    const std::vector<input::CsvRow> rows = table.rows();
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[1].text("label"), "b");
    EXPECT_EQ(rows[0].number("k", Quantity::stiffness), 2e6);
    EXPECT_DOUBLE_EQ(rows[0].number("speed", Quantity::speed), 2 * M_PI);
    EXPECT_EQ(rows[1].number("k", Quantity::stiffness), 3);
    EXPECT_EQ(rows[1].number("speed", Quantity::speed), 2);
    EXPECT_TRUE(asked.problems.empty());
    rows[1].fail("label", "wrong");
    EXPECT_NE(message(asked.problems).find("t.csv:5: label: wrong"), std::string::npos)
        << message(asked.problems);
}

TEST(CsvTable, MissingColumnsAndCellsAreEmpty) {
    Asked asked;
    auto table = asked.read("speed,k\n1,\n");
    EXPECT_FALSE(table.has("label"));
    const std::vector<input::CsvRow> rows = table.rows();
    EXPECT_FALSE(rows[0].text("label"));
    EXPECT_FALSE(rows[0].optional_number("k", Quantity::stiffness));
    EXPECT_TRUE(asked.problems.empty());
    EXPECT_TRUE(std::isnan(rows[0].number("k", Quantity::stiffness)));
    EXPECT_NE(
        message(asked.problems).find("t.csv:2: k: expected a stiffness in N/m, got an empty cell"),
        std::string::npos)
        << message(asked.problems);
}

TEST(CsvTable, QuotationMarksHoldCommasCommentsAndTheirLike) {
    Asked asked;
    auto table = asked.read("\"label\",k # comment\n"
                            "\"a, b\",3\n"
                            " \" 2\"\" bore, #4 \" , \"5 kN/m\" # the \"last\", but two\n"
                            "\"\"\"\",7#8\n"
                            "12\" disc,9\n"
                            "\"\",10\n");
    ASSERT_TRUE(table.usable()) << message(asked.problems);
    const std::vector<input::CsvRow> rows = table.rows();
    ASSERT_EQ(rows.size(), 5U);
    const std::vector<std::string> labels{"a, b", "2\" bore, #4", "\"", "12\" disc", ""};
    const std::vector<double> k{3, 5000, 7, 9, 10};
    for (std::size_t row = 0; row < 5; ++row) {
        EXPECT_EQ(rows[row].text("label").value_or(""), labels[row]);
        EXPECT_EQ(rows[row].number("k", Quantity::stiffness), k[row]);
    }
    EXPECT_TRUE(asked.problems.empty());
}

TEST(CsvTable, QuotationMarksThatDoNotMatchAreNamed) {
    Asked asked;
    const auto table = asked.read("label,k\n\"a,3\n\"a\" b,3\n\"a\"\"\"\",3\na,3\n");
    EXPECT_FALSE(table.usable());
    const std::string text = message(asked.problems);
    for (const char *line : {"t.csv:2: expected a quotation mark at the end",
                             "t.csv:3: expected a comma after the quotation mark",
                             "t.csv:4: expected a quotation mark at the end"})
        EXPECT_NE(text.find(line), std::string::npos) << text;
    EXPECT_EQ(text.find("t.csv:5"), std::string::npos) << text;
}

TEST(CsvTable, EveryMistakeOfTheHeaderIsNamed) {
    Asked asked;
    const auto table = asked.read("sped,k [kg],k\n1,2,3\n");
    EXPECT_FALSE(table.usable());
    const std::string text = message(asked.problems);
    EXPECT_NE(text.find("t.csv:1: sped: unknown column, did you mean \"speed\"?"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("t.csv:1: k: expected a unit of a stiffness"), std::string::npos) << text;
    EXPECT_NE(text.find("t.csv:1: k: expected each column once"), std::string::npos) << text;
}

} // namespace
} // namespace whirl::tests

// One table in the dialects of spreadsheets and programs is one rotor; what has two meanings, or is
// no table, is refused by name.

#include "scratch_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <random>

namespace whirl::tests::csv_dialects {
namespace {

/// A table in plain words: its cells with a decimal point.
struct PlainTable {
    std::vector<std::string> names, units; ///< of the columns; a unit may be empty
    std::vector<std::vector<std::string>> rows;
};

enum class Units { brackets, parentheses, second_line, heading };
enum class Encoding { utf8, utf8_marked, utf16_little, utf16_big, latin1 };

struct Dialect {
    std::string name;
    char separator = ',';
    std::string line_end = "\n";
    char decimal = '.';
    bool quoted = false;
    std::string around = {}; ///< blanks on both sides of a cell
    int header_trail = 0;    ///< empty cells behind the last column
    int row_trail = 0;
    Units units = Units::brackets;
    Encoding encoding = Encoding::utf8;
    bool reversed = false; ///< columns from the last to the first
    std::function<std::string(const std::string &)> whole = {}; ///< what becomes of the text
};

std::string cell_text(std::string cell, const Dialect &dialect, bool number) {
    if (number && dialect.decimal != '.')
        std::ranges::replace(cell, '.', dialect.decimal);
    return dialect.around + (dialect.quoted ? "\"" + cell + "\"" : cell) + dialect.around;
}

std::string heading(const std::string &name, const std::string &unit, Units units) {
    if (unit.empty() || units == Units::second_line)
        return name;
    if (units == Units::heading && unit == "rpm")
        return unit;
    return units == Units::parentheses ? name + " (" + unit + ")" : name + " [" + unit + "]";
}

std::string encoded(const std::string &text, Encoding encoding) {
    std::string out = encoding == Encoding::utf8_marked    ? "\xEF\xBB\xBF"
                      : encoding == Encoding::utf16_little ? "\xFF\xFE"
                      : encoding == Encoding::utf16_big    ? "\xFE\xFF"
                                                           : "";
    const std::string micro = "µ"; // the only sign beyond ASCII here
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool is_micro = text.compare(i, micro.size(), micro) == 0;
        const char byte = is_micro ? '\xB5' : text[i];
        if (encoding == Encoding::utf16_little)
            out += {byte, '\0'};
        else if (encoding == Encoding::utf16_big)
            out += {'\0', byte};
        else if (encoding == Encoding::latin1 || !is_micro)
            out += byte;
        else
            out += micro;
        i += is_micro ? micro.size() - 1 : 0;
    }
    return out;
}

std::string written(const PlainTable &table, const Dialect &dialect) {
    std::vector<std::size_t> order(table.names.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        order[i] = dialect.reversed ? order.size() - 1 - i : i;
    std::string text;
    const auto line = [&](const std::function<std::string(std::size_t)> &cell, int trail) {
        for (std::size_t i = 0; i < order.size(); ++i)
            text += (i > 0 ? std::string(1, dialect.separator) : "") + cell(order[i]);
        text += std::string(static_cast<std::size_t>(trail), dialect.separator) + dialect.line_end;
    };
    line(
        [&](std::size_t i) {
            return cell_text(heading(table.names[i], table.units[i], dialect.units), dialect,
                             false);
        },
        dialect.header_trail);
    if (dialect.units == Units::second_line)
        line([&](std::size_t i) { return cell_text(table.units[i], dialect, false); },
             dialect.row_trail);
    for (const std::vector<std::string> &row : table.rows)
        line(
            [&](std::size_t i) { return cell_text(row[i], dialect, table.names[i] != "material"); },
            dialect.row_trail);
    return encoded(dialect.whole ? dialect.whole(text) : text, dialect.encoding);
}

std::string replaced(std::string text, const std::string &from, const std::string &to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
    return text;
}

std::vector<Dialect> dialects() {
    const auto behind = [](const std::string &more) {
        return [more](const std::string &text) { return text + more; };
    };
    const auto before = [](const std::string &more) {
        return [more](const std::string &text) { return more + text; };
    };
    return {
        {.name = "commas"},
        {.name = "commas and blanks", .around = "  "},
        {.name = "commas and tabs around cells", .around = "\t"},
        {.name = "DOS line ends", .line_end = "\r\n"},
        {.name = "line ends of old Macintoshes", .line_end = "\r"},
        {.name = "byte order mark", .encoding = Encoding::utf8_marked},
        {.name = "Excel, CSV of a continental country",
         .separator = ';',
         .line_end = "\r\n",
         .decimal = ',',
         .encoding = Encoding::latin1},
        {.name = "Excel, CSV UTF-8 of a continental country",
         .separator = ';',
         .line_end = "\r\n",
         .decimal = ',',
         .encoding = Encoding::utf8_marked},
        {.name = "Excel, Unicode text",
         .separator = '\t',
         .line_end = "\r\n",
         .encoding = Encoding::utf16_little},
        {.name = "Excel, Unicode text of a continental country",
         .separator = '\t',
         .line_end = "\r\n",
         .decimal = ',',
         .encoding = Encoding::utf16_little},
        {.name = "UTF-16, the high byte first", .encoding = Encoding::utf16_big},
        {.name = "semicolons and decimal points", .separator = ';'},
        {.name = "tabs", .separator = '\t'},
        {.name = "tabs and decimal commas", .separator = '\t', .decimal = ','},
        {.name = "LibreOffice, every cell quoted", .quoted = true},
        {.name = "every cell quoted, decimal commas", .decimal = ',', .quoted = true},
        {.name = "empty columns behind the last", .header_trail = 2, .row_trail = 2},
        {.name = "empty cells behind the rows", .row_trail = 1},
        {.name = "empty columns, semicolons", .separator = ';', .header_trail = 1, .row_trail = 1},
        {.name = "empty rows below", .whole = behind(",,,\n,\n\n  \n")},
        {.name = "comments", .whole = before("# of a test, made by hand\n\n#\n")},
        {.name = "separator named for Excel",
         .separator = ';',
         .decimal = ',',
         .whole = before("sep=;\n")},
        {.name = "no-break blanks", .around = "\u00a0"},
        {.name = "narrow no-break blanks", .separator = ';', .decimal = ',', .around = "\u202f"},
        {.name = "units in parentheses", .units = Units::parentheses},
        {.name = "units in the second line", .units = Units::second_line},
        {.name = "units in the second line, tabs",
         .separator = '\t',
         .decimal = ',',
         .units = Units::second_line},
        {.name = "rpm as a heading", .units = Units::heading},
        {.name = "columns the other way round", .reversed = true},
        {.name = "large E",
         .whole = [](const std::string &text) { return replaced(text, "e+", "E+"); }},
        {.name = "minus signs of typesetting",
         .whole = [](const std::string &text) { return replaced(text, "-", "\u2212"); }},
        {.name = "no line end at the end",
         .whole = [](const std::string &text) { return text.substr(0, text.size() - 1); }},
    };
}

/// Numbers of three to five digits, of which none is a thousand or one and a little.
std::string number(std::mt19937 &random, double least, double most) {
    const double share = std::uniform_real_distribution(0.0, 1.0)(random);
    return fmt::format("{:.{}f}", least + share * (most - least),
                       std::uniform_int_distribution(1, 2)(random));
}

PlainTable random_stations(std::mt19937 &random) {
    PlainTable out{
        {"length", "outer", "inner", "material", "elements"}, {"mm", "µm", "cm", "", ""}, {}};
    for (int i = 0; i < 6; ++i)
        out.rows.push_back({number(random, 20, 300), number(random, 30000, 90000),
                            i % 2 == 0 ? "" : number(random, 0.1, 2),
                            i % 3 == 0 ? "steel" : "brass", std::to_string(1 + i)});
    return out;
}

PlainTable random_coefficients(std::mt19937 &random) {
    PlainTable out{
        {"speed", "kxx", "kxy", "kyy", "cxx"}, {"rpm", "N/um", "kN/mm", "N/m", "N s/m"}, {}};
    for (int i = 0; i < 5; ++i)
        out.rows.push_back({std::to_string(1000 * i + 7), number(random, 10, 90),
                            "-" + number(random, 1, 9),
                            fmt::format("{:.3e}", std::uniform_real_distribution(1e6, 9e7)(random)),
                            number(random, 100, 900)});
    return out;
}

const std::string on_tables = "format = 1\n"
                              "[material.steel]\nE = 2e11\nnu = 0.3\nrho = 7800\n"
                              "[material.brass]\nE = 1e11\nnu = 0.34\nrho = 8500\n"
                              "[shaft]\ntable = \"stations.csv\"\n"
                              "[[bearing]]\nz = 0\ntable = \"bearing.csv\"\n";

/// All numbers that the tables give a rotor.
std::vector<double> numbers_of(const model::Rotor &rotor) {
    std::vector<double> out;
    for (const model::Segment &s : rotor.shaft.segments)
        out.insert(out.end(), {s.length, s.outer_start, s.inner_start, s.material.E,
                               static_cast<double>(s.elements)});
    for (const model::Bearing &bearing : rotor.bearings) {
        out.insert(out.end(), bearing.speeds.begin(), bearing.speeds.end());
        for (const model::BearingCoefficients &row : bearing.rows)
            for (const Eigen::Matrix2d *m : {&row.k, &row.c})
                out.insert(out.end(), m->data(), m->data() + m->size());
    }
    return out;
}

TEST(CsvDialects, GiveTheSameRotor) {
    std::mt19937 random(7);
    ASSERT_GE(dialects().size(), 20U);
    for (int repeat = 0; repeat < 5; ++repeat) {
        const PlainTable stations = random_stations(random);
        const PlainTable coefficients = random_coefficients(random);
        std::vector<double> expected;
        for (std::size_t row = 0; row < stations.rows.size(); ++row) {
            const auto &cells = stations.rows[row];
            expected.insert(expected.end(),
                            {std::stod(cells[0]) / 1e3, std::stod(cells[1]) / 1e6,
                             cells[2].empty() ? 0 : std::stod(cells[2]) / 1e2,
                             cells[3] == "steel" ? 2e11 : 1e11, std::stod(cells[4])});
        }
        for (const auto &row : coefficients.rows)
            expected.push_back(std::stod(row[0]) * (std::numbers::pi / 30));
        for (const auto &row : coefficients.rows)
            expected.insert(expected.end(), {std::stod(row[1]) * 1e6, 0, std::stod(row[2]) * 1e6,
                                             std::stod(row[3]), std::stod(row[4]), 0, 0, 0});
        for (const Dialect &dialect : dialects()) {
            SCOPED_TRACE(dialect.name);
            std::vector<double> read;
            try {
                read = numbers_of(load_text(on_tables, {},
                                            {{"stations.csv", written(stations, dialect)},
                                             {"bearing.csv", written(coefficients, dialect)}})
                                      .rotor);
            } catch (const model::BadInput &error) {
                ADD_FAILURE() << error.what();
            }
            EXPECT_EQ(read, expected);
        }
    }
}

std::string said_of(const std::string &bearing_table) {
    try {
        (void)load_text(sound_case + "[[bearing]]\nz = 0\ntable = \"t.csv\"\n", {},
                        {{"t.csv", bearing_table}});
    } catch (const model::BadInput &error) {
        return error.what();
    }
    return "accepted";
}

TEST(CsvDialects, WhatIsNoNumberIsNamed) {
    const std::vector<std::pair<std::string, std::string>> answers{
        // errors of spreadsheets, with their cell
        {"speed [rpm],kxx\n1000,1e7\n2000,#DIV/0!\n", "t.csv:3: kxx: expected a stiffness in N/m, "
                                                      "got #DIV/0!, an error of the spreadsheet: a "
                                                      "division by zero (cell B3)"},
        {"speed [rpm],kxx\n1000,#N/A\n", "got #N/A, an error of the spreadsheet: a value"},
        {"speed [rpm],kxx\n#REF!,1e7\n", "t.csv:2: speed: expected an angular speed in rad/s, got "
                                         "#REF!, an error of the spreadsheet: a reference"},
        {"speed [rpm];kxx\n1000;#BEZUG!\n", "got #BEZUG!, an error of the spreadsheet (cell B2)"},
        {"speed [rpm]\tkxx\n1000\t#VALUE!\n", "got #VALUE!, an error of the spreadsheet"},
        {"speed [rpm],kxx\n1000,Err:502\n", "got Err:502, an error of the spreadsheet"},
        {"speed [rpm],kxx\n1000,######\n", "too narrow for the number (cell B2)"},
        {"speed [rpm],kxx\n1000, # none\n", "got an empty cell"},
        // thousands
        {"speed [rpm],kxx\n\"1,000\",1e7\n", "write \"1000\", or \"1.000\" if the comma is a"},
        {"speed [rpm]\tkxx\n1,000\t1e7\n", "write \"1000\", or \"1.000\" if the comma is a"},
        {"speed [rpm]\tkxx\n1 000\t1e7\n", "write \"1000\", without a separator of thousands"},
        {"speed [rpm]\tkxx\n1\u202f000\t1e7\n", "write \"1000\", without a separator"},
        {"speed [rpm];kxx\n1'000;1e7\n", "write \"1000\", without a separator of thousands"},
        {"speed [rpm];kxx\n1.000,5;1e7\n", "write \"1000.5\", without a separator of thousands"},
        {"speed [rpm];kxx\n1.000;10000000\n2.000;10000000\n", "write \"2000\" or \"2.0000\""},
        {"speed [rpm];kxx\n1,5;1e7\n2.5;1e7\n", "t.csv:2: speed: expected one decimal sign in a "
                                                "table, got \"1,5\" here and \"2.5\" in A3"},
        // headings
        {"n,kxx\n1000,1e7\n", "t.csv:1: n: unknown column"},
        {"N/m,kxx\n1000,1e7\n", "t.csv:1: N/m: unknown column"}, // kxx, kxy, kyx or kyy
        {"speed [1/s],kxx\n1000,1e7\n", "write \"rad/s\" or \"rev/s\""},
        {"rpm,speed,kxx\n1000,1000,1e7\n", "speed: expected each column once"},
        {"speed kxx kyy\n1000 1e7 1e7\n", "commas, semicolons or tabs between the columns, got "
                                          "blanks"},
        {"speed [rpm],,kxx\n1000,5,1e7\n", "expected the name of the column, got none"},
        {"speed [rpm],kxx\n1000,1e7,5\n", "t.csv:2: expected 2 cells as in the header, got 3"},
        {"speed [rpm],kxx\n", "expected rows below the header"},
        {",,,\n", "expected the name of the column"},
        {"", "expected a header line, the table is empty"},
        // no text
        {"PK\x03\x04"
         "aaaa",
         "it is a ZIP archive"},
        {"PK\x03\x04 [Content_Types].xml xl/workbook.xml", "an Excel workbook (.xlsx); export its"},
        {"PK\x03\x04 mimetypeapplication/vnd.oasis.opendocument.spreadsheet",
         "an OpenDocument spreadsheet (.ods); export its sheet as text"},
        {"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1", "an Excel workbook (.xls); export its sheet"},
        {std::string("s\0p\0e\0e\0d\0", 10), "without a byte order mark; save it as UTF-8"},
        {"%PDF-1.7\n", "it is a PDF"},
    };
    for (const auto &[table, answer] : answers) {
        const std::string said = said_of(table);
        EXPECT_NE(said.find(answer), std::string::npos) << table << "\n" << said;
    }
}

TEST(CsvDialects, FilesThatAreNoTablesAreNamed) {
    const auto said = [](const std::string &path) {
        return refusal(sound_case + "[[bearing]]\nz = 0\ntable = \"" + path + "\"\n");
    };
    EXPECT_NE(said("/dev/zero")
                  .find(":10: bearing[0].table: expected a CSV table, got /dev/zero: it is larger "
                        "than 100 MB"),
              std::string::npos);
    EXPECT_NE(said("/tmp").find("it is a folder"), std::string::npos);
    EXPECT_NE(said(std::string(300, 'x')).find("the file cannot be read: "), std::string::npos);
    EXPECT_NE(said("none.csv").find("there is no such file"), std::string::npos);
}

} // namespace
} // namespace whirl::tests::csv_dialects

// Titles and names of parts are the user's own: whatever they are, each reader gets them as they
// are written, and no program on the way takes them for anything else.

#include "report/common/csv.h"
#include "report/common/html.h"
#include "report/common/text_width.h"
#include "report/common/words.h"
#include "results/response.h"
#include "sample_results.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include <algorithm>
#include <random>

namespace whirl::report {

namespace {

/// Pieces that mean something to gnuplot, XML, HTML, JavaScript, a shell, a terminal, a spreadsheet
/// or UTF-8, and some that mean nothing.
const std::vector<std::string> pieces{"'",
                                      "''",
                                      "\"",
                                      "]]>",
                                      "]]",
                                      "<b>",
                                      "</script>",
                                      "<!--",
                                      "&amp;",
                                      "&#x41;",
                                      "&#65;",
                                      "`id`",
                                      "$HOME",
                                      "$(id)",
                                      "@x",
                                      "%",
                                      "%s",
                                      "%%d",
                                      "%{x}",
                                      "{a_b^2}",
                                      "\n",
                                      "\r",
                                      "\t",
                                      "\\n",
                                      "\\",
                                      "\\U+41",
                                      "\x1b[31m",
                                      "\a",
                                      "\x7f",
                                      "\u009b2J",
                                      "\u2028",
                                      "\u202e",
                                      "\ufffe",
                                      "\xff",
                                      "\xc3",
                                      "\xed\xa0\x80",
                                      "\xf8\x88\x80\x80",
                                      "é",
                                      "e\u0301",
                                      "Ω",
                                      "轴承",
                                      "😀",
                                      "=1+1",
                                      "+1",
                                      "-1",
                                      "@SUM",
                                      "＝1",
                                      ";",
                                      ",",
                                      "#",
                                      " ps 7 ",
                                      " noenhanced",
                                      "EOD",
                                      "2e+07",
                                      "~",
                                      "?",
                                      "*",
                                      "|",
                                      "0",
                                      "a",
                                      "B",
                                      "disc",
                                      " "};

class NastyNames {
  public:
    std::string next() {
        std::string name;
        const std::size_t count = 1 + _random() % 5;
        for (std::size_t i = 0; i < count; ++i)
            name += pieces[_random() % pieces.size()];
        return name + std::to_string(_number++); // none twice, and none empty
    }

  private:
    std::mt19937 _random{20};
    int _number = 0;
};

/// Each text of an SVG, letter by letter.
std::vector<std::string> texts_of(const std::string &svg) {
    std::vector<std::string> texts;
    pugi::xml_document picture;
    EXPECT_TRUE(picture.load_string(svg.c_str())) << svg;
    for (const auto &text : picture.select_nodes("//text")) {
        texts.emplace_back(text.node().text().get());
        for (const pugi::xml_node span : text.node().children("tspan"))
            texts.back() += span.text().get();
    }
    return texts;
}

bool contains(const std::vector<std::string> &all, const std::string &wanted) {
    return std::ranges::find(all, wanted) != all.end();
}

/// Cells of a file, quotation marks read as RFC 4180 has them.
std::vector<std::string> cells_of(const std::string &csv) {
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (std::size_t i = 0; i < csv.size(); ++i) {
        if (csv[i] == '"' && quoted && csv.substr(i + 1, 1) == "\"")
            cells.back() += csv[++i];
        else if (csv[i] == '"')
            quoted = !quoted;
        else if (!quoted && (csv[i] == ',' || csv[i] == '\n'))
            cells.emplace_back();
        else
            cells.back() += csv[i];
    }
    return cells;
}

bool has_control(const std::string &text) { return printable(text, true) != text; }

/// Named stations, bearings and a probe over a few speeds.
results::ResponseResult named_response(NastyNames &names) {
    results::ResponseResult result;
    result.speeds = {100, 200, 300};
    const std::vector<double> values{1e-5, 3e-5, 2e-5};
    for (int i = 0; i < 3; ++i) {
        results::ResponseNode node;
        node.name = names.next();
        node.z = 0.5 * i;
        node.amplitude = node.major = node.minor = node.phase = values;
        result.nodes.push_back(node);
    }
    result.bearings.resize(1);
    result.bearings[0].name = names.next();
    result.bearings[0].force = {1, 2, 3};
    result.probes.resize(1);
    result.probes[0].name = names.next();
    result.probes[0].amplitude = result.probes[0].phase = values;
    return result;
}

} // namespace

class NamesTest : public ScratchFolder {};

TEST_F(NamesTest, StandInPicturesPagesAndFilesAsTheyAreWritten) {
    NastyNames names;
    for (int run = 0; run < 12; ++run) {
        model::Case scene = sample_case();
        scene.title = names.next();
        const results::ResponseResult result = named_response(names);
        const Files files = write_report(scene, result, folder);
        if (!files.notes.empty())
            GTEST_SKIP() << "gnuplot is not installed";
        const std::string svg = content_of(folder / "response.svg");
        const std::vector<std::string> texts = texts_of(svg);
        EXPECT_TRUE(std::ranges::none_of(texts, has_control)) << run;
        EXPECT_TRUE(contains(texts, printable("Unbalance response: " + scene.title)))
            << scene.title << fmt::format("\n{}", texts);
        std::vector<std::string> all{result.bearings[0].name, result.probes[0].name};
        for (const results::ResponseNode &node : result.nodes) {
            all.push_back(node.name);
            EXPECT_TRUE(
                contains(texts, printable(node.name) + fmt::format(", z = {:.4g} m", node.z)))
                << node.name << fmt::format("\n{}", texts);
        }
        const nlohmann::json json = nlohmann::json::parse(content_of(folder / "response.json"));
        const std::string text = to_text(describe(scene, result));
        EXPECT_NE(text.find(printable(scene.title) + "\n"), std::string::npos) << text;
        const std::string page = content_of(folder / "report.html");
        EXPECT_NE(page.find("<h1>" + escaped(scene.title) + "</h1>"), std::string::npos);
        const std::vector<std::string> cells = cells_of(content_of(folder / "response.csv"));
        for (const std::string &name : all) {
            const std::string shown = printable(name);
            EXPECT_TRUE(std::ranges::any_of(cells, [&](const std::string &cell) {
                return cell == shown || cell == "'" + shown;
            })) << name;
            EXPECT_TRUE(name == result.bearings[0].name ||
                        page.find(escaped(name)) != std::string::npos)
                << name;
            EXPECT_NE(text.find(shown), std::string::npos) << name;
        }
        for (const std::string &cell : cells) {
            const bool number = cell.find_first_not_of("-+.e0123456789") == std::string::npos;
            EXPECT_TRUE(number || std::string("=+-@").find(cell.front()) == std::string::npos)
                << "a spreadsheet computes " << cell;
        }
    }
}

// gnuplot takes percent signs of tics for formats of numbers.
TEST_F(NamesTest, OfDrawingsAreTheSameInBothFormats) {
    NastyNames names;
    for (int run = 0; run < 12; ++run) {
        const std::string name = names.next();
        Drawing drawing;
        drawing.width = 400;
        drawing.height = 100;
        drawing.texts.push_back({{200, 50}, name});
        EXPECT_TRUE(contains(texts_of(to_svg(drawing)), printable(name))) << name;
        PlotJobs jobs;
        if (!jobs.start(to_figure(drawing), PictureFormat::svg, "a.svg"))
            GTEST_SKIP() << "gnuplot is not installed";
        EXPECT_TRUE(contains(texts_of(jobs.finish().at("a.svg")), printable(name))) << name;
    }
}

TEST(Names, OfCellsAreNoFormulas) {
    EXPECT_EQ(csv_cell("=HYPERLINK(\"http://x\")"), "\"'=HYPERLINK(\"\"http://x\"\")\"");
    EXPECT_EQ(csv_cell("-1"), "\"'-1\"");
    EXPECT_EQ(csv_cell("＠SUM(A1)"), "\"'＠SUM(A1)\"");
    EXPECT_EQ(csv_cell("a;=1"), "\"a;=1\"") << "one cell where semicolons part them";
    EXPECT_EQ(csv_cell("a=1"), "a=1");
    EXPECT_EQ(csv_cell(-1.5), "-1.5") << "a number is one";
}

// The bytes of an escape sequence, of C1 controls, and what is no UTF-8: overlong, a surrogate,
// cut.
TEST(Names, HaveNothingThatATerminalObeys) {
    EXPECT_EQ(printable("a\x1b[31mb\x7f\u009b2J"), "a [31mb  2J");
    EXPECT_EQ(printable("a\nb"), "a b");
    EXPECT_EQ(printable("a\nb\r", true), "a\nb ");
    EXPECT_EQ(printable("\xc0\x80|\xed\xa0\x80|\xe8\xbd"),
              "\ufffd\ufffd|\ufffd\ufffd\ufffd|\ufffd\ufffd");
    EXPECT_EQ(printable("é轴😀\u00a0"), "é轴😀\u00a0");
    EXPECT_EQ(json_text(Json("\x1b\x7f\u0085é")), "\"\\u001b\\u007f\\u0085é\"\n");
}

} // namespace whirl::report

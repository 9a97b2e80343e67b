// The command report from outside: page, checks, PDF, exit statuses.

#include "cases/program_run.h"
#include "support/own_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <unistd.h>

namespace report_command_test {

namespace fs = std::filesystem;
using nlohmann::json;
using whirl::tests::ProgramRun;

std::string case_folder(const std::string &name) {
    return std::string(WHIRL_ROOT) + "/cases/" + name;
}

class ReportCommand : public whirl::tests::InOwnFolder {
  protected:
    [[nodiscard]] ProgramRun run(const std::vector<std::string> &arguments) const {
        return whirl::tests::run_program(WHIRL_PROGRAM, arguments, (folder / "errors").string());
    }
    [[nodiscard]] json result(std::vector<std::string> arguments) const {
        arguments.emplace_back("--json");
        const ProgramRun done = run(arguments);
        EXPECT_EQ(done.status, 0) << done.errors;
        return done.status == 0 ? json::parse(done.output) : json();
    }
};

std::string text_of_file(const fs::path &file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> files_in(const fs::path &folder) {
    std::vector<std::string> names;
    for (const auto &entry : fs::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

/// What a page loads or leads to: attributes that are no places within it.
class OutsideLinks : public pugi::xml_tree_walker {
  public:
    std::vector<std::string> found;
    bool for_each(pugi::xml_node &node) override {
        for (const pugi::xml_attribute &attribute : node.attributes()) {
            const std::string name = attribute.name();
            const std::string value = attribute.value();
            const bool links = name == "src" || name == "href" || name == "xlink:href";
            if (links && !value.starts_with('#') && !value.starts_with("data:"))
                found.push_back(name + "=" + value);
        }
        return true;
    }
};

/// The body as XML: only the head has elements without ends.
pugi::xml_parse_result parse_body(const std::string &page, pugi::xml_document &document) {
    const std::size_t from = page.find("<body>");
    const std::size_t to = page.find("</body>");
    if (from == std::string::npos || to == std::string::npos)
        return {};
    return document.load_string(page.substr(from, to + 7 - from).c_str());
}

TEST_F(ReportCommand, IsOnePageThatLoadsNothing) {
    for (const char *name : {"compressor_margins", "extractor_two_plane", "uniform_shaft_lund"}) {
        const ProgramRun done = run({"report", case_folder(name), "--out", name});
        ASSERT_EQ(done.status, 0) << done.errors;
        EXPECT_EQ(files_in(name),
                  (std::vector<std::string>{"report.csv", "report.html", "report.json"}));
        const std::string page = text_of_file(fs::path(name) / "report.html");
        pugi::xml_document document;
        const pugi::xml_parse_result parsed = parse_body(page, document);
        ASSERT_TRUE(parsed) << name << ": " << parsed.description() << " at " << parsed.offset;
        OutsideLinks links;
        document.traverse(links);
        EXPECT_TRUE(links.found.empty()) << links.found.front();
        EXPECT_EQ(page.find("url("), std::string::npos);
        EXPECT_EQ(page.find("@import"), std::string::npos);
        EXPECT_NE(page.find("class=\"verdict "), std::string::npos);
        EXPECT_NE(page.find("Approved"), std::string::npos);
    }
}

TEST_F(ReportCommand, AnswersInTwentyFiveLinesAndNamesThePage) {
    const ProgramRun done = run({"report", case_folder("compressor_margins")});
    ASSERT_EQ(done.status, 0) << done.errors;
    const auto page = done.output.find("report:  out/compressor_margins/report/report.html");
    ASSERT_NE(page, std::string::npos) << done.output;
    EXPECT_LE(std::count(done.output.begin(), done.output.begin() + static_cast<long>(page), '\n'),
              25)
        << done.output;
}

/// Margins of the checks are those of critical and response, which find the peaks each by itself.
TEST_F(ReportCommand, MarginsAreThoseOfTheOtherCommands) {
    const json report = result({"report", case_folder("compressor_margins")});
    std::vector<double> found;
    for (const json &check : report.at("checks"))
        if (check.at("name") == "separation margin" && check.at("value").is_number())
            found.push_back(check.at("value"));
    std::sort(found.begin(), found.end());
    ASSERT_FALSE(found.empty());
    for (const char *command : {"critical", "response"}) {
        std::vector<double> theirs;
        const json other = result({command, case_folder("compressor_margins")});
        for (const json &margin : other.at("margins"))
            if (margin.at("side") != "inside")
                theirs.push_back(margin.at("found").get<double>() / 100);
        std::sort(theirs.begin(), theirs.end());
        ASSERT_EQ(found.size(), theirs.size()) << command;
        for (std::size_t i = 0; i < found.size(); ++i) // roots, to 1e-10 of the speed
            EXPECT_NEAR(found[i], theirs[i], 1e-8) << command;
    }
}

/// A check passes if and only if its value keeps its limit, and the verdict follows from all.
TEST_F(ReportCommand, VerdictFollowsFromTheChecks) {
    for (const char *name : {"compressor_margins", "id_fan", "extractor_two_plane"}) {
        const json report = result({"report", case_folder(name)});
        bool fails = false;
        bool open = report.at("checks").empty();
        for (const json &check : report.at("checks")) {
            for (const char *key : {"name", "value", "limit", "unit", "pass", "where", "source"})
                EXPECT_TRUE(check.contains(key)) << name << " " << key;
            if (check.at("pass").is_null()) {
                open = true;
                EXPECT_FALSE(check.at("why").is_null()) << check;
                continue;
            }
            fails = fails || !check.at("pass").get<bool>();
            if (check.at("pass").get<bool>() && check.at("limit").is_number()) {
                ASSERT_TRUE(check.at("value").is_number()) << check;
                const double value = check.at("value");
                const double limit = check.at("limit");
                EXPECT_TRUE(check.at("at_least").get<bool>() ? value >= limit : value <= limit)
                    << check;
            }
        }
        EXPECT_EQ(report.at("verdict"), fails ? "fails" : open ? "incomplete" : "passes") << name;
    }
}

TEST_F(ReportCommand, WithoutOperatingSpeedsItIsIncomplete) {
    const json report = result({"report", case_folder("friswell_5_9_1")});
    EXPECT_EQ(report.at("verdict"), "incomplete");
    EXPECT_NE(report.at("verdict_text").get<std::string>().find("[operation]"), std::string::npos)
        << report.at("verdict_text");
}

/// Its units are those asked for, with `[units] json = true` in JSON too.
TEST_F(ReportCommand, JsonIsInSiUnlessAskedOtherwise) {
    const std::vector<std::string> plain{"report", case_folder("id_fan")};
    std::vector<std::string> other = plain;
    other.insert(other.end(), {"--units", "mm-rpm", "--json-units"});
    const json si = result(plain);
    const json mm = result(other);
    ASSERT_EQ(si.at("checks").size(), mm.at("checks").size());
    bool compared = false;
    for (std::size_t i = 0; i < si.at("checks").size(); ++i) {
        const json &a = si.at("checks")[i];
        const json &b = mm.at("checks")[i];
        EXPECT_EQ(a.at("name"), b.at("name"));
        if (a.at("unit") != "m" || !a.at("value").is_number())
            continue;
        ASSERT_NE(b.at("unit"), "m");
        const std::string unit = b.at("unit");
        const double factor = unit.starts_with("mm") ? 1e3 : 1e6;
        EXPECT_NEAR(b.at("value").get<double>() / (a.at("value").get<double>() * factor), 1, 1e-12);
        compared = true;
    }
    EXPECT_TRUE(compared);
}

TEST_F(ReportCommand, BadInputIsStatusTwo) {
    const ProgramRun bad =
        run({"report", case_folder("friswell_5_9_1"), "--set", "bearing[0].k=5 kg"});
    EXPECT_EQ(bad.status, 2);
    EXPECT_NE(bad.errors.find("bearing[0].k"), std::string::npos) << bad.errors;
    EXPECT_TRUE(fs::is_empty("."));
}

/// The hash is that of the files one after another, as sha256sum has it.
TEST_F(ReportCommand, HashIsThatOfTheCaseFiles) {
    const std::string toml = case_folder("hill_rotor") + "/case.toml";
    ASSERT_EQ(run({"report", case_folder("hill_rotor"), "--out", "r"}).status, 0);
    const ProgramRun sum = whirl::tests::run_program("/usr/bin/sha256sum", {toml}, "errors");
    if (sum.status != 0)
        GTEST_SKIP() << "no sha256sum here";
    const std::string page = text_of_file("r/report.html");
    EXPECT_NE(page.find(sum.output.substr(0, 64)), std::string::npos);
}

class WithPath {
  public:
    explicit WithPath(const std::string &path) : _before(std::getenv("PATH")) {
        setenv("PATH", path.c_str(), 1);
    }
    ~WithPath() { setenv("PATH", _before.c_str(), 1); }
    WithPath(const WithPath &) = delete;
    WithPath &operator=(const WithPath &) = delete;
    WithPath(WithPath &&) = delete;
    WithPath &operator=(WithPath &&) = delete;

  private:
    std::string _before;
};

/// The page is written all the same, without a PDF beside it.
TEST_F(ReportCommand, WithoutAPrinterItWritesThePageAndSaysWhatToInstall) {
    fs::create_directory(folder / "empty");
    const WithPath nothing((folder / "empty").string());
    const ProgramRun done = run({"report", case_folder("friswell_5_9_1"), "--pdf", "--out", "r"});
    EXPECT_EQ(done.status, 1);
    EXPECT_NE(done.errors.find("weasyprint"), std::string::npos) << done.errors;
    EXPECT_NE(done.errors.find("the page is there: r/report.html"), std::string::npos)
        << done.errors;
    EXPECT_EQ(std::count(done.errors.begin(), done.errors.end(), '\n'), 1) << done.errors;
    EXPECT_EQ(files_in("r"),
              (std::vector<std::string>{"report.csv", "report.html", "report.json"}));
    EXPECT_NE(text_of_file("r/report.html").find("</html>"), std::string::npos);
    EXPECT_NE(done.output.find("r/report.html"), std::string::npos) << done.output;
}

/// A printer that writes something else costs the PDF, and nothing else.
TEST_F(ReportCommand, ABrokenPrinterCostsThePdfAlone) {
    fs::create_directory(folder / "bin");
    const fs::path fake = folder / "bin" / "weasyprint";
    std::ofstream(fake) << "#!/bin/sh\necho no pdf\n";
    fs::permissions(fake, fs::perms::owner_all);
    const WithPath only((folder / "bin").string());
    const ProgramRun done = run({"report", case_folder("friswell_5_9_1"), "--pdf", "--out", "r"});
    EXPECT_EQ(done.status, 1);
    EXPECT_NE(done.errors.find("weasyprint has not printed"), std::string::npos) << done.errors;
    EXPECT_EQ(files_in("r"),
              (std::vector<std::string>{"report.csv", "report.html", "report.json"}));
}

TEST_F(ReportCommand, WithoutGnuplotThePageSaysSo) {
    fs::create_directory(folder / "empty");
    const WithPath nothing((folder / "empty").string());
    const ProgramRun done = run({"report", case_folder("friswell_5_9_1"), "--out", "r"});
    ASSERT_EQ(done.status, 0) << done.errors;
    EXPECT_NE(done.output.find("gnuplot is not installed"), std::string::npos) << done.output;
    EXPECT_NE(text_of_file("r/report.html").find("gnuplot is not installed"), std::string::npos);
}

TEST_F(ReportCommand, PrintsAPdfWhereThereIsAPrinter) {
    bool there = false;
    for (const char *name :
         {"chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "weasyprint"})
        there = there || fs::exists(fs::path("/usr/bin") / name);
    if (!there)
        GTEST_SKIP() << "neither Chromium nor WeasyPrint is installed";
    const ProgramRun done = run({"report", case_folder("id_fan"), "--pdf", "--out", "r"});
    ASSERT_EQ(done.status, 0) << done.errors;
    EXPECT_EQ(files_in("r"),
              (std::vector<std::string>{"report.csv", "report.html", "report.json", "report.pdf"}));
    EXPECT_TRUE(text_of_file("r/report.pdf").starts_with("%PDF-"));
    // Of another run without one it would be beside a page that it is not of.
    ASSERT_EQ(run({"report", case_folder("id_fan"), "--out", "r"}).status, 0);
    EXPECT_FALSE(fs::exists("r/report.pdf"));
}

} // namespace report_command_test

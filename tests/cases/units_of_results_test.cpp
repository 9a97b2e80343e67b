// Every command of every case in every set of units against the same result in SI: JSON, the data
// of the page, tables in files, sentences and labels. A result is computed once and written in
// each. What a number is comes from docs/schema ("quantity"), sizes of units from the table below.

#include "cli/commands.h"
#include "input/case_file.h"
#include "model/errors.h"
#include "report/report.h"
#include "support/case_names.h"
#include "support/schema.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace cli = whirl::cli;
namespace model = whirl::model;
namespace report = whirl::report;
using nlohmann::json;

constexpr double pi = 3.14159265358979323846;

/// One of a unit in SI. NIST SP 811: inch and pound are exact, a pound-force is a pound times
/// 9.80665 m/s2. Hz counts turns.
const std::map<std::string, double> sizes{{"", 1},
                                          {"m", 1},
                                          {"mm", 1e-3},
                                          {"cm", 1e-2},
                                          {"um", 1e-6},
                                          {"µm", 1e-6},
                                          {"in", 0.0254},
                                          {"mil", 2.54e-5},
                                          {"rad/s", 1},
                                          {"rpm", pi / 30},
                                          {"Hz", 2 * pi},
                                          {"N", 1},
                                          {"kN", 1e3},
                                          {"lbf", 0.45359237 * 9.80665},
                                          {"N/m", 1},
                                          {"N/mm", 1e3},
                                          {"lbf/in", 0.45359237 * 9.80665 / 0.0254},
                                          {"kg", 1},
                                          {"lb", 0.45359237},
                                          {"kg m2", 1},
                                          {"kg m²", 1},
                                          {"kg mm2", 1e-6},
                                          {"lb in2", 0.45359237 * 0.0254 * 0.0254},
                                          {"rad", 1},
                                          {"deg", pi / 180},
                                          {"1/s", 1},
                                          {"s", 1},
                                          {"J", 1},
                                          {"1/kg", 1},
                                          {"kg m2/s", 1},
                                          {"m/s2", 1},
                                          {"N m/rad", 1},
                                          {"N s/m", 1},
                                          {"N m", 1}};

/// Units as they are asked for, and by quantity.
struct Preset {
    std::string name;
    std::vector<std::string> asked;
    std::map<std::string, std::string> units;
    bool peak_to_peak = false;
};
const std::vector<Preset> presets{{"mm-rpm",
                                   {"units.preset=mm-rpm"},
                                   {{"length", "mm"},
                                    {"amplitude", "um"},
                                    {"deflection", "um"},
                                    {"speed", "rpm"},
                                    {"frequency", "Hz"},
                                    {"stiffness", "N/mm"},
                                    {"inertia", "kg mm2"}}},
                                  {"us",
                                   {"units.preset=us", "units.peak_to_peak=true"},
                                   {{"length", "in"},
                                    {"amplitude", "mil"},
                                    {"deflection", "mil"},
                                    {"speed", "rpm"},
                                    {"frequency", "Hz"},
                                    {"force", "lbf"},
                                    {"stiffness", "lbf/in"},
                                    {"mass", "lb"},
                                    {"inertia", "lb in2"}},
                                   true},
                                  {"mixed",
                                   {"units.speed=Hz", "units.frequency=rpm", "units.length=cm",
                                    "units.amplitude=mm", "units.force=kN"},
                                   {{"speed", "Hz"},
                                    {"frequency", "rpm"},
                                    {"length", "cm"},
                                    {"amplitude", "mm"},
                                    {"deflection", "mm"},
                                    {"force", "kN"}}}};
/// Of the data of a page where nothing is asked for.
const Preset readers{"readers",
                     {},
                     {{"speed", "rpm"},
                      {"frequency", "Hz"},
                      {"amplitude", "µm"},
                      {"deflection", "µm"},
                      {"angle", "deg"}}};

/// What a number of a quantity in SI is multiplied by.
double factor_of(const Preset &preset, const std::string &quantity) {
    const auto unit = preset.units.find(quantity);
    const double twice = preset.peak_to_peak && quantity == "amplitude" ? 2 : 1;
    return unit == preset.units.end() ? 1 : twice / sizes.at(unit->second);
}
/// The same of numbers beside a unit: "mil pk-pk".
double factor_of_unit(std::string unit) {
    double twice = 1;
    if (unit.ends_with(" pk-pk")) {
        unit.resize(unit.size() - 6);
        twice = 2;
    }
    return twice / sizes.at(unit);
}

/// The schema of a key, references followed.
const json &resolved(const json &whole, const json &schema) {
    const auto reference = schema.find("$ref");
    if (reference == schema.end())
        return schema;
    return whole.at(json::json_pointer(reference->get<std::string>().substr(1)));
}

/// Compares numbers one by one; each must say in the schema what it is.
class Walk {
  public:
    Walk(const Preset &preset, std::string where)
        : _preset(preset), _where(std::move(where)),
          _whole(whirl::tests::schema_file("result.schema.json")) {}

    void compare(const json &si, const json &other) {
        const json &rules = _whole.at("definitions").at(si.at("command").get<std::string>());
        walk(rules, si, other, "", "");
    }
    int compared = 0, converted = 0;

  private:
    void same(const json &si, const json &other, double factor, const std::string &path) {
        if (!si.is_number()) {
            EXPECT_EQ(si, other) << _where << path;
            return;
        }
        ASSERT_TRUE(other.is_number()) << _where << path;
        const double wanted = si.get<double>() * factor;
        ++compared;
        converted += factor != 1 ? 1 : 0;
        EXPECT_NEAR(other.get<double>(), wanted, 1e-14 * std::abs(wanted)) << _where << path;
    }
    void lists(const json &si, const json &other, double factor, const std::string &path) {
        if (!si.is_array()) {
            same(si, other, factor, path);
            return;
        }
        ASSERT_EQ(si.size(), other.size()) << _where << path;
        for (std::size_t i = 0; i < si.size(); ++i)
            lists(si[i], other[i], factor, path);
    }
    /// Quantities that a row tells: "by unit", "by of", "by path".
    [[nodiscard]] double of_row(const std::string &quantity, const json &row) const {
        if (quantity.starts_with("by of"))
            return factor_of(_preset, row.at("of") == "bearing" ? "force" : "amplitude");
        if (quantity == "by path")
            return factor_of(_preset, row.at("path") == "speed" ? "speed" : "");
        const auto unit = row.value("unit", "");
        const std::string of = unit == "rad/s"   ? "speed"
                               : unit == "m"     ? (_inputs ? "length" : "amplitude")
                               : unit == "N"     ? "force"
                               : unit == "N/m"   ? "stiffness"
                               : unit == "kg"    ? "mass"
                               : unit == "kg m2" ? "inertia"
                                                 : "";
        return factor_of(_preset, of);
    }
    void walk(const json &given, const json &si, const json &other, const std::string &path,
              const std::string &quantity, const json *row = nullptr) {
        const json &schema = resolved(_whole, given);
        const std::string own = schema.value("quantity", quantity);
        if (si.is_object()) {
            const json properties = schema.value("properties", json::object());
            const json *of =
                si.contains("unit") || si.contains("of") || si.contains("path") ? &si : row;
            for (const auto &[key, value] : si.items()) {
                if (key == "seconds" || key == "provenance" || key == "units" || key == "unit")
                    continue;
                ASSERT_TRUE(other.contains(key)) << _where << path << "/" << key;
                ASSERT_TRUE(properties.contains(key)) << _where << path << "/" << key;
                const bool centre = si.value("quantity", json()) == "centre of mass";
                const bool was = std::exchange(_inputs, _inputs || key == "inputs" || centre);
                walk(properties.at(key), value, other.at(key), path + "/" + key, own, of);
                _inputs = was;
            }
            return;
        }
        if (si.is_array() && own.empty()) {
            ASSERT_EQ(si.size(), other.size()) << _where << path;
            const json items = schema.value("items", json::object());
            for (std::size_t i = 0; i < si.size(); ++i)
                walk(items, si[i], other[i], path, own, row);
            return;
        }
        if (si.is_string()) {
            sentence(si, other, path);
            return;
        }
        const bool numbers = si.is_number_float() || (si.is_array() && !own.empty());
        if (numbers) {
            ASSERT_FALSE(own.empty()) << _where << path << ": no quantity in the schema";
            lists(si, other,
                  own.starts_with("by ") && row ? of_row(own, *row) : factor_of(_preset, own),
                  path);
        } else {
            EXPECT_EQ(si, other) << _where << path;
        }
    }
    /// The same words, and each number the other one or it in one of the units.
    void sentence(const std::string &si, const std::string &other, const std::string &path) {
        static const std::regex number(R"((^|[ (+-])([0-9][0-9.]*(e[-+]?[0-9]+)?))");
        std::sregex_iterator a(si.begin(), si.end(), number);
        std::sregex_iterator b(other.begin(), other.end(), number);
        const std::sregex_iterator none;
        for (; a != none && b != none; ++a, ++b) {
            const double x = std::stod((*a)[2]);
            const double y = std::stod((*b)[2]);
            bool found = std::abs(x - y) <= 1e-12 * std::abs(x);
            for (const auto &[quantity, unit] : _preset.units)
                found = found || std::abs(y - x * factor_of(_preset, quantity)) <=
                                     0.06 * std::abs(y); // of one digit that is printed
            EXPECT_TRUE(found) << _where << path << "\n" << si << "\n" << other;
        }
        EXPECT_TRUE(a == none && b == none) << _where << path << "\n" << si << "\n" << other;
    }

    const Preset &_preset;
    std::string _where;
    json _whole;
    bool _inputs = false; ///< lengths are places, no amplitudes
};

std::vector<std::string> cells(const std::string &line) {
    std::vector<std::string> out(1);
    bool quoted = false;
    for (const char letter : line) {
        quoted = letter == '"' ? !quoted : quoted;
        if (letter == ',' && !quoted)
            out.emplace_back();
        else if (letter != '"')
            out.back() += letter;
    }
    return out;
}
struct Heading {
    std::string name, unit;
};
Heading heading_of(std::string cell) {
    Heading out{cell, ""};
    if (const std::size_t at = cell.rfind(" ["); at != std::string::npos && cell.ends_with(']'))
        out = {cell.substr(0, at), cell.substr(at + 2, cell.size() - at - 3)};
    if (out.name.ends_with(" pk-pk")) {
        out.name.resize(out.name.size() - 6);
        out.unit += " pk-pk";
    }
    return out;
}

/// Each column by the unit that its heading names, or the cell of a column `unit`.
void compare_files(const std::string &si, const std::string &other, const std::string &where) {
    std::istringstream a(si);
    std::istringstream b(other);
    std::string line;
    std::string line_b;
    std::getline(a, line);
    std::getline(b, line_b);
    const auto head = cells(line);
    const auto head_b = cells(line_b);
    ASSERT_EQ(head.size(), head_b.size()) << where;
    while (std::getline(a, line)) {
        ASSERT_TRUE(std::getline(b, line_b)) << where;
        const auto row = cells(line);
        const auto row_b = cells(line_b);
        ASSERT_EQ(row.size(), row_b.size()) << where;
        const auto units = std::find(head.begin(), head.end(), "unit");
        const auto place = static_cast<std::size_t>(units - head.begin());
        for (std::size_t i = 0; i < row.size(); ++i) {
            const Heading of = heading_of(head[i]);
            const Heading of_b = heading_of(head_b[i]);
            ASSERT_TRUE(sizes.contains(of.unit)) << where << head[i];
            double factor = factor_of_unit(of_b.unit) * sizes.at(of.unit);
            const bool by_row =
                place < row.size() && (of.name == "closed form" || of.name == "model");
            if (by_row)
                factor = factor_of_unit(row_b[place]) * sizes.at(row[place]);
            char *end = nullptr;
            const double x = std::strtod(row[i].c_str(), &end);
            if (row[i].empty() || *end != '\0' || factor == 1) {
                if (i != place) {
                    EXPECT_EQ(row[i], row_b[i]) << where << head[i];
                }
                continue;
            }
            EXPECT_NEAR(std::strtod(row_b[i].c_str(), nullptr), x * factor,
                        1e-14 * std::abs(x * factor))
                << where << head[i];
        }
    }
    EXPECT_FALSE(std::getline(b, line_b)) << where;
}

/// No label of a picture and no text names a unit that another one was asked for in the place of.
void expect_no_other_units(const std::string &text, const std::string &where) {
    static const std::regex usual(R"(\((rad/s|µm|m|N|N/m|kg)\))");
    std::smatch found;
    EXPECT_FALSE(std::regex_search(text, found, usual)) << where << ": " << found[0];
}

/// What the commands of a case take of it: few speeds and short motions, to be quick.
struct Asked {
    std::string command;
    std::vector<std::string> overrides;
};
const std::vector<Asked> commands{
    {"show", {}},
    {"campbell", {"speeds.count=3"}},
    {"critical", {"speeds.count=3"}},
    {"modes", {"speeds.count=3"}},
    {"response", {"speeds.count=3"}},
    {"stability", {"speeds.count=3"}},
    {"balance", {"speeds.count=3", "balance.balanced_position=false", "balance.simulated=0"}},
    {"rigid-limit", {}},
    {"samples", {"samples.count=2"}}};

json read(const std::string &text) { return json::parse(text); }

/// All that there is of a result, in SI and in all others.
void compare_report(report::Report of, const model::Case &scene, const std::string &where) {
    model::Case in_si = scene;
    in_si.units = {};
    of.scene = &in_si;
    const json si = read(report::to_json(of));
    const std::string csv = of.csv(report::Units::of_files({}));
    {
        Walk walk(readers, where + " (page)");
        walk.compare(si, read(report::to_page_json(of)));
    }
    for (const Preset &preset : presets) {
        model::Case in_others = scene;
        in_others.units = whirl::input::output_units(preset.asked);
        in_others.units.json = true;
        of.scene = &in_others;
        const std::string name = where + " (" + preset.name + ")";
        Walk walk(preset, name);
        walk.compare(si, read(report::to_json(of)));
        EXPECT_GT(walk.converted, 0) << name;
        const report::Units units = report::Units::of_files(in_others.units);
        compare_files(csv, of.csv(units), name);
        if (preset.name != "us")
            continue;
        const report::Units shown = report::Units::of_readers(in_others.units);
        expect_no_other_units(report::to_text(of), name);
        for (const report::Section &section : of.sections(shown))
            expect_no_other_units(section.html, name);
        if (of.figure)
            expect_no_other_units(of.figure(shown).script, name);
        if (of.pictures)
            for (const report::Picture &picture : of.pictures(shown))
                expect_no_other_units(picture.figure.script, name);
    }
}

class UnitsOfResults : public testing::TestWithParam<std::string> {};

TEST_P(UnitsOfResults, AreThoseAskedForInEveryCommand) {
    int reports = 0;
    for (const Asked &asked : commands) {
        cli::Arguments arguments;
        arguments.command = asked.command;
        arguments.scene = std::string(WHIRL_ROOT) + "/cases/" + GetParam();
        arguments.overrides = asked.overrides;
        const std::string where = asked.command + " " + GetParam();
        try {
            const whirl::input::CaseFile file(arguments.scene);
            const model::Case scene = file.load(arguments.overrides);
            const cli::Run run{arguments, file, scene, [&](const report::Report &of) {
                                   ++reports;
                                   compare_report(of, scene, where);
                               }};
            cli::command_named(asked.command)->run(run);
        } catch (const model::Failure &) { // a command that this case has no answer for
        }
    }
    EXPECT_GT(reports, 0);
}

INSTANTIATE_TEST_SUITE_P(Cases, UnitsOfResults, testing::ValuesIn(whirl::tests::case_names()),
                         [](const auto &name) { return name.param; });

} // namespace

// Every command of every case in every set of units against the same result in SI, number by
// number: JSON, the data of the page, tables in files; text, pages and pictures. A result is
// computed once and written in each. What a number is comes from docs/schema ("quantity") or from
// the unit beside it (marked_texts.h), sizes of units from a table of this test (unit_presets.h).

#include "cli/commands.h"
#include "input/case_file.h"
#include "marked_texts.h"
#include "model/errors.h"
#include "report/common/html.h"
#include "report/common/plot_jobs.h"
#include "report/compare/comparison.h"
#include "report/report.h"
#include "support/case_names.h"
#include "support/schema.h"
#include "support/svg_plot.h"
#include "unit_presets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace cli = whirl::cli;
namespace model = whirl::model;
namespace report = whirl::report;
using nlohmann::json;
using whirl::tests::Axis;
using whirl::tests::Compared;
using whirl::tests::MarkedTexts;
using whirl::tests::Panel;
using whirl::tests::PlotPixel;
using whirl::tests::PlottedCurve;
using whirl::tests::Preset;
using whirl::tests::size_of;
using whirl::tests::svg_plot;
using whirl::tests::SvgPlot;

/// The schema of a key, references followed.
const json &resolved(const json &whole, const json &schema) {
    const auto reference = schema.find("$ref");
    if (reference == schema.end())
        return schema;
    return whole.at(json::json_pointer(reference->get<std::string>().substr(1)));
}

/// Compares numbers of JSON one by one; each must say in the schema what it is, or its row by its
/// unit. Strings are compared with those in marked units.
class Walk {
  public:
    Walk(const Preset &preset, MarkedTexts &texts, std::string where)
        : _preset(preset), _texts(texts), _where(std::move(where)),
          _whole(whirl::tests::schema_file("result.schema.json")) {}

    void compare(const json &si, const json &other, const json &marked) {
        const json &rules = _whole.at("definitions").at(si.at("command").get<std::string>());
        walk(rules, {si, other, marked}, "", "", nullptr);
    }
    Compared compared;

  private:
    /// The same part of a result in SI, in other units and in marked ones.
    struct Part {
        const json &si, &other, &marked;
        template <class Key> [[nodiscard]] Part at(const Key &key) const {
            return {si.at(key), other.at(key), marked.at(key)};
        }
    };

    void same(const json &si, const json &other, double factor, const std::string &path) {
        if (!si.is_number()) {
            EXPECT_EQ(si, other) << _where << path;
            return;
        }
        ASSERT_TRUE(other.is_number()) << _where << path;
        const double wanted = si.get<double>() * factor;
        ++compared.numbers;
        compared.converted += factor != 1 ? 1 : 0;
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
    [[nodiscard]] double of_row(const std::string &quantity, const json &marked_row) const {
        if (quantity.starts_with("by of"))
            return _preset.factor(marked_row.at("of") == "bearing" ? "force" : "amplitude");
        if (quantity == "by path")
            return _preset.factor(marked_row.at("path") == "speed" &&
                                          marked_row.at("dimensionless").is_null()
                                      ? "speed"
                                      : "");
        const auto of = MarkedTexts::quantity_in(marked_row.value("unit", ""));
        return of ? _preset.factor(names_of(*of).name) : 1;
    }
    void walk(const json &given, const Part &part, const std::string &path,
              const std::string &quantity, const json *marked_row) {
        static const json nothing = json::object();
        const json &si = part.si;
        const json &either = resolved(_whole, given);
        // Of alternatives that have the same keys any does.
        const json &schema =
            either.contains("anyOf") ? resolved(_whole, either.at("anyOf").front()) : either;
        const std::string own = schema.value("quantity", quantity);
        if (si.is_object()) {
            const json &properties =
                schema.contains("properties") ? schema.at("properties") : nothing;
            const json *of = si.contains("unit") || si.contains("of") || si.contains("path")
                                 ? &part.marked
                                 : marked_row;
            for (const auto &[key, value] : si.items()) {
                if (key == "seconds" || key == "provenance" || key == "units")
                    continue;
                ASSERT_TRUE(part.other.contains(key)) << _where << path << "/" << key;
                ASSERT_TRUE(properties.contains(key)) << _where << path << "/" << key;
                walk(properties.at(key), part.at(key), path + "/" + key, own, of);
            }
            return;
        }
        if (si.is_array() && own.empty()) {
            ASSERT_EQ(si.size(), part.other.size()) << _where << path;
            const json &items = schema.contains("items") ? schema.at("items") : nothing;
            for (std::size_t i = 0; i < si.size(); ++i)
                walk(items, part.at(i), path, own, marked_row);
            return;
        }
        if (si.is_string()) {
            ASSERT_TRUE(part.other.is_string()) << _where << path;
            _texts.compare(part.marked.get<std::string>(), part.other.get<std::string>());
            return;
        }
        const bool numbers = si.is_number_float() || (si.is_array() && !own.empty());
        if (numbers) {
            ASSERT_FALSE(own.empty()) << _where << path << ": no quantity in the schema";
            lists(si, part.other,
                  own.starts_with("by ") && marked_row ? of_row(own, *marked_row)
                                                       : _preset.factor(own),
                  path);
        } else {
            EXPECT_EQ(si, part.other) << _where << path;
        }
    }

    const Preset &_preset;
    MarkedTexts &_texts;
    std::string _where;
    json _whole;
};

/// One of a unit in a heading: "mil pk-pk".
double factor_of_unit(std::string unit) {
    double twice = 1;
    if (unit.ends_with(" pk-pk")) {
        unit.resize(unit.size() - 6);
        twice = 2;
    }
    return twice / size_of(unit);
}

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
void compare_files(const std::string &si, const std::string &other, const std::string &marked,
                   MarkedTexts &texts, const std::string &where, Compared &compared) {
    std::istringstream a(si);
    std::istringstream b(other);
    std::istringstream m(marked);
    std::string line_m;
    std::getline(m, line_m);
    std::string line;
    std::string line_b;
    std::getline(a, line);
    std::getline(b, line_b);
    // Columns whose rows say in which unit they are.
    static const std::set<std::string> of_unit{"closed form", "model",      "first_value",
                                               "other_value", "difference", "error"};
    const auto head = cells(line);
    const auto head_b = cells(line_b);
    ASSERT_EQ(head.size(), head_b.size()) << where;
    const auto units = std::find(head.begin(), head.end(), "unit");
    const auto place = static_cast<std::size_t>(units - head.begin());
    std::vector<double> factors;
    std::vector<bool> by_row;
    for (std::size_t i = 0; i < head.size(); ++i) {
        const Heading of = heading_of(head[i]);
        factors.push_back(factor_of_unit(heading_of(head_b[i]).unit) * size_of(of.unit));
        by_row.push_back(place < head.size() && of_unit.contains(of.name));
    }
    while (std::getline(a, line)) {
        ASSERT_TRUE(std::getline(b, line_b) && std::getline(m, line_m)) << where;
        const auto row = cells(line);
        const auto row_b = cells(line_b);
        ASSERT_EQ(row.size(), row_b.size()) << where;
        for (std::size_t i = 0; i < row.size(); ++i) {
            const double factor =
                by_row[i] ? factor_of_unit(row_b[place]) * size_of(row[place]) : factors[i];
            char *end = nullptr;
            const double x = std::strtod(row[i].c_str(), &end);
            const bool number = !row[i].empty() && *end == '\0';
            compared.numbers += number ? 1 : 0;
            compared.converted += number && factor != 1 ? 1 : 0;
            if (!number || factor == 1) {
                if (row[i] != row_b[i])
                    texts.compare(cells(line_m).at(i), row_b[i]);
                continue;
            }
            const double y = std::strtod(row_b[i].c_str(), nullptr);
            if (!(std::abs(y - x * factor) <= 1e-14 * std::abs(x * factor)))
                ADD_FAILURE() << where << head[i] << row[i] << row_b[i];
        }
    }
    EXPECT_FALSE(std::getline(b, line_b)) << where;
}

/// All that was compared, by kind.
struct Totals {
    std::map<std::string, Compared> of;
    int labels = 0, labels_without_match = 0, pictures = 0, panels = 0, unreadable = 0, unnamed = 0;
    double farthest = 0; ///< of a point from its curve in the other picture, pixels
};
Totals totals;

/// The distance of a point from the lines of a curve.
double distance(const PlotPixel &at, const PlottedCurve &curve) {
    double least = HUGE_VAL;
    for (const auto &line : curve.lines)
        for (std::size_t i = 0; i < line.size(); ++i) {
            const PlotPixel &a = line[i];
            const PlotPixel &b = line[std::min(i + 1, line.size() - 1)];
            const double dx = b.x - a.x;
            const double dy = b.y - a.y;
            const double square = dx * dx + dy * dy;
            const double along =
                square > 0 ? std::clamp(((at.x - a.x) * dx + (at.y - a.y) * dy) / square, 0.0, 1.0)
                           : 0;
            least = std::min(least, std::hypot(at.x - a.x - along * dx, at.y - a.y - along * dy));
        }
    return least;
}

/// A place on an axis in marked units, on the same axis in others.
double moved(const Axis &from, const Axis &to, double pixel, const MarkedTexts &texts) {
    const auto of = MarkedTexts::quantity_in(from.name);
    const double ratio = of ? texts.ratio(*of) : 1;
    const double value = from.value(pixel);
    return to.pixel(from.logarithmic ? value + std::log10(ratio) : value * ratio);
}

/// The rings of a polar plot are round numbers in every unit.
bool rings(const std::string &where, const PlottedCurve &curve) {
    return where.ends_with("response_polar") && curve.name == "gnuplot_plot_1a";
}

void compare_panels(const Panel &marked, const Panel &other, const MarkedTexts &texts,
                    const std::string &where) {
    ++totals.panels;
    const auto named = [](const Panel &panel) {
        return std::pair(panel.x.name.empty(), panel.y.name.empty());
    };
    if (named(marked) != named(other)) { // gnuplot leaves out one that has no room
        ++totals.unnamed;
        return;
    }
    EXPECT_EQ(texts.words(marked.x.name), other.x.name) << where;
    EXPECT_EQ(texts.words(marked.y.name), other.y.name) << where;
    ASSERT_EQ(marked.curves.size(), other.curves.size()) << where;
    if (!marked.x.readable() || !marked.y.readable() || !other.x.readable() ||
        !other.y.readable() || marked.x.logarithmic != other.x.logarithmic ||
        marked.y.logarithmic != other.y.logarithmic) {
        ++totals.unreadable;
        return;
    }
    // Coordinates have two decimals, and so have the places of the two numbers of each axis that a
    // value is read by.
    constexpr double resolution = 0.05;
    for (std::size_t k = 0; k < marked.curves.size(); ++k) {
        double worst = 0;
        PlotPixel worst_at{};
        for (const auto &line : marked.curves[k].lines)
            for (const PlotPixel &at : line) {
                if (!marked.holds(at) || marked.curves[k].in_legend(line) ||
                    rings(where, marked.curves[k]))
                    continue;
                const PlotPixel there{moved(marked.x, other.x, at.x, texts),
                                      moved(marked.y, other.y, at.y, texts)};
                if (!other.holds(there)) // cut off where the axis ends
                    continue;
                const double off = distance(there, other.curves[k]);
                totals.farthest = std::max(totals.farthest, off);
                Compared &compared = totals.of["points of curves"];
                compared.numbers += 2;
                compared.converted += 2;
                if (off > worst) {
                    worst = off;
                    worst_at = at;
                }
            }
        EXPECT_LE(worst, resolution) << where << ", " << marked.curves[k].name << " at "
                                     << worst_at.x << ", " << worst_at.y << " of " << marked.y.name;
    }
}

void compare_pictures(const std::string &marked, const std::string &other, MarkedTexts &texts,
                      const std::string &where) {
    const SvgPlot a = svg_plot(marked);
    const SvgPlot b = svg_plot(other);
    ++totals.pictures;
    std::vector<model::Quantity> axes;
    for (const Panel &panel : a.panels)
        for (const Axis *axis : {&panel.x, &panel.y})
            if (const auto of = MarkedTexts::quantity_in(axis->name))
                axes.push_back(*of);
    texts.compare_labels(a.texts, b.texts, axes);
    ASSERT_EQ(a.panels.size(), b.panels.size()) << where;
    for (std::size_t i = 0; i < a.panels.size(); ++i)
        compare_panels(a.panels[i], b.panels[i], texts, where);
}

void expect_scaled(const json &si, const json &other, double factor, const std::string &where) {
    ASSERT_EQ(si.size(), other.size()) << where;
    if (si.is_number_float()) {
        const double wanted = si.get<double>() * factor;
        EXPECT_NEAR(other.get<double>(), wanted, 1e-14 * std::abs(wanted)) << where;
        totals.of["page data"] += {1, factor != 1 ? 1 : 0, 0};
    } else if (si.is_structured()) {
        for (const auto &[key, value] : si.items())
            expect_scaled(value, si.is_array() ? other.at(std::stoul(key)) : other.at(key), factor,
                          where);
    } else {
        EXPECT_EQ(si, other) << where;
    }
}

/// What the commands of a case take of it: few speeds and short motions, to be quick.
struct Asked {
    std::string command;
    std::vector<std::string> overrides;
    std::vector<std::string> cases{}; ///< dear commands: these alone
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
    {"weights", {}},
    {"samples", {"samples.count=2"}},
    {"sweep", {}},
    {"simulate", {"speeds.count=1"}, {"runup_jeffcott", "rodrigues_two_plane"}},
    {"simulate",
     {"simulate.sweep.count=2", "simulate.sweep.hold=1", "simulate.starts.count=3"},
     {"sweep_two_balls"}},
    {"accuracy", {}, {"friswell_5_9_1"}}};

json read(const std::string &text) { return json::parse(text); }

/// What a report says and draws in the units of a case.
struct Written {
    Written(report::Report of, const model::Case &scene, const model::OutputUnits &asked)
        : in_units(scene), units(report::Units::of_readers(asked)) {
        in_units.units = asked;
        of.scene = &in_units;
        page = read(report::to_page_json(of));
        text = report::to_text(of, {10, true, 0}); // all there is
        for (const report::Section &section : of.sections(units))
            html += "<h2>" + section.heading + "</h2>" + section.html;
        in_units.units.json = true;
        json_in = read(report::to_json(of));
        csv = of.csv(report::Units::of_files(asked));
        if (of.pictures)
            for (const report::Picture &picture : of.pictures(units))
                if (picture.csv)
                    more_csv.push_back(picture.csv(report::Units::of_files(asked)));
    }
    model::Case in_units;
    report::Units units;
    json page, json_in;
    std::string text, html, csv;
    std::vector<std::string> more_csv;
};

std::vector<report::Picture> pictures_of(const report::Report &of, const report::Units &units) {
    std::vector<report::Picture> pictures;
    if (of.chart)
        pictures.push_back({of.command, of.chart(units)});
    if (of.pictures)
        for (const report::Picture &picture : of.pictures(units))
            pictures.push_back(picture);
    return pictures;
}

/// The drawing of the rotor: its labels, and the numbers of its axis, which stand where they did.
void compare_shafts(const report::Drawing &marked, const report::Drawing &other, MarkedTexts &texts,
                    const std::string &where) {
    std::vector<std::string> labels[2];
    std::vector<whirl::tests::Tick> ticks[2];
    for (const std::size_t k : {0U, 1U})
        for (const report::DrawText &text : (k == 0 ? marked : other).texts) {
            const auto numbers = whirl::tests::numbers_of(text.text);
            if (numbers.size() == 1 && numbers[0].begin == 0 && numbers[0].end == text.text.size())
                ticks[k].push_back({text.at.x, numbers[0].value});
            else
                labels[k].push_back(text.text);
        }
    texts.compare_labels(labels[0], labels[1]);
    ASSERT_GE(ticks[0].size(), 2U) << where;
    ASSERT_GE(ticks[1].size(), 2U) << where;
    const Axis axis{"", ticks[0], false};
    for (const auto &tick : ticks[1]) {
        const double wanted = axis.value(tick.pixel) * texts.ratio(model::Quantity::length);
        EXPECT_NEAR(tick.value, wanted, 1e-5 * std::abs(ticks[1].back().value)) << where;
        texts.compared += {1, texts.ratio(model::Quantity::length) != 1 ? 1 : 0, 0};
    }
}

/// The pictures of a report in marked units beside those in a preset.
void compare_drawings(report::Report of, const Written &marked, const Written &other,
                      const Preset &preset, const std::string &where) {
    MarkedTexts texts(other.units, preset.peak_to_peak, where);
    of.scene = &marked.in_units;
    const std::vector<report::Picture> a = pictures_of(of, marked.units);
    std::vector<report::Drawing> drawn;
    if (of.drawing)
        drawn.push_back(of.drawing(marked.units));
    of.scene = &other.in_units;
    const std::vector<report::Picture> b = pictures_of(of, other.units);
    if (of.drawing)
        drawn.push_back(of.drawing(other.units));
    ASSERT_EQ(a.size(), b.size()) << where;
    report::PlotJobs jobs;
    bool installed = true;
    const auto start = [&](const report::Chart &chart, const Written &in, const std::string &name) {
        installed = installed && jobs.start(report::chart_figure(chart, in.in_units, in.units),
                                            report::PictureFormat::svg, name);
    };
    for (std::size_t i = 0; i < a.size(); ++i) {
        start(a[i].chart, marked, std::to_string(i) + "a");
        start(b[i].chart, other, std::to_string(i) + "b");
    }
    const auto svgs = jobs.finish();
    for (std::size_t i = 0; i < a.size() && installed; ++i)
        compare_pictures(svgs.at(std::to_string(i) + "a"), svgs.at(std::to_string(i) + "b"), texts,
                         where + ", picture " + a[i].name);
    if (!drawn.empty())
        compare_shafts(drawn[0], drawn[1], texts, where);
    totals.of["labels of pictures"] += texts.compared;
    totals.labels += texts.labels;
    totals.labels_without_match += texts.labels_without_match;
    if (!texts.unmatched.empty() && std::getenv("WHIRL_SHOW_LABELS") != nullptr)
        std::cout << where << "\n" << texts.unmatched;
}

/// All that there is of a result, in SI and in all others.
void compare_report(const report::Report &of, const model::Case &scene, const std::string &where) {
    static std::size_t counted = 0;
    const Written si(of, scene, {});
    const Written marked(of, scene, whirl::tests::marked_units());
    const auto compare_json = [&](const Preset &preset, const json &other, const json &in_marked,
                                  const report::Units &units, const char *kind) {
        MarkedTexts texts(units, preset.peak_to_peak, where + " (" + preset.name + ")");
        Walk walk(preset, texts, where + " (" + preset.name + ", " + kind + ")");
        walk.compare(si.json_in, other, in_marked);
        totals.of[kind] += walk.compared;
        totals.of["sentences of JSON"] += texts.compared;
        if (preset.name != "si")
            EXPECT_GT(walk.compared.converted, 0) << where << kind;
    };
    const std::size_t drawn = 1 + counted++ % (whirl::tests::presets().size() - 1);
    for (const Preset &preset : whirl::tests::presets()) {
        const std::string name = where + " (" + preset.name + ")";
        const Written other(of, scene, whirl::input::output_units(preset.asked));
        compare_json(preset, other.json_in, marked.json_in,
                     report::Units::of_files(other.in_units.units), "JSON");
        Preset on_page = preset;
        on_page.units["angle"] = "deg";
        compare_json(on_page, other.page, marked.page, other.units, "page data");
        if (si.page.contains("drawn")) {
            Written plain(of, scene, whirl::input::output_units({"units.preset=si"}));
            expect_scaled(plain.page.at("drawn").at("rotor"), other.page.at("drawn").at("rotor"),
                          preset.factor("length"), name);
        }
        const report::Units files = report::Units::of_files(other.in_units.units);
        MarkedTexts cells_of_files(files, preset.peak_to_peak, name + ", CSV");
        compare_files(si.csv, other.csv, marked.csv, cells_of_files, name, totals.of["CSV"]);
        for (std::size_t i = 0; i < si.more_csv.size(); ++i)
            compare_files(si.more_csv[i], other.more_csv[i], marked.more_csv[i], cells_of_files,
                          name, totals.of["CSV"]);
        MarkedTexts terminal(other.units, preset.peak_to_peak, name + ", text");
        terminal.compare_terminal(marked.text, other.text);
        totals.of["text"] += terminal.compared;
        MarkedTexts html(other.units, preset.peak_to_peak, name + ", page");
        html.compare_html(marked.html, other.html);
        totals.of["tables of pages"] += html.compared;
        if (&preset == &whirl::tests::presets()[drawn])
            compare_drawings(of, marked, other, preset, name);
    }
}

/// All numbers a hundredth larger: something to compare a result with.
report::Json enlarged(report::Json value) {
    if (value.is_number_float())
        return value.get<double>() * 1.01;
    if (value.is_structured())
        for (auto &item : value)
            item = enlarged(item);
    return value;
}

/// The result beside a larger one, in all units.
void compare_comparison(report::Report of, const model::Case &scene, const std::string &where) {
    if (of.command != "critical" && of.command != "response" && of.command != "show" &&
        of.command != "campbell")
        return;
    of.scene = &scene;
    const auto result = report::Json::parse(report::to_si_json(of));
    std::vector<report::ComparedResult> results;
    results.push_back({"one.json", result});
    results.push_back({"two.json", enlarged(result)});
    const report::Comparison both = report::compare(std::move(results));
    const auto written = [&](const report::Units &units) {
        return read(report::json_text(report::comparison_json(both, units)));
    };
    const model::OutputUnits marks = whirl::tests::marked_units();
    const std::string name = "compare " + where;
    for (const Preset &preset : whirl::tests::presets()) {
        const model::OutputUnits asked = whirl::input::output_units(preset.asked);
        const report::Units files = report::Units::of_files(asked);
        const report::Units readers = report::Units::of_readers(asked);
        MarkedTexts texts(files, preset.peak_to_peak, name + " (" + preset.name + ")");
        Walk walk(preset, texts, name + " (" + preset.name + ")");
        walk.compare(written({}), written(files), written(report::Units::of_files(marks)));
        totals.of["compare: JSON"] += walk.compared;
        MarkedTexts terminal(readers, preset.peak_to_peak, name + " (" + preset.name + "), text");
        terminal.compare_terminal(report::comparison_text(both, report::Units::of_readers(marks)),
                                  report::comparison_text(both, readers));
        totals.of["compare: text"] += terminal.compared;
    }
}

class UnitsOfResults : public testing::TestWithParam<std::string> {
  protected:
    static void TearDownTestSuite() {
        // Labels for which there was room in one picture alone, axes with less than two numbers.
        EXPECT_LE(totals.labels_without_match, 5 + totals.labels / 50);
        EXPECT_LE(totals.unreadable + totals.unnamed, 5 + totals.panels / 10);
        for (const auto &[kind, compared] : totals.of)
            std::cout << kind << ": " << compared.numbers << " numbers compared, "
                      << compared.converted << " in another unit than SI, " << compared.rough
                      << " to fewer digits\n";
        std::cout << totals.pictures << " pictures, " << totals.panels << " panels ("
                  << totals.unreadable << " without two numbers on each axis, " << totals.unnamed
                  << " without the name of one), farthest point " << totals.farthest
                  << " pixels off; " << totals.labels << " labels, " << totals.labels_without_match
                  << " of them in one picture alone\n";
    }
};

TEST_P(UnitsOfResults, AreThoseAskedForInEveryCommand) {
    int reports = 0;
    for (const Asked &asked : commands) {
        if (!asked.cases.empty() && std::ranges::find(asked.cases, GetParam()) == asked.cases.end())
            continue;
        cli::Arguments arguments;
        arguments.command = asked.command;
        arguments.scene = std::string(WHIRL_ROOT) + "/cases/" + GetParam();
        arguments.overrides = asked.overrides;
        const std::string where = asked.command + " " + GetParam();
        try {
            const whirl::input::CaseFile file(arguments.scene);
            const model::Case scene = file.load(arguments.overrides);
            cli::refuse_without_shaft(scene, arguments);
            const cli::Run run{arguments, file, scene, [&](const report::Report &of) {
                                   ++reports;
                                   compare_report(of, scene, where);
                                   compare_comparison(of, scene, where);
                               }};
            cli::command_named(asked.command)->run(run);
        } catch (const model::Failure &failure) {
            // A command that this case has no answer for.
            EXPECT_TRUE(asked.cases.empty()) << where << failure.what();
        }
    }
    EXPECT_GT(reports, 0);
}

INSTANTIATE_TEST_SUITE_P(Cases, UnitsOfResults, testing::ValuesIn(whirl::tests::case_names()),
                         [](const auto &name) { return name.param; });

} // namespace

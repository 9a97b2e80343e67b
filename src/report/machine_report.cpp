// Report of the command report: all analyses of a case.

#include "results/machine_report.h"

#include "report/common/checks.h"
#include "report/common/json.h"
#include "report/common/text_width.h"
#include "report/common/words.h"
#include "report/pictures/figures.h"
#include "report/reports.h"
#include "results/response.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace whirl::report {

using results::MachineReport;

namespace {

/// Pictures of an analysis beside its main one: more belong to its own page.
constexpr std::size_t most_pictures = 5;

/// Lines of checks on the terminal, so that verdict, checks and what is around them take 25.
constexpr std::size_t most_checks = 16;

/// An analysis as part of the report.
struct Of {
    const char *command;
    const char *heading;
    std::optional<Report> report{};
    model::Sentence why{};
    bool failed = false;
};

template <class Result>
Of part_of(const char *command, const char *heading, const model::Case &scene,
           const results::Part<Result> &part) {
    Of of{command, heading};
    if (part.result)
        of.report = describe(scene, *part.result);
    of.why = part.why;
    of.failed = part.failed;
    return of;
}

/// In the order of the chapters: what decides first.
std::vector<Of> all_parts(const model::Case &scene, const MachineReport &result) {
    std::vector<Of> parts;
    parts.push_back(part_of("response", "Unbalance response", scene, result.response));
    parts.push_back(part_of("critical", "Critical speeds", scene, result.critical));
    parts.push_back(part_of("campbell", "Campbell diagram", scene, result.campbell));
    parts.push_back(part_of("stability", "Stability", scene, result.stability));
    parts.push_back(part_of("modes", "Mode shapes", scene, result.modes));
    parts.push_back(part_of("balance", "Auto-balancing", scene, result.balance));
    parts.push_back(part_of("show", "The rotor", scene, result.show));
    return parts;
}

/// Notes that no earlier chapter has.
std::vector<model::Sentence> new_notes(const std::vector<model::Sentence> &notes,
                                       std::vector<model::Sentence> &said) {
    std::vector<model::Sentence> fresh;
    for (const model::Sentence &note : notes)
        if (std::find(said.begin(), said.end(), note) == said.end()) {
            said.push_back(note);
            fresh.push_back(note);
        }
    return fresh;
}

Chapter chapter_of(const Of &part, const Units &units, std::vector<model::Sentence> &said) {
    if (!part.report)
        return {.command = part.command,
                .heading = part.heading,
                .answer = model::Sentence("not computed: {}", part.why),
                .answered = false};
    const Report &report = *part.report;
    Chapter chapter{.command = report.command, .heading = part.heading, .answer = report.answer};
    if (report.chart)
        chapter.pictures.push_back({report.command, report.chart(units), {}});
    if (report.pictures)
        for (Picture &picture : report.pictures(units))
            if (chapter.pictures.size() <= most_pictures)
                chapter.pictures.push_back(std::move(picture));
    if (report.brief)
        chapter.tables = report.brief(units);
    chapter.notes = new_notes(report.model->notes, said);
    return chapter;
}

/// What the machine does at the speed at which it runs as a rule, else at its maximum continuous
/// speed: the largest of the readings of probes, of the velocities of pedestals and of the forces
/// of bearings. Empty where that is not known.
model::Sentence running_sentence(const MachineReport &result) {
    namespace as = model::as;
    if (!result.response.result || !result.response.result->operating)
        return {};
    const auto &rows = result.response.result->operating->rows;
    const auto at = [&rows](const char *speed) {
        return std::ranges::find_if(
            rows, [speed](const auto &row) { return row.at.find(speed) != std::string::npos; });
    };
    const auto chosen = at("normal") != rows.end() ? at("normal") : at("maximum");
    if (chosen == rows.end())
        return {};
    model::Sentence said;
    // Values that have no limit or are not known have a chapter of their own to say so.
    const auto add = [&](const char *of, const char *does, auto value,
                         const model::ValueOf &as_value, const char *behind) {
        const results::OperatingRow *largest = nullptr;
        for (const results::OperatingRow &row : rows)
            if (row.speed == chosen->speed && row.of == of && std::isfinite(value(row)) &&
                (!largest || value(row) > value(*largest)))
                largest = &row;
        if (!largest)
            return;
        said += model::Sentence("{}{} {} {}{}", said.empty() ? ": " : ", ",
                                results::place_in_words(of, largest->name, largest->z, 4), does,
                                as_value(value(*largest), 4), behind);
    };
    add(
        "probe", "reads", [](const auto &row) { return row.amplitude; }, as::amplitude, "");
    add(
        "pedestal", "moves at", [](const auto &row) { return row.velocity / std::numbers::sqrt2; },
        as::velocity, " rms");
    add(
        "bearing", "carries", [](const auto &row) { return row.force.value_or(NAN); }, as::force,
        "");
    return said.empty()
               ? said
               : model::Sentence("At {} ({} speed){}", as::speed(chosen->speed), chosen->at, said);
}

Document document_of(const model::Case &scene, const MachineReport &result, const Units &units) {
    Document document{.verdict = results::judgement_name(result.assessment.verdict),
                      .sentence = result.assessment.sentence,
                      .running = running_sentence(result),
                      .drawing = scene_drawing(scene, units),
                      .checks = checks_page(result.assessment.checks, units),
                      .chapters = {},
                      .left_out = {}};
    std::vector<model::Sentence> said;
    for (const Of &part : all_parts(scene, result))
        if (part.report || part.failed)
            document.chapters.push_back(chapter_of(part, units, said));
        else
            document.left_out.emplace_back("{}: {}", part.heading, part.why);
    return document;
}

Json sections_json(const model::Case &scene, const MachineReport &result, const Units &units) {
    return json_list(all_parts(scene, result), [&units](const Of &part) {
        const bool there = part.report.has_value();
        return Json{{"command", part.command},
                    {"heading", part.heading},
                    {"answer", there ? Json(units.text(part.report->answer)) : Json()},
                    {"why", there ? Json() : Json(units.text(part.why))},
                    {"failed", part.failed},
                    {"notes", there ? written(units, part.report->model->notes) : Json::array()}};
    });
}

Json json_of(const model::Case &scene, const MachineReport &result, const Units &units) {
    const results::Assessment &assessment = result.assessment;
    return {{"verdict", results::judgement_name(assessment.verdict)},
            {"verdict_text", units.text(assessment.sentence)},
            {"running", units.text(running_sentence(result))},
            {"checks", checks_json(assessment.checks, units)},
            {"sections", sections_json(scene, result, units)}};
}

std::string text_of(const model::Case &scene, const MachineReport &result, const Units &units) {
    const std::string verdict = capitalized(results::judgement_name(result.assessment.verdict));
    const model::Sentence running = running_sentence(result);
    std::string text = fmt::format("{}\n{}: {}\n{}\n", title_of(scene), verdict,
                                   printable(units.text(result.assessment.sentence)),
                                   running.empty() ? "" : printable(units.text(running)) + "\n") +
                       checks_text(result.assessment.checks, most_checks, units);
    std::string failed;
    for (const Of &part : all_parts(scene, result))
        if (part.failed)
            failed += fmt::format("note: {} not computed: {}\n", part.command,
                                  printable(units.text(part.why)));
    return text + (failed.empty() ? "" : "\n" + failed) + "\n";
}

} // namespace

Report describe(const model::Case &scene, const MachineReport &result) {
    return {.command = "report",
            .heading = "Report",
            .scene = &scene,
            .model = &result.model,
            .json = [&](const Units &units) { return json_of(scene, result, units); },
            .csv = [&](const Units &units) { return checks_csv(result.assessment.checks, units); },
            .text = [&](const Units &units) { return text_of(scene, result, units); },
            .document = [&](const Units &units) { return document_of(scene, result, units); }};
}

} // namespace whirl::report

// What every result begins with in JSON.

#include "report/common/json.h"
#include "report/common/units.h"
#include "report/report.h"
#include "results/model_summary.h"

namespace whirl::report {

std::string program_version() { return WHIRL_VERSION; }

namespace {

Json whole_json(const Report &report, const Units &units) {
    const results::ModelSummary &model = *report.model;
    Json json{
        {"program", "whirl"},
        {"version", program_version()},
        {"format", 1},
        {"command", report.command},
        {"case", report.scene->name},
        {"title", report.scene->title},
        {"formulation", model.formulation},
        {"order", model.order},
        {"elements", model.elements},
        {"unknowns_count", model.unknowns},
        {"seconds", model.seconds},
        {"notes", json_list(model.notes, [&units](const auto &note) { return units.text(note); })}};
    if (const auto &operation = report.scene->operation)
        json["operation"] = {
            {"from", operation->from}, {"to", operation->to}, {"trip", operation->trip}};
    json["provenance"] = {{"version", program_version()},
                          {"date", report.provenance.date},
                          {"case", report.provenance.case_text}};
    take_entries(json, report.json(units));
    return json;
}

} // namespace

std::string to_json(const Report &report) {
    Json json = whole_json(report, {});
    if (written_units().given() && written_units().json)
        convert_json(json);
    return json_text(json);
}

std::string to_si_json(const Report &report) { return json_text(whole_json(report, {})); }

std::string to_text(const Report &report) {
    return in_written_units(report.text(Units::of_readers(report.scene->units)));
}

} // namespace whirl::report

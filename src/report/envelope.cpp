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
    Json json{{"program", "whirl"},
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
              {"notes", written(units, model.notes)}};
    if (const auto &operation = report.scene->operation)
        json["operation"] = {{"from", written(units, Quantity::speed, operation->from)},
                             {"to", written(units, Quantity::speed, operation->to)},
                             {"normal", written(units, Quantity::speed, operation->normal)},
                             {"trip", written(units, Quantity::speed, operation->trip)}};
    json["provenance"] = {{"version", program_version()},
                          {"date", report.provenance.date},
                          {"case", report.provenance.case_text}};
    take_entries(json, report.json(units));
    return json;
}

} // namespace

std::string to_json(const Report &report) {
    const Units units = Units::of_json(report.scene->units);
    Json json = whole_json(report, units);
    if (units.asked())
        json["units"] = unit_names(units);
    return json_text(json);
}

std::string to_page_json(const Report &report) {
    const Units units = Units::of_readers(report.scene->units);
    Json json = whole_json(report, units);
    json["units"] = unit_names(units);
    if (report.drawn)
        json["drawn"] = report.drawn(units);
    return json_text(json);
}

std::string to_si_json(const Report &report) { return json_text(whole_json(report, {})); }

std::string to_text(const Report &report) {
    return report.text(Units::of_readers(report.scene->units));
}

} // namespace whirl::report

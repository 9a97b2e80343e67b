// What every result begins with in JSON.

#include "report/common/fitted_text.h"
#include "report/common/json.h"
#include "report/common/units.h"
#include "report/common/words.h"
#include "report/report.h"
#include "results/model_summary.h"

namespace whirl::report {

std::string program_version() { return WHIRL_VERSION; }

namespace {

/// Of readings alone there is no form, only why.
Json formulation_json(const results::ModelSummary &model) {
    if (!model.none)
        return model.formulation;
    return {{"frame", nullptr},
            {"unknowns", nullptr},
            {"form", nullptr},
            {"why", model.formulation.why}};
}

Json whole_json(const Report &report, const Units &units) {
    const results::ModelSummary &model = *report.model;
    Json json{{"program", "whirl"},
              {"version", program_version()},
              {"format", 1},
              {"command", report.command},
              {"case", report.scene->name},
              {"title", report.scene->title},
              {"formulation", formulation_json(model)},
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
                          {"case", report.provenance.case_text},
                          {"set", report.provenance.set}};
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
    if (report.chart)
        json["chart"] = chart_json(report.chart(units));
    if (report.drawn)
        json["drawn"] = report.drawn(units);
    return json_text(json);
}

std::string to_si_json(const Report &report) { return json_text(whole_json(report, {})); }

std::string to_text(const Report &report, const TextStyle &style, const std::string &last) {
    const Units units = Units::of_readers(report.scene->units).styled(style);
    return fitted_text(report.text(units), note_lines(report.model->notes, units), last,
                       style.lines);
}

} // namespace whirl::report

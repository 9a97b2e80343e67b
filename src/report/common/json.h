#pragma once

// How the types of results become JSON; only for sources in report.

#include "results/balance.h"
#include "results/formulation.h"
#include "results/whirl.h"

#include <nlohmann/json.hpp>

#include <optional>

/// null for what is missing. The library itself writes NaN and infinity as null, and a pair as a
/// list of two.
template <class T> struct nlohmann::adl_serializer<std::optional<T>> {
    template <class Json> static void to_json(Json &json, const std::optional<T> &value) {
        json = value ? Json(*value) : Json(nullptr);
    }
};

namespace whirl::report {

using Json = nlohmann::ordered_json;

/// As text; bytes that are not UTF-8 are replaced: a title must not cost the result.
[[nodiscard]] inline std::string json_text(const Json &json) {
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// `of(item)` for each item, as a list.
template <class List, class Of> [[nodiscard]] Json json_list(const List &list, Of of) {
    Json items = Json::array();
    for (const auto &item : list)
        items.push_back(of(item));
    return items;
}

} // namespace whirl::report

namespace whirl::results {

inline void to_json(report::Json &json, const Whirl &whirl) { json = whirl_name(whirl); }

inline void to_json(report::Json &json, const SpeedBand &band) {
    json = report::Json::array({band.from, band.to});
}

inline void to_json(report::Json &json, const Formulation &used) {
    json = {{"frame", frame_name(used.form)},
            {"unknowns", unknowns_name(used.form)},
            {"form", form_name(used.form)},
            {"why", used.why}};
}

} // namespace whirl::results

#pragma once

// How the types of results become JSON; only for sources in report.

#include "report/common/units.h"
#include "results/balance.h"
#include "results/formulation.h"
#include "results/whirl.h"

#include <nlohmann/json.hpp>

#include <complex>
#include <optional>
#include <type_traits>
#include <vector>

// What all reports do with JSON, compiled once in json.cpp: their sources are not optimised. `what`
// is "extern template" or "template"; void is written so that a check of macros takes it for a
// type.
#define WHIRL_JSON(what)                                                                           \
    what basic_json<ordered_map>::basic_json(const ordered_json &);                                \
    what basic_json<ordered_map>::basic_json(ordered_json &&) noexcept;                            \
    what basic_json<ordered_map>::basic_json(initializer_list_t, bool, value_t);                   \
    what basic_json<ordered_map>::~basic_json() noexcept;                                          \
    what std::void_t<> basic_json<ordered_map>::json_value::destroy(value_t);                      \
    what ordered_json &basic_json<ordered_map>::operator=(ordered_json) noexcept;                  \
    what std::void_t<> basic_json<ordered_map>::push_back(ordered_json &&);                        \
    what ordered_json &basic_json<ordered_map>::operator[](object_t::key_type);                    \
    what std::string basic_json<ordered_map>::dump(int, char, bool, error_handler_t) const
namespace nlohmann {
WHIRL_JSON(extern template);
}

/// null for what is missing. The library itself writes NaN and infinity as null, and a pair as a
/// list of two.
template <class T> struct nlohmann::adl_serializer<std::optional<T>> {
    template <class Json> static void to_json(Json &json, const std::optional<T> &value) {
        json = value ? Json(*value) : Json(nullptr);
    }
};
template <> struct nlohmann::adl_serializer<std::optional<double>> {
    static void to_json(nlohmann::ordered_json &json, const std::optional<double> &value);
};

namespace whirl::report {

using Json = nlohmann::ordered_json;

/// An empty object with room for some entries: where it has to grow, the library copies all that it
/// holds.
[[nodiscard]] Json json_object(std::size_t entries);

/// Moves the entries of one object into another one, which `update` would copy.
void take_entries(Json &object, Json &&more);

/// As text; bytes that are not UTF-8 are replaced: a title must not cost the result. Control
/// characters stand there by their numbers.
[[nodiscard]] std::string json_text(const Json &json);

/// Numbers, in lists or alone, times a factor.
[[nodiscard]] Json scaled(Json numbers, double factor);
/// Numbers in SI as they are written in these units.
template <class Numbers>
[[nodiscard]] Json written(const Units &units, Quantity quantity, const Numbers &in_si) {
    return scaled(Json(in_si), units.factor(quantity));
}
/// The names of the units by quantity, as a result says in which it is: {"speed": "rpm", ..}.
[[nodiscard]] Json unit_names(const Units &units);
/// Sentences in these units.
[[nodiscard]] Json written(const Units &units, const std::vector<model::Sentence> &sentences);

/// `of(item)` for each item, as a list.
template <class List, class Of> [[nodiscard]] Json json_list(const List &list, Of of) {
    Json items = Json::array();
    for (const auto &item : list)
        items.push_back(of(item));
    return items;
}
[[nodiscard]] inline Json real_parts(const std::vector<std::complex<double>> &list) {
    return json_list(list, [](std::complex<double> value) { return value.real(); });
}
[[nodiscard]] inline Json imaginary_parts(const std::vector<std::complex<double>> &list) {
    return json_list(list, [](std::complex<double> value) { return value.imag(); });
}

} // namespace whirl::report

namespace whirl::results {

inline void to_json(report::Json &json, const Whirl &whirl) { json = whirl_name(whirl); }

inline void to_json(report::Json &json, const Interval &band) {
    json = report::Json::array({band.from, band.to});
}

inline void to_json(report::Json &json, const Formulation &used) {
    json = {{"frame", frame_name(used.form)},
            {"unknowns", unknowns_name(used.form)},
            {"form", form_name(used.form)},
            {"why", used.why}};
}

} // namespace whirl::results

#pragma once

// What the tables of the response to the imbalances and to the weight have in common.

#include "report/common/csv.h"
#include "report/common/table.h"
#include "results/response.h"

#include <algorithm>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace whirl::report {

/// A station, a bearing or a probe at one speed.
template <class Of> struct At {
    double speed; ///< rad/s
    const Of *of;
    std::size_t index; ///< of the speed
};

template <class Of> Column<At<Of>> series(std::string key, std::string csv, auto Of::*list) {
    return {std::move(key), InCsv(std::move(csv)), [list](const At<Of> &at) {
                const auto &values = at.of->*list;
                return at.index < values.size() ? Json(values[at.index]) : Json();
            }};
}

/// What does not depend on the speed.
template <class Of> Columns<At<Of>> place_columns(const char *kind) {
    return {{InCsv("speed [rad/s]"), &At<Of>::speed},
            {InCsv("kind"), [kind](const At<Of> &) { return kind; }},
            {"z", InCsv("z [m]"), [](const At<Of> &at) { return at.of->z; }},
            {"name", InCsv("name"), [](const At<Of> &at) { return at.of->name; }}};
}

/// Everything of a kind in JSON: what stands once, and lists over the speeds.
template <class Of>
Json json_of_kind(const std::vector<double> &speeds, const std::vector<Of> &all,
                  const Columns<At<Of>> &once, const Columns<At<Of>> &over_speeds) {
    return json_list(all, [&](const Of &of) {
        std::vector<At<Of>> rows;
        for (std::size_t i = 0; i < speeds.size(); ++i)
            rows.push_back({speeds[i], &of, i});
        Json json = json_row(once, At<Of>{0, &of, 0});
        take_entries(json, json_lists(over_speeds, rows));
        return json;
    });
}

/// The curves of a kind, which stand one after another, as far as there are any.
/// @param key  of their values
[[nodiscard]] Json curves_of_kind(const results::ResponseCurves &curves, std::size_t from,
                                  std::size_t to, const char *key);

template <class Of>
std::string csv_of_kind(const std::vector<std::string> &headings, double speed, std::size_t index,
                        const std::vector<Of> &all, Columns<At<Of>> columns,
                        const Columns<At<Of>> &more) {
    columns.insert(columns.end(), more.begin(), more.end());
    std::vector<At<Of>> rows;
    for (const Of &of : all)
        rows.push_back({speed, &of, index});
    return csv_rows(headings, columns, rows);
}

template <class Of> bool is_of(const results::ResponsePeak &peak, const Of &of, const char *kind) {
    if constexpr (std::is_same_v<Of, results::ResponseProbe>)
        if (peak.angle != of.angle)
            return false;
    return peak.of == kind && peak.z == of.z;
}

/// The largest value in the range: a peak, or at one of its ends.
struct LargestValue {
    std::string name;
    double z = 0;                ///< m
    double angle = 0;            ///< of a probe, rad
    std::optional<double> value; ///< infinite: no limit
    double speed = 0;            ///< rad/s
    std::optional<double> error; ///< relative
};

template <class Of>
std::vector<LargestValue>
peaks_of(const std::vector<double> &speeds, const std::vector<results::ResponsePeak> &found_peaks,
         const std::vector<Of> &all, std::vector<double> Of::*list, const char *kind) {
    std::vector<LargestValue> peaks;
    for (const Of &of : all) {
        LargestValue peak{of.name, of.z, 0, {}, 0, {}};
        if constexpr (std::is_same_v<Of, results::ResponseProbe>)
            peak.angle = of.angle;
        const std::vector<double> &values = of.*list;
        const auto end =
            values.begin() + static_cast<std::ptrdiff_t>(std::min(values.size(), speeds.size()));
        const auto at =
            static_cast<std::size_t>(std::max_element(values.begin(), end) - values.begin());
        if (values.begin() != end) {
            peak.value = values[at];
            peak.speed = speeds[at];
            if (at < of.error.size())
                peak.error = of.error[at];
        }
        for (const results::ResponsePeak &found : found_peaks)
            if (is_of(found, of, kind) && (!peak.value || found.value > *peak.value)) {
                peak.value = found.value;
                peak.speed = found.speed;
                peak.error = found.error;
            }
        peaks.push_back(peak);
    }
    return peaks;
}

/// @param what  the amplitude on the terminal
[[nodiscard]] Columns<LargestValue> peak_columns(const char *on_page, const char *on_terminal,
                                                 const char *what);

/// Local maxima of the curves.
[[nodiscard]] const Columns<results::ResponsePeak> &curve_peaks();

} // namespace whirl::report

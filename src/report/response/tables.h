#pragma once

// What the tables of the response to the imbalances and to the weight have in common.

#include "report/common/csv.h"
#include "report/common/table.h"
#include "results/response.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace whirl::report {

/// A station, a bearing or a probe at one speed.
template <class Of> struct At {
    double speed; ///< rad/s
    const Of *of;
    std::size_t index; ///< of the speed
};

/// @param csv  heading in the file; empty: the key
template <class Of>
Column<At<Of>> series(const std::string &key, Quantity quantity, auto Of::*list,
                      const std::string &csv = "") {
    return {key, InCsv(csv.empty() ? key : csv), quantity, [list](const At<Of> &at) {
                const auto &values = at.of->*list;
                return at.index < values.size() ? Json(values[at.index]) : Json();
            }};
}

/// What is told of the places of one kind.
template <class Of> class Kind {
  public:
    /// @param name    in the file
    /// @param series  what has a value at each speed
    /// @param more    what has one value, beside place and name
    Kind(std::string name, Columns<At<Of>> series, const Columns<At<Of>> &more = {})
        : _once{{InCsv("speed"), Quantity::speed, &At<Of>::speed},
                {InCsv("kind"), [name = std::move(name)](const At<Of> &) { return name; }},
                {InFiles("z"), Quantity::length, [](const At<Of> &at) { return at.of->z; }},
                {InFiles("name"), [](const At<Of> &at) { return at.of->name; }}},
          _series(std::move(series)) {
        _once = and_then(_once, more);
        _in_file = and_then(_once, _series);
    }

    /// In JSON: what has one value, and lists over the speeds.
    [[nodiscard]] Json json(const std::vector<double> &speeds, const std::vector<Of> &all,
                            const Units &units) const {
        return json_list(all, [&](const Of &of) {
            std::vector<At<Of>> rows;
            for (std::size_t i = 0; i < speeds.size(); ++i)
                rows.push_back({speeds[i], &of, i});
            Json json = json_row(_once, At<Of>{0, &of, 0}, units);
            take_entries(json, json_lists(_series, rows, units));
            return json;
        });
    }

    /// The lines of one speed in a file.
    [[nodiscard]] std::string csv(const std::vector<CsvHeading> &headings, double speed,
                                  std::size_t index, const std::vector<Of> &all,
                                  const Units &units) const {
        std::vector<At<Of>> rows;
        for (const Of &of : all)
            rows.push_back({speed, &of, index});
        return csv_rows(headings, _in_file, rows, units);
    }

  private:
    Columns<At<Of>> _once, _series, _in_file;
};

/// The curves of a kind, which stand one after another, as far as there are any.
/// @param key  of their values
[[nodiscard]] Json curves_of_kind(const results::ResponseCurves &curves, std::size_t from,
                                  std::size_t to, const char *key, Quantity quantity,
                                  const Units &units);

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
    for (int place = 0; const Of &of : all) {
        LargestValue peak{of.name, of.z, 0, {}, 0, {}};
        if constexpr (requires { of.angle; })
            peak.angle = of.angle;
        const std::vector<double> &values = of.*list;
        if (!values.empty()) {
            const auto at = static_cast<std::size_t>(
                std::max_element(values.begin(), values.end()) - values.begin());
            peak.value = values[at];
            peak.speed = speeds[at];
            if (at < of.error.size())
                peak.error = of.error[at];
        }
        for (const results::ResponsePeak &found : found_peaks)
            if (found.of == kind && found.place == place &&
                (!peak.value || found.value > *peak.value)) {
                peak.value = found.value;
                peak.speed = found.speed;
                peak.error = found.error;
            }
        peaks.push_back(peak);
        ++place;
    }
    return peaks;
}

/// Those without limit first, those whose sharpness is not known last.
[[nodiscard]] std::vector<results::ResponsePeak>
sharpest_first(std::vector<results::ResponsePeak> peaks);

/// What the peaks are of, and all of them.
[[nodiscard]] Json resonances_json(const std::vector<results::Resonance> &resonances,
                                   const Units &units);
[[nodiscard]] std::string peaks_text(const std::vector<results::Resonance> &resonances,
                                     const std::vector<results::ResponsePeak> &peaks,
                                     const Units &units);
[[nodiscard]] std::string peaks_page(const std::vector<results::Resonance> &resonances,
                                     const std::vector<results::ResponsePeak> &peaks,
                                     const Units &units);

/// Local maxima of the curves.
[[nodiscard]] const Columns<results::ResponsePeak> &curve_peaks();

} // namespace whirl::report

#pragma once

#include "model/case.h"
#include "report/common/json.h"
#include "report/common/units.h"
#include "results/whirl.h"

#include <complex>
#include <optional>
#include <string>
#include <vector>

namespace whirl::results {
struct ModelSummary;
struct Interval;
} // namespace whirl::results

namespace whirl::report {

inline constexpr double degrees = 180 / pi; ///< in one rad

/// Number for readers, at most `digits` significant digits; without a power of ten below 1e6.
[[nodiscard]] inline std::string readable(double value, int digits = 5) {
    return model::readable(value, digits);
}
/// For pictures: numbers with a power of ten as they are written by hand, "2·10⁷" for "2e+07".
[[nodiscard]] std::string with_powers(const std::string &text);
/// The texts one after another, with something between them.
[[nodiscard]] std::string joined(const std::vector<std::string> &texts, const std::string &between);
/// The same of `of(item)` for each item.
template <class List, class Of>
[[nodiscard]] std::string joined(const List &list, const std::string &between, const Of &of) {
    std::vector<std::string> texts;
    for (const auto &item : list)
        texts.push_back(of(item));
    return joined(texts, between);
}

/// "lag" or "lead"; in a sentence.
[[nodiscard]] inline const char *phase_word(bool lag) { return lag ? "lag" : "lead"; }
[[nodiscard]] std::string phase_convention(bool lag);
/// Of a number that has a direction; none: nothing has none.
[[nodiscard]] inline std::optional<double> phase_of(std::complex<double> value) {
    return value == 0.0 ? std::nullopt : std::optional(std::arg(value));
}

/// Of `count` places at most so many, evenly spread, with the first and, of more than one, the
/// last.
[[nodiscard]] std::vector<std::size_t> spread_over(std::size_t count, std::size_t most);

/// With a capital letter in front.
[[nodiscard]] std::string capitalized(std::string text);

/// The title of a case, or its name.
[[nodiscard]] std::string title_of(const model::Case &scene);
/// A name; nothing where it is empty, as that of a mode that is not known.
[[nodiscard]] inline std::optional<std::string> known_name(const std::string &name) {
    return name.empty() ? std::nullopt : std::optional(name);
}
/// One place of a rotor: its name, or where it is.
[[nodiscard]] std::string place(const std::string &name, double z, const Units &units);
/// The same of a row of a table.
inline constexpr auto place_of = [](const auto &row, const Units &units) {
    return place(row.name, row.z, units);
};
/// Angles, "10 -20"; of one balancer after the other "10 -20 | 30". @param format  of a number
[[nodiscard]] std::string angles_text(const std::vector<double> &angles, const Units &units,
                                      const char *format = "{:.5g}", const char *between = " ");
[[nodiscard]] std::string angles_text(const std::vector<std::vector<double>> &angles,
                                      const Units &units, const char *format = "{:.5g}");
/// "at 4000 rpm", "0 to 4000 rpm, 101 speeds".
[[nodiscard]] std::string range_text(const std::vector<double> &speeds, const Units &units);

/// The sense of a whirl, and of orbits that are nearly lines their direction: "forward",
/// "horizontal", "backward, vertical", "in one plane, 30 deg". Directions within 10 degrees of x
/// and of y, upright, have names.
/// @param plane  from x towards y, rad, or none
[[nodiscard]] std::string whirl_text(results::Whirl whirl, std::optional<double> plane,
                                     const Units &units);
/// Of the direction alone; empty without one.
[[nodiscard]] std::string plane_text(std::optional<double> plane, const Units &units);
/// The same of a row of a table; nothing where it has no whirl.
inline constexpr auto whirl_of = [](const auto &row, const Units &units) {
    const std::optional<results::Whirl> whirl = row.whirl;
    return whirl ? std::optional(whirl_text(*whirl, row.plane, units)) : std::nullopt;
};

/// For the terminal: title of the case and what was computed.
[[nodiscard]] std::string heading(const model::Case &scene, const std::string &what);
/// For the terminal: the model behind a result.
[[nodiscard]] std::string model_text(const results::ModelSummary &model, const Units &units);
/// For the terminal: each note once, the worst first, information last.
[[nodiscard]] std::vector<std::string> note_lines(const std::vector<model::Sentence> &notes,
                                                  const Units &units);

/// Bands of speeds in one cell; @param end  format of an end
[[nodiscard]] std::string bands_text(const std::vector<results::Interval> &bands, const char *end,
                                     const char *to, const char *between, const Units &units);

// Entries of a case that change together, of [sweep] and [map].

/// "value", "factor" or "shift", as in a case.
[[nodiscard]] std::string change_name(model::SweepChange change);
[[nodiscard]] std::vector<std::string> entries_of(const model::SweepAxis &axis);
/// The axis with what became of its entries where it is over a dimensionless number.
[[nodiscard]] Json axis_json(const model::SweepAxis &axis, const Json &changes, const Units &units);
/// What an axis is called: the entry, or the first of those that change together; the dimensionless
/// number, by what.
[[nodiscard]] std::string axis_name(const model::SweepAxis &axis);

} // namespace whirl::report

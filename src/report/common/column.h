#pragma once

#include "report/common/json.h"

#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace whirl::report {

// Formats of numbers on the terminal.
inline constexpr const char *precise = "{:#.10g}"; ///< ten digits: what the elements are made for
inline constexpr const char *rough = "{:.1e}";     ///< errors

/// How a column looks to somebody who reads a page or the terminal.
struct Shown {
    std::optional<std::string> heading;  ///< none: the column is not there
    std::string format = "{:.6g}";       ///< of its numbers; may hold a unit
    std::optional<std::string> infinite; ///< in place of infinity; none: as what is missing

    Shown() = default;
    Shown(std::string shown_heading, std::string shown_format = "{:.6g}",
          std::optional<std::string> shown_infinite = std::nullopt)
        : heading(std::move(shown_heading)), format(std::move(shown_format)),
          infinite(std::move(shown_infinite)) {}
};

// Where a column stands beside JSON, each with its heading there.
struct InCsv {
    std::string heading; ///< with its unit in brackets
    explicit InCsv(std::string with_unit) : heading(std::move(with_unit)) {}
};
struct OnPage : Shown {
    using Shown::Shown;
};
struct InText : Shown {
    using Shown::Shown;
};
/// The same on the page and the terminal.
struct ForReaders : Shown {
    using Shown::Shown;
};

/// One column of a result, described once for all its readers. Some are for one reader alone: rpm
/// beside rad/s, or all digits beside a rounded value.
template <class Row> struct Column {
    std::string key; ///< in JSON; empty: not there
    std::string csv; ///< heading in the file; empty: not there
    Shown page;      ///< in the HTML report
    Shown text;      ///< on the terminal
    std::function<Json(const Row &, std::size_t)> value;

    /// @param parts  the key, where it is in JSON; the other places where it is; then its value:
    ///               member, or function of the row, or of the row and its index
    template <class First, class Second, class... More>
    Column(First first, Second second, More... more) {
        static_assert(((place<First> + place<Second>)+... + place<More>) == sizeof...(More) + 1,
                      "a column has one value");
        take(std::move(first));
        take(std::move(second));
        (take(std::move(more)), ...);
    }

  private:
    /// 1 for where a column is, 0 for its value.
    template <class Part>
    static constexpr std::size_t place =
        std::is_convertible_v<Part, std::string> || std::is_same_v<Part, InCsv> ||
                std::is_base_of_v<Shown, Part>
            ? 1
            : 0;

    void take(std::string json_key) { key = std::move(json_key); }
    void take(const char *json_key) { key = json_key; }
    void take(InCsv part) { csv = std::move(part.heading); }
    void take(OnPage part) { page = std::move(part); }
    void take(InText part) { text = std::move(part); }
    void take(const ForReaders &part) { page = text = part; }
    template <class Of> void take(Of of) {
        value = [of = std::move(of)](const Row &row, std::size_t index) -> Json {
            if constexpr (std::is_invocable_v<Of, const Row &, std::size_t>)
                return std::invoke(of, row, index);
            else
                return std::invoke(of, row);
        };
    }
};
template <class Row> using Columns = std::vector<Column<Row>>;

/// A number or nothing times a factor.
[[nodiscard]] inline double times(double factor, double value) { return value * factor; }
[[nodiscard]] inline std::optional<double> times(double factor, std::optional<double> value) {
    return value ? std::optional(*value * factor) : std::nullopt;
}
/// The value of a column in a unit of readers: in(rpm, &CriticalSpeed::speed).
template <class Factor, class Of> [[nodiscard]] auto in(Factor factor, Of of) {
    return [factor, of](const auto &row) { return times(factor, std::invoke(of, row)); };
}

} // namespace whirl::report

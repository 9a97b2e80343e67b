#pragma once

#include "report/common/json.h"
#include "report/common/units.h"

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

/// How a column looks to somebody who reads a page or the terminal. Its unit joins the heading.
struct Shown {
    std::optional<std::string> heading;  ///< none: the column is not there
    std::string format = "{:.6g}";       ///< of its numbers
    std::optional<std::string> infinite; ///< in place of infinity; none: as what is missing
    int digits = 0;        ///< significant ones, in place of the format; 0: as the format says
    std::string si_format; ///< of a second column in SI; empty: there is none

    Shown() = default;
    Shown(std::string shown_heading, std::string shown_format = "{:.6g}",
          std::optional<std::string> shown_infinite = std::nullopt)
        : heading(std::move(shown_heading)), format(std::move(shown_format)),
          infinite(std::move(shown_infinite)) {}
};

// Where a column stands beside JSON, each with its heading there, without a unit.
struct InCsv {
    std::string heading;
    explicit InCsv(std::string name) : heading(std::move(name)) {}
};
/// In JSON and CSV under one name.
struct InFiles {
    std::string name;
    explicit InFiles(std::string key) : name(std::move(key)) {}
};
struct OnPage : Shown {
    using Shown::Shown;
    /// The same in SI beside it, where no unit was asked for: rad/s beside rpm. With a unit that
    /// was asked for the one column has the digits of this one.
    [[nodiscard]] OnPage and_si(std::string format) const {
        OnPage both = *this;
        both.si_format = std::move(format);
        return both;
    }
};
struct InText : Shown {
    using Shown::Shown;
    [[nodiscard]] InText and_si(std::string format) const {
        InText both = *this;
        both.si_format = std::move(format);
        return both;
    }
};
/// The same on the page and the terminal.
struct ForReaders : Shown {
    using Shown::Shown;
};
/// The same, but for the first letter: a small one on the terminal.
struct Titled : Shown {
    using Shown::Shown;
};
/// A number with as many digits as the elements are made for, and in SI beside it.
struct AllDigits {
    std::string heading; ///< as that of Titled
    explicit AllDigits(std::string name) : heading(std::move(name)) {}
};
/// The error estimate of a row, over its value.
struct RelativeError {};

/// With a small letter in front.
[[nodiscard]] std::string uncapitalized(std::string text);

/// A column whose rows differ in what they are: amplitudes of stations and forces of bearings.
template <class Of> struct OfEach {
    Of quantity; ///< of a row
};
template <class Of> OfEach(Of) -> OfEach<Of>;

/// Results that hold numbers in SI, for which a column must say what they are.
template <class Value> inline constexpr bool is_quantity = std::is_floating_point_v<Value>;
template <class Value> inline constexpr bool is_quantity<std::optional<Value>> = is_quantity<Value>;
template <class Value> inline constexpr bool is_quantity<std::vector<Value>> = is_quantity<Value>;
template <> inline constexpr bool is_quantity<results::Interval> = true;
template <> inline constexpr bool is_quantity<Json> = true;

/// One column of a result, described once for all its readers. Some are for one reader alone: all
/// digits beside a rounded value.
template <class Row> struct Column {
    std::string key; ///< in JSON; empty: not there
    std::string csv; ///< heading in the file; empty: not there
    Shown page;      ///< in the HTML report
    Shown text;      ///< on the terminal
    Quantity quantity = Quantity::number;
    std::function<Quantity(const Row &)> quantity_of; ///< where it differs from row to row

    /// @param parts  the key, where it is in JSON; the other places where it is; what its numbers
    ///               are: a Quantity or OfEach; then its value: member, or function of the row, of
    ///               the row and its index, or of the row and the units (of texts with numbers, to
    ///               whose heading a quantity adds their unit)
    template <class First, class Second, class... More>
    Column(First first, Second second, More... more) {
        check<First, Second, More...>();
        take(std::move(first));
        take(std::move(second));
        (take(std::move(more)), ...);
    }

    [[nodiscard]] Quantity of(const Row &row) const {
        return quantity_of ? quantity_of(row) : quantity;
    }
    /// Of a row: numbers in SI.
    [[nodiscard]] Json value(const Row &row, std::size_t index, const Units &units) const {
        return _value(row, index, units);
    }
    /// The same in the units.
    [[nodiscard]] Json written(const Row &row, std::size_t index, const Units &units) const {
        return scaled(value(row, index, units), units.factor(of(row)));
    }

  private:
    std::function<Json(const Row &, std::size_t, const Units &)> _value;

    template <class Part> static constexpr bool is_each = false;
    template <class Of> static constexpr bool is_each<OfEach<Of>> = true;
    template <class Part>
    static constexpr bool says_what =
        std::is_same_v<Part, Quantity> || std::is_same_v<Part, RelativeError> || is_each<Part>;
    template <class Part>
    static constexpr bool is_place =
        std::is_convertible_v<Part, std::string> || std::is_same_v<Part, InCsv> ||
        std::is_same_v<Part, InFiles> || std::is_same_v<Part, AllDigits> ||
        std::is_base_of_v<Shown, Part>;
    template <class Part> static constexpr bool is_value = !is_place<Part> && !says_what<Part>;

    template <class Of>
    static auto value_of(const Of &of, const Row &row, std::size_t index, const Units &units) {
        if constexpr (std::is_invocable_v<Of, const Row &, std::size_t>)
            return std::invoke(of, row, index);
        else if constexpr (std::is_invocable_v<Of, const Row &, const Units &>)
            return std::invoke(of, row, units);
        else
            return std::invoke(of, row);
    }
    template <class Part> static constexpr bool measured() {
        if constexpr (is_value<Part>)
            return is_quantity<decltype(value_of(std::declval<const Part &>(),
                                                 std::declval<const Row &>(), 0,
                                                 std::declval<const Units &>()))>;
        else
            return false;
    }
    template <class... Parts> static constexpr void check() {
        static_assert((static_cast<int>(is_value<Parts>) + ...) == 1, "a column has one value");
        static_assert(!(measured<Parts>() || ...) || (says_what<Parts> || ...),
                      "a column of numbers says what they are");
    }

    void take(std::string json_key) { key = std::move(json_key); }
    void take(const char *json_key) { key = json_key; }
    void take(InCsv part) { csv = std::move(part.heading); }
    void take(InFiles part) { key = csv = std::move(part.name); }
    void take(OnPage part) { page = std::move(part); }
    void take(InText part) { text = std::move(part); }
    void take(const ForReaders &part) { page = text = part; }
    void take(const Titled &part) {
        page = text = part;
        text.heading = uncapitalized(*part.heading);
    }
    void take(const AllDigits &part) {
        take(OnPage(part.heading, "{:.10g}").and_si("{:.10g}"));
        take(InText(uncapitalized(part.heading)).and_si(precise));
    }
    void take(RelativeError) {
        take(OnPage("Relative error", "{:.2g}"));
        take(InText("error", rough));
    }
    void take(Quantity what) { quantity = what; }
    template <class Of> void take(OfEach<Of> of) { quantity_of = std::move(of.quantity); }
    template <class Of> void take(Of of) {
        _value = [of = std::move(of)](const Row &row, std::size_t index,
                                      const Units &units) -> Json {
            return value_of(of, row, index, units);
        };
    }
};
template <class Row> using Columns = std::vector<Column<Row>>;

/// Columns, and behind them others.
template <class Row>
[[nodiscard]] Columns<Row> and_then(Columns<Row> columns,
                                    const std::type_identity_t<Columns<Row>> &others) {
    columns.insert(columns.end(), others.begin(), others.end());
    return columns;
}

/// A number or nothing times a factor.
[[nodiscard]] inline double times(double factor, double value) { return value * factor; }
[[nodiscard]] inline std::optional<double> times(double factor, std::optional<double> value) {
    return value ? std::optional(*value * factor) : std::nullopt;
}
/// The value of a column times a factor, such as 100 for percent.
template <class Factor, class Of> [[nodiscard]] auto in(Factor factor, Of of) {
    return [factor, of](const auto &row) { return times(factor, std::invoke(of, row)); };
}

} // namespace whirl::report

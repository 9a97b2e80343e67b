#pragma once

#include "report/common/units.h"
#include "unit_presets.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::tests {

/// A number in a text.
struct Number {
    std::size_t begin = 0, end = 0; ///< bytes
    double value = 0;
    double last = 1; ///< one in its last place
    int digits = 0;  ///< significant ones that are written
};
/// Numbers that stand alone: not "1F", "m2" or a digit of a name. Powers of ten as programs and as
/// people write them: "2e+07", "2·10⁷".
[[nodiscard]] std::vector<Number> numbers_of(const std::string &text);

/// How many numbers were compared.
struct Compared {
    int numbers = 0;   ///< that have a quantity
    int converted = 0; ///< whose unit is not the one of SI
    int rough = 0; ///< only to the place where one of the two ends, as trailing zeros may be cut
    Compared &operator+=(const Compared &more);
};

/// Compares texts in the units of a preset with the same in marked units, in which each number says
/// what it is, by its own unit or by that of the heading of its column. Other words and numbers
/// are the same letter by letter; differences are failures of the test.
class MarkedTexts {
  public:
    MarkedTexts(const report::Units &units, bool peak_to_peak, std::string where)
        : _units(units), _peak_to_peak(peak_to_peak), _where(std::move(where)) {}

    /// A sentence or a label.
    void compare(const std::string &marked, const std::string &other);
    /// What the terminal shows: tables whose columns but the first end below the ends of their
    /// headings, and sentences.
    void compare_terminal(const std::string &marked, const std::string &other);
    /// Tables and paragraphs of a page.
    void compare_html(const std::string &marked, const std::string &other);
    /// Labels of a picture, in any order: where there is room for them depends on their lengths.
    /// @param axes  what numbers alone may be: they stand beside marks
    void compare_labels(const std::vector<std::string> &marked,
                        const std::vector<std::string> &other,
                        const std::vector<model::Quantity> &axes = {});

    /// The quantity that the heading of a column or the name of an axis names.
    [[nodiscard]] static std::optional<model::Quantity> quantity_in(const std::string &heading);
    /// What a number in marked units is multiplied by.
    [[nodiscard]] double ratio(model::Quantity quantity) const;
    /// The words that a text in marked units has in these.
    [[nodiscard]] std::string words(std::string marked) const;

    Compared compared;
    int labels = 0, labels_without_match = 0;
    std::string unmatched; ///< labels, one a line

  private:
    using Quantities = std::vector<std::optional<model::Quantity>>;
    [[nodiscard]] static Quantities own_quantities(const std::string &marked,
                                                   const std::vector<Number> &numbers);
    /// @param quantities  of the numbers of `marked` @returns what differs, or nothing
    std::string difference(const std::string &marked, const std::string &other,
                           const Quantities &quantities);
    [[nodiscard]] static std::optional<model::Quantity>
    quantity_of_row(const std::vector<std::string> &cells);
    void by_row(const std::string &marked, const std::string &other,
                const std::vector<Number> &numbers, Quantities &quantities) const;
    void expect_same(const std::string &marked, const std::string &other,
                     const Quantities &quantities);

    const report::Units &_units;
    bool _peak_to_peak;
    std::string _where;
};

} // namespace whirl::tests

#pragma once

#include "report/pictures/style.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::report {

/// Positions near the wanted ones that keep the gap and stay in the range; order is kept.
[[nodiscard]] std::vector<double> spread(const std::vector<double> &wanted, double gap,
                                         Range range);

/// Boxes in fractions of a panel; finds a free place for a label beside its point.
class LabelPlacer {
  public:
    struct Box {
        double x = 0, y = 0, width = 0, height = 0; ///< lower left corner and size
    };
    void block(const Box &box) { _boxes.push_back(box); }
    /// Takes this very place. @returns false where another label has it or it leaves the picture.
    bool take(const Box &box);
    /// Least covered place of a label of this size around (x, y); the place is taken from then on.
    /// Nothing where any place leaves the picture or lies on another label.
    std::optional<Box> place(double x, double y, double width, double height);

  private:
    /// Whether no label has that place, and it is within the picture.
    [[nodiscard]] bool free(const Box &box) const;

    std::vector<Box> _boxes;
    std::vector<Box> _labels;
};

/// Says of marks for whose labels there is no place that the table has them; nothing without any.
/// @param at  where, in parts of the graph: "0,1.06"
[[nodiscard]] std::string left_out(int count, const std::string &mark, const std::string &at);

} // namespace whirl::report

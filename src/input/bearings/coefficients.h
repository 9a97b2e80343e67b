#pragma once

#include "input/checked_table.h"
#include "model/bearing.h"

#include <array>
#include <functional>
#include <optional>
#include <string>

namespace whirl::input {

/// A coefficient of a bearing: its name and its place in one of the 2x2 matrices. Without a place
/// it stands for both entries of the diagonal, alike.
struct Coefficient {
    const char *name;
    Quantity quantity;
    Eigen::Matrix2d model::BearingCoefficients::*matrix;
    int row = -1;
    int column = -1;

    [[nodiscard]] bool on_diagonal() const { return row < 0; }
    /// Range of those that are the same in x and y.
    [[nodiscard]] Range range() const {
        return on_diagonal() ? Range::not_negative() : Range::any();
    }
};

using CoefficientMatrix = Eigen::Matrix2d model::BearingCoefficients::*;

/// k, kxx, ..., kyy, c, ..., m, ..., myy: what a table over the speed may have.
[[nodiscard]] const std::array<Coefficient, 15> &bearing_coefficients();

/// A number by its name; empty where it is not given.
using NumberOf = std::function<std::optional<double>(const Coefficient &)>;

/// @param seal  the same from every direction unless it says otherwise: kyx = -kxy, cyx = -cxy
[[nodiscard]] model::BearingCoefficients read_coefficients(const NumberOf &number, bool seal);

/// A key and what is wrong with it.
struct WrongKey {
    std::string key;
    std::string message;
};
/// k beside kxx and so on (that of a seal goes with the coupling).
[[nodiscard]] std::optional<WrongKey> mixed_keys(const std::function<bool(const char *)> &has,
                                                 bool seal);

/// What is wrong with mass coefficients: they would push as if there were less than no mass.
/// @param isotropic  given as m
[[nodiscard]] std::optional<WrongKey> against_mass(const Eigen::Matrix2d &m, bool isotropic);

/// Reads a bearing table (CSV) into the rows of the bearing.
void read_bearing_table(const std::string &path, bool spline, model::Bearing &bearing,
                        ReadContext &context);

/// Rows of the cubic spline (not-a-knot) through the rows of a table, so near that straight lines
/// between them depart from the spline by at most 1e-5 of the largest entry of that kind.
/// Between two rows of the table there is a line, among three a parabola.
/// @returns false where that would take more than 2000 rows
[[nodiscard]] bool refine_by_spline(model::Bearing &bearing);

} // namespace whirl::input

#pragma once

#include "linalg/rational_curve.h"

#include <Eigen/Core>

#include <utility>
#include <vector>

namespace whirl::linalg {

/// Functions of a real variable by rational functions between places where they may bend, and
/// between halves of these where one with few places does not do.
class RationalPieces {
  public:
    /// @param cuts    ascending, at least two: the functions are analytic between
    /// @param enough  as RationalCurve's
    /// @param most    places between two cuts
    /// @throws SolverError where nothing is solved between two cuts
    RationalPieces(const std::vector<double> &cuts, const RationalCurve::Solve &solve,
                   double enough, std::size_t most);

    /// Ascending.
    [[nodiscard]] const std::vector<RationalCurve> &pieces() const { return _pieces; }
    [[nodiscard]] const RationalCurve &piece_at(double place) const {
        return _pieces[number_of(place)];
    }
    /// The interpolated values and their derivatives.
    [[nodiscard]] std::pair<Eigen::MatrixXcd, Eigen::MatrixXcd> with_slope(double place) const {
        return piece_at(place).with_slope(place);
    }
    /// Solves at these places too. @returns the largest misfit that was there, but for places in
    /// pieces that were not fitted before
    double take_in(const std::vector<double> &places);
    /// Places between which the functions are not interpolated to what is accepted.
    [[nodiscard]] std::vector<std::pair<double, double>> unsettled() const;

  private:
    double _enough;
    std::vector<RationalCurve> _pieces;

    void add(double from, double to, const RationalCurve::Solve &solve, std::size_t most);
    [[nodiscard]] std::size_t number_of(double place) const;
};

} // namespace whirl::linalg

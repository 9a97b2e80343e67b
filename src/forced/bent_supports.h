#pragma once

#include "forced/shape_terms.h"
#include "model/rotor.h"

#include <Eigen/Core>

#include <complex>
#include <optional>
#include <utility>
#include <vector>

namespace whirl::forced {

/// Rows of all bearing tables, rad/s, between neighbouring ones of which every coefficient stays
/// within 1 % of the largest one of its kind there of a straight line: all rows of a coarse table,
/// few of one with many rows along a curve.
[[nodiscard]] std::vector<double> rows_of_straight_pieces(const model::Rotor &rotor);

/// How a coefficient matrix changes per rad/s at a speed (of a row: above it), k and c.
[[nodiscard]] model::BearingCoefficients slope_of(const model::Bearing &bearing, double speed);

/// Bearings between two rows of their tables that have other rows between them: what they are
/// beside the straight lines from the one to the other. It acts on the stretches of few bearings,
/// so that equations with the lines in them, solved for unit forces there, give the solution of
/// those with the bearings as they are by a system of a few unknowns (Sherman, Morrison, Woodbury).
class BentSupports {
  public:
    /// @param from,to  rows, rad/s; what is given must outlive this
    BentSupports(const assembly::Discretization &discretization, const ShapeTerms &terms,
                 double from, double to);

    /// No rows between.
    [[nodiscard]] bool none() const { return _bearings.empty(); }
    /// B: forces on the unknowns, which read the stretches of these bearings by B^T.
    [[nodiscard]] const Eigen::MatrixXd &columns() const { return _columns; }
    /// B Z B^T
    [[nodiscard]] Eigen::MatrixXcd over_unknowns(const Eigen::MatrixXcd &Z) const;

    struct Change {
        Eigen::MatrixXcd Z;     ///< P is B Z B^T more than that with the lines
        Eigen::MatrixXcd slope; ///< dZ/ds
    };
    /// At a speed; a complex one means the lines between the rows about its real part.
    [[nodiscard]] Change at(std::complex<double> s) const;

    /// Solutions at a real s, of P u = b, from those of the lines.
    /// @param numbers  of b and B, some rows L u of them
    /// @param stretch  the same of rows B^T
    [[nodiscard]] QuadraticResolvent::Solution
    solution(double s, const QuadraticResolvent::Solution &numbers,
             const QuadraticResolvent::Solution &stretch) const;

    /// Poles (roots of det P) from those with the lines: such whose real part is next to the piece
    /// and that are not far from the real speeds by Newton's method, with right and left vectors;
    /// where two lead to one, by the equations between each two rows. Others as they are: no
    /// resonance is at them.
    /// @param lines  P with the straight lines
    [[nodiscard]] std::vector<std::complex<double>>
    poles(const QuadraticTerms &lines, const std::vector<std::complex<double>> &guesses) const;

  private:
    const assembly::Discretization &_discretization;
    const ShapeTerms &_terms;
    double _from, _to;
    std::vector<std::size_t> _bearings; ///< with rows between
    std::vector<double> _inner;         ///< those rows
    Eigen::MatrixXd _columns;

    [[nodiscard]] std::optional<std::complex<double>> pole(const QuadraticTerms &lines,
                                                           std::complex<double> guess) const;
    [[nodiscard]] std::vector<std::complex<double>> row_by_row(const QuadraticTerms &lines) const;
    [[nodiscard]] bool in_sight(std::complex<double> pole) const;
};

} // namespace whirl::forced

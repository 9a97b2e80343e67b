#pragma once

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace whirl::forced {

/// P(s) = P0 + s P1 + s^2 P2, dense and complex, and the solution of P(s) u = b at any s.
struct QuadraticTerms {
    Eigen::MatrixXcd P0, P1, P2;

    [[nodiscard]] Eigen::MatrixXcd slope(std::complex<double> s) const {
        return P1 + (2.0 * s) * P2;
    }

    [[nodiscard]] Eigen::MatrixXcd at(std::complex<double> s) const {
        return P0 + s * P1 + (s * s) * P2;
    }
};

/// Rows of numbers y = L u of the solutions of P(s) u = b for many s, from one Schur form: with
/// s = shift + width / m, P(s) u = b says (m - C) z = m^2 (P(shift)^-1 b, 0) of a companion matrix
/// C, z = (m u, u). C = Q T Q^H with T triangular; its eigenvalues are the poles. By the
/// eigenvectors of T each number is a sum over the poles, m^2 sum r_k / (m - m_k). Where these
/// terms cancel, as about poles that nearly coincide, T is solved twice instead. Of several right
/// sides b each has numbers of its own. Poles far from the places asked for act together: where
/// these are not asked for, C is taken on a Krylov basis of (P(shift)^-1 b, 0), as large as it
/// needs to be for numbers that are exact to rounding.
class QuadraticResolvent {
  public:
    /// @param b         right sides, a column each
    /// @param rows      L
    /// @param from, to  where s lies, real; the shift keeps away from there
    /// @param all_poles false: those that b drives and that are felt between these places, with the
    ///                  numbers exact to rounding, at a small part of the cost
    /// @throws linalg::SolverError where the Schur form is not found
    QuadraticResolvent(const QuadraticTerms &terms, const Eigen::MatrixXcd &b,
                       const Eigen::MatrixXd &rows, double from, double to, bool all_poles = true);

    /// All roots of det P(s), or those of them, but for those much farther away than any s asked
    /// for.
    [[nodiscard]] std::vector<std::complex<double>> poles() const;

    struct Solution {
        Eigen::MatrixXcd y;     ///< a column for each right side
        Eigen::MatrixXcd slope; ///< dy/ds
    };
    /// `count` of the numbers, from the first. Next to a pole their error is that of the pole, some
    /// 1e-15 of the range.
    [[nodiscard]] Solution at(double s, Eigen::Index first, Eigen::Index count) const;

  private:
    double _width;
    std::complex<double> _shift;
    Eigen::MatrixXcd _T;
    Eigen::MatrixXcd _lower; ///< L times the rows of Q that u is of
    Eigen::MatrixXcd _h;     ///< Q^H (P(shift)^-1 b, 0)
    struct Residues {
        Eigen::MatrixXcd of;   ///< r_k, a column a pole
        Eigen::MatrixXd sizes; ///< their moduli
    };
    std::vector<Residues> _residues; ///< for each right side

    [[nodiscard]] std::complex<double> m_at(double s) const { return _width / (s - _shift); }
    void find_residues();
    [[nodiscard]] Solution by_triangle(std::complex<double> m, Eigen::Index first,
                                       Eigen::Index count) const;
    /// The numbers and what they change, from v = (m - T)^-1 h and w = (m - T)^-1 v as L sees them.
    [[nodiscard]] Solution solution(std::complex<double> m, const Eigen::MatrixXcd &v,
                                    const Eigen::MatrixXcd &w) const;
};

} // namespace whirl::forced

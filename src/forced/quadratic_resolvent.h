#pragma once

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace whirl::forced {

/// P(s) = P0 + s P1 + s^2 P2, dense and complex, and the solution of P(s) u = b at any s.
struct QuadraticTerms {
    Eigen::MatrixXcd P0, P1, P2;

    [[nodiscard]] Eigen::MatrixXcd at(std::complex<double> s) const {
        return P0 + s * P1 + (s * s) * P2;
    }
};

/// P(s) u = b for many s, from one Schur form: with s = shift + width / m, P(s) u = b says
/// (m - C) z = m^2 (P(shift)^-1 b, 0) of a companion matrix C, z = (m u, u). C = Q T Q^H with T
/// triangular, so that an s costs two triangular solves; its eigenvalues are the poles.
class QuadraticResolvent {
  public:
    /// @param from, to  where s lies, real; the shift keeps away from there
    /// @throws linalg::SolverError where the Schur form is not found
    QuadraticResolvent(const QuadraticTerms &terms, const Eigen::VectorXcd &b, double from,
                       double to);

    /// All roots of det P(s), but for those much farther away than any s asked for.
    [[nodiscard]] std::vector<std::complex<double>> poles() const;

    struct Solution {
        Eigen::VectorXcd u;
        Eigen::VectorXcd slope; ///< du/ds
    };
    /// Backward stable; next to a pole its error is that of the pole, some 1e-15 of the range.
    [[nodiscard]] Solution at(double s) const;

  private:
    double _width;
    std::complex<double> _shift;
    Eigen::MatrixXcd _T;
    Eigen::MatrixXcd _lower; ///< the rows of Q that u is of
    Eigen::VectorXcd _h;     ///< Q^H (P(shift)^-1 b, 0)
};

} // namespace whirl::forced

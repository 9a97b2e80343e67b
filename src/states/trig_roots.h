#pragma once

#include <Eigen/Core>

#include <complex>
#include <functional>
#include <vector>

namespace whirl::states {

/// A real trigonometric polynomial of d angles, sum of Re[c_k exp(i k.x)].
class TrigPolynomial {
  public:
    struct Term {
        Eigen::VectorXi k;
        std::complex<double> c;
    };
    /// Terms below this times the size are rounding of the values they come from.
    static constexpr double rounding = 1e-14;

    explicit TrigPolynomial(std::vector<Term> terms) : _terms(std::move(terms)) {}

    [[nodiscard]] const std::vector<Term> &terms() const { return _terms; }
    /// Sum of |c_k|: no value is larger.
    [[nodiscard]] double size() const;
    /// Sum of |c_k| |k|_1 |k_j| over the terms: for points whose angles differ by at most h each,
    /// derivatives by x_j differ by at most h times this.
    [[nodiscard]] Eigen::VectorXd bends() const;

  private:
    std::vector<Term> _terms;
};

/// The d trigonometric polynomials of d angles, of degree at most degrees(j) in x_j, that take
/// these values: by sums over a grid of 2 degrees(j) + 1 angles each.
/// @param sizes  of the terms that each value is a sum of: rounding is measured by them
/// @throws linalg::SolverError where one of them is zero everywhere
[[nodiscard]] std::vector<TrigPolynomial>
interpolated(const Eigen::VectorXi &degrees, const Eigen::VectorXd &sizes,
             const std::function<Eigen::VectorXd(const Eigen::VectorXd &)> &values);

struct TrigRoots {
    std::vector<Eigen::VectorXd> roots; ///< in [0, 2 pi)
    /// Places where roots are so close to being double that it is not decided how many there are.
    std::vector<Eigen::VectorXd> undecided;
};

/// All common real roots. Cells of the torus are halved until in each either one of the polynomials
/// has no root, or together they have at most one, which Newton's method with the matrix of the
/// centre then finds or rules out; both by bounds of the second derivatives from the coefficients
/// (R. E. Moore, Interval Analysis, 1966, and the theorem of L. V. Kantorovich). Nothing is left
/// out but what rounding hides.
/// @throws linalg::SolverError where the roots are not isolated
[[nodiscard]] TrigRoots all_roots(const std::vector<TrigPolynomial> &polynomials);

} // namespace whirl::states

#pragma once

#include "linalg/sparse_factor.h"
#include "modes/biorthogonal.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <complex>
#include <functional>
#include <optional>
#include <vector>

namespace whirl::modes {

/// An eigenpair of the whole rotor at one speed.
struct WholeRoot {
    std::complex<double> value;   ///< l, 1/s
    Eigen::VectorXcd right, left; ///< Q(l) right = 0, left^H Q(l) = 0
    double residual = 0;          ///< of l, relative: what the iteration leaves
    double rounding = 0;          ///< of l, relative: what rounding of the entries can cause
};

/// The left vector, or force, that belongs to a right one: of a complex problem, which is
/// symmetric, its conjugate; of a real one, where it is mirrored, that of (x, -y).
template <class Scalar> [[nodiscard]] Eigen::VectorXcd in_mirror(const Eigen::VectorXcd &right);

/// Q(l) = l^2 M + l D + K of the whole rotor at one speed: its eigenpairs from guesses, and how
/// many eigenvalues there are. KLU analyses the pattern once.
template <class Scalar> class WholePencil {
  public:
    using Vector = Eigen::VectorXcd;

    /// @param scale  of the order of the eigenvalues asked for, 1/s
    void set(const QuadraticOf<Scalar> &problem, double scale);

    /// The eigenpair next to a guess, by inverse iteration from both sides beside the Rayleigh
    /// quotient (P. Lancaster, Lambda-matrices and Vibrating Systems, 1966, chapter 6): with the
    /// vectors of both sides its error is the product of theirs. Nothing where it does not settle.
    [[nodiscard]] std::optional<WholeRoot> refined(const WholeRoot &guess);

    /// About Q(l)^-1 times a vector: right for what a guess leaves out.
    using Inverse = std::function<Vector(const Vector &)>;
    /// The eigenpair of which a guess has all but a small part, of both vectors: one correction of
    /// each. Its residual is by how much that moved the eigenvalue.
    /// @param mirrored  left vectors are the right ones in the mirror (FormMatrices::mirrored)
    [[nodiscard]] WholeRoot corrected(const WholeRoot &guess, const Inverse &inverse,
                                      bool mirrored) const;

    /// Argument of det Q(z), rad; nothing at an eigenvalue.
    [[nodiscard]] std::optional<double> determinant_phase(std::complex<double> z);

  private:
    using Complex = std::complex<double>;
    struct Products {
        Vector M, D, K;
    };
    Eigen::SparseMatrix<Complex> _Q;
    std::vector<Scalar> _M, _D, _K; ///< at the places of Q, scaled
    Eigen::VectorXd _scales;        ///< of the unknowns: all count alike, whatever their units
    linalg::SparseFactor<Complex> _factors{true};

    void put(const Eigen::SparseMatrix<Scalar> &A, std::vector<Scalar> &entries) const;
    [[nodiscard]] bool factorize(Complex l);
    void multiply(const Vector &x, Products &out) const;
    void multiply_adjoint(const Vector &y, Products &out) const;
    [[nodiscard]] double entries_between(const Vector &y, double size, const Vector &x) const;
};

extern template class WholePencil<double>;
extern template class WholePencil<std::complex<double>>;

/// A circle in the plane of eigenvalues.
struct Circle {
    double centre = 0; ///< on the real axis, 1/s
    double radius = 0;
};

/// Whether all eigenvalues inside a circle are among those known: the argument of the determinant
/// around it, with the eigenvalues known, inside and outside, divided out. Nothing where it is not
/// decided: one lies on the circle.
/// @param known  of a real problem both conjugates; outside the circle they need be near alone
template <class Scalar>
[[nodiscard]] std::optional<bool> complete_within(WholePencil<Scalar> &pencil, const Circle &circle,
                                                  const std::vector<std::complex<double>> &known);

} // namespace whirl::modes

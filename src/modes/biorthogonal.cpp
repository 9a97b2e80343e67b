#include "modes/biorthogonal.h"

#include "linalg/dense/products.h"
#include "linalg/quadratic/quadratic_pattern.h"
#include "linalg/sparse_factor.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace whirl::modes {

namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Complex = std::complex<double>;

template <class Scalar> using Columns = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
template <class Scalar> using Values = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

/// y^T (v dD + dK) x of each mode.
template <class Scalar, class Change>
Values<Scalar> derivatives(const Change &change, const Values<Scalar> &values,
                           const Columns<Scalar> &X, const Columns<Scalar> &Y) {
    Columns<Scalar> dQ = (change.D * X) * values.asDiagonal();
    if (change.K.nonZeros() > 0)
        dQ += change.K * X;
    return Y.cwiseProduct(dQ).colwise().sum().transpose();
}

/// States left and right of given left and right vectors, and rates.
template <class Scalar, class Problem>
void fill(const Problem &problem, const Values<Scalar> &values, const Columns<Scalar> &X,
          const Columns<Scalar> &Y, Columns<Scalar> &left, Columns<Scalar> &right, ModeBasis &out) {
    const Eigen::Index n = X.rows();
    const Columns<Scalar> KY = problem.K.transpose() * Y;
    const Columns<Scalar> MY = problem.M.transpose() * Y;
    left.resize(2 * n, X.cols());
    right.resize(2 * n, X.cols());
    left << KY, -MY * values.asDiagonal();
    right << X, X * values.asDiagonal();
    const Values<Scalar> below = derivatives<Scalar>(problem.below, values, X, Y);
    const Values<Scalar> above =
        problem.smooth ? below : derivatives<Scalar>(problem.above, values, X, Y);
    out.rate_below.resize(X.cols());
    out.rate_above.resize(X.cols());
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
        const Values<Scalar> terms = left.col(i).cwiseProduct(right.col(i));
        const Scalar norm = terms.sum();
        // A mode that coalesces with another has a product of zero with itself; below this share
        // of its terms it is rounding.
        const bool known = std::abs(norm) > 1e-12 * terms.cwiseAbs().sum();
        left.col(i) *= known ? Scalar(1) / norm : Scalar(0);
        const double unknown = std::numeric_limits<double>::quiet_NaN();
        out.rate_below(i) = known ? Complex(values(i) * below(i) / norm) : unknown;
        out.rate_above(i) = known ? Complex(values(i) * above(i) / norm) : unknown;
    }
}

/// Vectors of equal eigenvalues may be mixed: makes left^T right the unit matrix where it can be.
void separate_columns(Eigen::MatrixXcd &left, const Eigen::MatrixXcd &right) {
    const Eigen::MatrixXcd products = linalg::transposed_times(left, right);
    const Eigen::Index n = products.rows();
    const double off =
        (products - Eigen::MatrixXcd(products.diagonal().asDiagonal())).cwiseAbs().sum();
    if (n == 0 || off < 1e-6 * static_cast<double>(n))
        return;
    Eigen::FullPivLU<Eigen::MatrixXcd> lu(products);
    lu.setThreshold(1e-6);
    if (lu.isInvertible())
        left = linalg::solved(products.partialPivLu(), Eigen::MatrixXcd(left.transpose()))
                   .transpose()
                   .eval();
}

} // namespace

Eigen::MatrixXd overlaps(const ModeBasis &a, const ModeBasis &b) {
    if (!a.is_complex())
        return linalg::transposed_times(a.left, b.right)
            .cwiseProduct(linalg::transposed_times(b.left, a.right).transpose())
            .cwiseAbs();
    const auto products = [&](const Eigen::MatrixXcd &of_a, const Eigen::MatrixXcd &of_b) {
        return Eigen::MatrixXd(
            linalg::transposed_times(a.complex_left, of_b)
                .cwiseProduct(linalg::transposed_times(b.complex_left, of_a).transpose())
                .cwiseAbs());
    };
    Eigen::MatrixXd out = products(a.complex_right, b.complex_right);
    for (std::size_t alias = 0; alias < a.aliases.size(); ++alias)
        out = out.cwiseMax(products(a.aliases[a.ways_back[alias]], b.aliases[alias]));
    return out;
}

std::complex<double> overlap(const ModeBasis &a, const ModeBasis &b, Eigen::Index i,
                             Eigen::Index j) {
    if (!a.is_complex())
        return a.left.col(i).dot(b.right.col(j)) * b.left.col(j).dot(a.right.col(i));
    // Not conjugated.
    return a.complex_left.col(i).cwiseProduct(b.complex_right.col(j)).sum() *
           b.complex_left.col(j).cwiseProduct(a.complex_right.col(i)).sum();
}

ModeBasis basis_of(const QuadraticAt &problem, const Eigen::VectorXd &values,
                   const Eigen::MatrixXd &vectors) {
    ModeBasis out;
    fill<double>(problem, values, vectors, vectors, out.left, out.right, out);
    return out;
}

ModeBasis basis_of(const ComplexQuadraticAt &problem, const Eigen::VectorXcd &values,
                   const Eigen::MatrixXcd &vectors) {
    ModeBasis out;
    fill<Complex>(problem, values, vectors, vectors, out.complex_left, out.complex_right, out);
    separate_columns(out.complex_left, out.complex_right);
    return out;
}

ModeBasis basis_of(const QuadraticAt &problem, const Eigen::VectorXcd &values,
                   const Eigen::MatrixXcd &vectors, const Eigen::MatrixXcd &left) {
    ModeBasis out;
    fill<Complex>(problem, values, vectors, left, out.complex_left, out.complex_right, out);
    separate_columns(out.complex_left, out.complex_right);
    return out;
}

ModeBasis basis_of(const DenseQuadraticAt &problem, const Eigen::VectorXcd &values,
                   const Eigen::MatrixXcd &vectors, const Eigen::MatrixXcd &left) {
    ModeBasis out;
    fill<Complex>(problem, values, vectors, left, out.complex_left, out.complex_right, out);
    separate_columns(out.complex_left, out.complex_right);
    return out;
}

Eigen::MatrixXcd mirrored_vectors(Eigen::MatrixXcd right) {
    right(Eigen::seqN(1, right.rows() / 2, 2), Eigen::all) *= -1;
    return right;
}

/// With the transposed problem: two steps from a shift 1e-7 off leave (1e-7 over the relative
/// gap)^2 of the other modes.
Eigen::MatrixXcd left_vectors(const QuadraticAt &problem, const Eigen::VectorXcd &values,
                              const Eigen::MatrixXcd &X) {
    linalg::QuadraticPattern Q(problem.M, problem.D, problem.K);
    Eigen::MatrixXcd Y = problem.M * Eigen::MatrixXcd(X.conjugate());
    linalg::SparseFactor<Complex> lu;
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
        const Complex v = values(i) * (1 + 1e-7);
        if (v == 0.0 || !lu.factorize(Q.at(v))) {
            Y.col(i).setZero(); // not followed by this vector
            continue;
        }
        Eigen::VectorXcd y = Y.col(i);
        lu.solve_transposed(y);
        y = problem.M.transpose() * y;
        lu.solve_transposed(y);
        Y.col(i) = y / y.cwiseAbs().maxCoeff();
    }
    return Y;
}

} // namespace whirl::modes

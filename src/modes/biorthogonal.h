#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <complex>
#include <cstddef>
#include <vector>

namespace whirl::modes {

/// Q(v) = v^2 M + v D + K at one speed.
template <class Scalar> struct QuadraticOf {
    using Sparse = Eigen::SparseMatrix<Scalar>;
    struct Rates {
        Sparse D, K;
    };
    Sparse M, D, K;
    /// Change with speed, towards lower and higher ones: they differ at the rows of bearing tables.
    Rates below, above;
    bool smooth = true; ///< both are the same
};

/// In the symmetric forms v is real, l = i v, and M stands with a minus.
using QuadraticAt = QuadraticOf<double>;
/// With complex symmetric matrices (form planar_damped), l itself in the place of v.
using ComplexQuadraticAt = QuadraticOf<std::complex<double>>;

/// Of a reduced rotor, what states and rates need.
struct DenseQuadraticAt {
    struct Rates {
        Eigen::MatrixXcd D, K;
    };
    Eigen::MatrixXcd M, K;
    Rates below, above;
    bool smooth = true;
};

/// Right and left eigenvectors of some modes at one speed as states (x, v x), so that products
/// left^T right of one speed are the unit matrix. With y the left vector of the problem itself,
/// y^T Q(v) = 0, the left state is (K^T y, -v M^T y) / y^T (K - v^2 M) x: two modes of one problem
/// have y1^T (K - v1 v2 M) x2 = 0 (theory.md, "Following modes"). Real in the symmetric forms,
/// complex in the others; the other pair is empty. A mode with v = 0 has zeros.
struct ModeBasis {
    Eigen::MatrixXd left, right;
    Eigen::MatrixXcd complex_left, complex_right;
    [[nodiscard]] bool is_complex() const { return complex_left.size() > 0; }
    /// In rotating axes a mode may be followed by an alias of its continuation, its conjugate or
    /// one of a Hill series: right vectors of such aliases, and the alias that leads back from
    /// each.
    std::vector<Eigen::MatrixXcd> aliases;
    std::vector<std::size_t> ways_back;
    /// Of a Hill series: more aliases than the conjugate.
    [[nodiscard]] bool of_series() const { return aliases.size() > 1; }
    /// dv/dspeed of each mode towards lower and higher speeds; not a number where unknown.
    Eigen::VectorXcd rate_below, rate_above;
};

/// Products of left and right vectors of two speeds, both ways, of the aliases that fit best: 1 for
/// a mode and itself, 0 for two modes of one speed. Rows of a, columns of b.
[[nodiscard]] Eigen::MatrixXd overlaps(const ModeBasis &a, const ModeBasis &b);

/// One of these products, with its phase; of a mode itself, not of its aliases.
[[nodiscard]] std::complex<double> overlap(const ModeBasis &a, const ModeBasis &b, Eigen::Index i,
                                           Eigen::Index j);

/// Eigenpairs of a symmetric problem: left vectors are the right ones.
[[nodiscard]] ModeBasis basis_of(const QuadraticAt &problem, const Eigen::VectorXd &values,
                                 const Eigen::MatrixXd &vectors);

/// Complex symmetric problem: left vectors are the right ones.
[[nodiscard]] ModeBasis basis_of(const ComplexQuadraticAt &problem, const Eigen::VectorXcd &values,
                                 const Eigen::MatrixXcd &vectors);

/// @param left  left vectors of the problem, of any length
[[nodiscard]] ModeBasis basis_of(const QuadraticAt &problem, const Eigen::VectorXcd &values,
                                 const Eigen::MatrixXcd &vectors, const Eigen::MatrixXcd &left);

[[nodiscard]] ModeBasis basis_of(const DenseQuadraticAt &problem, const Eigen::VectorXcd &values,
                                 const Eigen::MatrixXcd &vectors, const Eigen::MatrixXcd &left);

/// Left vectors of a problem that is its transpose seen in a mirror (y -> -y): the right ones
/// mirrored.
[[nodiscard]] Eigen::MatrixXcd mirrored_vectors(Eigen::MatrixXcd right);

/// Left vectors by inverse iteration next to each eigenvalue.
[[nodiscard]] Eigen::MatrixXcd left_vectors(const QuadraticAt &problem,
                                            const Eigen::VectorXcd &values,
                                            const Eigen::MatrixXcd &right);

} // namespace whirl::modes

#include "modes/roots/roots.h"

#include "linalg/check.h"
#include "linalg/dense/complex_factors.h"
#include "linalg/dense/general_eigen.h"
#include "linalg/dense/products.h"
#include "linalg/symmetric_eigen.h"
#include "linalg/unit_scales.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace whirl::modes {

namespace {

using Complex = std::complex<double>;
constexpr double machine = std::numeric_limits<double>::epsilon();

/// Allowances over the rounding of matrix entries and of the decomposition.
constexpr double of_entries = 30;
constexpr double of_solver = 3;

/// Part of the largest mu (below): smaller ones are those of infinite roots.
constexpr double infinite = 1e-14;

/// The companion matrix in mu = 1/(s (l - shift)).
template <class Scalar> struct CompanionMatrix {
    using Matrix = typename DenseQuadratic<Scalar>::Matrix;
    Eigen::PartialPivLU<Matrix> lu; ///< of the problem at the shift
    Matrix C;
    double s = 1;

    CompanionMatrix(const DenseQuadratic<Scalar> &p, double shift)
        : lu(shift * shift * p.M + shift * p.D + p.K) {
        const Eigen::Index n = p.M.rows();
        const Matrix slope = 2 * shift * p.M + p.D;
        const Matrix A = linalg::solved(lu, slope);
        const Matrix B = linalg::solved(lu, p.M);
        s = std::sqrt(std::max(B.norm(), A.squaredNorm()));
        C = Matrix::Zero(2 * n, 2 * n);
        C.topLeftCorner(n, n) = -A / s;
        C.topRightCorner(n, n) = -B / (s * s);
        C.bottomLeftCorner(n, n).setIdentity();
        if (!C.allFinite())
            throw linalg::SolverError("the matrix at the shift is singular");
    }
};

/// Its eigenvalues and vectors. Of a real matrix the vectors of a conjugate pair stand in two
/// columns.
template <class Scalar> struct Companion {
    using Matrix = typename DenseQuadratic<Scalar>::Matrix;
    static constexpr bool real = std::is_same_v<Scalar, double>;
    using Decomposition = std::conditional_t<real, linalg::GeneralEigen, linalg::ComplexEigen>;
    double s = 1;
    double norm = 0;
    Decomposition of; ///< states (mu x, x)
    Matrix right;     ///< mu x
    Matrix left;      ///< y of the problem itself

    Companion(const DenseQuadratic<Scalar> &p, double shift) {
        const Eigen::Index n = p.M.rows();
        CompanionMatrix<Scalar> matrix(p, shift);
        s = matrix.s;
        norm = matrix.C.norm();
        if constexpr (real)
            of = linalg::general_eigen(std::move(matrix.C), linalg::Vectors::both);
        else
            of = linalg::general_eigen(std::move(matrix.C));
        right = of.right.topRows(n);
        left = matrix.lu.adjoint().solve(Matrix(of.left.topRows(n)));
    }

    /// Of a conjugate pair the first column.
    [[nodiscard]] bool pair(Eigen::Index j) const { return real && of.values(j).imag() > 0; }
    [[nodiscard]] Eigen::VectorXcd vector(const Matrix &a, Eigen::Index j) const {
        if constexpr (real)
            return linalg::unpacked(a, j, pair(j));
        else
            return a.col(j);
    }
    /// a^H b of a root.
    [[nodiscard]] Complex product(const Matrix &a, const Matrix &b, Eigen::Index j) const {
        if constexpr (real)
            return linalg::packed_product(a, b, j, pair(j));
        else
            return a.col(j).dot(b.col(j));
    }
    [[nodiscard]] double length(const Matrix &a, Eigen::Index j) const {
        return a.middleCols(j, pair(j) ? 2 : 1).norm();
    }
    /// Moduli of vectors, in the first of their columns.
    [[nodiscard]] Eigen::MatrixXd moduli(const Matrix &packed) const {
        Eigen::MatrixXd out = packed.cwiseAbs();
        for (Eigen::Index j = 0; j + 1 < out.cols(); ++j)
            if (pair(j))
                out.col(j) = (out.col(j).array().square() + out.col(j + 1).array().square()).sqrt();
        return out;
    }
};

/// |y|^T |A| |x| of each root, in the first of its columns.
template <class Matrix>
Eigen::VectorXd sizes(const Eigen::MatrixXd &y, const Matrix &A, const Eigen::MatrixXd &x) {
    const Eigen::MatrixXd entries = A.cwiseAbs();
    const Eigen::MatrixXd forces = linalg::times(entries, x);
    return y.cwiseProduct(forces).colwise().sum();
}

Root conjugate(Root root) {
    root.value = std::conj(root.value);
    root.rate = std::conj(root.rate);
    root.slope = std::conj(root.slope);
    root.right = root.right.conjugate().eval();
    root.left = root.left.conjugate().eval();
    return root;
}

template <class Value, class Modulus>
void drop_zeros(std::vector<Value> &roots, int zeros, const Modulus &modulus) {
    std::ranges::stable_sort(roots, {}, modulus);
    roots.erase(roots.begin(), roots.begin() + std::min<std::ptrdiff_t>(zeros, std::ssize(roots)));
}

/// Deflections, slopes and balls have different units.
template <class Scalar> Eigen::VectorXd unit_scales(const DenseQuadratic<Scalar> &p, double shift) {
    return linalg::scales_at(shift, p.M.diagonal().cwiseAbs(), p.K.diagonal().cwiseAbs());
}

template <class Scalar>
DenseQuadratic<Scalar> scaled(const DenseQuadratic<Scalar> &p, const Eigen::VectorXd &d) {
    using Matrix = typename DenseQuadratic<Scalar>::Matrix;
    const auto of = [&d](const Matrix &A) -> Matrix {
        return A.size() == 0 ? A : Matrix(d.asDiagonal() * A * d.asDiagonal());
    };
    return {of(p.M), of(p.D), of(p.K), of(p.D_rate), of(p.K_rate)};
}

} // namespace

template <class Scalar>
std::vector<Root> all_roots(const DenseQuadratic<Scalar> &unscaled, double shift, int zeros) {
    using Matrix = typename DenseQuadratic<Scalar>::Matrix;
    const Eigen::VectorXd d = unit_scales(unscaled, shift);
    const DenseQuadratic<Scalar> p = scaled(unscaled, d);
    const Companion<Scalar> c(p, shift);
    const bool rates = p.D_rate.size() > 0;
    const Matrix turned_D = rates ? linalg::times(p.D_rate, c.right) : Matrix();
    const Matrix turned_K = rates ? linalg::times(p.K_rate, c.right) : Matrix();
    const Eigen::MatrixXd right_size = c.moduli(c.right);
    const Eigen::MatrixXd left_size = c.moduli(c.left);
    const Eigen::VectorXd m_size = sizes(left_size, p.M, right_size);
    const Eigen::VectorXd g_size = sizes(left_size, p.D, right_size);
    const Eigen::VectorXd k_size = sizes(left_size, p.K, right_size);
    const double smallest = infinite * c.of.values.cwiseAbs().maxCoeff();
    std::vector<Root> out;
    for (Eigen::Index j = 0; j < c.of.values.size(); ++j) {
        const Complex mu = c.of.values(j);
        if (std::abs(mu) <= smallest || (Companion<Scalar>::real && mu.imag() < 0))
            continue;
        const double lengths = c.length(c.of.right, j) * c.length(c.of.left, j);
        // Vectors of a repeated root can coincide to the last digit (balls near rest).
        const Complex product = std::abs(c.of.products(j)) > machine * lengths
                                    ? c.of.products(j)
                                    : Complex(machine * lengths);
        Root root;
        const Complex l = shift + 1.0 / (c.s * mu);
        const Complex slope = -c.s * mu * product; // y^H Q'(l) mu x
        root.value = l;
        root.slope = slope;
        if (rates)
            root.rate =
                -(l * c.product(c.left, turned_D, j) + c.product(c.left, turned_K, j)) / slope;
        const double size = std::abs(l);
        const double entries = size * size * m_size(j) + size * g_size(j) + k_size(j);
        const double condition = lengths / std::abs(product);
        root.noise = machine * (of_entries * entries / std::abs(slope) +
                                of_solver * c.norm * condition * c.s * std::norm(l - shift) +
                                of_entries * size);
        root.right = d.asDiagonal() * c.vector(c.right, j);
        root.left = d.asDiagonal() * c.vector(c.left, j);
        if (c.pair(j))
            out.push_back(conjugate(root));
        out.push_back(std::move(root));
    }
    drop_zeros(out, zeros, [](const Root &root) { return std::abs(root.value); });
    return out;
}

template <class Scalar>
std::vector<Root> sharp_roots(const DenseQuadratic<Scalar> &problem, double shift, int zeros,
                              int lowest) {
    constexpr double sharp = 1e-10; // relative: of whirls as near as this each is to be found
    constexpr double far = 1e3;     // of the shift: nearer ones have other reasons to be blurred
    constexpr double clear = 1.2;   // ratio of moduli between which roots are divided
    const auto size = [](const Root &root) { return std::abs(root.value); };
    std::vector<Root> out = all_roots(problem, shift, zeros);
    std::ranges::stable_sort(out, {}, size);
    for (std::ptrdiff_t known = -1;;) {
        const auto end = out.begin() + std::min<std::ptrdiff_t>(lowest, std::ssize(out));
        const auto blurred = std::find_if(out.begin(), end, [&](const Root &root) {
            return size(root) > far * shift && root.noise > sharp * size(root);
        });
        if (blurred == end)
            return out;
        std::ptrdiff_t first = blurred - out.begin();
        while (first > 0 && size(out[first]) < clear * size(out[first - 1]))
            --first;
        if (first <= known)
            return out; // double precision has no more
        known = first;
        shift = usual_shift(0, size(out[first]));
        std::vector<Root> faster = all_roots(problem, shift, zeros + static_cast<int>(known));
        std::ranges::stable_sort(faster, {}, size);
        out.resize(known);
        std::ranges::move(faster, std::back_inserter(out));
    }
}

Root with_vectors(const DenseQuadratic<double> &p, Complex value) {
    constexpr double offset = 1e-8; // of the value: far above its rounding, and nearer than others
    constexpr int solves = 2;
    const Complex l = value * (1 + offset);
    linalg::ComplexFactors factors;
    if (!factors.factorize((l * l * p.M.cast<Complex>() + l * p.D.cast<Complex>()).eval() +
                           p.K.cast<Complex>()))
        throw linalg::SolverError("the matrix beside an eigenvalue is singular");
    Root out;
    out.value = value;
    out.right = linalg::deterministic_vector(static_cast<int>(p.M.rows())).cast<Complex>();
    out.left = out.right;
    for (int solve = 0; solve < solves; ++solve) {
        out.right = factors.solution(std::move(out.right)).normalized();
        out.left = factors.adjoint_solution(std::move(out.left)).normalized();
    }
    const Eigen::VectorXcd M_x = p.M * out.right;
    const Eigen::VectorXcd D_x = p.D * out.right;
    const Eigen::VectorXcd K_x = p.K * out.right;
    const Complex left_over = out.left.dot(value * value * M_x + value * D_x + K_x);
    out.slope = out.left.dot(2.0 * value * M_x + D_x);
    // Beside an almost equal root the quotient would lead away: to a double one by half of the way
    // at a time.
    constexpr double of_step = 4;
    const Complex step = left_over / out.slope;
    out.sharp = std::abs(step) < offset * std::abs(value);
    if (out.sharp)
        out.value -= step;
    const double size = std::abs(value);
    const Eigen::MatrixXd entries =
        size * size * p.M.cwiseAbs() + size * p.D.cwiseAbs() + p.K.cwiseAbs();
    out.noise =
        (out.sharp ? 0 : of_step * std::abs(step)) +
        machine * of_entries *
            (out.left.cwiseAbs().dot(entries * out.right.cwiseAbs()) / std::abs(out.slope) + size);
    return out;
}

std::vector<Complex> all_values(const DenseQuadratic<double> &problem, double shift, int zeros) {
    CompanionMatrix<double> matrix(scaled(problem, unit_scales(problem, shift)), shift);
    const Eigen::VectorXcd mu = linalg::general_eigenvalues(std::move(matrix.C));
    const double smallest = infinite * mu.cwiseAbs().maxCoeff();
    std::vector<Complex> out;
    for (const Complex &value : mu)
        if (std::abs(value) > smallest)
            out.push_back(shift + 1.0 / (matrix.s * value));
    drop_zeros(out, zeros, [](Complex value) { return std::abs(value); });
    return out;
}

template std::vector<Root> all_roots(const DenseQuadratic<double> &, double, int);
template std::vector<Root> all_roots(const DenseQuadratic<Complex> &, double, int);
template std::vector<Root> sharp_roots(const DenseQuadratic<double> &, double, int, int);
template std::vector<Root> sharp_roots(const DenseQuadratic<Complex> &, double, int, int);

} // namespace whirl::modes

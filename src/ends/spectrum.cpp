#include "ends/spectrum.h"

#include "linalg/check.h"
#include "linalg/dense/general_eigen.h"
#include "linalg/dense/products.h"
#include "linalg/unit_scales.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::ends {

namespace {

using Complex = std::complex<double>;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Allowances over the rounding of matrix entries and of the decomposition.
constexpr double of_entries = 30;
constexpr double of_solver = 3;

/// The companion matrix in mu = 1/(s (l - shift)), its eigenvalues and vectors.
struct Companion {
    double s = 1;
    double norm = 0;
    linalg::GeneralEigen of; ///< states (mu x, x)
    Eigen::MatrixXd right;   ///< mu x, in two columns where complex
    Eigen::MatrixXd left;    ///< y of the problem itself, in the same way
};

Companion decomposed(const DenseProblem &p, double shift) {
    const Eigen::Index n = p.M.rows();
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(shift * shift * p.M + shift * p.D + p.K);
    const Eigen::MatrixXd slope = 2 * shift * p.M + p.D;
    const Eigen::MatrixXd A = linalg::solved(lu, slope);
    const Eigen::MatrixXd B = linalg::solved(lu, p.M);
    Companion out;
    out.s = std::sqrt(std::max(B.norm(), A.squaredNorm()));
    Eigen::MatrixXd C = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    C.topLeftCorner(n, n) = -A / out.s;
    C.topRightCorner(n, n) = -B / (out.s * out.s);
    C.bottomLeftCorner(n, n).setIdentity();
    if (!C.allFinite())
        throw linalg::SolverError("the matrix at the shift is singular");
    out.norm = C.norm();
    out.of = linalg::general_eigen(std::move(C), linalg::Vectors::both);
    out.right = out.of.right.topRows(n);
    out.left = lu.transpose().solve(Eigen::MatrixXd(out.of.left.topRows(n)));
    return out;
}

/// Moduli of vectors in two columns each where complex, in the first of them.
Eigen::MatrixXd moduli(const linalg::GeneralEigen &of, const Eigen::MatrixXd &packed) {
    Eigen::MatrixXd out = packed.cwiseAbs();
    for (Eigen::Index j = 0; j + 1 < out.cols(); ++j)
        if (of.is_pair(j))
            out.col(j) = (packed.col(j).array().square() + packed.col(j + 1).array().square())
                             .sqrt()
                             .matrix();
    return out;
}

/// |y|^T |A| |x| of each root, in the first of its columns.
Eigen::VectorXd sizes(const Eigen::MatrixXd &y, const Eigen::MatrixXd &A,
                      const Eigen::MatrixXd &x) {
    const Eigen::MatrixXd entries = A.cwiseAbs();
    const Eigen::MatrixXd forces = entries * x;
    Eigen::VectorXd out(x.cols());
    for (Eigen::Index j = 0; j < x.cols(); ++j)
        out(j) = y.col(j).dot(forces.col(j));
    return out;
}

Root conjugate(Root root) {
    root.value = std::conj(root.value);
    root.rate = std::conj(root.rate);
    root.slope = std::conj(root.slope);
    root.right = root.right.conjugate().eval();
    root.left = root.left.conjugate().eval();
    return root;
}

void drop_zeros(std::vector<Root> &roots, int zeros) {
    std::ranges::stable_sort(roots, {}, [](const Root &a) { return std::abs(a.value); });
    roots.erase(roots.begin(), roots.begin() + std::min<std::ptrdiff_t>(zeros, std::ssize(roots)));
}

DenseProblem scaled(const DenseProblem &p, const Eigen::VectorXd &d) {
    const auto of = [&d](const Eigen::MatrixXd &A) -> Eigen::MatrixXd {
        return d.asDiagonal() * A * d.asDiagonal();
    };
    return {of(p.M), of(p.D), of(p.K), of(p.D_rate), of(p.K_rate)};
}

} // namespace

int Spectrum::growing() const {
    return static_cast<int>(
        std::ranges::count_if(roots, [](const Root &r) { return r.sign() > 0; }));
}

const Root &Spectrum::nearest(std::complex<double> value) const {
    return *std::ranges::min_element(roots, {},
                                     [&](const Root &a) { return std::abs(a.value - value); });
}

Spectrum all_roots(const DenseProblem &unscaled, double speed, double shift, int zeros) {
    // Deflections, slopes and balls have different units.
    const Eigen::VectorXd d =
        linalg::scales_at(shift, unscaled.M.diagonal(), unscaled.K.diagonal());
    const DenseProblem p = scaled(unscaled, d);
    const Companion c = decomposed(p, shift);
    const Eigen::MatrixXd turned_D = p.D_rate * c.right;
    const Eigen::MatrixXd turned_K = p.K_rate * c.right;
    const Eigen::MatrixXd right_size = moduli(c.of, c.right);
    const Eigen::MatrixXd left_size = moduli(c.of, c.left);
    const Eigen::VectorXd m_size = sizes(left_size, p.M, right_size);
    const Eigen::VectorXd g_size = sizes(left_size, p.D, right_size);
    const Eigen::VectorXd k_size = sizes(left_size, p.K, right_size);
    const double smallest = 1e-14 * c.of.values.cwiseAbs().maxCoeff(); // below: infinite roots
    Spectrum out{speed, {}, unscaled};
    for (Eigen::Index j = 0; j < c.of.values.size(); ++j) {
        const Complex mu = c.of.values(j);
        if (std::abs(mu) <= smallest || mu.imag() < 0)
            continue;
        const bool pair = c.of.is_pair(j);
        const double lengths =
            linalg::packed_norm(c.of.right, j, pair) * linalg::packed_norm(c.of.left, j, pair);
        // Vectors of a repeated root can coincide to the last digit (balls near rest).
        const Complex product = std::abs(c.of.products(j)) > epsilon * lengths
                                    ? c.of.products(j)
                                    : Complex(epsilon * lengths);
        Root root;
        const Complex l = shift + 1.0 / (c.s * mu);
        const Complex slope = -c.s * mu * product; // y^H Q'(l) mu x
        root.value = l;
        root.slope = slope;
        root.rate = -(l * linalg::packed_product(c.left, turned_D, j, pair) +
                      linalg::packed_product(c.left, turned_K, j, pair)) /
                    slope;
        const double size = std::abs(l);
        const double entries = size * size * m_size(j) + size * g_size(j) + k_size(j);
        const double condition = lengths / std::abs(product);
        root.noise = epsilon * (of_entries * entries / std::abs(slope) +
                                of_solver * c.norm * condition * c.s * std::norm(l - shift) +
                                of_entries * size);
        root.right = d.asDiagonal() * linalg::unpacked(c.right, j, pair);
        root.left = d.asDiagonal() * linalg::unpacked(c.left, j, pair);
        if (pair)
            out.roots.push_back(conjugate(root));
        out.roots.push_back(std::move(root));
    }
    drop_zeros(out.roots, zeros);
    return out;
}

} // namespace whirl::ends

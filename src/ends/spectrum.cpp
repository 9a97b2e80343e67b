#include "ends/spectrum.h"

#include "linalg/check.h"
#include "linalg/unit_scales.h"

#include <Eigen/Eigenvalues>
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

/// The companion matrix in mu = 1/(s (l - shift)), its eigenvectors and their inverse.
struct Companion {
    double s = 1;
    double norm = 0;
    Eigen::VectorXcd mu;
    Eigen::MatrixXcd right;   ///< states (mu x, x), a column each
    Eigen::MatrixXcd inverse; ///< of right: left states, a row each
    Eigen::MatrixXcd left;    ///< y^H of the problem itself, a row each
};

/// Inverse; where vectors of a repeated root coincide to the last digit (balls near rest), that of
/// a matrix a rounding error away: the rows of these vectors are then large, those of others as
/// they would be.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd &A) {
    Eigen::MatrixXd out = Eigen::PartialPivLU<Eigen::MatrixXd>(A).inverse();
    if (out.allFinite())
        return out;
    const auto uneven = [&A](Eigen::Index i, Eigen::Index j) {
        return std::sin(static_cast<double>(1 + i + j * A.rows()));
    };
    const auto n = A.rows();
    const Eigen::MatrixXd near = A + epsilon * Eigen::MatrixXd::NullaryExpr(n, n, uneven);
    return Eigen::PartialPivLU<Eigen::MatrixXd>(near).inverse();
}

/// Inverse of the matrix of eigenvectors, in real arithmetic: with u, v in the place of a pair
/// u +- i v, whose rows in the inverse are then half of (row of u) -+ i (row of v).
Eigen::MatrixXcd inverse_of_vectors(const Eigen::EigenSolver<Eigen::MatrixXd> &solver) {
    const Eigen::VectorXcd &values = solver.eigenvalues();
    const Eigen::Index n = values.size();
    const Eigen::MatrixXcd vectors = solver.eigenvectors();
    Eigen::MatrixXd parts(n, n);
    for (Eigen::Index j = 0; j < n; ++j)
        if (j + 1 < n && values(j).imag() != 0) {
            parts.col(j) = vectors.col(j).real();
            parts.col(j + 1) = vectors.col(j).imag();
            ++j;
        } else {
            parts.col(j) = vectors.col(j).real();
        }
    const Eigen::MatrixXd rows = inverse_of(parts);
    Eigen::MatrixXcd out = rows.cast<Complex>();
    for (Eigen::Index j = 0; j + 1 < n; ++j)
        if (values(j).imag() != 0) {
            out.row(j).real() = rows.row(j) / 2;
            out.row(j).imag() = -rows.row(j + 1) / 2;
            out.row(j + 1) = out.row(j).conjugate();
            ++j;
        }
    return out;
}

Companion decomposed(const DenseProblem &p, double shift) {
    const Eigen::Index n = p.M.rows();
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(shift * shift * p.M + shift * p.D + p.K);
    const Eigen::MatrixXd A = lu.solve(2 * shift * p.M + p.D);
    const Eigen::MatrixXd B = lu.solve(p.M);
    Companion out;
    out.s = std::sqrt(std::max(B.norm(), A.squaredNorm()));
    Eigen::MatrixXd C = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    C.topLeftCorner(n, n) = -A / out.s;
    C.topRightCorner(n, n) = -B / (out.s * out.s);
    C.bottomLeftCorner(n, n).setIdentity();
    if (!C.allFinite())
        throw linalg::SolverError("the matrix at the shift is singular");
    out.norm = C.norm();
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(C);
    if (solver.info() != Eigen::Success)
        throw linalg::SolverError("the dense eigensolver did not converge");
    out.mu = solver.eigenvalues();
    out.right = solver.eigenvectors();
    out.inverse = inverse_of_vectors(solver);
    const Eigen::MatrixXcd W = out.inverse.leftCols(n).transpose();
    Eigen::MatrixXcd Y(n, 2 * n);
    Y.real() = lu.transpose().solve(Eigen::MatrixXd(W.real()));
    Y.imag() = lu.transpose().solve(Eigen::MatrixXd(W.imag()));
    out.left = Y.transpose();
    return out;
}

Eigen::MatrixXcd times(const Eigen::MatrixXd &A, const Eigen::MatrixXcd &X) {
    Eigen::MatrixXcd out(A.rows(), X.cols());
    out.real() = A * X.real();
    out.imag() = A * X.imag();
    return out;
}

/// Scalars y^H A x, one for each root.
Eigen::VectorXcd products(const Eigen::MatrixXcd &left, const Eigen::MatrixXd &A,
                          const Eigen::MatrixXcd &X) {
    return left.cwiseProduct(times(A, X).transpose()).rowwise().sum();
}

Eigen::VectorXd sizes(const Eigen::MatrixXcd &left, const Eigen::MatrixXd &A,
                      const Eigen::MatrixXcd &X) {
    const Eigen::MatrixXd AX = A.cwiseAbs() * X.cwiseAbs();
    return left.cwiseAbs().cwiseProduct(AX.transpose()).rowwise().sum();
}

void drop_zeros(std::vector<Root> &roots, int zeros) {
    std::stable_sort(roots.begin(), roots.end(), [](const Root &a, const Root &b) {
        return std::abs(a.value) < std::abs(b.value);
    });
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
        std::count_if(roots.begin(), roots.end(), [](const Root &r) { return r.sign() > 0; }));
}

const Root &Spectrum::nearest(std::complex<double> value) const {
    return *std::min_element(roots.begin(), roots.end(), [&](const Root &a, const Root &b) {
        return std::abs(a.value - value) < std::abs(b.value - value);
    });
}

Spectrum all_roots(const DenseProblem &unscaled, double speed, double shift, int zeros) {
    // Deflections, slopes and balls have different units.
    const Eigen::VectorXd d =
        linalg::scales_at(shift, unscaled.M.diagonal(), unscaled.K.diagonal());
    const DenseProblem p = scaled(unscaled, d);
    const Eigen::Index n = p.M.rows();
    const Companion c = decomposed(p, shift);
    const Eigen::MatrixXcd X = c.right.topRows(n);
    const Eigen::VectorXcd m = products(c.left, p.M, X);
    const Eigen::VectorXcd g = products(c.left, p.D, X);
    const Eigen::VectorXcd g_rate = products(c.left, p.D_rate, X);
    const Eigen::VectorXcd k_rate = products(c.left, p.K_rate, X);
    const Eigen::VectorXd m_size = sizes(c.left, p.M, X);
    const Eigen::VectorXd g_size = sizes(c.left, p.D, X);
    const Eigen::VectorXd k_size = sizes(c.left, p.K, X);
    const double smallest = 1e-14 * c.mu.cwiseAbs().maxCoeff(); // below: infinite eigenvalues
    Spectrum out{speed, {}};
    for (Eigen::Index i = 0; i < 2 * n; ++i) {
        if (std::abs(c.mu(i)) <= smallest)
            continue;
        Root root;
        const Complex l = shift + 1.0 / (c.s * c.mu(i));
        const Complex slope = 2.0 * l * m(i) + g(i);
        root.value = l;
        root.rate = -(l * g_rate(i) + k_rate(i)) / slope;
        const double size = std::abs(l);
        const double entries = size * size * m_size(i) + size * g_size(i) + k_size(i);
        const double condition = c.right.col(i).norm() * c.inverse.row(i).norm();
        root.noise = epsilon * (of_entries * entries / std::abs(slope) +
                                of_solver * c.norm * condition * c.s * std::norm(l - shift) +
                                of_entries * size);
        root.right = d.asDiagonal() * X.col(i);
        root.left = d.asDiagonal() * c.left.row(i).adjoint();
        out.roots.push_back(std::move(root));
    }
    drop_zeros(out.roots, zeros);
    return out;
}

} // namespace whirl::ends

#include "periodic/collocation.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <vector>

namespace whirl::periodic {

namespace {

using Real = long double; // the transformation costs some four digits
using LongMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using LongComplex = std::complex<Real>;
using LongComplexMatrix = Eigen::Matrix<LongComplex, Eigen::Dynamic, Eigen::Dynamic>;

/// X of A X = B by elimination with row pivots. Written out for these few rows: Eigen's factors in
/// long double take longer to compile than a whole room.
template <class Matrix> Matrix solved(Matrix A, Matrix B) {
    const Eigen::Index n = A.rows();
    for (Eigen::Index k = 0; k < n; ++k) {
        Eigen::Index pivot = k;
        for (Eigen::Index i = k + 1; i < n; ++i)
            if (std::abs(A(i, k)) > std::abs(A(pivot, k)))
                pivot = i;
        for (Eigen::Index j = 0; j < n; ++j)
            std::swap(A(k, j), A(pivot, j));
        for (Eigen::Index j = 0; j < B.cols(); ++j)
            std::swap(B(k, j), B(pivot, j));
        for (Eigen::Index i = 0; i < n; ++i) { // rows above as well: B becomes X
            if (i == k)
                continue;
            const auto factor = A(i, k) / A(k, k);
            for (Eigen::Index j = k + 1; j < n; ++j)
                A(i, j) -= factor * A(k, j);
            for (Eigen::Index j = 0; j < B.cols(); ++j)
                B(i, j) -= factor * B(k, j);
        }
    }
    for (Eigen::Index k = 0; k < n; ++k)
        for (Eigen::Index j = 0; j < B.cols(); ++j)
            B(k, j) /= A(k, k);
    return B;
}

/// P_s - P_(stages-1), Legendre polynomials on [-1, 1], and its derivative; its zeros are the
/// points.
std::pair<Real, Real> radau_polynomial(Real x) {
    Real before = 1;
    Real now = x;
    Real slope_before = 0;
    Real slope = 1;
    for (int k = 1; k < stages; ++k) {
        const Real next = ((2 * k + 1) * x * now - k * before) / (k + 1);
        const Real slope_next = slope_before + (2 * k + 1) * now;
        before = now;
        now = next;
        slope_before = slope;
        slope = slope_next;
    }
    return {now - before, slope - slope_before};
}

std::vector<Real> points() {
    std::vector<Real> out;
    for (int k = stages - 1; k > 0; --k) { // all but the one at 1, ascending
        Real x = std::cos(std::numbers::pi_v<Real> * (2 * k) / (2 * stages - 1));
        for (int step = 0; step < 100; ++step) {
            const auto [value, slope] = radau_polynomial(x);
            x -= value / slope;
        }
        out.push_back((x + 1) / 2);
    }
    out.push_back(1);
    return out;
}

/// Integrals from 0 to each point of the polynomials that are 1 at one point and 0 at the others.
LongMatrix butcher_matrix(const std::vector<Real> &c) {
    LongMatrix powers(stages, stages);
    LongMatrix integrals(stages, stages);
    for (int i = 0; i < stages; ++i)
        for (int k = 0; k < stages; ++k) {
            powers(i, k) = std::pow(c[static_cast<std::size_t>(i)], static_cast<Real>(k));
            integrals(i, k) =
                std::pow(c[static_cast<std::size_t>(i)], static_cast<Real>(k + 1)) / (k + 1);
        }
    return solved<LongMatrix>(powers.transpose(), integrals.transpose()).transpose();
}

/// An eigenvalue of A with its vectors on the right and on the left, left^T right = 1.
struct Eigentriple {
    LongComplex value;
    LongComplexMatrix right, left; ///< (stages, 1)
};

/// From a value that is right to double precision: Rayleigh quotients of both vectors after each
/// step of inverse iteration, errors to the third power (Ostrowski 1959).
Eigentriple refined(const LongComplexMatrix &A, LongComplex value) {
    Eigentriple out{value, LongComplexMatrix::Ones(stages, 1), LongComplexMatrix::Ones(stages, 1)};
    constexpr int steps = 3; // the first finds the vectors, the second all digits
    for (int step = 0; step < steps; ++step) {
        LongComplexMatrix shifted = A;
        for (int k = 0; k < stages; ++k)
            shifted(k, k) -= out.value;
        out.right = solved<LongComplexMatrix>(shifted, out.right);
        out.left = solved<LongComplexMatrix>(shifted.transpose(), out.left);
        Real size = 0;
        for (int k = 0; k < stages; ++k)
            size = std::hypot(size, std::abs(out.right(k)));
        out.right /= LongComplex(size);
        LongComplex product = 0;
        LongComplex quotient = 0;
        for (int i = 0; i < stages; ++i) {
            product += out.left(i) * out.right(i);
            for (int j = 0; j < stages; ++j)
                quotient += out.left(i) * A(i, j) * out.right(j);
        }
        out.value = quotient / product;
        out.left /= product;
    }
    return out;
}

Collocation made() {
    const std::vector<Real> c = points();
    const LongMatrix inverse =
        solved<LongMatrix>(butcher_matrix(c), LongMatrix::Identity(stages, stages));
    const LongComplexMatrix complex_inverse = inverse.cast<LongComplex>();
    Collocation out{Eigen::VectorXd(stages), inverse.cast<double>(), Eigen::VectorXcd(stages / 2),
                    Eigen::MatrixXcd(stages, stages / 2), Eigen::MatrixXcd(stages / 2, stages)};
    for (int i = 0; i < stages; ++i)
        out.nodes(i) = static_cast<double>(c[static_cast<std::size_t>(i)]);
    const Eigen::VectorXcd values =
        Eigen::EigenSolver<Eigen::MatrixXd>(out.inverse, false).eigenvalues();
    int pair = 0;
    for (const std::complex<double> &near : values) {
        if (near.imag() <= 0) // of an even number of stages none is real
            continue;
        const Eigentriple found = refined(complex_inverse, LongComplex(near));
        out.roots(pair) = std::complex<double>(found.value);
        for (int i = 0; i < stages; ++i) {
            out.T(i, pair) = std::complex<double>(found.right(i));
            out.left(pair, i) = std::complex<double>(found.left(i));
        }
        ++pair;
    }
    return out;
}

} // namespace

const Collocation &collocation() {
    static const Collocation once = made();
    return once;
}

} // namespace whirl::periodic

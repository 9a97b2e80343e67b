#include "synchronous/linear_piece.h"

#include "linalg/quadratic/quadratic_eigen.h"
#include "linalg/sparse_sum.h"
#include "linalg/symmetric_eigen.h"
#include "linalg/unit_scales.h"
#include "synchronous/parts.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::synchronous {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// The piece in t = 1 .. 2, w = origin + t width: Q = K + t D + t^2 M. Away from t = 0, so that
/// errors relative to t are errors relative to the piece.
struct Piece {
    Piece(const Sparse &K_from, const Sparse &K_to, const Sparse &A, double from, double to)
        : width(to - from), origin(from - width), K(2 * K_from - K_to - origin * origin * A),
          D(K_to - K_from - 2 * origin * width * A), M(-width * width * A),
          size(K_from.cwiseAbs() + K_to.cwiseAbs()), absA(A.cwiseAbs()) {}

    double width, origin;
    Sparse K, D, M;
    Sparse size, absA; ///< of the entries, for rounding

    [[nodiscard]] double speed(double t) const { return origin + t * width; }
    [[nodiscard]] Sparse at(double t) const { return linalg::sum(1, K, t, D, t * t, M); }
};

/// The root of x^T Q(t) x near t: its error is the square of that of x.
double rayleigh(const Piece &piece, const Eigen::VectorXd &x, double t) {
    const double k = x.dot(piece.K * x);
    const double d = x.dot(piece.D * x);
    const double m = x.dot(piece.M * x);
    for (int step = 0; step < 3; ++step) {
        const double slope = d + 2 * t * m;
        const double value = k + t * d + t * t * m;
        // At a root where an eigenvalue only touches zero the slope vanishes.
        if (!(std::abs(value) < 1e-6 * std::abs(slope)))
            return t;
        t -= value / slope;
    }
    return t;
}

CrossingPair crossing_at(const Piece &piece, const linalg::ComplexPair &found,
                         const Eigen::VectorXd &x) {
    CrossingPair out;
    const double t = rayleigh(piece, x, found.value.real());
    const double w = piece.speed(t);
    const double slope = x.dot(piece.D * x) + 2 * t * x.dot(piece.M * x); // of x^T Q x over t
    const Eigen::VectorXd a = x.cwiseAbs();
    const double entries = a.dot(piece.size * a) + w * w * a.dot(piece.absA * a);
    out.pair.value = w;
    out.pair.vector = x / std::sqrt(entries);
    out.pair.residual = found.residual * t * piece.width / w;
    out.pair.rounding = std::numeric_limits<double>::epsilon() / 2 * entries * piece.width /
                        std::max(std::abs(slope) * w, 1e-300);
    out.downwards = slope < 0;
    return out;
}

/// Speeds, as t, in the two widest gaps between the roots and the ends of the piece.
std::vector<double> widest_gaps(const Piece &piece, const std::vector<CrossingPair> &roots) {
    std::vector<double> ends{1};
    for (const CrossingPair &root : roots)
        ends.push_back(std::clamp((root.pair.value - piece.origin) / piece.width, 1.0, 2.0));
    ends.push_back(2);
    std::vector<std::pair<double, double>> gaps; // width, middle
    for (std::size_t i = 0; i + 1 < ends.size(); ++i)
        gaps.emplace_back(ends[i + 1] - ends[i], (ends[i] + ends[i + 1]) / 2);
    std::sort(gaps.rbegin(), gaps.rend());
    std::vector<double> out;
    constexpr double no_room = 1e-6; // of the piece: too near to a root to count beside it
    for (const auto &[width, middle] : gaps)
        if (out.size() < 2 && width > no_room)
            out.push_back(middle);
    std::ranges::sort(out);
    return out;
}

bool counts_agree(const Piece &piece, const std::vector<CrossingPair> &roots) {
    const std::vector<double> at = widest_gaps(piece, roots);
    if (at.size() < 2)
        return true;
    int expected = 0;
    for (const CrossingPair &root : roots)
        if (root.pair.value > piece.speed(at[0]) && root.pair.value < piece.speed(at[1]))
            expected += root.downwards ? 1 : -1;
    return negative_eigenvalues(piece.at(at[1])) - negative_eigenvalues(piece.at(at[0])) ==
           expected;
}

/// Roots among the pairs: real ones in the piece. Double roots can come as a pair off the real
/// axis: by rounding where there are two vectors, by its square root where there is one.
std::vector<CrossingPair> real_ones(const Piece &piece,
                                    const std::vector<linalg::ComplexPair> &pairs) {
    constexpr double touching = 1e-7; // of the speed
    constexpr double at_an_end = 1e-10;
    std::vector<CrossingPair> out;
    for (const linalg::ComplexPair &pair : pairs) {
        const double w = piece.speed(pair.value.real());
        const double slack = at_an_end * w;
        if (w < piece.speed(1) - slack || w > piece.speed(2) + slack || !(w > 0))
            continue;
        if (std::abs(pair.value.imag()) * piece.width > touching * w)
            continue;
        out.push_back(crossing_at(piece, pair, pair.vector.real()));
        if (pair.value.imag() == 0)
            continue;
        if (out.back().pair.rounding < 1e-11) { // x^T Q' x is not zero: two vectors
            out.push_back(crossing_at(piece, pair, pair.vector.imag()));
        } else { // down and up again
            out.push_back(out.back());
            out.back().downwards = !out.back().downwards;
        }
    }
    std::ranges::stable_sort(out, {}, [](const auto &root) { return root.pair.value; });
    return out;
}

} // namespace

int negative_eigenvalues(const Sparse &Q) {
    // Unit diagonal: pivots are then not chosen, and not judged, by units.
    const Eigen::VectorXd d = unit_diagonal(Q.diagonal().cwiseAbs());
    return linalg::negative_pivots(Eigen::SimplicialLDLT<Sparse>(linalg::scaled(Q, d)));
}

PieceRoots roots_of_piece(const Sparse &K_from, const Sparse &K_to, const Sparse &A, double from,
                          double to) {
    const Piece piece(K_from, K_to, A, from, to);
    const int n = static_cast<int>(A.rows());
    PieceRoots out;
    for (int ask = 6;; ask *= 2) {
        linalg::QuadraticOptions options;
        options.shift = 1.5 + 0.00371; // no round number, where a root might stand
        options.wanted = std::min(ask, n);
        options.fewest = 1;
        const linalg::QuadraticResult found =
            linalg::solve_quadratic(piece.M, piece.D, piece.K, options);
        out.roots = real_ones(piece, found.pairs);
        out.complete = found.complete_radius >= 0.51;
        if (out.complete || options.wanted == n)
            break;
    }
    out.complete = out.complete && counts_agree(piece, out.roots);
    return out;
}

} // namespace whirl::synchronous

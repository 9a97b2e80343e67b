#include "criterion/sign_changes.h"

#include "linalg/check.h"
#include "linalg/dense/products.h"
#include "linalg/quadratic/quadratic_eigen.h"
#include "synchronous/parts.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace whirl::criterion {

namespace {

using Complex = std::complex<double>;
using Entries = std::vector<Eigen::Triplet<double>>;
using Sparse = Eigen::SparseMatrix<double>;

/// Real numbers in the place of complex unknowns, (Re, Im), where a rotor has such.
class RealUnknowns {
  public:
    /// @param size  complex unknowns
    RealUnknowns(int size, bool complex) : _size(size), _complex(complex) {}

    [[nodiscard]] int size() const { return (_complex ? 2 : 1) * _size; }

    /// factor A, at a row and a column; transposed: A^H.
    void add(const linalg::Matrix &A, Complex factor, int first, bool adjoint, Entries &out) const {
        const linalg::SparseView view = A.view();
        for (int i = 0; i < A.size(); ++i)
            for (linalg::SparseView::InnerIterator it(view, i); it; ++it) {
                const auto row = static_cast<int>(adjoint ? it.col() : it.row());
                const auto column = static_cast<int>(adjoint ? it.row() : it.col());
                put(first + row, first + column,
                    it.value() * (adjoint ? std::conj(factor) : factor), _size, _size, out);
            }
    }
    /// An entry of a block whose complex numbers have their imaginary parts so many rows and
    /// columns behind the real ones.
    void put(int row, int column, Complex value, int rows, int columns, Entries &out) const {
        const auto entry = [&out](int i, int j, double x) {
            if (x != 0)
                out.emplace_back(i, j, x);
        };
        entry(row, column, value.real());
        if (!_complex)
            return;
        entry(row + rows, column + columns, value.real());
        entry(row, column + columns, -value.imag());
        entry(row + rows, column, value.imag());
    }

  private:
    int _size;
    bool _complex;
};

/// Q(speed) = K + speed D + speed^2 M.
struct Quadratic {
    Sparse M, D, K;
};

Sparse matrix_of(int size, const Entries &entries) {
    Sparse out(size, size);
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
}

/// What a coefficient that is linear between two speeds is at zero, and how much more a unit of
/// speed.
struct Line {
    double at_zero_of_first, at_zero_of_second, slope_of_first, slope_of_second;

    Line(double from, double to)
        : at_zero_of_first(to > from ? to / (to - from) : 1),
          at_zero_of_second(to > from ? -from / (to - from) : 0),
          slope_of_first(to > from ? -1 / (to - from) : 0),
          slope_of_second(to > from ? 1 / (to - from) : 0) {}
};

/// The problem on (u, v, s): Z u = B s, Z^H v = B s, B^H (u + v) = 0.
/// @param first,second  the rotor with its bearings as at two speeds, linear between
/// @param B             loads of the imbalances, a column each
Quadratic bordered(const linalg::HarmonicTerms &first, const linalg::HarmonicTerms &second,
                   const Line &line, const Eigen::MatrixXcd &B) {
    const int n = first.K.size();
    const auto planes = static_cast<int>(B.cols());
    const auto empty = [](const linalg::Matrix &A) {
        return Sparse(A.view()).cwiseAbs().sum() == 0;
    };
    const bool complex =
        !empty(first.C) || !empty(first.G) || !empty(second.C) || !B.imag().isZero(0);
    const RealUnknowns unknowns(n, complex);
    Entries M;
    Entries D;
    Entries K;
    for (const bool adjoint : {false, true}) {
        const int at = adjoint ? unknowns.size() : 0;
        const auto add = [&](const linalg::Matrix &a, const linalg::Matrix &b, Complex factor,
                             Entries &constant, Entries &per_speed) {
            unknowns.add(a, factor * line.at_zero_of_first, at, adjoint, constant);
            unknowns.add(b, factor * line.at_zero_of_second, at, adjoint, constant);
            unknowns.add(a, factor * line.slope_of_first, at, adjoint, per_speed);
            unknowns.add(b, factor * line.slope_of_second, at, adjoint, per_speed);
        };
        constexpr Complex i(0, 1);
        add(first.K, second.K, 1, K, D);
        add(first.Kc, second.Kc, 1, D, M);
        add(first.C, second.C, i, D, M);
        unknowns.add(first.G, i, at, adjoint, M);
        // Masses of a table, linear too, would make it cubic: those of the middle.
        unknowns.add(first.M, -0.5, at, adjoint, M);
        unknowns.add(second.M, -0.5, at, adjoint, M);
    }
    // The imbalances in a unit by which they weigh as much as the stiffness.
    const double weight = Sparse(first.K.view()).diagonal().cwiseAbs().mean();
    const int border = 2 * unknowns.size();
    for (int row = 0; row < n; ++row)
        for (int j = 0; j < planes; ++j) {
            const Complex b = weight * B(row, j);
            for (const int at : {0, unknowns.size()}) {
                unknowns.put(at + row, border + j, -b, n, planes, K);
                unknowns.put(border + j, at + row, std::conj(b), planes, n, K);
            }
        }
    const int size = border + (complex ? 2 : 1) * planes;
    return {matrix_of(size, M), matrix_of(size, D), matrix_of(size, K)};
}

/// All roots no farther from the middle of the interval than its ends.
std::vector<linalg::ComplexPair> roots_about(const Quadratic &q, double from, double to) {
    linalg::QuadraticOptions options;
    options.shift = from + 0.4931 * (to - from); // no number that people choose
    options.fewest = 1;
    options.enough = to - options.shift;
    options.negligible = from;
    for (options.wanted = 8;; options.wanted *= 2) {
        linalg::QuadraticResult found = linalg::solve_quadratic(q.M, q.D, q.K, options);
        if (found.complete_radius >= options.enough)
            return std::move(found.pairs);
        if (options.wanted > q.K.rows())
            throw linalg::SolverError("speeds at which the criterion changes its sign are not "
                                      "resolved among the others");
    }
}

} // namespace

std::vector<double> sign_changes(const synchronous::ForwardReceptance &receptance,
                                 const Eigen::MatrixXd &range, double from, double to) {
    const Eigen::MatrixXcd B =
        linalg::times(receptance.places(), Eigen::MatrixXcd(range.cast<Complex>()));
    std::vector<double> borders{from};
    for (const double row : receptance.table_speeds())
        if (row > from && row < to)
            borders.push_back(row);
    borders.push_back(to);
    std::vector<double> out(borders.begin() + 1, borders.end() - 1); // a kink may touch zero
    linalg::HarmonicTerms first = receptance.system(from);
    for (std::size_t k = 0; k + 1 < borders.size(); ++k) {
        const bool varies = !receptance.table_speeds().empty();
        linalg::HarmonicTerms second = receptance.system(varies ? borders[k + 1] : from);
        const Line line(borders[k], varies ? borders[k + 1] : borders[k]);
        for (const linalg::ComplexPair &root :
             roots_about(bordered(first, second, line, B), borders[k], borders[k + 1])) {
            // Two roots that are nearly one part into the complex plane by the root of rounding.
            constexpr double near_the_axis = 1e-5;
            const double speed = root.value.real();
            if (std::abs(root.value.imag()) < near_the_axis * speed && speed > borders[k] &&
                speed < borders[k + 1])
                out.push_back(speed);
        }
        first = std::move(second);
    }
    std::ranges::sort(out);
    return out;
}

} // namespace whirl::criterion

#include "linalg/complex_factors.h"

#include "linalg/check.h"

#include <Eigen/OrderingMethods>

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl::linalg {

using Row = Eigen::Map<Eigen::RowVectorXcd>;

BandMatrix::BandMatrix(int size, int width)
    : _size(size), _width(width), _pivots(static_cast<std::size_t>(size)),
      _entries(static_cast<std::size_t>(size * (3 * width + 1))) {}

void BandMatrix::clear() { std::fill(_entries.begin(), _entries.end(), 0.0); }

/// L and U; exchanges of rows leave L as it is.
void BandMatrix::eliminate() {
    for (int k = 0; k < _size; ++k) {
        const int last_row = std::min(k + _width, _size - 1);
        const int last_column = std::min(k + 2 * _width, _size - 1);
        int pivot = k;
        for (int i = k + 1; i <= last_row; ++i)
            if (std::norm(entry(i, k)) > std::norm(entry(pivot, k)))
                pivot = i;
        if (pivot != k)
            for (int j = k; j <= last_column; ++j)
                std::swap(entry(k, j), entry(pivot, j));
        _pivots[static_cast<std::size_t>(k)] = pivot;
        const std::complex<double> diagonal = entry(k, k);
        if (!(std::abs(diagonal) > 0))
            throw SolverError("the band matrix is singular");
        for (int i = k + 1; i <= last_row; ++i) {
            if (entry(i, k) == 0.0)
                continue;
            const std::complex<double> factor = entry(i, k) / diagonal;
            entry(i, k) = factor;
            if (k < last_column)
                Row(&entry(i, k + 1), last_column - k) -=
                    factor * Row(&entry(k, k + 1), last_column - k);
        }
    }
}

Eigen::VectorXcd BandMatrix::solve(Eigen::VectorXcd b) {
    eliminate();
    return solve_again(std::move(b));
}

Eigen::VectorXcd BandMatrix::solve_again(Eigen::VectorXcd b) const {
    for (int k = 0; k < _size; ++k) {
        std::swap(b(k), b(_pivots[static_cast<std::size_t>(k)]));
        for (int i = k + 1; i <= std::min(k + _width, _size - 1); ++i)
            b(i) -= entry(i, k) * b(k);
    }
    for (int k = _size - 1; k >= 0; --k) {
        const int last_column = std::min(k + 2 * _width, _size - 1);
        for (int j = k + 1; j <= last_column; ++j)
            b(k) -= entry(k, j) * b(j);
        b(k) /= entry(k, k);
    }
    return b;
}

namespace {

/// Without the tests for infinities of the standard's product.
inline std::complex<double> product(std::complex<double> a, std::complex<double> b) {
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

} // namespace

SymmetricFactor::SymmetricFactor(const Sparse &pattern) {
    const auto n = static_cast<int>(pattern.rows());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
    Eigen::AMDOrdering<int> ordering;
    ordering(pattern, permutation);
    const auto &order = permutation.indices();
    std::vector<int> step(static_cast<std::size_t>(n)); // at which an unknown is eliminated
    for (int k = 0; k < n; ++k) {
        _order.push_back(order(k));
        step[static_cast<std::size_t>(order(k))] = k;
    }
    _first.push_back(0);
    for (int k = 0; k < n; ++k) {
        const int column = _order[static_cast<std::size_t>(k)];
        for (int p = pattern.outerIndexPtr()[column]; p < pattern.outerIndexPtr()[column + 1];
             ++p) {
            const int row = step[static_cast<std::size_t>(pattern.innerIndexPtr()[p])];
            if (row <= k)
                _entries.push_back({row, p});
        }
        _first.push_back(static_cast<int>(_entries.size()));
    }
    analyse();
}

/// Which columns of L each row reaches, in an order that respects their dependence (T. A. Davis,
/// Algorithm 849: a concise sparse Cholesky factorization package, ACM TOMS 31, 2005).
void SymmetricFactor::analyse() {
    const std::size_t n = _order.size();
    Eigen::VectorXi parent = Eigen::VectorXi::Constant(static_cast<Eigen::Index>(n), -1);
    Eigen::VectorXi flag = Eigen::VectorXi::Constant(static_cast<Eigen::Index>(n), -1);
    Eigen::VectorXi counts = Eigen::VectorXi::Constant(static_cast<Eigen::Index>(n), 0);
    std::vector<int> path(n);
    std::vector<int> reach(n); // filled from its end: later paths stand before earlier ones
    _reach_first.push_back(0);
    for (std::size_t k = 0; k < n; ++k) {
        const auto row = static_cast<int>(k);
        flag(row) = row;
        std::size_t top = n;
        for (int p = _first[k]; p < _first[k + 1]; ++p) {
            std::size_t length = 0;
            for (int i = _entries[static_cast<std::size_t>(p)].row; flag(i) != row; i = parent(i)) {
                if (parent(i) < 0)
                    parent(i) = row;
                ++counts(i);
                flag(i) = row;
                path[length++] = i;
            }
            while (length > 0)
                reach[--top] = path[--length];
        }
        for (; top < n; ++top)
            _reach.push_back(reach[top]);
        _reach_first.push_back(static_cast<int>(_reach.size()));
    }
    _start.push_back(0);
    for (const int count : counts)
        _start.push_back(_start.back() + count);
    _rows.resize(static_cast<std::size_t>(_start.back()));
    _L.resize(_rows.size());
    _D.resize(n);
    _inverse.resize(n);
    _work.assign(n, 0.0);
    _filled.resize(n);
}

void SymmetricFactor::factorize(const Sparse &A) {
    const std::size_t n = _order.size();
    const Complex *values = A.valuePtr();
    std::copy(_start.begin(), _start.end() - 1, _filled.begin());
    for (std::size_t k = 0; k < n; ++k) {
        for (int p = _first[k]; p < _first[k + 1]; ++p) {
            const Entry &entry = _entries[static_cast<std::size_t>(p)];
            _work[static_cast<std::size_t>(entry.row)] += values[entry.value];
        }
        Complex pivot = _work[k];
        _work[k] = 0;
        for (int r = _reach_first[k]; r < _reach_first[k + 1]; ++r) {
            const auto i = static_cast<std::size_t>(_reach[static_cast<std::size_t>(r)]);
            const Complex y = _work[i];
            _work[i] = 0;
            const auto end = static_cast<std::size_t>(_filled[i]);
            Complex *work = _work.data();
            const Complex *L = _L.data();
            const int *rows = _rows.data();
            for (auto p = static_cast<std::size_t>(_start[i]); p < end; ++p)
                work[rows[p]] -= product(L[p], y);
            const Complex l = product(y, _inverse[i]);
            pivot -= product(l, y);
            _rows[end] = static_cast<int>(k);
            _L[end] = l;
            ++_filled[i];
        }
        const double size = std::abs(pivot);
        if (!(size > 0) || !std::isfinite(size)) {
            _work.assign(n, 0.0);
            throw SolverError("a pivot of the symmetric factorisation is zero");
        }
        _D[k] = pivot;
        _inverse[k] = 1.0 / pivot;
    }
}

Eigen::VectorXcd SymmetricFactor::solve(const Eigen::VectorXcd &b) const {
    const std::size_t n = _order.size();
    std::vector<Complex> x(n);
    for (std::size_t k = 0; k < n; ++k)
        x[k] = b(_order[k]);
    for (std::size_t k = 0; k < n; ++k)
        for (auto p = static_cast<std::size_t>(_start[k]);
             p < static_cast<std::size_t>(_start[k + 1]); ++p)
            x[static_cast<std::size_t>(_rows[p])] -= product(_L[p], x[k]);
    for (std::size_t k = n; k-- > 0;) {
        x[k] = product(x[k], _inverse[k]);
        for (auto p = static_cast<std::size_t>(_start[k]);
             p < static_cast<std::size_t>(_start[k + 1]); ++p)
            x[k] -= product(_L[p], x[static_cast<std::size_t>(_rows[p])]);
    }
    Eigen::VectorXcd out(b.size());
    for (std::size_t k = 0; k < n; ++k)
        out(_order[k]) = x[k];
    return out;
}

RealEnergy::RealEnergy(const SymmetricFactor &factors)
    : _order(factors._order), _start(factors._start), _rows(factors._rows) {
    for (const std::complex<double> &entry : factors._L)
        _L.push_back(entry.real());
    for (const std::complex<double> &inverse : factors._inverse)
        _inverse.push_back(inverse.real());
}

double SymmetricFactor::determinant_phase() const {
    // Products of a few pivots at a time: an argument costs more than a product.
    double phase = 0;
    Complex some = 1;
    for (std::size_t k = 0; k < _D.size(); ++k) {
        some = product(some, _D[k] / std::abs(_D[k]));
        if (k % 64 == 63 || k + 1 == _D.size()) {
            phase += std::arg(some);
            some = 1;
        }
    }
    return phase;
}

} // namespace whirl::linalg

#include "linalg/dense/band_matrix.h"

#include "linalg/check.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl::linalg {

using Row = Eigen::Map<Eigen::RowVectorXcd>;

BandMatrix::BandMatrix(int size, int width)
    : _size(size), _width(width), _pivots(static_cast<std::size_t>(size)),
      _entries(static_cast<std::size_t>(size * (3 * width + 1))) {}

void BandMatrix::clear() { std::fill(_entries.begin(), _entries.end(), 0.0); }

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

Eigen::VectorXcd BandMatrix::solve(Eigen::VectorXcd b) const {
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

} // namespace whirl::linalg

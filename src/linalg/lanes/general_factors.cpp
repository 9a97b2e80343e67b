#include "linalg/lanes/general_factors.h"

#include <algorithm>

namespace whirl::linalg {

namespace {

/// Place of an entry of the pattern.
int place_of(const EliminationPattern::Sparse &pattern, int row, int column) {
    const int *first = pattern.innerIndexPtr() + pattern.outerIndexPtr()[column];
    const int *last = pattern.innerIndexPtr() + pattern.outerIndexPtr()[column + 1];
    return static_cast<int>(std::lower_bound(first, last, row) - pattern.innerIndexPtr());
}

} // namespace

GeneralFactors::GeneralFactors(const Sparse &pattern)
    : EliminationPattern(pattern), _L(_rows.size()), _U(_rows.size()), _inverse(_order.size()),
      _left(_order.size(), Complex4{}), _above(_order.size(), Complex4{}), _x(_order.size()) {
    for (std::size_t column = 0; column < _order.size(); ++column)
        for (int p = _first[column]; p < _first[column + 1]; ++p) {
            const auto row = static_cast<std::size_t>(_entries[static_cast<std::size_t>(p)].row);
            _mirrored.push_back(place_of(pattern, _order[column], _order[row]));
        }
}

/// Row k of L and column k of U by those before.
std::array<bool, lanes> GeneralFactors::factorize(const Vector4 &values) {
    in_lanes([&]() __attribute__((always_inline)) {
        Complex4 *left = _left.data();
        Complex4 *above = _above.data();
        Complex4 *L = _L.data();
        Complex4 *U = _U.data();
        const int *rows = _rows.data();
        for (std::size_t k = 0; k < _order.size(); ++k) {
            for (int p = _first[k]; p < _first[k + 1]; ++p) { // each once
                const auto [row, place] = _entries[static_cast<std::size_t>(p)];
                above[row] = values[static_cast<std::size_t>(place)];
                left[row] =
                    values[static_cast<std::size_t>(_mirrored[static_cast<std::size_t>(p)])];
            }
            Complex4 pivot = above[k];
            above[k] = left[k] = Complex4{};
            for (int r = _reach_first[k]; r < _reach_first[k + 1]; ++r) {
                const auto [column, end] = _reach[static_cast<std::size_t>(r)];
                const Complex4 u = above[column];
                Complex4 l;
                set_product(l, left[column], _inverse[static_cast<std::size_t>(column)]);
                above[column] = left[column] = Complex4{};
                for (int p = _start[static_cast<std::size_t>(column)]; p < end; ++p) {
                    subtract_product(above[rows[p]], L[p], u);
                    subtract_product(left[rows[p]], U[p], l);
                }
                L[end] = l;
                U[end] = u;
                subtract_product(pivot, l, u);
            }
            set_inverse(_inverse[k], pivot);
        }
    });
    return finite(_inverse);
}

void GeneralFactors::solve_transposed(Vector4 &b) const {
    in_lanes([&]() __attribute__((always_inline)) {
        const std::size_t n = _order.size();
        Complex4 *x = _x.data();
        const int *rows = _rows.data();
        for (std::size_t k = 0; k < n; ++k)
            x[k] = b[static_cast<std::size_t>(_order[k])];
        for (std::size_t k = 0; k < n; ++k) {
            Complex4 known;
            set_product(known, x[k], _inverse[k]);
            x[k] = known;
            for (int p = _start[k]; p < _start[k + 1]; ++p)
                subtract_product(x[rows[p]], _U[static_cast<std::size_t>(p)], known);
        }
        for (std::size_t k = n; k-- > 0;) {
            Complex4 sum = x[k];
            for (int p = _start[k]; p < _start[k + 1]; ++p)
                subtract_product(sum, _L[static_cast<std::size_t>(p)], x[rows[p]]);
            x[k] = sum;
        }
        for (std::size_t k = 0; k < n; ++k)
            b[static_cast<std::size_t>(_order[k])] = x[k];
    });
}

} // namespace whirl::linalg

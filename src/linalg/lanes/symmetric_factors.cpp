#include "linalg/lanes/symmetric_factors.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace whirl::linalg {

SymmetricFactors::SymmetricFactors(const Sparse &pattern)
    : EliminationPattern(pattern), _L(_rows.size()), _D(_order.size()), _inverse(_order.size()),
      _work(_order.size(), Complex4{}), _x(_order.size()) {}

std::vector<int> SymmetricFactors::places(std::size_t nonzeros) const {
    std::vector<int> out(nonzeros, -1);
    for (std::size_t entry = 0; entry < _entries.size(); ++entry)
        out[static_cast<std::size_t>(_entries[entry].place)] = static_cast<int>(entry);
    return out;
}

std::array<bool, lanes> SymmetricFactors::factorize(const Vector4 &values) {
    in_lanes([&]() __attribute__((always_inline)) {
        Complex4 *work = _work.data();
        Complex4 *L = _L.data();
        const int *rows = _rows.data();
        for (std::size_t k = 0; k < _order.size(); ++k) {
            for (auto p = static_cast<std::size_t>(_first[k]);
                 p < static_cast<std::size_t>(_first[k + 1]); ++p) // each once
                work[_entries[p].row] = values[p];
            Complex4 pivot = work[k];
            work[k] = Complex4{};
            for (int r = _reach_first[k]; r < _reach_first[k + 1]; ++r) {
                const auto [column, end] = _reach[static_cast<std::size_t>(r)];
                const Complex4 y = work[column];
                work[column] = Complex4{};
                for (int p = _start[static_cast<std::size_t>(column)]; p < end; ++p)
                    subtract_product(work[rows[p]], L[p], y);
                set_product(L[end], y, _inverse[static_cast<std::size_t>(column)]);
                subtract_product(pivot, L[end], y);
            }
            _D[k] = pivot;
            set_inverse(_inverse[k], pivot);
        }
    });
    return finite(_inverse);
}

void SymmetricFactors::solve(Vector4 &b) const {
    in_lanes([&]() __attribute__((always_inline)) {
        const std::size_t n = _order.size();
        Complex4 *x = _x.data();
        const int *rows = _rows.data();
        for (std::size_t k = 0; k < n; ++k)
            x[k] = b[static_cast<std::size_t>(_order[k])];
        for (std::size_t k = 0; k < n; ++k) {
            const Complex4 known = x[k];
            for (int p = _start[k]; p < _start[k + 1]; ++p)
                subtract_product(x[rows[p]], _L[static_cast<std::size_t>(p)], known);
        }
        for (std::size_t k = n; k-- > 0;) {
            Complex4 sum;
            set_product(sum, x[k], _inverse[k]);
            for (int p = _start[k]; p < _start[k + 1]; ++p)
                subtract_product(sum, _L[static_cast<std::size_t>(p)], x[rows[p]]);
            x[k] = sum;
        }
        for (std::size_t k = 0; k < n; ++k)
            b[static_cast<std::size_t>(_order[k])] = x[k];
    });
}

std::array<double, lanes> SymmetricFactors::determinant_phases() const {
    // Products of a few pivots at a time: an argument costs more than a product.
    constexpr std::size_t few = 16;
    std::array<double, lanes> phases{};
    for (int lane = 0; lane < lanes; ++lane) {
        std::complex<double> some = 1;
        for (std::size_t k = 0; k < _D.size(); ++k) {
            const std::complex<double> pivot = _D[k].at(lane);
            const std::complex<double> unit = pivot / std::abs(pivot);
            some = {some.real() * unit.real() - some.imag() * unit.imag(),
                    some.real() * unit.imag() + some.imag() * unit.real()};
            if (k % few == few - 1 || k + 1 == _D.size()) {
                phases[static_cast<std::size_t>(lane)] += std::arg(some);
                some = 1;
            }
        }
    }
    return phases;
}

RealEnergies::RealEnergies(const SymmetricFactors &factors)
    : _order(factors._order), _start(_order.size() + 1, 0), _columns(factors._rows.size()),
      _L(_columns.size()), _inverse(_order.size()), _work(_order.size()) {
    const std::vector<int> &by_columns = factors._start;
    const std::vector<int> &rows = factors._rows;
    for (const int row : rows)
        ++_start[static_cast<std::size_t>(row) + 1];
    std::partial_sum(_start.begin(), _start.end(), _start.begin());
    std::vector<int> next(_start.begin(), _start.end() - 1);
    for (std::size_t column = 0; column < _order.size(); ++column)
        for (auto p = static_cast<std::size_t>(by_columns[column]);
             p < static_cast<std::size_t>(by_columns[column + 1]); ++p) {
            const auto place = static_cast<std::size_t>(next[static_cast<std::size_t>(rows[p])]++);
            _columns[place] = static_cast<int>(column);
            _L[place] = factors._L[p].re;
        }
    for (std::size_t k = 0; k < _inverse.size(); ++k)
        _inverse[k] = factors._inverse[k].re;
}

/// With A = L D L^T it is the sum of |L^-1 b|^2 / D.
std::array<double, lanes> RealEnergies::operator()(const Vector4 &b) const {
    Real4 sum{};
    in_lanes([&]() __attribute__((always_inline)) {
        const std::size_t n = _order.size();
        Complex4 *work = _work.data();
        const int *columns = _columns.data();
        const Real4 *L = _L.data();
        for (std::size_t k = 0; k < n; ++k) {
            Complex4 known = b[static_cast<std::size_t>(_order[k])];
            for (int p = _start[k], end = _start[k + 1]; p < end; ++p) {
                const Complex4 &other = work[columns[p]];
                known.re -= L[p] * other.re;
                known.im -= L[p] * other.im;
            }
            work[k] = known;
            sum += _inverse[k] * (known.re * known.re + known.im * known.im);
        }
    });
    return {sum[0], sum[1], sum[2], sum[3]};
}

} // namespace whirl::linalg

#include "linalg/lanes/complex_product.h"

#include "linalg/lanes/complex4.h"

#include <array>
#include <cstring>

namespace whirl::linalg {

namespace {

/// Columns of a matrix in two parts, each so many entries after the last, and what they multiply.
struct Columns {
    const double *re, *im;
    Eigen::Index apart, count;
    const double *x_re, *x_im;
};

/// The next `vectors` times four rows: sums that stay in registers.
template <int vectors>
WHIRL_INLINED void add_rows(const Columns &A, Eigen::Index row, double *out_re, double *out_im) {
    std::array<Real4, vectors> re{};
    std::array<Real4, vectors> im{};
    for (Eigen::Index column = 0; column < A.count; ++column) {
        const double a = A.x_re[column];
        const double b = A.x_im[column];
        const Real4 along{a, a, a, a};
        const Real4 across{b, b, b, b};
        const double *from_re = A.re + column * A.apart + row;
        const double *from_im = A.im + column * A.apart + row;
        for (int v = 0; v < vectors; ++v) {
            Real4 p;
            Real4 q;
            std::memcpy(&p, from_re + lanes * v, sizeof p);
            std::memcpy(&q, from_im + lanes * v, sizeof q);
            re[v] += p * along - q * across;
            im[v] += p * across + q * along;
        }
    }
    for (int v = 0; v < vectors; ++v) {
        std::memcpy(out_re + row + lanes * v, &re[v], sizeof re[v]);
        std::memcpy(out_im + row + lanes * v, &im[v], sizeof im[v]);
    }
}

} // namespace

ComplexProduct::ComplexProduct(const Eigen::MatrixXcd &A)
    : _rows(whole(A.rows())), _columns(A.cols()),
      _re(static_cast<std::size_t>(_rows * _columns), 0.0), _im(_re) {
    for (Eigen::Index column = 0; column < _columns; ++column)
        for (Eigen::Index row = 0; row < A.rows(); ++row) {
            const auto at = static_cast<std::size_t>(column * _rows + row);
            _re[at] = A(row, column).real();
            _im[at] = A(row, column).imag();
        }
}

Eigen::Index ComplexProduct::whole(Eigen::Index size) { return (size + lanes - 1) / lanes * lanes; }

void ComplexProduct::operator()(const double *re, const double *im, double *out_re,
                                double *out_im) const {
    const Columns A{_re.data(), _im.data(), _rows, _columns, re, im};
    in_lanes([&]() __attribute__((always_inline)) {
        Eigen::Index row = 0;
        for (; row + 4 * lanes <= _rows; row += 4 * lanes)
            add_rows<4>(A, row, out_re, out_im);
        for (; row + 2 * lanes <= _rows; row += 2 * lanes)
            add_rows<2>(A, row, out_re, out_im);
        if (row < _rows)
            add_rows<1>(A, row, out_re, out_im);
    });
}

} // namespace whirl::linalg

#include "linalg/lanes/small_products.h"

#include "linalg/lanes/complex4.h"

#include <array>

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
            load(p, from_re + lanes * v);
            load(q, from_im + lanes * v);
            re[v] += p * along - q * across;
            im[v] += p * across + q * along;
        }
    }
    for (int v = 0; v < vectors; ++v) {
        store(re[v], out_re + row + lanes * v);
        store(im[v], out_im + row + lanes * v);
    }
}

template <int vectors>
WHIRL_INLINED void add_rows(const double *A, Eigen::Index apart, Eigen::Index columns,
                            const double *x, double *out) {
    std::array<Real4, vectors> sum{};
    for (Eigen::Index column = 0; column < columns; ++column) {
        const double a = x[column];
        const Real4 factor{a, a, a, a};
        for (int v = 0; v < vectors; ++v) {
            Real4 p;
            load(p, A + column * apart + lanes * v);
            sum[v] += p * factor;
        }
    }
    for (int v = 0; v < vectors; ++v)
        store(sum[v], out + lanes * v);
}

/// The columns of a matrix one after the other, each filled up with zeros.
template <class Matrix> std::vector<double> filled_up(const Matrix &A) {
    const Eigen::Index rows = whole_vectors(A.rows());
    std::vector<double> out(static_cast<std::size_t>(rows * A.cols()), 0.0);
    for (Eigen::Index column = 0; column < A.cols(); ++column)
        for (Eigen::Index row = 0; row < A.rows(); ++row)
            out[static_cast<std::size_t>(column * rows + row)] = A(row, column);
    return out;
}

} // namespace

Eigen::Index whole_vectors(Eigen::Index size) { return (size + lanes - 1) / lanes * lanes; }

RealProduct::RealProduct(const Eigen::MatrixXd &A)
    : _rows(whole_vectors(A.rows())), _columns(A.cols()), _A(filled_up(A)) {}

void RealProduct::operator()(const double *x, double *out) const {
    in_lanes([&]() __attribute__((always_inline)) {
        along_row<8>(
            0, _rows, [&]<int vectors>(Eigen::Index row) __attribute__((always_inline)) {
                add_rows<vectors>(_A.data() + row, _rows, _columns, x, out + row);
            });
    });
}

ComplexProduct::ComplexProduct(const Eigen::MatrixXcd &A)
    : _rows(whole_vectors(A.rows())), _columns(A.cols()), _re(filled_up(A.real())),
      _im(filled_up(A.imag())) {}

void ComplexProduct::operator()(const double *re, const double *im, double *out_re,
                                double *out_im) const {
    const Columns A{_re.data(), _im.data(), _rows, _columns, re, im};
    in_lanes([&]() __attribute__((always_inline)) {
        along_row<4>(
            0, _rows, [&]<int vectors>(Eigen::Index row) __attribute__((always_inline)) {
                add_rows<vectors>(A, row, out_re, out_im);
            });
    });
}

} // namespace whirl::linalg

#include "linalg/lanes/small_products.h"

#include "linalg/lanes/complex4.h"

#include <array>

namespace whirl::linalg {

namespace {

/// `vectors` times four rows of a product, from the row on at which A begins: sums that stay in
/// registers.
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
std::vector<double> filled_up(const Eigen::MatrixXd &A) {
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

} // namespace whirl::linalg

#include "linalg/sparse_factor.h"

#include <suitesparse/klu.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <type_traits>
#include <vector>

namespace whirl::linalg {

namespace {

// KLU is written in C: it takes what it does not change without const, and complex numbers as pairs
// of real ones.
double *reals(const double *p) { return const_cast<double *>(p); }
double *reals(const std::complex<double> *p) {
    return reinterpret_cast<double *>(const_cast<std::complex<double> *>(p));
}

bool odd(const int *permutation, int size) {
    std::vector<bool> seen(static_cast<std::size_t>(size), false);
    bool out = false;
    for (int start = 0; start < size; ++start) {
        if (seen[static_cast<std::size_t>(start)])
            continue;
        seen[static_cast<std::size_t>(start)] = true;
        // A cycle of n elements is n - 1 exchanges.
        for (int i = permutation[start]; i != start; i = permutation[i]) {
            seen[static_cast<std::size_t>(i)] = true;
            out = !out;
        }
    }
    return out;
}

} // namespace

template <class Scalar> struct SparseFactor<Scalar>::Data {
    static constexpr bool real = std::is_same_v<Scalar, double>;
    klu_common common{};
    klu_symbolic *symbolic = nullptr;
    klu_numeric *numeric = nullptr;
    bool keeps_pivots = false;
    Eigen::VectorXi columns, rows; ///< places of the entries that `symbolic` is made for

    void analyse(const Sparse &A) {
        const Eigen::Map<const Eigen::VectorXi> first(A.outerIndexPtr(), A.outerSize() + 1);
        const Eigen::Map<const Eigen::VectorXi> places(A.innerIndexPtr(), A.nonZeros());
        if (places.size() == rows.size() && first.size() == columns.size() && places == rows &&
            first == columns)
            return;
        drop();
        columns = first;
        rows = places;
        klu_free_symbolic(&symbolic, &common);
        symbolic = klu_analyze(static_cast<int>(A.rows()), columns.data(), rows.data(), &common);
    }

    /// In the order of the last one; false where there is none, or a pivot is zero.
    bool refactorize(const Sparse &A) {
        return keeps_pivots && numeric != nullptr &&
               (real ? klu_refactor : klu_z_refactor)(columns.data(), rows.data(),
                                                      reals(A.valuePtr()), symbolic, numeric,
                                                      &common) != 0 &&
               common.status == KLU_OK;
    }

    /// Too little memory is no zero pivot.
    void check_memory() const {
        if (common.status == KLU_OUT_OF_MEMORY || common.status == KLU_TOO_LARGE)
            throw std::bad_alloc();
    }

    void drop() { (real ? klu_free_numeric : klu_z_free_numeric)(&numeric, &common); }

    ~Data() {
        drop();
        klu_free_symbolic(&symbolic, &common);
    }
};

template <class Scalar>
SparseFactor<Scalar>::SparseFactor(bool keeps_pivots) : _data(std::make_unique<Data>()) {
    _data->keeps_pivots = keeps_pivots;
    klu_defaults(&_data->common);
    // A pivot on the diagonal, as the order foresees it, unless it is so much smaller than the
    // largest: entries grow by no more than 11 times in a step.
    _data->common.tol = 0.1;
}

template <class Scalar> SparseFactor<Scalar>::~SparseFactor() = default;

template <class Scalar> bool SparseFactor<Scalar>::factorize(const Sparse &A) {
    _data->analyse(A);
    _data->check_memory();
    if (_data->symbolic == nullptr)
        return false;
    if (_data->refactorize(A))
        return true;
    _data->drop();
    _data->numeric = (Data::real ? klu_factor : klu_z_factor)(
        _data->columns.data(), _data->rows.data(), reals(A.valuePtr()), _data->symbolic,
        &_data->common);
    _data->check_memory();
    return _data->numeric != nullptr && _data->common.status == KLU_OK;
}

template <class Scalar> void SparseFactor<Scalar>::forget_pivots() { _data->drop(); }

template <class Scalar> void SparseFactor<Scalar>::solve(Columns b) const {
    (Data::real ? klu_solve
                : klu_z_solve)(_data->symbolic, _data->numeric, static_cast<int>(b.outerStride()),
                               static_cast<int>(b.cols()), reals(b.data()), &_data->common);
}

template <class Scalar> void SparseFactor<Scalar>::solve_transposed(Columns b) const {
    const auto stride = static_cast<int>(b.outerStride());
    const auto count = static_cast<int>(b.cols());
    if constexpr (Data::real)
        klu_tsolve(_data->symbolic, _data->numeric, stride, count, b.data(), &_data->common);
    else
        klu_z_tsolve(_data->symbolic, _data->numeric, stride, count, reals(b.data()), 0,
                     &_data->common);
}

template <class Scalar>
bool SparseFactor<Scalar>::negative_determinant() const requires std::is_same_v<Scalar, double> {
    // P R A Q = L U: the scales R of the rows are positive, the diagonal of L is 1.
    const int n = _data->symbolic->n;
    const auto *pivots = static_cast<const double *>(_data->numeric->Udiag);
    const bool flipped = odd(_data->numeric->Pnum, n) != odd(_data->symbolic->Q, n);
    const auto negative = std::count_if(pivots, pivots + n, [](double u) { return u < 0; });
    return flipped != (negative % 2 == 1);
}

template <class Scalar>
double SparseFactor<Scalar>::determinant_phase() const requires(!std::is_same_v<Scalar, double>) {
    const int n = _data->symbolic->n;
    const auto *pivots = static_cast<const Scalar *>(_data->numeric->Udiag);
    const bool flipped = odd(_data->numeric->Pnum, n) != odd(_data->symbolic->Q, n);
    double phase = flipped ? std::numbers::pi : 0;
    for (int i = 0; i < n; ++i)
        phase = std::remainder(phase + std::arg(pivots[i]), 2 * std::numbers::pi);
    return phase;
}

template class SparseFactor<double>;
template class SparseFactor<std::complex<double>>;

} // namespace whirl::linalg

#pragma once

#include "linalg/lanes/complex4.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace whirl::reduction {

/// Blocks of 4 x 4, one a plane, side by side.
using PlaneBlocks = Eigen::Matrix<double, 4, Eigen::Dynamic>;

/// (1 + B Q) y = b: B couples the planes by the shapes of the rotor, Q is of the masses in each
/// plane. Of so few unknowns a general solver spends most of its time on finding out how many there
/// are: the compiler knows it here, and all of it is inlined for the instructions of one machine
/// (linalg::in_lanes).
template <int planes> class PlaneSystem {
  public:
    /// @param products  2P x 2P: B is this, alike in both directions
    /// @param coupling  Q
    WHIRL_INLINED PlaneSystem(const Eigen::MatrixXd &products, const PlaneBlocks &coupling) {
        for (int plane = 0; plane < planes; ++plane)
            for (int c = 0; c < 4; ++c) {
                const double *q = &coupling(0, 4 * plane + c);
                std::array<double, size> &column = _A[4 * plane + c];
                for (int i = 0; i < 2 * planes; ++i)
                    for (int axis = 0; axis < 2; ++axis)
                        column[2 * i + axis] = products(i, 2 * plane) * q[axis] +
                                               products(i, 2 * plane + 1) * q[2 + axis];
            }
        for (int k = 0; k < size; ++k)
            _A[k][k] += 1;
        each([&]<int k>() __attribute__((always_inline)) { eliminate<k>(); });
    }

    /// y of a column b, in its place.
    WHIRL_INLINED void solve(double *b) const {
        std::array<double, size> y;
        std::copy(b, b + size, y.begin());
        for (int k = 0; k < size; ++k)
            std::swap(y[k], y[_pivots[k]]);
        each([&]<int k>() __attribute__((always_inline)) {
            for (int i = k + 1; i < size; ++i)
                y[i] -= y[k] * _A[k][i];
        });
        each([&]<int from_last>() __attribute__((always_inline)) {
            constexpr int k = size - 1 - from_last;
            y[k] *= _A[k][k];
            for (int i = 0; i < k; ++i)
                y[i] -= y[k] * _A[k][i];
        });
        std::copy(y.begin(), y.end(), b);
    }

  private:
    static constexpr int size = 4 * planes;
    std::array<std::array<double, size>, size> _A; ///< factors by columns, inverted diagonal
    std::array<int, size> _pivots;

    /// f(0), ..., f(size - 1), each known to the compiler.
    template <class F> WHIRL_INLINED static void each(const F &f) {
        [&]<int... k>(std::integer_sequence<int, k...>) __attribute__((always_inline)) {
            (f.template operator()<k>(), ...);
        }
        (std::make_integer_sequence<int, size>());
    }

    /// Elimination with row pivoting, a column.
    template <int k> WHIRL_INLINED void eliminate() {
        int pivot = k;
        for (int i = k + 1; i < size; ++i)
            pivot = std::abs(_A[k][i]) > std::abs(_A[k][pivot]) ? i : pivot;
        _pivots[k] = pivot;
        if (pivot != k)
            for (std::array<double, size> &column : _A)
                std::swap(column[k], column[pivot]);
        _A[k][k] = 1 / _A[k][k];
        for (int i = k + 1; i < size; ++i)
            _A[k][i] *= _A[k][k];
        for (int j = k + 1; j < size; ++j)
            for (int i = k + 1; i < size; ++i)
                _A[j][i] -= _A[j][k] * _A[k][i];
    }
};

} // namespace whirl::reduction

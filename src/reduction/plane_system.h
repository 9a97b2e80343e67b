#pragma once

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <utility>

namespace whirl::reduction {

/// Blocks of 4 x 4, one a plane, side by side.
using PlaneBlocks = Eigen::Matrix<double, 4, Eigen::Dynamic>;

/// (1 + B Q) y = b: B couples the planes by the shapes of the rotor, Q is of the masses in each
/// plane. Of so few unknowns a general solver spends most of its time on finding out how many there
/// are: the compiler knows it here.
template <int planes> class PlaneSystem {
  public:
    /// @param products  2P x 2P: B is this, alike in both directions
    /// @param coupling  Q
    PlaneSystem(const Eigen::MatrixXd &products, const PlaneBlocks &coupling) {
        for (int plane = 0; plane < planes; ++plane)
            for (int c = 0; c < 4; ++c) {
                const auto q = coupling.col(4 * plane + c);
                auto column = _A.col(4 * plane + c);
                for (int i = 0; i < 2 * planes; ++i)
                    column.template segment<2>(2 * i) =
                        products(i, 2 * plane) * q.template head<2>() +
                        products(i, 2 * plane + 1) * q.template tail<2>();
            }
        _A.diagonal().array() += 1;
        each([&]<int k>() { eliminate<k>(); });
    }

    /// y of a column b, in its place.
    void solve(double *column) const {
        Eigen::Map<Column> b(column);
        Column y = b;
        for (int k = 0; k < size; ++k)
            std::swap(y(k), y(_pivots[k]));
        each([&]<int k>() {
            y.template tail<size - 1 - k>() -= y(k) * _A.col(k).template tail<size - 1 - k>();
        });
        each([&]<int from_last>() {
            constexpr int k = size - 1 - from_last;
            y(k) *= _A(k, k);
            y.template head<k>() -= y(k) * _A.col(k).template head<k>();
        });
        b = y;
    }

  private:
    static constexpr int size = 4 * planes;
    using Column = Eigen::Matrix<double, size, 1>;
    Eigen::Matrix<double, size, size> _A; ///< factors, inverted diagonal
    std::array<int, size> _pivots;

    /// f(0), ..., f(size - 1), each known to the compiler.
    template <class F> static void each(const F &f) {
        [&]<int... k>(std::integer_sequence<int, k...>) { (f.template operator()<k>(), ...); }
        (std::make_integer_sequence<int, size>());
    }
    template <int k, class C> static auto below(C &column) {
        return column.template tail<size - 1 - k>();
    }

    /// Elimination with row pivoting, a column.
    template <int k> void eliminate() {
        int pivot = k;
        for (int i = k + 1; i < size; ++i)
            pivot = std::abs(_A(i, k)) > std::abs(_A(pivot, k)) ? i : pivot;
        _pivots[k] = pivot;
        if (pivot != k)
            _A.row(k).swap(_A.row(pivot));
        _A(k, k) = 1 / _A(k, k);
        auto pivot_column = _A.col(k);
        const Eigen::Matrix<double, size - 1 - k, 1> factors = below<k>(pivot_column) * _A(k, k);
        below<k>(pivot_column) = factors;
        for (int j = k + 1; j < size; ++j) {
            auto column = _A.col(j);
            below<k>(column) -= column(k) * factors;
        }
    }
};

} // namespace whirl::reduction

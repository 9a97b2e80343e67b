#pragma once

#include "linalg/complex_factors.h"
#include "linalg/lanes/complex4.h"

#include <array>
#include <vector>

namespace whirl::linalg {

/// L U of four complex matrices at once, all with one pattern, which is its own mirror image, their
/// entries are not. Rows are not exchanged: whoever solves with it looks at the residual.
class GeneralFactors {
  public:
    using Sparse = Eigen::SparseMatrix<std::complex<double>>;

    /// @param pattern  compressed, every entry with its mirror image, the whole diagonal
    explicit GeneralFactors(const Sparse &pattern);

    /// @param values  entries in the order of the pattern
    /// @returns in each lane whether no pivot is zero or not a number
    std::array<bool, lanes> factorize(const Vector4 &values);

    /// A^-T b in the place of b, each with its own matrix.
    void solve_transposed(Vector4 &b) const;

  private:
    /// An entry above the diagonal, or on it, and its mirror image: places in the pattern.
    struct Entry {
        int row, upper, lower;
    };
    /// A column of L and row of U in which a row of L and column of U has an entry, and its place.
    struct Reach {
        int column, place;
    };
    std::vector<int> _order;       ///< unknown eliminated at each step
    std::vector<int> _first;       ///< of each column in `_entries`
    std::vector<Entry> _entries;   ///< by column, in the order of elimination
    std::vector<int> _reach_first; ///< of each row in `_reach`
    std::vector<Reach> _reach;
    std::vector<int> _start; ///< of each column in `_rows`, `_L`, `_U`
    std::vector<int> _rows;  ///< of L below the diagonal, and columns of U behind it
    Vector4 _L, _U, _inverse;
    Vector4 _left, _above; ///< a row and a column at work, zero between calls
    mutable Vector4 _x;
};

} // namespace whirl::linalg

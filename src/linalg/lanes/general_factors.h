#pragma once

#include "linalg/lanes/complex4.h"
#include "linalg/lanes/elimination_pattern.h"

#include <array>
#include <vector>

namespace whirl::linalg {

/// L U of four complex matrices at once, all with one pattern, which is its own mirror image, their
/// entries are not; U has its entries where the mirror image of L has. Rows are not exchanged:
/// whoever solves with it looks at the residual.
class GeneralFactors : private EliminationPattern {
  public:
    using EliminationPattern::Sparse;

    /// @param pattern  compressed, every entry with its mirror image, the whole diagonal
    explicit GeneralFactors(const Sparse &pattern);

    /// @param values  entries in the order of the pattern
    /// @returns in each lane whether no pivot is zero or not a number
    std::array<bool, lanes> factorize(const Vector4 &values);

    /// A^-T b in the place of b, each with its own matrix.
    void solve_transposed(Vector4 &b) const;

  private:
    std::vector<int> _mirrored; ///< of each entry the place of its mirror image in the pattern
    Vector4 _L, _U, _inverse;
    Vector4 _left, _above; ///< a row and a column at work, zero between calls
    mutable Vector4 _x;
};

} // namespace whirl::linalg

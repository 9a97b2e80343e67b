#pragma once

#include "linalg/complex_factors.h"

#include <vector>

namespace whirl::linalg {

/// Of an elimination without exchanges of rows: its order, and where L (and the mirror image of it)
/// has entries, by rows and by columns.
class EliminationPattern {
  protected:
    explicit EliminationPattern(const SymmetricFactor &one);

    /// A column of L in which a row has an entry, and the place of that in L.
    struct Reach {
        int column, place;
    };
    std::vector<int> _order;       ///< unknown eliminated at each step
    std::vector<int> _first;       ///< of each column among the entries of the matrix
    std::vector<int> _reach_first; ///< of each row in `_reach`
    std::vector<Reach> _reach;
    std::vector<int> _start; ///< of each column in `_rows`
    std::vector<int> _rows;  ///< of L below the diagonal
};

} // namespace whirl::linalg

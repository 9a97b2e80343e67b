#pragma once

#include <Eigen/SparseCore>

#include <complex>
#include <vector>

namespace whirl::linalg {

/// Of an elimination without exchanges of rows: its order (minimum degree), and where L (and the
/// mirror image of it) has entries, by rows and by columns. The same for all matrices with one
/// pattern.
class EliminationPattern {
  public:
    using Sparse = Eigen::SparseMatrix<std::complex<double>>;

  protected:
    /// @param pattern  compressed, every entry with its mirror image, the whole diagonal
    explicit EliminationPattern(const Sparse &pattern);

    /// An entry of the upper triangle in the order of elimination, and its place in the matrix.
    struct Entry {
        int row, place;
    };
    /// A column of L in which a row has an entry, and the place of that in L.
    struct Reach {
        int column, place;
    };
    std::vector<int> _order;       ///< unknown eliminated at each step
    std::vector<int> _first;       ///< of each column in `_entries`
    std::vector<Entry> _entries;   ///< by column
    std::vector<int> _reach_first; ///< of each row in `_reach`
    std::vector<Reach> _reach;
    std::vector<int> _start; ///< of each column in `_rows`
    std::vector<int> _rows;  ///< of L below the diagonal

  private:
    void analyse();
};

} // namespace whirl::linalg

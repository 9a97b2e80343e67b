#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <complex>
#include <vector>

namespace whirl::linalg {

/// A square complex matrix with all its entries within `width` places of the diagonal, for linear
/// systems along a chain. Elimination with partial pivoting, in place.
class BandMatrix {
  public:
    BandMatrix(int size, int width);

    void clear();
    /// Entry with |row - column| <= width.
    std::complex<double> &operator()(int row, int column) { return entry(row, column); }

    /// A^-1 b. The entries are lost.
    /// @throws SolverError where a pivot is zero or not a number.
    [[nodiscard]] Eigen::VectorXcd solve(Eigen::VectorXcd b);
    /// A^-1 b of the A that was solved with last.
    [[nodiscard]] Eigen::VectorXcd solve_again(Eigen::VectorXcd b) const;

  private:
    int _size;
    int _width;
    std::vector<int> _pivots; ///< row exchanged with each
    /// Row by row from `width` before the diagonal to 2 * width behind it: exchanged rows reach
    /// that far.
    std::vector<std::complex<double>> _entries;

    [[nodiscard]] std::size_t place(int row, int column) const {
        return static_cast<std::size_t>(row * (3 * _width + 1) + column - row + _width);
    }
    std::complex<double> &entry(int row, int column) { return _entries[place(row, column)]; }
    [[nodiscard]] const std::complex<double> &entry(int row, int column) const {
        return _entries[place(row, column)];
    }
    void eliminate();
};

/// L D L^T of sparse matrices that are complex and symmetric (not Hermitian), all with one pattern:
/// the order of elimination (minimum degree) is found once. Rows are not exchanged: whoever solves
/// with it looks at the residual.
class SymmetricFactor {
  public:
    using Sparse = Eigen::SparseMatrix<std::complex<double>>;

    /// @param pattern  compressed, every entry with its mirror image, the whole diagonal
    explicit SymmetricFactor(const Sparse &pattern);

    /// @throws SolverError where a pivot is zero or not a number.
    void factorize(const Sparse &A);

    [[nodiscard]] Eigen::VectorXcd solve(const Eigen::VectorXcd &b) const;

    /// Argument of the determinant, rad, with some multiple of 2 pi.
    [[nodiscard]] double determinant_phase() const;

  private:
    friend class RealEnergy;
    friend class EliminationPattern;
    friend class SymmetricFactors;
    friend class GeneralFactors;
    using Complex = std::complex<double>;
    /// An entry of the upper triangle in the order of elimination, and its place in the matrix.
    struct Entry {
        int row, value;
    };
    std::vector<int> _order;       ///< unknown eliminated at each step
    std::vector<int> _first;       ///< of each column in `_entries`
    std::vector<Entry> _entries;   ///< by column
    std::vector<int> _reach_first; ///< of each row in `_reach`
    std::vector<int> _reach;       ///< columns of L that a row has entries in, in order
    std::vector<int> _start;       ///< of each column in `_rows`, `_L`
    std::vector<int> _rows;        ///< of L below the diagonal
    std::vector<Complex> _L, _D, _inverse;
    std::vector<Complex> _work; ///< zero between calls
    std::vector<int> _filled;   ///< entries of each column so far

    void analyse();
};

/// Factors of a real symmetric positive definite matrix, as one lane of RealEnergies
/// (lanes/symmetric_factors.h).
class RealEnergy {
  public:
    explicit RealEnergy(const SymmetricFactor &factors);

  private:
    friend class RealEnergies;
    std::vector<int> _order, _start, _rows;
    std::vector<double> _L, _inverse;
};

} // namespace whirl::linalg

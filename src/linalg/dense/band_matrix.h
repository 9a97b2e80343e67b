#pragma once

#include <Eigen/Core>

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

    /// L and U in the place of the entries; exchanges of rows leave L as it is.
    /// @throws SolverError where a pivot is zero or not a number.
    void eliminate();

    /// A^-1 b of the A that was eliminated.
    [[nodiscard]] Eigen::VectorXcd solve(Eigen::VectorXcd b) const;

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
};

} // namespace whirl::linalg

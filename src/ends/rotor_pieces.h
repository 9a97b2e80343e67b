#pragma once

#include "modes/form_matrices.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace whirl::ends {

/// Q(l) = l^2 M + l D + K at one speed and its change with the speed, dense.
struct DenseProblem {
    Eigen::MatrixXd M, D, K;
    Eigen::MatrixXd D_rate, K_rate;
};

/// A rotor on few planar shapes, or whole, at any speed of a range. Between neighbouring rows of
/// bearing tables D is linear in the speed and K quadratic: such a piece of the range is made once.
class RotorPieces {
  public:
    /// @param whole    forms general and rotating
    /// @param shapes   N x r planar shapes; none: the whole rotor
    /// @param borders  of the pieces, ascending, at least two, rad/s
    RotorPieces(const modes::FormMatrices &whole, const Eigen::MatrixXd *shapes,
                const std::vector<double> &borders);

    [[nodiscard]] int pieces() const { return static_cast<int>(_pieces.size()); }
    [[nodiscard]] double from(int piece) const { return at_index(piece).from; }
    [[nodiscard]] double to(int piece) const { return at_index(piece).to; }
    [[nodiscard]] DenseProblem at(double speed, int piece) const;
    /// The piece that a speed lies in, the first or the last one beyond the range.
    [[nodiscard]] int piece_of(double speed) const;

    /// Amplitudes of the shapes as unknowns of the whole rotor.
    [[nodiscard]] Eigen::VectorXcd lifted(const Eigen::VectorXcd &reduced) const;

  private:
    struct Piece {
        double from = 0, to = 0;          ///< rad/s
        Eigen::MatrixXd D, D1, K, K1, K2; ///< powers of (speed - from)
    };
    const Eigen::MatrixXd *_shapes;
    Eigen::MatrixXd _M;
    std::vector<Piece> _pieces;

    [[nodiscard]] const Piece &at_index(int piece) const {
        return _pieces[static_cast<std::size_t>(piece)];
    }
    [[nodiscard]] Eigen::MatrixXd reduced(const Eigen::SparseMatrix<double> &A) const;
};

} // namespace whirl::ends

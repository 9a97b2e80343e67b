#pragma once

#include "ends/spectrum.h"
#include "modes/form_matrices.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace whirl::ends {

/// A reduced rotor, or a whole one, at any speed of a range. Between neighbouring rows of bearing
/// tables D is linear in the speed and K quadratic: such a part of the range is made once, when a
/// speed in it is asked for. A piece is what lies between borders: it has several parts where the
/// tables have rows in it at which they hardly bend.
class RotorPieces {
  public:
    /// @param whole    forms general and rotating
    /// @param shapes   N x r planar shapes; none: the whole rotor
    /// @param borders  of the pieces, ascending, at least two, rad/s
    /// @param rows     of the tables, ascending, rad/s
    RotorPieces(const modes::FormMatrices &whole, const Eigen::MatrixXd *shapes,
                const std::vector<double> &borders, const std::vector<double> &rows);

    [[nodiscard]] int pieces() const { return static_cast<int>(_borders.size()) - 1; }
    [[nodiscard]] double from(int piece) const { return _borders[static_cast<std::size_t>(piece)]; }
    [[nodiscard]] double to(int piece) const { return from(piece + 1); }
    [[nodiscard]] DenseProblem at(double speed, int piece) const;
    /// The piece that a speed lies in, the first or the last one beyond the range.
    [[nodiscard]] int piece_of(double speed) const;

    /// Amplitudes of the shapes as unknowns of the whole rotor.
    [[nodiscard]] Eigen::VectorXcd lifted(const Eigen::VectorXcd &reduced) const;

  private:
    struct Part {
        double from = 0;                  ///< rad/s
        Eigen::MatrixXd D, D1, K, K1, K2; ///< powers of (speed - from)
    };
    const modes::FormMatrices &_whole;
    const Eigen::MatrixXd *_shapes;
    Eigen::MatrixXd _M;
    std::vector<double> _borders;
    std::vector<double> _ends; ///< of the parts, the borders among them, rad/s
    mutable std::vector<std::optional<Part>> _parts;

    /// The part of a piece that a speed lies in.
    [[nodiscard]] const Part &part_at(double speed, int piece) const;
    [[nodiscard]] Eigen::MatrixXd reduced(const Eigen::SparseMatrix<double> &A) const;
};

} // namespace whirl::ends

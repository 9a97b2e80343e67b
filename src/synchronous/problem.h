#pragma once

#include "assembly/discretization.h"
#include "linalg/sparse_sum.h"
#include "results/formulation.h"

#include <Eigen/SparseCore>

#include <complex>
#include <optional>
#include <vector>

namespace whirl::synchronous {

/// Q(l) = l^2 M + l D + K with complex matrices.
struct ComplexQuadratic {
    using Sparse = Eigen::SparseMatrix<std::complex<double>>;
    Sparse M, D, K;

    [[nodiscard]] Sparse at(std::complex<double> l) const {
        return linalg::sum(l * l, M, l, D, 1, K);
    }
    [[nodiscard]] Sparse slope(std::complex<double> l) const { return (2.0 * l) * M + D; }
};

/// The synchronous eigenproblem of the whole rotor, Q(l) x = 0 with l = i |W|, in every form: over
/// planar unknowns l^2 (M -+ G) + K (forward and backward), over pairs (x, y)
/// l^2 (M - i s G) + l (C - i s Kc) + K, s the sign of the spin speed W, hyperbolic l^2 (M + S) +
/// K, in rotating axes with the balls held K - i s l Ks - l^2 Kss. The bearings change it from row
/// to row of their tables, linearly between; it is constant below the first row and above the last.
class SynchronousProblem {
  public:
    /// @param spin           sign of the spin speed
    /// @param whirl_sign     planar: +1 forward, -1 backward
    /// @param bearing_speed  the bearings are as at that speed (rad/s) everywhere; none: by tables
    SynchronousProblem(const assembly::Discretization &rotor, results::Form form, int spin,
                       int whirl_sign = 1, std::optional<double> bearing_speed = {});

    [[nodiscard]] const assembly::Discretization &rotor() const { return _d; }
    [[nodiscard]] int spin() const { return _spin; } ///< sign of the spin speed
    /// Speeds of the rows times the sign of the spin, rad/s, ascending; one, and no more, where
    /// nothing changes with speed.
    [[nodiscard]] const std::vector<double> &rows() const { return _rows; }
    /// Those of them at which a table bends.
    [[nodiscard]] const std::vector<double> &bends() const { return _bends; }
    [[nodiscard]] bool constant() const { return _rows.size() == 1; }
    [[nodiscard]] ComplexQuadratic at_row(std::size_t row) const;
    /// At the first row, and by how much D and K differ from it at another one (M: zero).
    [[nodiscard]] const ComplexQuadratic &first() const { return _first; }
    [[nodiscard]] const ComplexQuadratic &change(std::size_t row) const { return _changes[row]; }

    /// The unknowns are pairs (x, y), not those of one plane.
    [[nodiscard]] bool pairs() const { return _pairs; }
    /// M and K are Hermitian and D is zero at every row: the inertia of K - W^2 M gives how many
    /// roots are below W.
    [[nodiscard]] bool conservative() const { return _conservative; }

  private:
    const assembly::Discretization &_d;
    int _spin;
    std::vector<double> _rows;
    std::vector<double> _bends;
    ComplexQuadratic _first;
    std::vector<ComplexQuadratic> _changes;
    bool _pairs = true;
    bool _conservative = false;

    void add_bearing_changes(results::Form form);
};

} // namespace whirl::synchronous

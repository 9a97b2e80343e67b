#pragma once

#include "linalg/lanes/complex4.h"
#include "linalg/lanes/elimination_pattern.h"

#include <vector>

namespace whirl::linalg {

/// L D L^T of four complex symmetric matrices at once, all with one pattern. Rows are not
/// exchanged: whoever solves with it looks at the residual.
class SymmetricFactors : private EliminationPattern {
  public:
    using EliminationPattern::Sparse;

    /// @param pattern  compressed, every entry with its mirror image, the whole diagonal
    explicit SymmetricFactors(const Sparse &pattern);

    /// Of each nonzero of the pattern the place of its entry; none (-1) of those in the triangle
    /// that is the mirror image of the other.
    [[nodiscard]] std::vector<int> places(std::size_t nonzeros) const;
    [[nodiscard]] std::size_t entries() const { return _entries.size(); }

    /// @param values  entries at their places
    /// @returns in each lane whether no pivot is zero or not a number
    std::array<bool, lanes> factorize(const Vector4 &values);

    /// Each with its own matrix, in place.
    void solve(Vector4 &b) const;

    /// Argument of each determinant, rad, with some multiple of 2 pi.
    [[nodiscard]] std::array<double, lanes> determinant_phases() const;

  private:
    friend class RealEnergies;
    Vector4 _L, _D, _inverse;
    Vector4 _work; ///< zero between calls
    mutable Vector4 _x;
};

/// b^H A^-1 b in four lanes, each with a real symmetric positive definite A of its own.
class RealEnergies {
  public:
    /// @param factors  of these A
    explicit RealEnergies(const SymmetricFactors &factors);

    [[nodiscard]] std::array<double, lanes> operator()(const Vector4 &b) const;

  private:
    std::vector<int> _order, _start, _columns; ///< L by rows: sums stay in registers
    std::vector<Real4> _L, _inverse;
    mutable Vector4 _work;
};

} // namespace whirl::linalg

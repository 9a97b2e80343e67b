#pragma once

#include "modes/following/eigenpair_refinement.h"
#include "modes/following/symmetric_problem.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace whirl::modes {

/// Q(l) = l^2 M + l D + K of a reduced problem at one speed: small, full, complex and symmetric.
struct ReducedMatrices {
    Eigen::MatrixXd all; ///< M, D and K below each other, the imaginary parts beside the real ones

    /// The products with columns, below each other.
    [[nodiscard]] Eigen::MatrixXcd times(const Eigen::MatrixXcd &Y) const;
    [[nodiscard]] Eigen::VectorXcd times(const Eigen::VectorXcd &y) const;
};

/// A symmetric problem on the space of shapes that it has at some speeds (Ritz): few unknowns, as
/// shapes change little with speed. It makes guesses: what it finds is as good as the space, which
/// the residual with the full matrices tells.
class ReducedModel {
  public:
    /// @param problem  kept by reference
    explicit ReducedModel(const SymmetricProblem &problem);

    /// Widens the space. Coordinates known before keep their places, further ones are zero.
    void add(const std::vector<Eigen::VectorXcd> &vectors);
    /// Widens it by pairs at a speed and by the directions in which they change from there.
    void add_with_changes(double speed, const std::vector<SymmetricPair> &pairs);
    [[nodiscard]] Eigen::Index size() const { return _basis.cols(); }
    [[nodiscard]] bool conjugates() const { return _problem.conjugates(); }

    /// Of a vector in the space, and back: those of pairs from their coordinates.
    [[nodiscard]] Eigen::VectorXcd coordinates(const Eigen::VectorXcd &vector) const;
    void set_vectors(const std::vector<SymmetricPair *> &pairs) const;

    [[nodiscard]] ReducedMatrices at(double speed) const;
    /// dl/dspeed of pairs at a speed from their values and coordinates.
    void set_rates(double speed, const std::vector<SymmetricPair *> &pairs) const;

  private:
    const SymmetricProblem &_problem;
    Eigen::MatrixXcd _basis, _K_basis; ///< basis^H K basis = 1 with the real part of K
    Eigen::MatrixXd _parts;            ///< of the basis: real, imaginary beside
    Eigen::MatrixXcd _M, _D, _K, _D1, _K1;
    Eigen::MatrixXd _all; ///< all five below each other, the imaginary parts beside the real ones

    void append(Eigen::VectorXcd x);
    void project(Eigen::Index first);
};

} // namespace whirl::modes

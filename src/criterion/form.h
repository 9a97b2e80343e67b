#pragma once

#include "results/balance.h"
#include "results/formulation.h"
#include "synchronous/receptance.h"

#include <map>
#include <optional>

namespace whirl::criterion {

/// The criterion's Hermitian form at the correction planes over spin speed; speeds once looked at
/// are remembered. Of an axisymmetric rotor it has a row a plane, of another one two, real: the
/// components of an imbalance along the axes of the rotor.
class BalanceForm {
  public:
    /// @param places     deflections at the planes; the discretisation must outlive this
    /// @param z          where the planes are, m
    /// @param harmonics  form hill: terms of the series in twice the spin speed
    BalanceForm(const assembly::Discretization &rotor, results::Form form,
                const std::vector<assembly::Combination> &places, const std::vector<double> &z,
                int harmonics = 0);

    /// Hermitian part of R, 1/kg. At a resonance, where R has no value, that of a speed beside it.
    /// @throws model::AnalysisFailure where there is none there either.
    [[nodiscard]] const Eigen::MatrixXcd &at(double speed);

    /// The criterion: the largest eigenvalue over the imbalances of plane j (of an axisymmetric
    /// rotor Re R_jj) or, where j is the number of planes, over those of all planes that make a
    /// force at all (all of them, unless the rotor is rigid and has more than two planes).
    [[nodiscard]] double value(std::size_t plane, double speed);
    /// How far it can be off by rounding, 1/kg.
    [[nodiscard]] double rounding(std::size_t plane, double speed);
    /// The imbalance at plane j of the largest eigenvalue: a rotor that is not axisymmetric has one
    /// direction of it, rad from its x towards its y, within a quarter turn to either side.
    [[nodiscard]] std::optional<double> worst_direction(std::size_t plane, double speed);
    /// Speeds at which eigenvalues of the form change their sign (sign_changes.h), of plane j or of
    /// all planes.
    /// @throws linalg::SolverError
    [[nodiscard]] std::vector<double> sign_changes(std::size_t plane, double from, double to) const;
    /// Eigenvalues of the form; those of imbalances without force are exactly zero.
    [[nodiscard]] results::SignaturePoint signature(double speed);

    /// Independent imbalances of an axisymmetric rotor: planes, of a rigid one no more than two.
    [[nodiscard]] int rank() const { return static_cast<int>(_ranges.back().cols() / _a_place); }
    [[nodiscard]] const synchronous::ForwardReceptance &receptance() const { return _receptance; }

  private:
    synchronous::ForwardReceptance _receptance;
    Eigen::Index _a_place; ///< rows and columns of the form a plane
    /// Orthonormal imbalances, a column each, of each plane alone, then of all that make a force.
    std::vector<Eigen::MatrixXd> _ranges;
    std::map<double, Eigen::MatrixXcd> _known;

    [[nodiscard]] Eigen::MatrixXcd on_range(std::size_t plane, double speed);
};

} // namespace whirl::criterion

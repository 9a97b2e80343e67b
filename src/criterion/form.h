#pragma once

#include "results/balance.h"
#include "results/formulation.h"
#include "synchronous/receptance.h"

#include <map>

namespace whirl::criterion {

/// The criterion's Hermitian form at the correction planes over spin speed; speeds once looked at
/// are remembered.
class BalanceForm {
  public:
    /// @param places  deflections at the planes; the discretisation must outlive this
    /// @param z       where the planes are, m
    BalanceForm(const assembly::Discretization &rotor, results::Form form,
                const std::vector<assembly::Combination> &places, const std::vector<double> &z);

    /// Hermitian part of R, planes x planes, 1/kg. At a resonance, where R has no value, that of a
    /// speed beside it.
    /// @throws model::AnalysisFailure where there is none there either.
    [[nodiscard]] const Eigen::MatrixXcd &at(double speed);

    /// The criterion: Re R_jj of plane j, or where j is their number the largest eigenvalue of all
    /// planes on the imbalances that make a force at all (all of them, unless the rotor is rigid
    /// and has more than two planes).
    [[nodiscard]] double value(std::size_t plane, double speed);
    /// How far it can be off by rounding, 1/kg.
    [[nodiscard]] double rounding(std::size_t plane, double speed);
    /// Eigenvalues of the form; those of imbalances without force are exactly zero.
    [[nodiscard]] results::SignaturePoint signature(double speed);

    [[nodiscard]] int rank() const { return static_cast<int>(_range.cols()); }
    [[nodiscard]] const synchronous::ForwardReceptance &receptance() const { return _receptance; }

  private:
    synchronous::ForwardReceptance _receptance;
    Eigen::MatrixXd _range; ///< orthonormal imbalances that make a force, planes x rank
    std::map<double, Eigen::MatrixXcd> _known;

    [[nodiscard]] Eigen::MatrixXcd on_range(double speed);
};

} // namespace whirl::criterion

#pragma once

#include "linalg/definite_pencil.h"
#include "reduction/reduced_rotor.h"

#include <Eigen/Core>

#include <map>
#include <vector>

namespace whirl::reduction {

/// How far a reduced rotor is from the full one, which is solved once.
class ReductionError {
  public:
    /// @throws linalg::SolverError where the full model cannot be solved.
    ReductionError(const assembly::Discretization &discretization, const ReductionGoal &goal);

    /// Fills response_error: largest difference of the deflections at the places, and those
    /// watched, under forward synchronous unit forces at the places, over the largest of them; and
    /// frequency_error: of the whirl speeds on mean bearings up to the fastest motion that acts.
    void measure(ReducedRotor &reduced);

    /// Of the responses of two reduced rotors to unit forces at the places that go round at this
    /// frequency (rad/s), forward or backward: the largest difference of the deflections, over the
    /// largest of the first.
    [[nodiscard]] double difference(const ReducedRotor &a, const ReducedRotor &b,
                                    double frequency) const;

  private:
    Eigen::MatrixXd _loads; ///< at the places, a column each
    Eigen::MatrixXd _seen;  ///< at all places whose deflections count
    double _speed;
    double _fastest; ///< rad/s: up to there whirl speeds are compared
    double _shift;   ///< 1/s2, times the mass, added to the stiffness: holds a rotor that is free
    Eigen::MatrixXcd _response;
    linalg::DefinitePencil _pencil;
    std::map<std::size_t, std::vector<linalg::RealPair>> _slowest; ///< by how many were asked for

    [[nodiscard]] const std::vector<linalg::RealPair> &whirl(std::size_t wanted);
};

} // namespace whirl::reduction

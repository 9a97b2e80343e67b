#pragma once

#include "assembly/discretization.h"
#include "balancers/arrangement.h"
#include "ends/refinement.h"
#include "modes/form_matrices.h"
#include "results/formulation.h"

#include <functional>
#include <optional>
#include <vector>

namespace whirl::ends {

/// Ends of growth once more in a finer model (mesh_error::finer_order on the same mesh), each from
/// the motion that passes the imaginary axis there: a root, where a search asks for whole spectra.
class FinerEnds {
  public:
    /// Forms general and rotating.
    /// @param discretization  of the rotor that the ends belong to; must outlive this
    FinerEnds(const assembly::Discretization &discretization, results::Form form,
              const balancers::Arrangement &arrangement);

    /// Of matrices that a parameter changes as the speed does (AllMotions).
    /// @param matrices  of the finer model, which it is given
    FinerEnds(const assembly::Discretization &discretization,
              const std::function<modes::FormMatrices(const assembly::Discretization &)> &matrices);

    /// Error of an end, rad/s: its distance to that of the finer model, with safety, and what
    /// rounding leaves open in both.
    /// @param own     the motion on the axis, of the rotor itself
    /// @param inward  1 where something grows above its speed, -1 below
    /// @param reach   rad/s; an end farther away is another one
    /// @returns nothing where the finer model's end is not found for certain
    [[nodiscard]] std::optional<double> error(const EndOfGrowth &own, double inward,
                                              double reach) const;

  private:
    const assembly::Discretization &_discretization;
    assembly::Discretization _finer;
    modes::FormMatrices _matrices;
    std::vector<int> _places; ///< of the planar unknowns of the rotor among the finer ones

    [[nodiscard]] Eigen::VectorXcd embedded(const Eigen::VectorXcd &vector) const;
};

} // namespace whirl::ends

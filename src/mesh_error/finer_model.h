#pragma once

#include "mesh_error/safety.h"
#include "modes/spectrum.h"

#include <Eigen/SparseCore>

#include <memory>
#include <vector>

namespace whirl::mesh_error {

/// The same rotor at finer_order on the same mesh: its functions contain those of the coarse model,
/// so that a coarse mode can be written down in its unknowns and found again among its modes.
class FinerModel {
  public:
    /// @param coarse      kept by reference
    /// @param refinement  that of `coarse`
    FinerModel(const model::Rotor &rotor, const modes::SpectrumSolver &coarse, int refinement = 1);

    /// Relative error of each eigenvalue of `coarse`, estimated as its difference to the finer
    /// model's, with safety. Modes are matched by their place among those of their sense in the
    /// symmetric forms (min-max: none can be lower than it should), by their shapes in the others.
    [[nodiscard]] std::vector<double> errors(const modes::Spectrum &coarse) const;
    /// The same of some of the modes of a spectrum alone, from each of which its finer one is
    /// found; empty where that is not sure.
    [[nodiscard]] std::vector<double> errors_by_refinement(const modes::Spectrum &some) const;

    [[nodiscard]] const modes::SpectrumSolver &solver() const { return *_fine; }

  private:
    const modes::SpectrumSolver &_coarse;
    std::unique_ptr<modes::SpectrumSolver> _fine;
    std::vector<int> _places; ///< of the coarse planar unknowns among the fine ones
    Eigen::SparseMatrix<double> _mass;

    [[nodiscard]] std::vector<double> errors_by_place(const modes::Spectrum &coarse) const;
    [[nodiscard]] std::vector<double> errors_by_shape(const modes::Spectrum &coarse) const;
    [[nodiscard]] Eigen::VectorXcd embedded(const Eigen::VectorXcd &shape) const;
    [[nodiscard]] Eigen::VectorXcd embedded_terms(const Eigen::VectorXcd &vector) const;
};

} // namespace whirl::mesh_error

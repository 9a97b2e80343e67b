#pragma once

#include "assembly/discretization.h"
#include "assembly/system.h"
#include "modes/form_matrices.h"
#include "modes/general_spectrum.h"
#include "reduction/planar_shapes.h"

#include <Eigen/Core>
#include <Eigen/SparseCholesky>

#include <memory>

namespace whirl::modes {

/// Form general of a held rotor on few shapes of one plane: modes nearly those of the whole rotor,
/// all of them from one small dense problem a speed.
class FewShapes {
  public:
    /// None where the rotor is not held, or small.
    /// @param discretization  must outlive the result; bearings do not change with speed
    /// @param modes           that are to be described
    [[nodiscard]] static std::unique_ptr<FewShapes> of(const assembly::Discretization &d,
                                                       int modes);

    /// As those of GeneralSpectrum, over all unknowns of the rotor; no more than the `wanted`
    /// lowest.
    [[nodiscard]] Spectrum modes(double speed, int wanted) const;

    /// Over the amplitudes of the shapes in pairs (x, y).
    [[nodiscard]] const FormMatrices &matrices() const { return _matrices; }
    [[nodiscard]] Eigen::VectorXcd amplitudes(const Eigen::VectorXcd &shape) const;

    /// Estimated relative change of an eigenvalue by all that the shapes leave out: with the
    /// residual r = Q(l) x of the whole rotor, r^H H^-1 r / (2 |l|^2 x^H M x), H the planar
    /// stiffness. (l is a stationary value, so that the error is of the second order; beyond the
    /// shapes Q is nearly H.)
    [[nodiscard]] double left_out(double speed, const WhirlMode &mode) const;

  private:
    FewShapes(const assembly::Discretization &d, reduction::PlanarShapes shapes);

    reduction::PlanarShapes _shapes;
    Eigen::MatrixXd _onto; ///< amplitudes of planar unknowns
    assembly::FixedSystem _whole;
    GeneralSpectrum _spectrum;
    FormMatrices _matrices;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> _stiffness; ///< factors of H
};

} // namespace whirl::modes

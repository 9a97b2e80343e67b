#pragma once

#include "assembly/discretization.h"
#include "modes/biorthogonal.h"
#include "modes/form_matrices.h"
#include "modes/whirl_mode.h"

#include <memory>
#include <optional>
#include <vector>

namespace whirl::modes {

/// Whirl modes in a form of the fixed frame with damping (general, planar_damped), at any speed.
///
/// The rotor reduced to planar shapes (reduction/planar_shapes.h) has all its eigenvalues from one
/// small dense problem; each that is wanted is then refined on the whole rotor with right and left
/// vectors (roots/whole_pencil.h). This is done at five speeds of a range; at others the basis is
/// what their vectors span, and each mode is corrected once on the whole rotor. That the shapes
/// miss none is counted on the whole rotor at three of these, the ends among them, at every speed
/// alone, and wherever an eigenvalue turns out to be another one than the shapes had. Where it does
/// not hold, more shapes are taken.
class RefinedSpectrum {
  public:
    /// @param matrices  of the discretised rotor, kept by reference
    RefinedSpectrum(const assembly::Discretization &discretization, const FormMatrices &matrices);
    ~RefinedSpectrum();
    RefinedSpectrum(const RefinedSpectrum &) = delete;
    RefinedSpectrum &operator=(const RefinedSpectrum &) = delete;
    RefinedSpectrum(RefinedSpectrum &&) = delete;
    RefinedSpectrum &operator=(RefinedSpectrum &&) = delete;
    class Data;

    /// These speeds are asked for next, ascending or descending, here or by other processes:
    /// between them eigenvalues are counted at a few alone.
    void expect(const std::vector<double> &speeds, int wanted);

    /// The `wanted` whirl modes with the lowest frequencies, or all, and motions without whirl that
    /// are as slow or grow: Im >= 0, of form planar_damped whirl set, zero modes beside them.
    /// @throws linalg::SolverError where they are not all found
    [[nodiscard]] Spectrum modes(double speed, int wanted);

    /// At the slowest and the fastest of these speeds the planar shapes are examined: all modes
    /// wanted are found on the whole rotor and counted, and left_out() measured.
    void expect_reduced(const std::vector<double> &speeds, int wanted);

    /// As modes(), of the rotor on planar shapes that were examined, no eigenvalue refined: for
    /// what is discrete, as names of lines.
    [[nodiscard]] Spectrum reduced_modes(double speed, int wanted);
    /// By how much eigenvalues of reduced_modes() may be off, of their moduli: four times the most
    /// that they were where they were examined.
    [[nodiscard]] double left_out() const;

    /// States and rates of modes on the planar shapes of the range expected last, for the products
    /// by which modes are followed over it: these need no more than two or three digits. Nothing
    /// where none was expected, or of a rotor of few unknowns.
    /// @param right,left  y^T Q = 0, over the unknowns of the form
    [[nodiscard]] std::optional<ModeBasis> basis(double speed, const Eigen::VectorXcd &values,
                                                 const Eigen::MatrixXcd &right,
                                                 const Eigen::MatrixXcd &left) const;

    /// Modes near guesses of their eigenvalues and shapes, one for each; none where they cannot be
    /// found from these.
    [[nodiscard]] std::vector<WhirlMode> near(double speed, const std::vector<WhirlMode> &guesses);

  private:
    std::unique_ptr<Data> _data;
};

} // namespace whirl::modes

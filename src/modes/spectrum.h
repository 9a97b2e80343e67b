#pragma once

#include "model/rotor.h"
#include "modes/biorthogonal.h"
#include "modes/whirl_mode.h"
#include "results/formulation.h"

#include <Eigen/Core>

#include <complex>
#include <memory>
#include <utility>
#include <vector>

namespace whirl::assembly {
class Discretization;
}

namespace whirl::modes {

/// Whirl modes of one discretised rotor at any spin speed. Everything that does not depend on
/// the speed is assembled and factorised once.
class SpectrumSolver {
  public:
    /// @param order       of the shaft elements
    /// @param refinement  every element is split into that many
    /// @param harmonics   of the Hill series (form hill)
    SpectrumSolver(const model::Rotor &rotor, results::Form form, int order, int refinement = 1,
                   int harmonics = hill_harmonics);
    ~SpectrumSolver();
    SpectrumSolver(const SpectrumSolver &) = delete;
    SpectrumSolver &operator=(const SpectrumSolver &) = delete;
    SpectrumSolver(SpectrumSolver &&) = delete;
    SpectrumSolver &operator=(SpectrumSolver &&) = delete;

    /// The `wanted` whirl modes with the lowest frequencies (all, where there are fewer), and those
    /// of zero frequency, of free rigid motions, beside them.
    /// @param errors  of right vectors: damped ones in the fixed frame are those of the reduced
    ///                rotor, as after take_reduced_roots()
    /// @throws model::AnalysisFailure where they cannot be found.
    [[nodiscard]] Spectrum at(double speed, int wanted,
                              Errors errors = Errors::with_left_vectors) const;

    /// These speeds are asked for next, here or by other processes: what is found at one of them
    /// does not depend on who asks for the others.
    void expect(const std::vector<double> &speeds, int wanted) const;
    /// Whether what was found at one speed helps at the next, so that speeds cannot be shared among
    /// processes.
    /// @param follow  follow() is asked for
    [[nodiscard]] bool carries_over(bool follow) const;

    /// `reduction = "off"`: from now on damped forms of the fixed frame by SLEPc on all unknowns at
    /// each speed.
    void take_all_unknowns() const;
    /// Whether modes are those of shapes refined on the whole rotor (refined_spectrum.h).
    [[nodiscard]] bool refines() const;

    /// From now on damped forms of the fixed frame on planar shapes, refined nowhere but by near():
    /// for what is discrete, as names of lines.
    void take_reduced_roots() const;
    /// By how much eigenvalues of such modes were off at the most where they were refined as well,
    /// of their moduli; 0 of all others.
    [[nodiscard]] double left_out() const;

    /// Form rotating: by a reduced rotor over the range of these speeds, where one suffices.
    void follow(const std::vector<double> &speeds, int wanted) const;

    /// Form rotating: this rotor reduced to the shapes that its motions were found to have over a
    /// range of speeds, after follow() through several; for searches that ask at hundreds of
    /// speeds. Its modes are over the amplitudes of these shapes. Null where there is none.
    /// @param from,to  rad/s
    [[nodiscard]] const SpectrumSolver *reduced_for(double from, double to, int wanted) const;
    /// The reduction basis of a reduced rotor, planar shapes N x r; null of a whole one.
    [[nodiscard]] const Eigen::MatrixXd *shapes() const;

    /// Form hill: this rotor reduced to the shapes that its motions have over a range of speeds,
    /// its modes by monodromy matrices (hill/floquet_spectrum.h) and over the amplitudes of these
    /// shapes; near() makes them those of this rotor.
    /// @param from,to  rad/s
    [[nodiscard]] std::unique_ptr<SpectrumSolver> by_monodromy(double from, double to,
                                                               int wanted) const;
    /// True of such a reduced rotor, whose spectra cost little.
    [[nodiscard]] bool by_matrix() const;
    /// True if its monodromy matrix resolves `wanted` modes at this speed (not near standstill,
    /// FloquetSpectrum::resolves).
    [[nodiscard]] bool by_matrix(double speed, int wanted) const;
    /// Speed below which all natural frequencies are at least five times the speed, rad/s; 0: not
    /// known (FloquetSpectrum::slow).
    [[nodiscard]] double slow() const;

    /// Modes near guesses over the unknowns of this rotor, one for each; none where they cannot be
    /// found from these. Form hill: guesses over any unknowns, at speeds other than 0, by as many
    /// harmonics as each needs.
    [[nodiscard]] std::vector<WhirlMode> near(double speed,
                                              const std::vector<WhirlMode> &guesses) const;

    /// Left and right vectors of the modes of a spectrum of this rotor, for overlaps with those at
    /// any other speed. Rates are those of the modes' eigenvalues in the fixed frame.
    /// Those of form hill are not numbers: its left vectors are of the motions among themselves.
    [[nodiscard]] ModeBasis basis(const Spectrum &spectrum) const;

    /// The matrices of the eigenproblem at a speed; form hill: without the part of the bearings
    /// that turns. In no form with complex matrices.
    [[nodiscard]] QuadraticAt problem_at(double speed) const;

    /// Planar unknowns x and y of a mode in the fixed frame: x(t) = Re(x exp(l t)).
    [[nodiscard]] std::pair<Eigen::VectorXcd, Eigen::VectorXcd> planes(const WhirlMode &mode) const;

    [[nodiscard]] const assembly::Discretization &discretization() const;
    [[nodiscard]] results::Form form() const;
    /// Unknowns of the eigenproblem.
    [[nodiscard]] int unknowns() const;

    /// Harmonics of the Hill series for whirl modes; `stability` chooses its own number.
    static constexpr int hill_harmonics = 4;

  private:
    struct Data;
    std::unique_ptr<Data> _data;

    explicit SpectrumSolver(std::unique_ptr<Data> data);
    [[nodiscard]] Spectrum symmetric(double speed, int wanted) const;
    [[nodiscard]] Spectrum damped(double speed, int wanted, Errors errors) const;
    [[nodiscard]] Spectrum rotating(double speed, int wanted, Errors errors) const;
    [[nodiscard]] ModeBasis hill_basis(const Spectrum &spectrum) const;
    void classify(Spectrum &spectrum) const;
};

} // namespace whirl::modes

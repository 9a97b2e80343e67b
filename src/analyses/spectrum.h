#pragma once

#include "analyses/whirl_mode.h"

#include <complex>
#include <memory>
#include <vector>

namespace whirl::assembly {
class Discretization;
}

namespace whirl::analyses {

class Stations;

/// The whirl modes at one spin speed with the lowest frequencies, ascending by frequency.
struct Spectrum {
    double speed = 0; ///< rad/s
    std::vector<WhirlMode> modes;
    std::vector<double> overdamped; ///< real eigenvalues met on the way, 1/s
    double complete_radius = 0;     ///< all eigenvalues of smaller modulus are known, 1/s
};

/// Whirl modes of one discretised rotor at any spin speed. Everything that does not depend on
/// the speed is assembled and factorised once.
class SpectrumSolver {
  public:
    /// @param order       of the shaft elements
    /// @param refinement  every element is split into that many
    SpectrumSolver(const model::Rotor &rotor, Form form, int order, int refinement = 1);
    ~SpectrumSolver();
    SpectrumSolver(const SpectrumSolver &) = delete;
    SpectrumSolver &operator=(const SpectrumSolver &) = delete;
    SpectrumSolver(SpectrumSolver &&) = delete;
    SpectrumSolver &operator=(SpectrumSolver &&) = delete;

    /// At least `wanted` whirl modes (all, where there are fewer), lowest frequencies first.
    /// @throws model::AnalysisFailure where they cannot be found.
    [[nodiscard]] Spectrum at(double speed, int wanted) const;

    /// Modal assurance of modes of this rotor at any two speeds, 0..1, rows a, columns b, in the
    /// energy product of (displacement, velocity) in which modes of one speed are orthogonal.
    [[nodiscard]] Eigen::MatrixXd overlaps(const std::vector<WhirlMode> &a,
                                           const std::vector<WhirlMode> &b) const;

    /// Complex deflections of a mode at the stations: x(t) = Re(x exp(l t)).
    [[nodiscard]] Eigen::VectorXcd x_at(const WhirlMode &mode, const Stations &stations) const;
    [[nodiscard]] Eigen::VectorXcd y_at(const WhirlMode &mode, const Stations &stations) const;

    [[nodiscard]] const assembly::Discretization &discretization() const;
    [[nodiscard]] Form form() const;
    /// Unknowns of the eigenproblem.
    [[nodiscard]] int unknowns() const;

  private:
    struct Data;
    std::unique_ptr<Data> _data;

    [[nodiscard]] Spectrum symmetric(double speed, int wanted) const;
    [[nodiscard]] Spectrum general(double speed, int wanted) const;
    void classify(Spectrum &spectrum) const;
};

} // namespace whirl::analyses

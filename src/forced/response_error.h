#pragma once

#include "forced/forced_motion.h"
#include "results/formulation.h"

#include <array>
#include <complex>
#include <memory>
#include <optional>

namespace whirl::forced {

/// The finer rotor that errors of steady motions are told by: its order, and parts of each element.
struct FinerMesh {
    int order;
    int parts;
};
[[nodiscard]] FinerMesh finer_mesh(int order);
/// Estimated relative error of a number, from that of the finer rotor; 0 of two that are zero.
[[nodiscard]] double error_share(std::complex<double> coarse, std::complex<double> fine);

/// How far the steady motion of a discretised rotor is from that of a finer one, solved at
/// the same speed: elements of order p + 4 on the same mesh (order 5 for classical ones), above
/// order 30, which is the highest, elements of half the length. A rigid shaft has no such error.
class ResponseError {
  public:
    ResponseError(const assembly::Discretization &coarse, results::Form form,
                  const Drive &drive = {});

    /// @throws linalg::SolverError where the finer rotor is at an undamped resonance.
    void solve(double speed);

    /// Estimated relative error: the semi-major axis of the difference of the orbits over the
    /// larger of theirs, so that no point of the orbit, no |x| and no reading of a probe is off by
    /// more than this share of the amplitude; times a safety factor.
    [[nodiscard]] double at(double z, const Phasor &coarse) const;
    /// The same of the force in a bearing.
    [[nodiscard]] double of_force(int bearing, const Phasor &coarse) const;
    /// The same of what a bearing is stretched by.
    [[nodiscard]] double of_stretch(int bearing, const Phasor &coarse) const;
    /// The same of a deflection that is not that of a place, or of what a probe reads of it: as it
    /// is seen.
    [[nodiscard]] double of_quantity(const Quantity &quantity, const Phasor &seen) const;
    /// The same of what a probe reads, relative to that.
    /// @param coarse  what it looks at
    [[nodiscard]] double of_probe(const model::Probe &probe, const Phasor &coarse) const;

    /// The same of x and of y alone, each relative to itself.
    [[nodiscard]] std::array<double, 2> of_components(double z, const Phasor &coarse) const;

    /// There is no finer rotor: the shaft is rigid.
    [[nodiscard]] bool none() const { return _fine == nullptr; }
    /// The finer rotor's own motion.
    [[nodiscard]] Phasor finer_of(const Quantity &quantity) const { return _motion->of(quantity); }
    /// Under the weight, what stands still in the fixed frame: estimated relative error.
    [[nodiscard]] double at_rest(double z, std::complex<double> coarse);
    [[nodiscard]] double force_at_rest(int bearing, std::complex<double> coarse);

  private:
    std::unique_ptr<assembly::Discretization> _fine;
    std::optional<ForcedMotion> _motion; ///< none of a rigid shaft
};

} // namespace whirl::forced

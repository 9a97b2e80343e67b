#pragma once

#include "balancers/kind.h"

namespace whirl::balancers {

/// Equal rigid rings (mass m, inertia J about their own axes, bore radius R) side by side that hang
/// on a journal of the rotor with the clearance e: a ring's centre stands at e exp(i g), g its
/// angle, and turns by s about itself. A ring resists tilting with its plane of the rotor. The
/// energy, to second order in slopes, and the loss:
///
///     T = circle mass (m, e) + J s'^2/2 - s' J Im(conj(phi) phi')/2 + J |phi'|^2/4
///     F = c v^2/2 + d (s' - Omega)^2/2,   v = e (g' - Omega) - R (s' - Omega)
///
/// v is the speed of sliding at the contact, opposite the centre. docs/theory.md, "Ring balancers".
class RingKind final : public Kind {
  public:
    explicit RingKind(const model::Rings &rings) : _rings(rings) {}

    [[nodiscard]] std::string name() const override { return "ring"; }
    [[nodiscard]] std::string parts() const override { return "rings"; }
    [[nodiscard]] PartsInertia inertia() const override;
    [[nodiscard]] Reach reach() const override;
    [[nodiscard]] bool damped() const override { return _rings.damping > 0 && _rings.drag > 0; }
    [[nodiscard]] std::vector<CircledMass> circled() const override;
    [[nodiscard]] std::optional<std::vector<double>> usual_position(double capacity) const override;
    [[nodiscard]] SmallMotions small_motions(const std::vector<double> &angles) const override;
    [[nodiscard]] std::shared_ptr<const PartsMotion> motion(bool tilt,
                                                            double gravity) const override;
    [[nodiscard]] std::vector<std::string> coordinates() const override;
    [[nodiscard]] Outline outline() const override;

  private:
    const model::Rings &_rings;
};

} // namespace whirl::balancers

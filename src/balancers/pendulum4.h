#pragma once

#include "balancers/kind.h"
#include "model/rotor.h"

namespace whirl::balancers {

/// The pendulums of a balancer, for the analysis of their efficiency.
struct PlacedPendulums : model::Pendulums {
    std::string name;
    double z = 0;          ///< m
    std::size_t index = 0; ///< of the balancer in the rotor
};

[[nodiscard]] std::vector<PlacedPendulums> pendulums_in(const model::Rotor &rotor);

/// Two tied pairs of pendulums (masses m on arms l, hinged at +-a) on two perpendicular lines of
/// the rotor: G. Filimonikhin et al., four-pendulum auto-balancer with ties; small motions are
/// linear in the angles. docs/theory.md, "Four-pendulum balancers".
class PendulumKind final : public Kind {
  public:
    explicit PendulumKind(const model::Pendulums &pendulums) : _pendulums(pendulums) {}

    [[nodiscard]] std::string name() const override { return "pendulum4"; }
    [[nodiscard]] std::string parts() const override { return "pendulums"; }
    [[nodiscard]] PartsInertia inertia() const override;
    [[nodiscard]] Reach reach() const override;
    [[nodiscard]] bool damped() const override { return _pendulums.damping > 0; }
    [[nodiscard]] SmallMotions small_motions(const std::vector<double> &angles) const override;
    [[nodiscard]] std::shared_ptr<const PartsMotion> motion(bool tilt,
                                                            double gravity) const override;
    [[nodiscard]] std::vector<std::string> coordinates() const override { return {"phi", "psi"}; }
    [[nodiscard]] Outline outline() const override;

  private:
    const model::Pendulums &_pendulums;
};

} // namespace whirl::balancers

#pragma once

#include "balancers/kind.h"

namespace whirl::balancers {

/// Balls in one race or several side by side, each ball held back by h_A times its speed along the
/// race. Linear: A. N. Gorbenko, Mass-inertia characteristics and dimensionless equations of motion
/// of a rotor with an auto-balancer, with the complex second harmonic of the arrangement; several
/// rows of different balls as in G. Filimonikhin's multi-row balancers. docs/theory.md.
class BallKind final : public Kind {
  public:
    explicit BallKind(const model::Balls &balls) : _balls(balls) {}

    [[nodiscard]] std::string name() const override { return "ball"; }
    [[nodiscard]] std::string parts() const override { return "balls"; }
    [[nodiscard]] PartsInertia inertia() const override;
    [[nodiscard]] Reach reach() const override;
    [[nodiscard]] bool damped() const override;
    [[nodiscard]] std::optional<double> rate() const override;
    [[nodiscard]] std::vector<CircledMass> circled() const override;
    [[nodiscard]] std::optional<std::vector<double>> usual_position(double capacity) const override;
    [[nodiscard]] SmallMotions small_motions(const std::vector<double> &angles) const override;
    [[nodiscard]] std::shared_ptr<const PartsMotion> motion(bool tilt,
                                                            double gravity) const override;
    [[nodiscard]] std::vector<std::string> coordinates() const override;
    [[nodiscard]] Outline outline() const override;

  private:
    const model::Balls &_balls;
};

} // namespace whirl::balancers

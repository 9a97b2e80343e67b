#include "oracles/ball_motion.h"

#include "oracles/carried.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace whirl::oracles {

namespace {

using Vector = Eigen::VectorXd;

/// In axes that turn with the rotor motions are slower than the turns.
constexpr double steps_a_turn = 60;

/// q and its rates, Runge-Kutta 4.
class Marching {
  public:
    Marching(const CarriedRotor &rotor, const Vector &start) : _rotor(rotor), _q(start) {
        _r = Vector::Zero(start.size());
    }
    void step(double h) {
        const auto rate = [this](const Vector &q, const Vector &r) {
            return _rotor.acceleration(q, r);
        };
        const Vector a1 = rate(_q, _r);
        const Vector r2 = _r + h / 2 * a1;
        const Vector a2 = rate(_q + h / 2 * _r, r2);
        const Vector r3 = _r + h / 2 * a2;
        const Vector a3 = rate(_q + h / 2 * r2, r3);
        const Vector r4 = _r + h * a3;
        const Vector a4 = rate(_q + h * r3, r4);
        _q += h / 6 * (_r + 2 * r2 + 2 * r3 + r4);
        _r += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    }
    [[nodiscard]] const Vector &q() const { return _q; }

  private:
    const CarriedRotor &_rotor;
    Vector _q, _r;
};

Vector start(const CarriedRotor &rotor, const std::vector<std::vector<double>> &angles) {
    Vector q = Vector::Zero(rotor.unknowns());
    std::vector<std::size_t> used(angles.size(), 0);
    for (std::size_t k = 0; k < rotor.beads().size(); ++k) {
        if (rotor.beads()[k].held)
            continue;
        const std::size_t balancer = rotor.beads()[k].balancer;
        q[rotor.place(k)] = angles.at(balancer).at(used.at(balancer)++);
    }
    return q;
}

} // namespace

std::string BallOutcome::name() const {
    if (drift > std::numbers::pi)
        return "lagging";
    if (swing > 0.05)
        return "whirling";
    return residual < 0.1 ? "balanced" : "offset";
}

BallOutcome ball_motion(const CaseRotor &rotor, double speed,
                        const std::vector<std::vector<double>> &angles, double time) {
    const CarriedRotor carried(rotor, speed);
    const double without = carried.amplitude_without_beads();
    Marching motion(carried, start(carried, angles));
    const auto steps = static_cast<long>(steps_a_turn * time * speed / (2 * std::numbers::pi)) + 1;
    const auto beads = static_cast<Eigen::Index>(carried.beads().size());
    const auto in_rotor = [&] {
        Vector out(beads);
        for (Eigen::Index k = 0; k < beads; ++k)
            out[k] = motion.q()[carried.place(static_cast<std::size_t>(k))];
        return out;
    };
    Vector tenth, low, high;
    double largest = 0;
    for (long k = 0; k < steps; ++k) {
        if (k == steps - steps / 10)
            tenth = in_rotor();
        if (k == steps - steps / 40)
            low = high = in_rotor();
        if (k >= steps - steps / 40) {
            low = low.cwiseMin(in_rotor());
            high = high.cwiseMax(in_rotor());
            largest = std::max(largest, carried.amplitude(motion.q()));
        }
        motion.step(time / static_cast<double>(steps));
    }
    BallOutcome out;
    const Vector end = in_rotor();
    out.drift = (end - tenth).cwiseAbs().maxCoeff();
    out.swing = (high - low).maxCoeff();
    out.residual = largest / without;
    out.angles.resize(rotor.balancers.size());
    for (std::size_t k = 0; k < carried.beads().size(); ++k)
        out.angles[carried.beads()[k].balancer].push_back(
            std::remainder(end[static_cast<Eigen::Index>(k)], 2 * std::numbers::pi));
    return out;
}

} // namespace whirl::oracles

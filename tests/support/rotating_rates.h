#pragma once

#include "simulation/equations.h"
#include "simulation/motion.h"

#include <Eigen/Core>

#include <utility>

namespace whirl::tests {

/// State and its rates in rotating axes at the moment when they coincide with the fixed ones.
class RotatingRates {
  public:
    explicit RotatingRates(const model::Case &scene)
        : _scene(simulation::motion_scene(scene)), _motion(_scene.parts),
          _speed(scene.speeds->from) {}

    [[nodiscard]] int size() const { return 2 * _motion.coordinates(); }

    /// q, q' of the rotating frame to q', q'': w = u, w' = u' + i speed u, and so on.
    [[nodiscard]] Eigen::VectorXd at(const Eigen::VectorXd &rotating) const {
        const Eigen::Index r = _motion.parts().rotor.size();
        const Eigen::Index n = _motion.coordinates();
        Eigen::VectorXd state = Eigen::VectorXd::Zero(_motion.size());
        state.head(2 * n) = rotating;
        for (std::size_t i = 0; i < _scene.start_angles.size(); ++i)
            state(2 * r + static_cast<Eigen::Index>(i)) += _scene.start_angles[i];
        state.segment(n, r) -= _speed * rotating.segment(r, r);
        state.segment(n + r, r) += _speed * rotating.head(r);
        Eigen::VectorXd rates(_motion.size());
        _motion.rates(0, state.data(), rates.data());
        Eigen::VectorXd out(2 * n);
        out << rotating.tail(n), rates.segment(n, n);
        const auto u = rotating.head(2 * r);
        const auto du = rotating.segment(n, 2 * r);
        out.segment(n, r) += 2 * _speed * du.tail(r) + _speed * _speed * u.head(r);
        out.segment(n + r, r) += -2 * _speed * du.head(r) + _speed * _speed * u.tail(r);
        return out;
    }

    /// Numerical derivative at the start; differences of the sixth order leave nothing of the
    /// curvature, and 1e-13 of the largest rates by rounding.
    [[nodiscard]] Eigen::MatrixXd jacobian() const {
        constexpr double step = 1e-3;
        Eigen::MatrixXd J(size(), size());
        for (int i = 0; i < size(); ++i) {
            const Eigen::VectorXd one = step * Eigen::VectorXd::Unit(size(), i);
            const auto across = [&](int k) -> Eigen::VectorXd {
                return at(k * one) - at(-k * one);
            };
            J.col(i) = (45 * across(1) - 9 * across(2) + across(3)) / (60 * step);
        }
        return J;
    }

  private:
    simulation::MotionScene _scene;
    simulation::RotorMotion _motion;
    double _speed;
};

} // namespace whirl::tests

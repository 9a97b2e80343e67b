#include "oracles/ball_motion.h"

#include "oracles/rigid_rotor.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

namespace whirl::oracles {

namespace {

using Number = std::complex<double>;
using Vector = Eigen::VectorXd;

struct Ball {
    std::size_t balancer;
    double z; ///< from the centre of mass, m
    double mass, radius, damping;
};

/// State: Re w, Im w, Re phi, Im phi, ball angles in the fixed frame; then their rates.
class Equations {
  public:
    Equations(const CaseRotor &rotor, double speed) : _body(bare_rotor(rotor)), _speed(speed) {
        for (std::size_t b = 0; b < rotor.balancers.size(); ++b) {
            const Balancer &balancer = rotor.balancers[b];
            if (balancer.pendulums || balancer.imbalance_radius > 0)
                throw std::runtime_error("motion of balls: no pendulums, no point masses");
            const double z = balancer.z - static_cast<double>(_body.centre);
            _imbalance += balancer.imbalance;
            _imbalance_moment += balancer.imbalance * z;
            for (int i = 0; i < balancer.n; ++i)
                _balls.push_back({b, z, balancer.mass, balancer.radius, balancer.damping});
        }
    }

    [[nodiscard]] const std::vector<Ball> &balls() const { return _balls; }
    [[nodiscard]] Eigen::Index unknowns() const {
        return 4 + static_cast<Eigen::Index>(_balls.size());
    }

    [[nodiscard]] Vector rate(double t, const Vector &y) const {
        const Eigen::Index n = unknowns();
        Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n, n);
        Vector f = Vector::Zero(n);
        add_rotor(t, y, M, f);
        for (Eigen::Index j = 0; j < n - 4; ++j)
            add_ball(j, y, M, f);
        Vector out(2 * n);
        out.head(n) = y.tail(n);
        out.tail(n) = M.partialPivLu().solve(f);
        return out;
    }

    /// Largest deflection at the balancers with w and phi as in y.
    [[nodiscard]] double amplitude(const Vector &y) const {
        double out = 0;
        for (const Ball &ball : _balls)
            out = std::max(out, std::hypot(y[0] + ball.z * y[2], y[1] + ball.z * y[3]));
        return out;
    }

    /// The same of the steady motion without balls.
    [[nodiscard]] double amplitude_without_balls() const {
        const double W2 = _speed * _speed;
        const auto value = [](Real x) { return static_cast<double>(x); };
        Eigen::Matrix2cd D;
        D << Number(value(_body.k0) - W2 * value(_body.mass), _speed * value(_body.c0)),
            Number(value(_body.k1), _speed * value(_body.c1)),
            Number(value(_body.k1), _speed * value(_body.c1)),
            Number(value(_body.k2) - W2 * value(_body.A - _body.C), _speed * value(_body.c2));
        const Eigen::Vector2cd u =
            D.inverse() * Eigen::Vector2cd(W2 * _imbalance, W2 * _imbalance_moment);
        double out = 0;
        for (const Ball &ball : _balls)
            out = std::max(out, std::abs(u[0] + ball.z * u[1]));
        return out;
    }

  private:
    RigidRotor _body;
    double _speed;
    double _imbalance = 0;
    double _imbalance_moment = 0;
    std::vector<Ball> _balls;

    void add_rotor(double t, const Vector &y, Eigen::MatrixXd &M, Vector &f) const {
        const Eigen::Index n = unknowns();
        const auto value = [](Real x) { return static_cast<double>(x); };
        const Number w(y[0], y[1]), phi(y[2], y[3]);
        const Number w1(y[n], y[n + 1]), phi1(y[n + 2], y[n + 3]);
        const Number turning = _speed * _speed * std::polar(1.0, _speed * t);
        const Number force = _imbalance * turning - value(_body.k0) * w - value(_body.k1) * phi -
                             value(_body.c0) * w1 - value(_body.c1) * phi1;
        const Number moment = _imbalance_moment * turning - value(_body.k1) * w -
                              value(_body.k2) * phi - value(_body.c1) * w1 -
                              value(_body.c2) * phi1 + Number(0, _speed) * value(_body.C) * phi1;
        M.diagonal().head(4) << value(_body.mass), value(_body.mass), value(_body.A),
            value(_body.A);
        f.head(4) << force.real(), force.imag(), moment.real(), moment.imag();
    }

    void add_ball(Eigen::Index j, const Vector &y, Eigen::MatrixXd &M, Vector &f) const {
        const Eigen::Index n = unknowns();
        const Eigen::Index at = 4 + j;
        const Ball &ball = _balls[static_cast<std::size_t>(j)];
        const Number turned = std::polar(1.0, y[at]);
        const double c = turned.real();
        const double s = turned.imag();
        const double spin = y[n + at];
        const double m = ball.mass;
        const double R = ball.radius;
        const double z = ball.z;
        // m (w_A'' + (i gamma'' - gamma'^2) R e^{i gamma}) in the plane, times z on the slope
        for (const Eigen::Index axis : {0, 1}) {
            M(axis, axis) += m;
            M(axis, axis + 2) += m * z;
            M(axis + 2, axis) += m * z;
            M(axis + 2, axis + 2) += m * z * z;
            const double along = axis == 0 ? -s : c;
            const double outward = axis == 0 ? c : s;
            M(axis, at) += m * R * along;
            M(axis + 2, at) += m * R * z * along;
            f[axis] += m * R * spin * spin * outward;
            f[axis + 2] += m * R * z * spin * spin * outward;
            // R gamma'' = -Im(e^{-i gamma} w_A'') - ...
            M(at, axis) += along;
            M(at, axis + 2) += z * along;
        }
        M(at, at) += R;
        f[at] -= ball.damping / m * R * (spin - _speed);
        // m R^2 e^{i gamma}(c'' + gamma'^2 c): c'' = Re[(phi'' - 2 i g' phi' - i g'' phi -
        // g'^2 phi) e^{-i gamma}], so that gamma'^2 c drops out
        const Number phi = Number(y[2], y[3]) * std::conj(turned);
        const Number phi1 = Number(y[n + 2], y[n + 3]) * std::conj(turned);
        const double known = 2 * spin * phi1.imag();
        for (const Eigen::Index axis : {0, 1}) {
            const double outward = m * R * R * (axis == 0 ? c : s);
            M(2 + axis, 2) += outward * c;
            M(2 + axis, 3) += outward * s;
            M(2 + axis, at) += outward * phi.imag();
            f[2 + axis] -= outward * known;
        }
    }
};

Vector start(const Equations &equations, double speed,
             const std::vector<std::vector<double>> &angles) {
    const Eigen::Index n = equations.unknowns();
    Vector y = Vector::Zero(2 * n);
    std::vector<std::size_t> used(angles.size(), 0);
    for (std::size_t j = 0; j < equations.balls().size(); ++j) {
        const std::size_t balancer = equations.balls()[j].balancer;
        y[4 + static_cast<Eigen::Index>(j)] = angles.at(balancer).at(used.at(balancer)++);
        y[n + 4 + static_cast<Eigen::Index>(j)] = speed;
    }
    return y;
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
    const Equations equations(rotor, speed);
    const Eigen::Index n = equations.unknowns();
    Vector y = start(equations, speed, angles);
    const auto steps = static_cast<long>(120 * time * speed / (2 * std::numbers::pi)) + 1;
    const double h = time / static_cast<double>(steps);
    const auto in_rotor = [&](double t) { return Vector(y.segment(4, n - 4).array() - speed * t); };
    Vector tenth, low, high;
    double largest = 0;
    for (long k = 0; k < steps; ++k) {
        const double t = static_cast<double>(k) * h;
        if (k == steps - steps / 10)
            tenth = in_rotor(t);
        if (k == steps - steps / 40)
            low = high = in_rotor(t);
        if (k >= steps - steps / 40) {
            low = low.cwiseMin(in_rotor(t));
            high = high.cwiseMax(in_rotor(t));
            largest = std::max(largest, equations.amplitude(y));
        }
        const Vector a = equations.rate(t, y);
        const Vector b = equations.rate(t + h / 2, y + h / 2 * a);
        const Vector c = equations.rate(t + h / 2, y + h / 2 * b);
        const Vector d = equations.rate(t + h, y + h * c);
        y += h / 6 * (a + 2 * b + 2 * c + d);
    }
    BallOutcome out;
    const Vector end = in_rotor(time);
    out.drift = (end - tenth).cwiseAbs().maxCoeff();
    out.swing = (high - low).maxCoeff();
    out.residual = largest / equations.amplitude_without_balls();
    out.angles.resize(rotor.balancers.size());
    for (std::size_t j = 0; j < equations.balls().size(); ++j)
        out.angles[equations.balls()[j].balancer].push_back(
            std::remainder(end[static_cast<Eigen::Index>(j)], 2 * std::numbers::pi));
    return out;
}

} // namespace whirl::oracles

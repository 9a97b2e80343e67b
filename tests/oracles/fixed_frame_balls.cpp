#include "oracles/fixed_frame_balls.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace whirl::oracles {

namespace {

using Vector = Eigen::VectorXd;

struct Point {
    std::size_t balancer = 0;
    double z = 0; ///< from the centre of mass, m
    double mass = 0, radius = 0, damping = 0;
};

/// x, y of the centre of mass, slopes dx/dz and dy/dz, then the angles of the balls in fixed axes.
class Rotor {
  public:
    Rotor(const CaseRotor &rotor, double speed) : _rotor(rotor), _speed(speed) {
        for (const RigidDisc &disc : rotor.discs) {
            _mass += disc.mass;
            _centre += disc.mass * disc.z;
        }
        _centre /= _mass;
        for (const RigidDisc &disc : rotor.discs) {
            _tilt += disc.Id + disc.mass * (disc.z - _centre) * (disc.z - _centre);
            _polar += disc.Ip;
        }
        for (std::size_t b = 0; b < rotor.balancers.size(); ++b) {
            const Balancer &own = rotor.balancers[b];
            for (int i = 0; i < own.n; ++i)
                _points.push_back({b, from_centre(own.z), own.mass, own.radius, own.damping});
        }
    }
    [[nodiscard]] const std::vector<Point> &points() const { return _points; }
    [[nodiscard]] double from_centre(double z) const { return z - _centre; }

    [[nodiscard]] Vector acceleration(double t, const Vector &q, const Vector &v) const {
        const auto size = static_cast<Eigen::Index>(4 + _points.size());
        Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, size);
        Vector F = Vector::Zero(size);
        A.diagonal().head(4) << _mass, _mass, _tilt, _tilt;
        const auto push = [&F](double z, double x, double y) {
            F.head(4) += Eigen::Vector4d(x, y, z * x, z * y);
        };
        for (const Support &support : _rotor.supports) {
            const double z = from_centre(support.z);
            push(z, -support.k[0][0] * (q(0) + z * q(2)) - support.c[0][0] * (v(0) + z * v(2)),
                 -support.k[1][1] * (q(1) + z * q(3)) - support.c[1][1] * (v(1) + z * v(3)));
        }
        for (const Imbalance &own : _rotor.imbalances) {
            const double force = own.mr * _speed * _speed;
            push(from_centre(own.z), force * std::cos(_speed * t + own.phase),
                 force * std::sin(_speed * t + own.phase));
        }
        // Id s'' - i Ip W s' for slopes s = dx/dz + i dy/dz.
        const double polar = _polar * _speed;
        F(2) -= polar * v(3);
        F(3) += polar * v(2);
        for (std::size_t k = 0; k < _points.size(); ++k) {
            const Point &own = _points[k];
            const auto angle = static_cast<Eigen::Index>(4 + k);
            const double sine = own.radius * std::sin(q(angle));
            const double cosine = own.radius * std::cos(q(angle));
            Eigen::MatrixXd moves = Eigen::MatrixXd::Zero(2, size); // of the ball
            moves(0, 0) = moves(1, 1) = 1;
            moves(0, 2) = moves(1, 3) = own.z;
            moves(0, angle) = -sine;
            moves(1, angle) = cosine;
            A += own.mass * moves.transpose() * moves;
            F += own.mass * v(angle) * v(angle) * moves.transpose() * Eigen::Vector2d(cosine, sine);
            F(angle) -= own.damping * own.radius * own.radius * (v(angle) - _speed);
        }
        return A.partialPivLu().solve(F);
    }

  private:
    const CaseRotor &_rotor;
    double _speed;
    double _mass = 0, _centre = 0, _tilt = 0, _polar = 0; ///< SI
    std::vector<Point> _points;
};

} // namespace

BallsAtRest fixed_frame_balls(const CaseRotor &rotor, double speed,
                              const std::vector<std::vector<double>> &angles, double time) {
    const Rotor moving(rotor, speed);
    const auto balls = static_cast<Eigen::Index>(moving.points().size());
    Vector q = Vector::Zero(4 + balls), v = Vector::Zero(4 + balls);
    Eigen::Index place = 4;
    for (const auto &of_balancer : angles)
        for (const double angle : of_balancer)
            q(place++) = angle;
    v.tail(balls).setConstant(speed);
    constexpr double steps_a_turn = 100; // the motion is one a turn: 1e-8 of it a step
    const auto steps = static_cast<long>(steps_a_turn * time * speed / (2 * std::numbers::pi)) + 1;
    const double h = time / static_cast<double>(steps);
    const long last = steps - steps / 40;
    BallsAtRest out;
    out.amplitudes.assign(rotor.supports.size(), 0);
    Vector sum = Vector::Zero(balls), low, high;
    for (long k = 0; k < steps; ++k) {
        const double t = static_cast<double>(k) * h;
        if (k >= last) {
            const Vector in_rotor = (q.tail(balls).array() - speed * t).matrix();
            sum += in_rotor;
            low = k == last ? in_rotor : Vector(low.cwiseMin(in_rotor));
            high = k == last ? in_rotor : Vector(high.cwiseMax(in_rotor));
            for (std::size_t s = 0; s < rotor.supports.size(); ++s) {
                const double z = moving.from_centre(rotor.supports[s].z);
                out.amplitudes[s] =
                    std::max(out.amplitudes[s], std::hypot(q(0) + z * q(2), q(1) + z * q(3)));
            }
        }
        const Vector a1 = moving.acceleration(t, q, v);
        const Vector v2 = v + h / 2 * a1;
        const Vector a2 = moving.acceleration(t + h / 2, q + h / 2 * v, v2);
        const Vector v3 = v + h / 2 * a2;
        const Vector a3 = moving.acceleration(t + h / 2, q + h / 2 * v2, v3);
        const Vector v4 = v + h * a3;
        const Vector a4 = moving.acceleration(t + h, q + h * v3, v4);
        q += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
        v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    }
    if (balls > 0)
        out.swing = (high - low).maxCoeff();
    out.angles.resize(rotor.balancers.size());
    for (Eigen::Index k = 0; k < balls; ++k)
        out.angles[moving.points()[static_cast<std::size_t>(k)].balancer].push_back(
            std::remainder(sum(k) / static_cast<double>(steps - last), 2 * std::numbers::pi));
    return out;
}

} // namespace whirl::oracles

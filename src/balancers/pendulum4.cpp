#include "balancers/pendulum4.h"

#include <array>
#include <cmath>
#include <numbers>

namespace whirl::balancers {

namespace {

/// Two tied pendulums, hinged at +-a on a line of the rotor, that turn by equal angles f to
/// opposite sides: together they displace 2 i m l sin(f) exp(i line), line = theta + quarter turns.
struct PendulumPair {
    double mass = 0;    ///< m, kg
    double arm = 0;     ///< l, m
    double pivot = 0;   ///< a, m
    double damping = 0; ///< H1 of one hinge, N m s/rad
    double line = 0;    ///< angle of the line of hinges in the rotor, rad
    double gravity = 0; ///< m/s2

    /// @param angle,rate  f and f'
    [[nodiscard]] MassEquation equation(const SpinState &spin, double angle, double rate) const;
    [[nodiscard]] MassMomenta momenta(const SpinState &spin, const PlaneVector &v, double angle,
                                      double rate) const;
    void add_at_rest(const PlaneVector &place, double speed, double angle, Eigen::Index index,
                     AtRest &out) const;
    /// 2 i m l sin(f) exp(i line): the moment of mass, kg m.
    [[nodiscard]] Eigen::Vector2d offset(const SpinState &spin, double angle) const;
    /// a^2 + l^2 + 2 a l cos f: radius of a mass, squared, m2.
    [[nodiscard]] double about(double cosine) const {
        return pivot * pivot + arm * arm + 2 * pivot * arm * cosine;
    }
};

MassEquation PendulumPair::equation(const SpinState &spin, double angle, double rate) const {
    const double e = spin.angle + line;
    const Eigen::Vector2d along(std::cos(e), std::sin(e));
    const Eigen::Vector2d across(-along(1), along(0));
    const double twice = 2 * mass * arm;
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    MassEquation out;
    out.in_rotor = true;
    out.u.head<2>() = twice * cosine * across;
    out.a = twice * arm;
    out.friction = 2 * damping * rate;
    out.b = twice * pivot * spin.speed * spin.speed * sine + out.friction +
            twice * gravity * cosine * along(0);
    const double radial = rate * rate + spin.speed * spin.speed;
    out.force.head<2>() = twice * (radial * sine * across + 2 * spin.speed * rate * cosine * along);
    out.per_spin.head<2>() = twice * sine * along;
    out.offset = offset(spin, angle);
    out.weight = -gravity * out.offset(0);
    const double slowing = 4 * mass * pivot * arm * spin.speed * rate * sine;
    out.torque << -out.weight - slowing, 2 * mass * about(cosine);
    return out;
}

MassMomenta PendulumPair::momenta(const SpinState &spin, const PlaneVector &v, double angle,
                                  double rate) const {
    const Eigen::Vector2d S = offset(spin, angle);
    const Eigen::Vector2d turned(-S(1), S(0)); // i S
    const double e = spin.angle + line;
    const Eigen::Vector2d across(-std::sin(e), std::cos(e));
    const double cosine = std::cos(angle);
    const Eigen::Vector2d S_rate = 2 * mass * arm * cosine * rate * across + spin.speed * turned;
    MassMomenta out;
    out.kinetic = v.head<2>().dot(S_rate) +
                  mass * (about(cosine) * spin.speed * spin.speed + arm * arm * rate * rate);
    out.potential = gravity * S(1);
    out.spin = v.head<2>().dot(turned) + 2 * mass * about(cosine) * spin.speed;
    out.plane.head<2>() = S_rate;
    return out;
}

/// L = 2 m l [f' cos f (n.W' + Om e.W) - Om sin f (e.W' - Om n.W)] + 2 m a l Om^2 cos f
///     + m l^2 f'^2, e along the line of hinges, n across it.
void PendulumPair::add_at_rest(const PlaneVector &place, double speed, double angle,
                               Eigen::Index index, AtRest &out) const {
    const Eigen::Vector2d e(std::cos(line), std::sin(line));
    const Eigen::Vector2d n(-e(1), e(0));
    const double twice = 2 * mass * arm;
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    const double squared = speed * speed;
    const double across = n.dot(place.head<2>());
    out.force.head<2>() += twice * squared * sine * n;
    out.force(index) += twice * squared * (cosine * across - pivot * sine);
    out.inertia(index, index) += twice * arm;
    AtRest::add_symmetric(out.inertia, 0, index, twice * cosine * n);
    AtRest::add_skew(out.gyroscopic, 0, index, -2 * twice * speed * cosine * e);
    out.damping(index, index) += 2 * damping;
    AtRest::add_symmetric(out.stiffness, 0, index, -twice * squared * cosine * n);
    out.stiffness(index, index) += twice * squared * (sine * across + pivot * cosine);
}

Eigen::Vector2d PendulumPair::offset(const SpinState &spin, double angle) const {
    const double e = spin.angle + line;
    return 2 * mass * arm * std::sin(angle) * Eigen::Vector2d(-std::sin(e), std::cos(e));
}

class PendulumMotion final : public PartsMotion {
  public:
    PendulumMotion(const model::Pendulums &p, double gravity) {
        for (const double line : {0.0, std::numbers::pi / 2})
            _pairs[line > 0 ? 1 : 0] = {p.mass, p.arm, p.pivot, p.damping, line, gravity};
    }

    [[nodiscard]] int size() const override { return 2; }

    void equations(const PlaneMotion & /*plane*/, const SpinState &spin, const double *angles,
                   const double *rates, const Directions & /*towards*/,
                   MassEquation *out) const override {
        for (std::size_t j = 0; j < _pairs.size(); ++j)
            out[j] = _pairs[j].equation(spin, angles[j], rates[j]);
    }

    [[nodiscard]] AtRest at_rest(const PlaneVector &place, double speed,
                                 const double *angles) const override {
        AtRest out(size());
        for (std::size_t j = 0; j < _pairs.size(); ++j)
            _pairs[j].add_at_rest(place, speed, angles[j], static_cast<Eigen::Index>(4 + j), out);
        return out;
    }

    [[nodiscard]] MassMomenta momenta(const PlaneMotion &plane, const SpinState &spin,
                                      const double *angles, const double *rates) const override {
        MassMomenta sum;
        for (std::size_t j = 0; j < _pairs.size(); ++j)
            sum += _pairs[j].momenta(spin, plane.velocity, angles[j], rates[j]);
        return sum;
    }

  private:
    std::array<PendulumPair, 2> _pairs;
};

/// Two tied pairs of pendulums (masses m on arms l, hinged at +-a) on two perpendicular lines of
/// the rotor: G. Filimonikhin et al., four-pendulum auto-balancer with ties; small motions are
/// linear in the angles. docs/theory.md, "Four-pendulum balancers".
class PendulumKind final : public Kind {
  public:
    explicit PendulumKind(const model::Pendulums &pendulums) : _pendulums(pendulums) {}

    [[nodiscard]] std::string name() const override { return "pendulum4"; }
    [[nodiscard]] std::string parts() const override { return "pendulums"; }

    /// Four hinged arms seen as one body: their masses stand on two perpendicular lines, which
    /// makes them axisymmetric.
    [[nodiscard]] PartsInertia inertia() const override {
        PartsInertia out;
        const double reach = _pendulums.pivot + _pendulums.arm;
        out.mass = 4 * _pendulums.mass;
        out.on_circle = out.mass * reach * reach;
        out.turn_with_rotor = true;
        return out;
    }

    /// One tied pair makes 2 m l at most.
    [[nodiscard]] Reach reach() const override {
        return {2 * _pendulums.mass * _pendulums.arm, 4 * _pendulums.mass * _pendulums.arm,
                "2 m arm/(m0 R0)"};
    }
    [[nodiscard]] bool damped() const override { return _pendulums.damping > 0; }

    [[nodiscard]] std::vector<SwungMass> swung() const override {
        const double moment = 2 * _pendulums.mass * _pendulums.arm;
        return {{0, moment, _pendulums.pivot}, {std::numbers::pi / 2, moment, _pendulums.pivot}};
    }

    /// The masses of a pair stand at +-(a + l cos f) along its line of hinges and at l sin f across
    /// it: sum m r^2 exp(2 i b) = 2 m (along^2 - across^2) exp(2 i line).
    [[nodiscard]] HeldParts held(const std::vector<double> &angles) const override {
        HeldParts out;
        out.mass = 4 * _pendulums.mass;
        for (const std::size_t pair : {std::size_t{0}, std::size_t{1}}) {
            const double along = _pendulums.pivot + _pendulums.arm * std::cos(angles[pair]);
            const double across = _pendulums.arm * std::sin(angles[pair]);
            const double twice = 2 * _pendulums.mass;
            const std::complex<double> line = pair == 0 ? 1.0 : std::complex<double>(0, 1);
            out.on_circle += twice * (along * along + across * across);
            out.second_moment += twice * (along * along - across * across) * line * line;
            out.moment_of_mass += std::complex<double>(0, twice * across) * line;
        }
        return out;
    }

    [[nodiscard]] SmallMotions
    small_motions(const std::vector<double> & /*angles*/) const override {
        const double mass = 4 * _pendulums.mass;
        SmallMotions out;
        out.pull = Eigen::VectorXd::Constant(1, mass);
        out.conjugate = Eigen::VectorXcd::Zero(1);
        out.inertia = Eigen::MatrixXd::Constant(1, 1, mass);
        out.damping = Eigen::MatrixXd::Constant(
            1, 1, 4 * _pendulums.damping / (_pendulums.arm * _pendulums.arm));
        out.restoring = Eigen::VectorXd::Constant(1, mass * _pendulums.pivot / _pendulums.arm);
        out.drift = Eigen::VectorXd::Zero(1);
        return out;
    }

    [[nodiscard]] std::shared_ptr<const PartsMotion> motion(bool /*tilt*/,
                                                            double gravity) const override {
        return std::make_shared<PendulumMotion>(_pendulums, gravity);
    }
    [[nodiscard]] std::vector<std::string> coordinates() const override { return {"phi", "psi"}; }

    [[nodiscard]] Outline outline() const override {
        const double reach = _pendulums.pivot + _pendulums.arm;
        Outline out;
        out.label = "pendulum balancer";
        out.points = {reach};
        out.arms = {{_pendulums.pivot, reach}};
        return out;
    }

  private:
    const model::Pendulums &_pendulums;
};

} // namespace

std::unique_ptr<Kind> kind_of(const model::Pendulums &pendulums) {
    return std::make_unique<PendulumKind>(pendulums);
}

std::vector<PlacedPendulums> pendulums_in(const model::Rotor &rotor) {
    std::vector<PlacedPendulums> out;
    for (std::size_t i = 0; i < rotor.balancers.size(); ++i)
        if (const auto *parts = std::get_if<model::Pendulums>(&rotor.balancers[i].parts))
            out.push_back({*parts, rotor.balancers[i].name, rotor.balancers[i].z, i});
    return out;
}

} // namespace whirl::balancers

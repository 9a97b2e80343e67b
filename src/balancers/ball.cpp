#include "balancers/kind.h"

#include "balancers/balance_family.h"
#include "balancers/circle_mass.h"
#include "closed_form/balanced_position.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <span>

namespace whirl::balancers {

namespace {

using Eigen::Index;

/// Balls with one ratio of damping to mass: their masses' mean displacement is one unknown,
/// whatever their rows and radii.
struct Group {
    double rate = 0;                    ///< h_s, 1/s
    double mass = 0;                    ///< kg
    std::complex<double> conjugate = 0; ///< sum of m exp(2 i a), kg
};

/// Rates that differ by their rounding alone are one.
constexpr double same_rate = 1e-12;

std::vector<Group> groups_of(const model::Balls &balls, const std::vector<double> &angles) {
    std::vector<Group> groups;
    std::size_t first = 0;
    for (const model::BallRow &row : balls.rows) {
        const double rate = row.damping / row.mass;
        auto group = std::ranges::find_if(groups, [rate](const Group &g) {
            return std::abs(g.rate - rate) <= same_rate * std::max(g.rate, rate);
        });
        if (group == groups.end())
            group = groups.insert(groups.end(), {rate, 0, 0});
        const double mass = row.n * row.mass;
        const auto count = static_cast<std::size_t>(row.n);
        group->mass += mass;
        group->conjugate +=
            mass * closed_form::second_harmonic(std::span(angles).subspan(first, count));
        first += count;
    }
    return groups;
}

/// Displacements of the groups y_g = (T y)_g: the mean of all, y_0, which alone the node feels, and
/// of each group but the last its difference from that.
Eigen::MatrixXd means_and_differences(const std::vector<Group> &groups) {
    const Index n = std::ssize(groups);
    Eigen::MatrixXd T = Eigen::MatrixXd::Identity(n, n);
    for (Index g = 0; g < n; ++g)
        for (Index k = 0; k < n; ++k)
            T(g, k) = k == 0       ? 1
                      : g == k - 1 ? 1
                      : g == n - 1
                          ? -groups[static_cast<std::size_t>(k - 1)].mass / groups.back().mass
                          : 0;
    return T;
}

/// Free balls, row after row.
class BallMotion final : public PartsMotion {
  public:
    struct Ball {
        CircleMass mass;    ///< on circles about the axis; on other tracks its tilting alone, and
                            ///< not that in a tilted race
        double drag = 0;    ///< h_A R^2, N m s/rad
        double mass_kg = 0; ///< m
        double gravity = 0; ///< m/s2
        double lever = 0;   ///< of the resistance to rolling at the axis, per normal force, m
        std::optional<Track> track; ///< where it is no circle about the axis
        double tilting = 0;         ///< mu in a tilted race, kg m2
    };
    /// @param centre  of the races, from the axis in the rotor, m
    /// @param slope   of their planes (kind.h), rad
    BallMotion(std::vector<Ball> balls, std::vector<TouchingRow> touching,
               std::complex<double> centre, std::complex<double> slope)
        : _balls(std::move(balls)), _touching(std::move(touching)),
          _centre(centre.real(), centre.imag()), _slope(slope.real(), slope.imag()) {}

    [[nodiscard]] std::vector<TouchingRow> touching() const override { return _touching; }
    [[nodiscard]] bool resists(int ball) const override {
        return _balls[static_cast<std::size_t>(ball)].lever > 0;
    }

    [[nodiscard]] int size() const override { return static_cast<int>(_balls.size()); }

    void equations(const PlaneMotion &plane, const SpinState &spin, const double *angles,
                   const double *rates, const Directions &towards,
                   MassEquation *out) const override {
        for (std::size_t j = 0; j < _balls.size(); ++j) {
            MassEquation &e = out[j];
            const Ball &ball = _balls[j];
            ball.mass.write_equation(plane, towards.cosines[j], towards.sines[j],
                                     spin.speed + rates[j], e);
            if (ball.track) {
                add_track(ball, seen(ball, angles[j]), spin, rates[j],
                          {towards.cosines[j], towards.sines[j]}, e);
            } else {
                e.friction = ball.drag * rates[j];
                e.b += e.friction;
                e.torque << -e.friction, 0;
                e.by_spin = 0;
                if (ball.lever > 0)
                    press(ball, spin.angle + angles[j], spin.speed + rates[j], e);
            }
            if (ball.tilting > 0)
                add_inclined(ball.tilting, inclined(plane, spin, angles[j], rates[j]), e);
        }
    }

    [[nodiscard]] AtRest at_rest(const PlaneVector &place, double speed,
                                 const double *angles) const override {
        AtRest out(size());
        for (std::size_t j = 0; j < _balls.size(); ++j) {
            const auto index = static_cast<Index>(4 + j);
            const Ball &ball = _balls[j];
            ball.mass.add_at_rest(place, speed, angles[j], index, out);
            if (ball.track)
                add_track_at_rest(ball, place.head<2>() + _centre, speed, angles[j], index, out);
            else
                out.damping(index, index) += ball.drag;
            if (ball.tilting > 0) {
                // As the plane would do with their slope; the mean in the mass matrix has it not.
                PlaneVector with = place;
                with.tail<2>() += _slope;
                CircleMass{0, 0, ball.tilting, 0}.add_at_rest(with, speed, angles[j], index, out);
                out.force.segment<2>(2) += speed * speed * ball.tilting / 2 * _slope;
            }
        }
        return out;
    }

    [[nodiscard]] MassMomenta momenta(const PlaneMotion &plane, const SpinState &spin,
                                      const double *angles, const double *rates) const override {
        MassMomenta sum;
        for (std::size_t j = 0; j < _balls.size(); ++j) {
            const Ball &ball = _balls[j];
            sum += ball.mass.momenta(plane, spin.angle + angles[j], spin.speed + rates[j]);
            if (ball.track)
                sum += on_track(ball, seen(ball, angles[j]), plane.velocity, spin, angles[j],
                                rates[j]);
            if (ball.tilting > 0)
                sum += on_inclined(ball.tilting, inclined(plane, spin, angles[j], rates[j]),
                                   plane.velocity);
        }
        return sum;
    }

  private:
    std::vector<Ball> _balls;
    std::vector<TouchingRow> _touching;
    Eigen::Vector2d _centre; ///< of the races, in the rotor, m
    Eigen::Vector2d _slope;  ///< of the planes of the races, in the rotor, rad

    /// Radius of the track and the centre of the race, along the radius of a ball and across it.
    struct Seen {
        Track::Radius r;
        double along, across;
    };
    [[nodiscard]] Seen seen(const Ball &ball, double angle) const {
        const double cosine = std::cos(angle);
        const double sine = std::sin(angle);
        return {ball.track->at(angle), _centre(0) * cosine + _centre(1) * sine,
                _centre(1) * cosine - _centre(0) * sine};
    }
    /// The drag along the path over that along the circle.
    [[nodiscard]] static double path_squared(const Ball &ball, const Track::Radius &r) {
        return (r.value * r.value + r.slope * r.slope) / (ball.track->radius * ball.track->radius);
    }

    /// A ball in a tilted race: C + i S = (phi + slope exp(i th)) exp(-i g), and what of it is the
    /// race's alone.
    struct Inclined {
        Eigen::Vector2d out, around; ///< exp(i g) and i exp(i g)
        double C, S, race_c, race_s;
        double along;     ///< rate of C, 1/s
        double across;    ///< Im(phi' exp(-i g)), 1/s
        double rate, own; ///< g' and a', rad/s
    };
    [[nodiscard]] Inclined inclined(const PlaneMotion &plane, const SpinState &spin, double angle,
                                    double own) const {
        const auto direction = [](double a) { return Eigen::Vector2d(std::cos(a), std::sin(a)); };
        Inclined at;
        const Eigen::Vector2d in_rotor = direction(angle);
        at.out = direction(spin.angle + angle);
        at.around << -at.out(1), at.out(0);
        at.race_c = _slope.dot(in_rotor);
        at.race_s = _slope(1) * in_rotor(0) - _slope(0) * in_rotor(1);
        at.C = plane.place.tail<2>().dot(at.out) + at.race_c;
        at.S = plane.place.tail<2>().dot(at.around) + at.race_s;
        at.own = own;
        at.rate = spin.speed + own;
        at.along = plane.velocity.tail<2>().dot(at.out) + at.rate * at.S - spin.speed * at.race_s;
        at.across = plane.velocity.tail<2>().dot(at.around);
        return at;
    }

    // The energy of circle_mass.h, mu (C'^2 - g'^2 C^2)/2, with the slope of the race in the fixed
    // frame added to that of the plane.
    static void add_inclined(double mu, const Inclined &at, MassEquation &e) {
        // C'' = e . phi'' + S g'' - race_s th'' + rest
        const double rest = 2 * at.rate * at.across - at.rate * at.rate * (at.C - at.race_c) -
                            at.own * at.own * at.race_c;
        const double pull = rest + at.rate * at.rate * at.C;
        e.u.tail<2>() += mu * at.S * at.out;
        e.a += mu * (at.S * at.S - at.C * at.C);
        e.b += mu * (at.S * pull - 2 * at.rate * at.C * at.along);
        e.by_spin -= mu * at.S * at.race_s;
        e.force.tail<2>() -= mu * pull * at.out;
        e.per_spin.tail<2>() = mu * at.race_s * at.out;
        e.tilt += mu * (at.out * at.out.transpose() - Eigen::Matrix2d::Identity() / 2);
        e.torque += mu * at.race_s * Eigen::Vector2d(-pull, at.race_s);
        e.swash = -mu * at.race_s * at.out;
    }

    static MassMomenta on_inclined(double mu, const Inclined &at, const PlaneVector &velocity) {
        MassMomenta sum;
        sum.kinetic = mu * (at.along * at.along - at.rate * at.rate * at.C * at.C) / 2 -
                      mu * velocity.tail<2>().squaredNorm() / 4;
        sum.spin = mu * (at.along * (at.S - at.race_s) - at.rate * at.C * at.C);
        sum.plane.tail<2>() = mu * (at.along * at.out - velocity.tail<2>() / 2);
        return sum;
    }

    // A ball at c + rho(a) exp(i a) in the rotor (c = along + i across seen from it), g = th + a:
    // beside what its mass at the centre is, an eccentricity of the rotor, its energy is
    //     m [rho'^2 a'^2 - 2 rho' a' th' across + rho^2 g'^2 + 2 rho g' th' along]/2
    //         + m Re(conj(w') exp(i g) (rho' a' + i rho g')) - m G rho sin g.
    static void add_track(const Ball &ball, const Seen &at, const SpinState &spin, double own,
                          const Eigen::Vector2d &out, MassEquation &e) {
        const double m = ball.mass_kg;
        const auto [rho, slope, bend] = at.r;
        const double rate = spin.speed + own;
        const double turning = spin.speed * spin.speed;
        const double weight = m * ball.gravity;
        const Eigen::Vector2d around(-out(1), out(0));
        e.u.head<2>() += m * (slope * out + rho * around);
        e.a += m * (rho * rho + slope * slope);
        e.by_spin = m * (rho * at.along - slope * at.across - slope * slope);
        e.friction = ball.drag * path_squared(ball, at.r) * own;
        e.b += m * (slope * (rho + bend) * own * own -
                    turning * (rho * slope + slope * at.along + rho * at.across)) +
               weight * (slope * out(1) + rho * out(0)) + e.friction;
        e.force.head<2>() +=
            m * ((rho * rate * rate - bend * own * own) * out - 2 * slope * own * rate * around);
        e.per_spin.head<2>() = m * slope * out;
        e.offset = m * slope * around;
        e.weight = -weight * rho * out(0);
        e.torque << m * (rate * rate * (rho * slope + rho * at.across + slope * at.along) +
                         own * own * (slope * at.along - bend * (slope + at.across))) -
                        weight * slope * out(1) - e.friction,
            m * slope * (slope + 2 * at.across);
    }

    /// @param centre  of the race as the plane stands, in rotating axes, m
    static void add_track_at_rest(const Ball &ball, const Eigen::Vector2d &centre, double speed,
                                  double angle, Index index, AtRest &out) {
        const Eigen::Vector2d e(std::cos(angle), std::sin(angle));
        const Eigen::Vector2d n(-e(1), e(0));
        const Track::Radius r = ball.track->at(angle);
        const Eigen::Vector2d along = r.slope * e + r.value * n; // of its place over the angle
        const Eigen::Vector2d bent = (r.bend - r.value) * e + 2 * r.slope * n;
        const Eigen::Vector2d place = centre + r.value * e;
        const double pull = ball.mass_kg * speed * speed;
        out.force.head<2>() += pull * r.value * e;
        out.force(index) += pull * place.dot(along);
        out.inertia(index, index) += ball.mass_kg * along.squaredNorm();
        AtRest::add_symmetric(out.inertia, 0, index, ball.mass_kg * along);
        AtRest::add_skew(out.gyroscopic, 0, index,
                         2 * ball.mass_kg * speed * (r.slope * n - r.value * e));
        out.damping(index, index) += ball.drag * path_squared(ball, r);
        out.stiffness(index, index) -= pull * (along.squaredNorm() + place.dot(bent));
        AtRest::add_symmetric(out.stiffness, 0, index, -pull * along);
    }

    static MassMomenta on_track(const Ball &ball, const Seen &at, const PlaneVector &velocity,
                                const SpinState &spin, double angle, double own) {
        const double m = ball.mass_kg;
        const auto [rho, slope, bend] = at.r;
        const double rate = spin.speed + own;
        const Eigen::Vector2d out(std::cos(spin.angle + angle), std::sin(spin.angle + angle));
        const Eigen::Vector2d around(-out(1), out(0));
        const Eigen::Vector2d moved = slope * own * out + rho * rate * around;
        MassMomenta sum;
        sum.kinetic = m * (moved.squaredNorm() / 2 + moved.dot(velocity.head<2>()) +
                           spin.speed * (rho * rate * at.along - slope * own * at.across));
        sum.potential = m * ball.gravity * rho * out(1);
        sum.spin = m * (rho * rho * rate + rho * at.along * (spin.speed + rate) -
                        slope * own * at.across + rho * around.dot(velocity.head<2>()));
        sum.plane.head<2>() = m * moved;
        return sum;
    }

    /// m [R g'^2 - Re(exp(-i g) w'') - G sin g], pressing outwards.
    static void press(const Ball &ball, double angle, double rate, MassEquation &e) {
        const double cosine = std::cos(angle);
        const double sine = std::sin(angle);
        e.lever = ball.lever;
        e.normal = ball.mass.moment * rate * rate - ball.mass_kg * ball.gravity * sine;
        e.normal_y.head<2>() << -ball.mass_kg * cosine, -ball.mass_kg * sine;
    }
};

/// Balls in one race or several side by side, each ball held back by h_A times its speed along the
/// race. Linear: A. N. Gorbenko, Mass-inertia characteristics and dimensionless equations of motion
/// of a rotor with an auto-balancer, with the complex second harmonic of the arrangement; several
/// rows of different balls as in G. Filimonikhin's multi-row balancers. docs/theory.md.
class BallKind final : public Kind {
  public:
    explicit BallKind(const model::Balls &balls) : _balls(balls) {}

    [[nodiscard]] std::string name() const override { return "ball"; }
    [[nodiscard]] std::string parts() const override { return "balls"; }

    [[nodiscard]] PartsInertia inertia() const override {
        PartsInertia out;
        for (const model::BallRow &row : _balls.rows) {
            out.mass += row.n * row.mass;
            out.on_circle += row.n * row.mass * row.radius * row.radius;
        }
        return out;
    }

    [[nodiscard]] Reach reach() const override {
        Reach out;
        int balls = 0;
        for (const model::BallRow &row : _balls.rows) {
            out.imbalance += row.n * row.mass * row.radius;
            balls += row.n;
        }
        out.side_by_side = out.imbalance;
        out.formula = _balls.rows.size() > 1 ? "sum n m R/(m0 R0)"
                      : balls > 1            ? "n m R/(m0 R0)"
                                             : "m R/(m0 R0)";
        return out;
    }

    [[nodiscard]] bool damped() const override {
        return std::ranges::all_of(_balls.rows, [](const model::BallRow &row) {
            return row.damping > 0 || row.rolling > 0;
        });
    }

    [[nodiscard]] std::optional<double> rate() const override {
        if (_balls.rows.size() > 1)
            return std::nullopt;
        return _balls.rows.front().damping / _balls.rows.front().mass;
    }

    [[nodiscard]] std::vector<CircledMass> circled() const override {
        std::vector<CircledMass> out;
        for (int index = 0; const model::BallRow &row : _balls.rows)
            out.insert(out.end(), static_cast<std::size_t>(row.n),
                       {row.mass * row.radius, row.mass * row.radius * row.radius, index++});
        return out;
    }

    [[nodiscard]] std::complex<double> race_centre() const override {
        return std::polar(_balls.eccentricity, _balls.eccentricity_angle);
    }
    [[nodiscard]] std::complex<double> out_of_round() const override {
        return std::polar(_balls.ellipticity, 2 * _balls.ellipticity_angle);
    }

    [[nodiscard]] std::complex<double> inclination() const override {
        return -std::polar(_balls.tilt, _balls.tilt_angle);
    }

    [[nodiscard]] bool obstructed() const override {
        return _balls.ellipticity > 0 || _balls.tilt > 0 || !_balls.walls.empty();
    }

    /// Every row balances its share of the imbalance, symmetrically.
    [[nodiscard]] std::optional<std::vector<double>>
    usual_position(double capacity) const override {
        std::vector<double> angles;
        for (const model::BallRow &row : _balls.rows) {
            if (row.n == 1 && _balls.rows.size() > 1)
                return std::nullopt;
            const std::vector<double> own = symmetric_position(row.n, capacity);
            angles.insert(angles.end(), own.begin(), own.end());
        }
        return angles;
    }

    [[nodiscard]] SmallMotions small_motions(const std::vector<double> &angles) const override {
        const std::vector<Group> groups = groups_of(_balls, angles);
        const Index n = std::ssize(groups);
        Eigen::VectorXd mass(n);
        Eigen::VectorXd damping(n);
        Eigen::VectorXcd conjugate(n);
        double rates = 0;
        for (Index g = 0; g < n; ++g) {
            const Group &group = groups[static_cast<std::size_t>(g)];
            mass(g) = group.mass;
            damping(g) = group.mass * group.rate;
            conjugate(g) = group.conjugate;
            rates += group.rate;
        }
        const Eigen::MatrixXd T = means_and_differences(groups);
        SmallMotions out;
        out.pull = Eigen::VectorXd::Zero(n);
        out.pull(0) = mass.sum();
        out.conjugate = T.transpose() * conjugate;
        const Eigen::MatrixXd momentum = mass.asDiagonal() * T;
        const Eigen::MatrixXd drag = damping.asDiagonal() * T;
        out.inertia = T.transpose() * momentum;
        out.damping = T.transpose() * drag;
        out.restoring = Eigen::VectorXd::Zero(n);
        out.groups = T;
        // Differences that leave the sum as it is are other balanced positions.
        out.drift = Eigen::VectorXd::Constant(n, SmallMotions::far_away * rates);
        out.drift(0) = 0;
        out.set_diameter(conjugate.sum() / mass.sum(), rates);
        return out;
    }

    [[nodiscard]] std::shared_ptr<const PartsMotion> motion(bool tilt,
                                                            double gravity) const override {
        std::vector<BallMotion::Ball> balls;
        std::vector<TouchingRow> touching;
        for (const model::BallRow &row : _balls.rows) {
            if ((_balls.contact && row.n > 1) || !_balls.walls.empty())
                touching.push_back({static_cast<int>(balls.size()), row.n, row.touching_angle(),
                                    _balls.restitution, !_balls.contact, walls_of(row)});
            const double inertia = row.mass * row.radius * row.radius;
            const double inclined = tilt && _balls.tilt > 0 ? inertia : 0;
            const double tilting = tilt && !(_balls.tilt > 0) ? inertia : 0;
            std::optional<Track> track;
            if (race_centre() != 0.0 || out_of_round() != 0.0)
                track = Track{row.radius, out_of_round()};
            const CircleMass mass = track ? CircleMass{0, 0, tilting, 0}
                                          : CircleMass{row.mass * row.radius, inertia, tilting,
                                                       row.mass * row.radius * gravity};
            // The moment on the ball, rolling * N, is a force 2 rolling / diameter * N along the
            // race.
            const double lever = row.rolling > 0 ? 2 * row.rolling / row.diameter * row.radius : 0;
            balls.insert(balls.end(), static_cast<std::size_t>(row.n),
                         {mass, row.damping * row.radius * row.radius, row.mass, gravity, lever,
                          track, inclined});
        }
        return std::make_shared<BallMotion>(std::move(balls), std::move(touching), race_centre(),
                                            inclination());
    }

    [[nodiscard]] std::vector<std::string> coordinates() const override {
        std::vector<std::string> names;
        for (std::size_t j = 0; j < circled().size(); ++j)
            names.push_back("ball " + std::to_string(j + 1));
        return names;
    }

    [[nodiscard]] Outline outline() const override {
        Outline out;
        out.label = "ball balancer";
        for (const model::BallRow &row : _balls.rows)
            out.points.push_back(row.radius);
        return out;
    }

  private:
    const model::Balls &_balls;

    /// Where a ball of the row touches each wall: its centre half a diameter beside it.
    [[nodiscard]] std::vector<Wall> walls_of(const model::BallRow &row) const {
        const Track track{row.radius, out_of_round()};
        const auto beside = [&](double wall, int side) {
            double angle = wall;
            for (int i = 0; i < 60; ++i) // each step leaves less than half of the error
                angle = wall + side * std::asin(row.diameter / (2 * track.at(angle).value));
            return angle;
        };
        // How the distance from the wall, r sin(a - wall), changes.
        const auto arm = [&](double wall, double angle) {
            const Track::Radius r = track.at(angle);
            return r.value * std::cos(angle - wall) + r.slope * std::sin(angle - wall);
        };
        std::vector<Wall> out;
        for (const double wall : _balls.walls) {
            const double before = beside(wall, -1);
            const double behind = beside(wall, 1);
            out.push_back({before, behind, arm(wall, before), arm(wall, behind)});
        }
        return out;
    }
};

} // namespace

std::unique_ptr<Kind> kind_of(const model::Balls &balls) {
    return std::make_unique<BallKind>(balls);
}

} // namespace whirl::balancers

#include "balancers/kind.h"

#include "balancers/balance_family.h"
#include "balancers/circle_mass.h"
#include "closed_form/balanced_position.h"

#include <algorithm>
#include <cmath>

namespace whirl::balancers {

namespace {

/// The turning of a ring about its own axis.
struct OwnRotation {
    double inertia = 0; ///< J, kg m2
    double tilt = 0;    ///< J, or 0 where the tilt inertia is left out

    [[nodiscard]] MassEquation equation(const PlaneMotion &plane, double rate) const {
        const PlaneVector &p = plane.place;
        const PlaneVector &v = plane.velocity;
        MassEquation out;
        out.a = inertia;
        out.u << 0, 0, tilt * p(3) / 2, -tilt * p(2) / 2;
        out.force << 0, 0, -tilt * rate * v(3), tilt * rate * v(2);
        return out;
    }

    /// L = J (Om + s')^2/2 - J (Om + s') [i Phi . Phi' + Om |Phi|^2]/2, |phi'|^2 in the rotor's
    /// mass matrix.
    void add_at_rest(const PlaneVector &place, double speed, Eigen::Index index,
                     AtRest &out) const {
        const Eigen::Vector2d slope = place.tail<2>();
        const Eigen::Vector2d turned(-slope(1), slope(0));
        Eigen::Matrix2d turn;
        turn << 0, -1, 1, 0;
        const double squared = speed * speed;
        out.force.segment<2>(2) -= tilt * squared * slope;
        out.inertia(index, index) += inertia;
        AtRest::add_symmetric(out.inertia, 2, index, -tilt / 2 * turned);
        out.gyroscopic.block<2, 2>(2, 2) -= tilt * speed * turn;
        AtRest::add_skew(out.gyroscopic, 2, index, tilt * speed * slope);
        out.stiffness.block<2, 2>(2, 2) += tilt * squared * Eigen::Matrix2d::Identity();
    }

    [[nodiscard]] MassMomenta momenta(const PlaneMotion &plane, double rate) const {
        const PlaneVector &p = plane.place;
        const PlaneVector &v = plane.velocity;
        const double turning = p(2) * v(3) - p(3) * v(2); // Im(conj(phi) phi')
        MassMomenta out;
        out.kinetic = inertia * rate * rate / 2 - tilt * rate * turning / 2;
        out.spin = inertia * rate - tilt * turning / 2;
        out.plane << 0, 0, tilt * rate * p(3) / 2, -tilt * rate * p(2) / 2;
        return out;
    }
};

/// Coordinates: angles of all centres, then of all rings about themselves.
class RingMotion final : public PartsMotion {
  public:
    RingMotion(const model::Rings &rings, bool tilt, double gravity)
        : _rings(rings), _own{rings.inertia, tilt ? rings.inertia : 0} {
        const double moment = rings.mass * rings.clearance;
        const double inertia = moment * rings.clearance;
        _centre = {moment, inertia, tilt ? inertia : 0, moment * gravity};
    }

    [[nodiscard]] int size() const override { return 2 * _rings.n; }

    void equations(const PlaneMotion &plane, const SpinState &spin, const double * /*angles*/,
                   const double *rates, const Directions &towards,
                   MassEquation *out) const override {
        const double e = _rings.clearance;
        const double R = _rings.bore_radius();
        for (int j = 0; j < _rings.n; ++j) {
            const double own_rate = rates[_rings.n + j]; // in the rotor
            MassEquation &centre = out[j];
            MassEquation &own = out[_rings.n + j];
            centre = {};
            _centre.write_equation(plane, towards.cosines[j], towards.sines[j],
                                   spin.speed + rates[j], centre);
            own = _own.equation(plane, spin.speed + own_rate);
            const double sliding = _rings.damping * (e * rates[j] - R * own_rate); // N
            centre.friction = e * sliding;
            own.friction = _rings.drag * own_rate - R * sliding;
            for (MassEquation *equation : {&centre, &own}) {
                equation->b += equation->friction;
                equation->torque(0) = -equation->friction;
            }
        }
    }

    [[nodiscard]] AtRest at_rest(const PlaneVector &place, double speed,
                                 const double *angles) const override {
        AtRest out(size());
        const Eigen::Vector2d lever(_rings.clearance, -_rings.bore_radius());
        for (int j = 0; j < _rings.n; ++j) {
            const Eigen::Index centre = 4 + j;
            const Eigen::Index own = centre + _rings.n;
            _centre.add_at_rest(place, speed, angles[j], centre, out);
            _own.add_at_rest(place, speed, own, out);
            const Eigen::Matrix2d sliding = _rings.damping * lever * lever.transpose();
            out.damping(centre, centre) += sliding(0, 0);
            out.damping(centre, own) += sliding(0, 1);
            out.damping(own, centre) += sliding(1, 0);
            out.damping(own, own) += sliding(1, 1) + _rings.drag;
        }
        return out;
    }

    [[nodiscard]] MassMomenta momenta(const PlaneMotion &plane, const SpinState &spin,
                                      const double *angles, const double *rates) const override {
        MassMomenta sum;
        for (int j = 0; j < _rings.n; ++j) {
            sum += _centre.momenta(plane, spin.angle + angles[j], spin.speed + rates[j]);
            sum += _own.momenta(plane, spin.speed + rates[_rings.n + j]);
        }
        return sum;
    }

  private:
    model::Rings _rings;
    CircleMass _centre;
    OwnRotation _own;
};

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

    [[nodiscard]] PartsInertia inertia() const override {
        PartsInertia out;
        out.mass = _rings.n * _rings.mass;
        out.on_circle = out.mass * _rings.clearance * _rings.clearance;
        out.own = _rings.n * _rings.inertia;
        return out;
    }

    [[nodiscard]] Reach reach() const override {
        const double largest = _rings.n * _rings.mass * _rings.clearance;
        return {largest, largest, _rings.n > 1 ? "n m e/(m0 R0)" : "m e/(m0 R0)"};
    }
    [[nodiscard]] bool damped() const override { return _rings.damping > 0 && _rings.drag > 0; }

    [[nodiscard]] std::vector<CircledMass> circled() const override {
        const double moment = _rings.mass * _rings.clearance;
        return {static_cast<std::size_t>(_rings.n), {moment, moment * _rings.clearance, 0}};
    }

    [[nodiscard]] std::optional<std::vector<double>>
    usual_position(double capacity) const override {
        return symmetric_position(_rings.n, capacity);
    }

    /// y: displacement of the centres sigma, mean of i e exp(i g) dg, and, where rings and journal
    /// feel each other, that of the bores tau, mean of i R exp(i g) ds, of which only the rate
    /// matters.
    [[nodiscard]] SmallMotions small_motions(const std::vector<double> &angles) const override {
        const double n = _rings.n;
        const double mass = n * _rings.mass;
        const double R2 = _rings.bore_radius() * _rings.bore_radius();
        const std::complex<double> D = closed_form::second_harmonic(angles);
        const Eigen::Index unknowns = _rings.damping > 0 ? 2 : 1;
        SmallMotions out;
        out.pull = mass * Eigen::VectorXd::Unit(unknowns, 0);
        out.conjugate = mass * D * Eigen::VectorXcd::Unit(unknowns, 0);
        out.inertia = mass * Eigen::MatrixXd::Identity(unknowns, unknowns);
        out.damping = Eigen::MatrixXd::Zero(unknowns, unknowns);
        out.restoring = Eigen::VectorXd::Zero(unknowns);
        out.drift = Eigen::VectorXd::Zero(unknowns);
        double rate = 0;
        if (unknowns == 2) {
            const double c = n * _rings.damping;
            out.inertia(1, 1) = n * _rings.inertia / R2;
            out.damping << c, -c, -c, c + n * _rings.drag / R2;
            rate = out.damping(1, 1) / out.inertia(1, 1);
            out.drift(1) = SmallMotions::far_away * rate;
        }
        out.set_diameter(D, rate);
        return out;
    }

    [[nodiscard]] std::shared_ptr<const PartsMotion> motion(bool tilt,
                                                            double gravity) const override {
        return std::make_shared<RingMotion>(_rings, tilt, gravity);
    }

    [[nodiscard]] std::vector<std::string> coordinates() const override {
        std::vector<std::string> names;
        for (const char *what : {"ring ", "rotation of ring "})
            for (int j = 0; j < _rings.n; ++j)
                names.push_back(what + std::to_string(j + 1));
        return names;
    }

    /// The section of a homogeneous ring of this mass and inertia.
    [[nodiscard]] Outline outline() const override {
        const double bore = _rings.bore_radius();
        Outline out;
        out.label = "ring balancer";
        out.sections = {{bore, std::sqrt(std::max(bore * bore, 2 * _rings.inertia / _rings.mass -
                                                                   bore * bore))}};
        return out;
    }

  private:
    const model::Rings &_rings;
};

} // namespace

std::unique_ptr<Kind> kind_of(const model::Rings &rings) {
    return std::make_unique<RingKind>(rings);
}

} // namespace whirl::balancers

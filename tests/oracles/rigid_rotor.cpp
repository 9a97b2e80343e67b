#include "oracles/rigid_rotor.h"

#include "oracles/balls.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace whirl::oracles {

namespace {

/// A part of the body, about its own centre.
struct Part {
    Real z, mass, A, C;
};

Part part_of(const Segment &segment, Real left) {
    if (segment.outer_end != segment.left.outer || segment.inner_end != segment.left.inner)
        throw std::runtime_error("rigid body of the oracles: no cones");
    const Cylinder &c = segment.left;
    const Real L = c.length;
    const Real ro = static_cast<Real>(c.outer) / 2;
    const Real ri = static_cast<Real>(c.inner) / 2;
    const Real mass = c.rho * std::numbers::pi_v<Real> * (ro * ro - ri * ri) * L;
    const Real square = ro * ro + ri * ri;
    return {left + L / 2, mass, mass * (3 * square + L * L) / 12, mass * square / 2};
}

RigidRotor body_of(const CaseRotor &rotor, const std::vector<Part> &parts, const Complex &a) {
    RigidRotor out;
    out.a = a;
    for (const Part &part : parts) {
        out.mass += part.mass;
        out.centre += part.mass * part.z;
        out.C += part.C;
    }
    out.centre /= out.mass;
    for (const Part &part : parts)
        out.A += part.A + part.mass * (part.z - out.centre) * (part.z - out.centre);
    for (const Support &s : rotor.supports) {
        if (s.k[0][0] != s.k[1][1] || s.k[0][1] != 0 || s.c[0][0] != s.c[1][1])
            throw std::runtime_error("rigid body of the oracles: isotropic supports only");
        const Real z = s.z - out.centre;
        out.k0 += s.k[0][0];
        out.k1 += s.k[0][0] * z;
        out.k2 += s.k[0][0] * z * z;
        out.c0 += s.c[0][0];
        out.c1 += s.c[0][0] * z;
        out.c2 += s.c[0][0] * z * z;
    }
    return out;
}

std::vector<Part> bare_parts(const CaseRotor &rotor) {
    std::vector<Part> parts;
    Real left = 0;
    for (const Segment &segment : rotor.shaft) {
        parts.push_back(part_of(segment, left));
        left += segment.left.length;
    }
    for (const RigidDisc &disc : rotor.discs)
        parts.push_back({disc.z, disc.mass, disc.Id, disc.Ip});
    return parts;
}

Complex anisotropy_of(const CaseRotor &rotor) {
    Complex a = 0;
    for (const InertialAnisotropy &item : rotor.anisotropies)
        a += std::polar(static_cast<Real>(item.dI), 2 * static_cast<Real>(item.angle));
    return a;
}

/// Positive roots of a x^2 + b x + c, ascending.
std::vector<Real> positive_roots(Real a, Real b, Real c) {
    std::vector<Real> out;
    if (a == 0) {
        out = {-c / b};
    } else if (b * b >= 4 * a * c) {
        const Real q = -(b + std::copysign(std::sqrt(b * b - 4 * a * c), b)) / 2;
        out = {q / a, c / q};
    }
    std::erase_if(out, [](Real x) { return !(x > 0); });
    std::sort(out.begin(), out.end());
    return out;
}

std::vector<Real> roots_of_squares(std::vector<Real> squares) {
    std::erase_if(squares, [](Real x) { return !(x > 0); });
    std::sort(squares.begin(), squares.end());
    for (Real &x : squares)
        x = std::sqrt(x);
    return squares;
}

RigidRotor shifted(RigidRotor body, Real da) {
    body.A += da;
    return body;
}

} // namespace

RigidRotor bare_rotor(const CaseRotor &rotor) {
    return body_of(rotor, bare_parts(rotor), anisotropy_of(rotor));
}

RigidRotor composite_rotor(const CaseRotor &rotor) {
    std::vector<Part> parts = bare_parts(rotor);
    Complex a = anisotropy_of(rotor);
    for (const Balancer &balancer : rotor.balancers) {
        const BallInertia balls = ball_inertia(balancer);
        parts.push_back({balancer.z, balls.mass, balls.diametral, balls.polar});
        a += balls.a;
    }
    return body_of(rotor, parts, a);
}

std::vector<Real> resonances(const RigidRotor &b) {
    const Real J = b.A - b.C;
    return roots_of_squares(
        positive_roots(b.mass * J, -(J * b.k0 + b.mass * b.k2), b.k0 * b.k2 - b.k1 * b.k1));
}

std::vector<Real> split_resonances(const RigidRotor &body) {
    std::vector<Real> out = resonances(shifted(body, std::abs(body.a)));
    const std::vector<Real> other = resonances(shifted(body, -std::abs(body.a)));
    out.insert(out.end(), other.begin(), other.end());
    std::sort(out.begin(), out.end());
    return out;
}

std::vector<Real> additional_speeds(const RigidRotor &b, double plane) {
    const Real z = plane - b.centre;
    return roots_of_squares({(b.k2 + b.k0 * z * z - 2 * b.k1 * z) / (b.A + b.mass * z * z - b.C)});
}

std::vector<Real> split_additional_speeds(const RigidRotor &body, double plane) {
    std::vector<Real> out = additional_speeds(shifted(body, std::abs(body.a)), plane);
    for (const Real speed : additional_speeds(shifted(body, -std::abs(body.a)), plane))
        out.push_back(speed);
    std::sort(out.begin(), out.end());
    return out;
}

std::vector<Band> rigid_bands(const RigidRotor &body, double plane, Real to) {
    const std::vector<Real> omega = resonances(body);
    const std::vector<Real> hat = additional_speeds(body, plane);
    std::vector<Band> out;
    if (!omega.empty())
        out.emplace_back(omega[0], hat.empty() ? to : hat[0]);
    if (omega.size() > 1)
        out.emplace_back(omega[1], to);
    std::erase_if(out, [to](const Band &band) { return band.first >= to; });
    for (Band &band : out)
        band.second = std::min(band.second, to);
    return out;
}

std::vector<Band> rigid_joint_bands(const RigidRotor &body, Real to) {
    const std::vector<Real> omega = resonances(body);
    if (body.A > body.C && omega.size() > 1 && omega[1] < to)
        return {{omega[1], to}};
    return {};
}

int rigid_rank(const RigidRotor &body, const std::vector<double> &planes) {
    RealMatrix J(2, static_cast<Eigen::Index>(planes.size()));
    for (Eigen::Index i = 0; i < J.cols(); ++i)
        J.col(i) << 1, planes[static_cast<std::size_t>(i)] - body.centre;
    const Real radius = std::sqrt(body.A / body.mass);
    J.row(1) /= radius;
    int rank = 0;
    for (const Real eigenvalue : hermitian_eigenvalues(product(J, J.transpose()).cast<Complex>()))
        rank += eigenvalue > 1e-12L * static_cast<Real>(J.cols()) ? 1 : 0;
    return rank;
}

AnisotropicRotor::AnisotropicRotor(const RigidRotor &body)
    : p(std::sqrt(body.k2 / body.A)), h(body.c2 / body.A), C(body.C / body.A),
      a(std::abs(body.a) / body.A), A(body.A) {
    if (std::abs(body.k1 * body.k1) > 1e-20L * body.k0 * body.k2)
        throw std::runtime_error("the closed form is for rotors symmetric on their supports");
}

std::vector<Real> AnisotropicRotor::critical_speeds() const {
    return roots_of_squares({p * p / (1 - C + a), p * p / (1 - C - a)});
}

std::vector<Real> AnisotropicRotor::unstable() const {
    const Real b = 2 * p * p * (1 - C) - h * h;
    return roots_of_squares(positive_roots((1 - C) * (1 - C) - a * a, -b, p * p * p * p));
}

Real AnisotropicRotor::permissible() const {
    return h / p * std::sqrt(1 - C - h * h / (4 * p * p));
}

Real AnisotropicRotor::permissible_speed() const {
    return p / std::sqrt(1 - C - h * h / (2 * p * p));
}

} // namespace whirl::oracles

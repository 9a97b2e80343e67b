#include "oracles/rotating_state.h"

#include "oracles/balls.h"
#include "oracles/dense_rotor.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace whirl::oracles {

namespace {

/// Real matrices of the second, first and zeroth derivative.
struct Quadratic {
    RealMatrix second, first, zeroth;
};

Quadratic quadratic(const RotatingRotor &r, Real speed) {
    const Complex i(0, 1);
    const Eigen::Index n = r.M.rows();
    const auto count = static_cast<Eigen::Index>(r.balls.size());
    const Eigen::Index size = n + count;
    std::array<ComplexMatrix, 3> direct, conjugate;
    for (std::size_t k = 0; k < 3; ++k)
        direct[k] = conjugate[k] = ComplexMatrix::Zero(size, size);
    direct[2].topLeftCorner(n, n) = r.M.cast<Complex>();
    direct[1].topLeftCorner(n, n) =
        i * speed * (Real(2) * r.M - r.G).cast<Complex>() + (r.Ce + r.Ci).cast<Complex>();
    direct[0].topLeftCorner(n, n) =
        (r.K - speed * speed * (r.M - r.G)).cast<Complex>() + i * speed * r.Ce.cast<Complex>();
    conjugate[2].topLeftCorner(n, n) = r.Ma;
    conjugate[1].topLeftCorner(n, n) = r.Cia;
    conjugate[0].topLeftCorner(n, n) = speed * speed * r.Ma + r.Ka;
    // acceleration = z'' + 2 i Omega z' - Omega^2 z of u and s
    const std::array<Complex, 3> acceleration{-speed * speed, Real(2) * i * speed, Real(1)};
    for (Eigen::Index b = 0; b < count; ++b) {
        const BalancedBalls &balls = r.balls[static_cast<std::size_t>(b)];
        const ComplexMatrix plane = balls.plane.cast<Complex>();
        direct[2](n + b, n + b) += Real(1);
        direct[1](n + b, n + b) += balls.damping;
        for (std::size_t k = 0; k < 3; ++k) {
            direct[k].block(0, n + b, n, 1) += acceleration[k] * plane;
            direct[k].block(n + b, 0, 1, n) += balls.mass / 2 * acceleration[k] * plane.transpose();
            conjugate[k].block(n + b, 0, 1, n) -=
                balls.mass / 2 * balls.D * std::conj(acceleration[k]) * plane.transpose();
        }
    }
    return {real_form(direct[2], conjugate[2]), real_form(direct[1], conjugate[1]),
            real_form(direct[0], conjugate[0])};
}

} // namespace

RotatingRotor::RotatingRotor(Eigen::Index size) {
    for (RealMatrix *matrix : {&M, &G, &Ce, &Ci, &K})
        *matrix = RealMatrix::Zero(size, size);
    Ma = Ka = Cia = ComplexMatrix::Zero(size, size);
}

RotatingRotor rotating_shaft(const CaseRotor &rotor, int parts) {
    const DenseRotor dense = dense_rotor(rotor, parts);
    const Eigen::Index n = dense.planar();
    for (const Eigen::MatrixXd *matrix : {&dense.K, &dense.C})
        if (!matrix->topRightCorner(n, n).isZero(0) ||
            matrix->topLeftCorner(n, n) != matrix->bottomRightCorner(n, n))
            throw std::runtime_error("bearings that are not the same from every direction");
    RotatingRotor out(n);
    const auto wide = [n](const Eigen::MatrixXd &matrix) {
        return RealMatrix(matrix.topLeftCorner(n, n).cast<Real>());
    };
    out.M = wide(dense.M);
    out.K = wide(dense.K);
    out.G = dense.G.topRightCorner(n, n).cast<Real>();
    out.Ci = dense.Kc.topRightCorner(n, n).cast<Real>();
    out.Ce = wide(dense.C) - out.Ci;
    double start = 0;
    std::size_t node = 0;
    for (const Segment &segment : rotor.shaft) {
        const double end = start + segment.left.length;
        for (; node + 1 < dense.z.size() && dense.z[node] < end - 1e-9 * rotor.length(); ++node) {
            const BeamMatrices beam = beam_matrices(
                element_between(segment, dense.z[node] - start, dense.z[node + 1] - start));
            const auto first = static_cast<Eigen::Index>(2 * node);
            const auto add = [&](ComplexMatrix &to, double factor, const Eigen::Matrix4d &matrix) {
                for (Eigen::Index i = 0; i < 4; ++i)
                    for (Eigen::Index j = 0; j < 4; ++j)
                        to(first + i, first + j) += static_cast<Real>(factor) * matrix(i, j);
            };
            add(out.Ka, segment.asymmetry, beam.bending);
            add(out.Cia, segment.asymmetry * rotor.internal_damping, beam.bending);
            add(out.Ma, segment.asymmetry / 2, beam.gyroscopic);
        }
        start = end;
    }
    for (const InertialAnisotropy &item : rotor.anisotropies) {
        const Eigen::Index slope = dense.deflection(item.z) + 1;
        out.Ma(slope, slope) +=
            std::polar(static_cast<Real>(item.dI), 2 * static_cast<Real>(item.angle));
    }
    return out;
}

std::vector<Complex> state_eigenvalues(const RealMatrix &M, const RealMatrix &D,
                                       const RealMatrix &K, Real scale) {
    const Eigen::Index n = M.rows();
    // Deflections and slopes in units in which a unit of each has the same kinetic energy
    const auto unit = [&](Eigen::Index i) { return 1 / std::sqrt(M(i, i)); };
    RealMatrix mass(n, n);
    RealMatrix both(n, 2 * n);
    for (Eigen::Index j = 0; j < n; ++j)
        for (Eigen::Index i = 0; i < n; ++i) {
            const Real units = unit(i) * unit(j);
            mass(i, j) = units * M(i, j);
            both(i, j) = units * K(i, j) / (scale * scale);
            both(i, n + j) = units * D(i, j) / scale;
        }
    RealMatrix state = RealMatrix::Zero(2 * n, 2 * n);
    state.topRightCorner(n, n).setIdentity();
    state.bottomRows(n) = -solve(mass, both);
    std::vector<Complex> out;
    for (const Complex &value : oracles::eigenvalues(state))
        out.push_back(value * scale);
    return out;
}

std::vector<Complex> RotatingRotor::eigenvalues(Real speed) const {
    const Quadratic q = quadratic(*this, speed);
    // Times in units of the revolution, or of the fastest motion: entries of one size
    Real fastest = 0;
    for (Eigen::Index i = 0; i < q.second.rows(); ++i)
        fastest = std::max(fastest, std::abs(q.zeroth(i, i)) / q.second(i, i));
    return state_eigenvalues(q.second, q.first, q.zeroth,
                             std::max({speed, std::sqrt(fastest), Real(1e-300L)}));
}

Real RotatingRotor::growth(Real speed) const {
    Real out = -std::numeric_limits<Real>::infinity();
    for (const Complex &lambda : eigenvalues(speed))
        out = std::max(out, lambda.real());
    return out;
}

RealMatrix RotatingRotor::static_matrix(Real speed) const { return quadratic(*this, speed).zeroth; }

RotatingRotor rotating_body(const RigidRotor &body) {
    RotatingRotor out(2);
    out.M.diagonal() << body.mass, body.A;
    out.G(1, 1) = body.C;
    out.K << body.k0, body.k1, body.k1, body.k2;
    out.Ce << body.c0, body.c1, body.c1, body.c2;
    out.Ma(1, 1) = body.a;
    return out;
}

RotatingRotor rotating_composite(const CaseRotor &rotor) {
    const RigidRotor body = composite_rotor(rotor);
    RotatingRotor out = rotating_body(body);
    for (const Balancer &balancer : rotor.balancers) {
        BalancedBalls balls;
        balls.plane.resize(2);
        balls.plane << 1, balancer.z - body.centre;
        balls.mass = balancer.n * static_cast<Real>(balancer.mass);
        balls.damping = static_cast<Real>(balancer.damping) / balancer.mass;
        balls.D = second_harmonic(symmetric_position(balancer.n, capacity(balancer)));
        out.balls.push_back(balls);
    }
    return out;
}

RotatingRotor rotating_disc(const CaseRotor &rotor) {
    if (rotor.discs.size() != 1)
        throw std::runtime_error("one disc on a massless shaft");
    const RigidDisc &disc = rotor.discs.front();
    RotatingRotor out(2);
    out.M.diagonal() << disc.mass, disc.Id;
    out.G(1, 1) = disc.Ip;
    const std::vector<Real> place{static_cast<Real>(disc.z)};
    const RealMatrix stiff = inverse(MasslessShaft(rotor, 1, 1).coefficients(place));
    const RealMatrix soft = inverse(MasslessShaft(rotor, 1, -1).coefficients(place));
    out.K = (stiff + soft) / 2;
    // The direction of the stiffer bending turns the axes and changes no eigenvalue
    out.Ka = ((stiff - soft) / 2).cast<Complex>();
    for (const InertialAnisotropy &item : rotor.anisotropies)
        out.Ma(1, 1) += std::polar(static_cast<Real>(item.dI), 2 * static_cast<Real>(item.angle));
    return out;
}

bool grows(const std::vector<Complex> &eigenvalues, Real noise) {
    Real largest = 0;
    Real growth = -std::numeric_limits<Real>::infinity();
    for (const Complex &lambda : eigenvalues) {
        largest = std::max(largest, std::abs(lambda));
        growth = std::max(growth, lambda.real());
    }
    return growth > noise * largest;
}

std::vector<Band> growing_bands(const RotatingRotor &rotor, Real from, Real to, int steps,
                                Real noise) {
    return bands_where([&](Real speed) { return grows(rotor.eigenvalues(speed), noise); }, from, to,
                       steps);
}

} // namespace whirl::oracles

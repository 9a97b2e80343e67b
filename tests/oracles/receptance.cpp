#include "oracles/receptance.h"

#include "oracles/continuum_supports.h"
#include "oracles/continuum_wave.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace whirl::oracles {

namespace {

/// y' = A y of the shaft in forward motion; see Wave for the order.
Wave<Complex> wave_of(const Cylinder &c, Real internal_damping, const Complex &lambda, Real speed) {
    const Complex i(0, 1);
    const Real ro = static_cast<Real>(c.outer) / 2;
    const Real ri = static_cast<Real>(c.inner) / 2;
    const Real area = std::numbers::pi_v<Real> * (ro * ro - ri * ri);
    const Real I = area * (ro * ro + ri * ri) / 4;
    const Real m2 = ri * ri / (ro * ro);
    const Real s = (1 + m2) * (1 + m2);
    const Real nu = static_cast<Real>(c.E) / (2 * static_cast<Real>(c.G)) - 1;
    const Real cowper = 6 * (1 + nu) * s / ((7 + 6 * nu) * s + (20 + 12 * nu) * m2);
    const Real kappa = c.kappa > 0 ? static_cast<Real>(c.kappa) : cowper;
    const Complex damped = Real(1) + internal_damping * (lambda - i * speed);
    return {kappa * c.G * area * damped, c.E * I * damped, c.rho * area * lambda * lambda,
            c.rho * I * (lambda * lambda - Real(2) * i * speed * lambda)};
}

const Cylinder &cylinder_at(const SteppedRotor &rotor, Real z) {
    Real end = 0;
    for (const Cylinder &c : rotor.shaft)
        if (z < (end += c.length))
            return c;
    return rotor.shaft.back();
}

std::vector<Real> nodes_of(const SteppedRotor &rotor, const std::vector<double> &places,
                           const Complex &lambda, Real speed) {
    std::vector<Real> ends{0};
    for (const Cylinder &c : rotor.shaft)
        ends.push_back(ends.back() + c.length);
    const Real near = 1e-12L * ends.back();
    for (const RigidDisc &disc : rotor.discs)
        ends.push_back(disc.z);
    for (const Support &support : rotor.supports)
        ends.push_back(support.z);
    ends.insert(ends.end(), places.begin(), places.end());
    std::sort(ends.begin(), ends.end());
    std::vector<Real> nodes{ends.front()};
    for (const Real end : ends) {
        const Real length = end - nodes.back();
        if (length < near)
            continue;
        const Real left = nodes.back();
        const Cylinder &c = cylinder_at(rotor, left + length / 2);
        const Real longest = wave_of(c, rotor.internal_damping, lambda, speed).longest();
        const int parts = static_cast<int>(std::ceil(length / longest));
        for (int part = 1; part < parts; ++part)
            nodes.push_back(left + length * part / parts);
        nodes.push_back(end);
    }
    return nodes;
}

Eigen::Index row_at(const std::vector<Real> &nodes, double place) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < nodes.size(); ++i)
        if (std::abs(nodes[i] - place) < std::abs(nodes[best] - place))
            best = i;
    return static_cast<Eigen::Index>(2 * best);
}

/// Forces (Q, M) on both ends of a length from its deflections: U2 = a U1 + b F1, F2 = c U1 + d F1
/// with F of the left part on the right one.
Eigen::Matrix<Complex, 4, 4> length_stiffness(const Wave<Complex> &wave, Real h) {
    const Small<Complex, 4> T = wave.transfer(h);
    Eigen::Matrix<Complex, 2, 2> a, b, c, d;
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) {
            a(i, j) = T(i, j);
            b(i, j) = T(i, j + 2);
            c(i, j) = T(i + 2, j);
            d(i, j) = T(i + 2, j + 2);
        }
    const Eigen::Matrix<Complex, 2, 2> inverse = b.inverse();
    Eigen::Matrix<Complex, 4, 4> out;
    out.topLeftCorner(2, 2) = inverse * a;
    out.topRightCorner(2, 2) = -inverse;
    out.bottomLeftCorner(2, 2) = c - d * inverse * a;
    out.bottomRightCorner(2, 2) = d * inverse;
    return out;
}

} // namespace

ComplexMatrix receptance(const SteppedRotor &rotor, Complex lambda, Real speed,
                         const std::vector<double> &places) {
    const std::vector<Real> nodes = nodes_of(rotor, places, lambda, speed);
    const auto size = static_cast<Eigen::Index>(2 * nodes.size());
    ComplexMatrix dynamic = ComplexMatrix::Zero(size, size);
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
        const Cylinder &c = cylinder_at(rotor, (nodes[i] + nodes[i + 1]) / 2);
        const Wave<Complex> wave = wave_of(c, rotor.internal_damping, lambda, speed);
        const auto at = static_cast<Eigen::Index>(2 * i);
        dynamic.block<4, 4>(at, at) += length_stiffness(wave, nodes[i + 1] - nodes[i]);
    }
    for (const RigidDisc &disc : rotor.discs) {
        const Eigen::Index w = row_at(nodes, disc.z);
        dynamic(w, w) += static_cast<Real>(disc.mass) * lambda * lambda;
        dynamic(w + 1, w + 1) += static_cast<Real>(disc.Id) * lambda * lambda -
                                 static_cast<Real>(disc.Ip) * Complex(0, speed) * lambda;
    }
    for (const Support &support : rotor.supports) {
        const Circular k = circular(support.k, support.c, lambda);
        if (k.pq != Complex(0) || support.pedestal)
            throw std::runtime_error("receptance: supports alike in all directions only");
        const Eigen::Index w = row_at(nodes, support.z);
        dynamic(w, w) += k.pp;
        dynamic(w + 1, w + 1) += circular(support.kt, support.ct, lambda).pp;
    }
    const auto count = static_cast<Eigen::Index>(places.size());
    ComplexMatrix forces = ComplexMatrix::Zero(size, count);
    for (Eigen::Index j = 0; j < count; ++j)
        forces(row_at(nodes, places[static_cast<std::size_t>(j)]), j) = Real(1);
    const ComplexMatrix all = solve(dynamic, forces);
    ComplexMatrix out(count, count);
    for (Eigen::Index i = 0; i < count; ++i)
        out.row(i) = all.row(row_at(nodes, places[static_cast<std::size_t>(i)]));
    return out;
}

} // namespace whirl::oracles

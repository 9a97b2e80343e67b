#include "oracles/continuum_spectrum.h"

#include "oracles/continuum_roots.h"
#include "oracles/dense_rotor.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace whirl::oracles {

namespace {

bool tapered(const CaseRotor &rotor) {
    return std::any_of(rotor.shaft.begin(), rotor.shaft.end(), [](const Segment &s) {
        return s.outer_end != s.left.outer || s.inner_end != s.left.inner;
    });
}

void sort(std::vector<Complex> &roots) {
    std::sort(roots.begin(), roots.end(),
              [](const Complex &a, const Complex &b) { return a.imag() < b.imag(); });
}

/// Motions that the supports do not couple are looked for apart, so that pairs are simple roots.
std::vector<Motion> motions_of(const Continuum &continuum) {
    if (continuum.coupled())
        return {Motion::both};
    return {Motion::forward, Motion::backward};
}

std::vector<Complex> undamped(const Continuum &continuum, double speed, int wanted) {
    std::vector<Complex> out;
    for (const Motion motion : motions_of(continuum))
        for (const Real omega : frequencies(continuum, {motion, speed, false}, wanted, 1e7L))
            out.emplace_back(0, omega);
    return out;
}

/// Some 48 elements: first guesses to a thousandth.
std::vector<Complex> guesses(const CaseRotor &rotor, double speed, int wanted) {
    CaseRotor fine = rotor;
    for (Segment &segment : fine.shaft)
        segment.elements = std::max(1, static_cast<int>(48 / rotor.shaft.size()));
    std::vector<Complex> out;
    for (const std::complex<double> &lambda : whirl_eigenvalues(dense_rotor(fine), speed))
        if (out.size() < static_cast<std::size_t>(wanted) + 2)
            out.emplace_back(lambda);
    return out;
}

std::vector<Complex> damped(const Continuum &continuum, double speed,
                            const std::vector<Complex> &near) {
    constexpr Real same = 1e-12L; // roots found twice, from the guesses of a pair
    constexpr Real guess = 5e-3L; // error of the guesses, and of much less than their distances
    std::vector<Complex> out;
    for (const Motion motion : motions_of(continuum)) {
        std::vector<Complex> of_motion;
        for (const Complex &first : near) {
            const auto root = eigenvalue_near(continuum, {motion, speed, false}, first);
            if (!root || std::abs(*root - first) > guess * std::abs(first))
                continue;
            const auto known = [&root](const Complex &other) {
                return std::abs(other - *root) < same * std::abs(other);
            };
            if (std::none_of(of_motion.begin(), of_motion.end(), known))
                of_motion.push_back(*root);
        }
        out.insert(out.end(), of_motion.begin(), of_motion.end());
    }
    return out;
}

std::vector<Complex> of_slices(const CaseRotor &rotor, double speed, int wanted, int slices,
                               const std::vector<Complex> &near) {
    const Continuum continuum(stepped(rotor, slices));
    std::vector<Complex> roots = continuum.conservative() ? undamped(continuum, speed, wanted)
                                                          : damped(continuum, speed, near);
    sort(roots);
    if (roots.size() < static_cast<std::size_t>(wanted))
        throw std::runtime_error("fewer eigenvalues of the continuum than asked for");
    roots.resize(static_cast<std::size_t>(wanted));
    return roots;
}

} // namespace

std::vector<Complex> continuum_eigenvalues(const CaseRotor &rotor, double speed, int wanted) {
    const CaseRotor at_speed = rotor.at_speed(speed);
    const std::vector<Complex> near = guesses(at_speed, speed, wanted);
    if (!tapered(at_speed))
        return of_slices(at_speed, speed, wanted, 1, near);
    const std::vector<Complex> coarse = of_slices(at_speed, speed, wanted, 48, near);
    const std::vector<Complex> middle = of_slices(at_speed, speed, wanted, 96, near);
    std::vector<Complex> fine = of_slices(at_speed, speed, wanted, 192, near);
    for (std::size_t i = 0; i < fine.size(); ++i) {
        const Complex second = (Real(4) * middle[i] - coarse[i]) / Real(3);
        const Complex first = (Real(4) * fine[i] - middle[i]) / Real(3);
        fine[i] = (Real(16) * first - second) / Real(15);
    }
    return fine;
}

std::vector<Real> pinned_rayleigh_frequencies(const Cylinder &shaft, double speed, int wanted) {
    const Real ro = static_cast<Real>(shaft.outer) / 2;
    const Real ri = static_cast<Real>(shaft.inner) / 2;
    const Real area = std::numbers::pi_v<Real> * (ro * ro - ri * ri);
    const Real I = area * (ro * ro + ri * ri) / 4;
    std::vector<Real> out;
    for (int n = 1; n <= wanted; ++n) {
        const Real k = n * std::numbers::pi_v<Real> / static_cast<Real>(shaft.length);
        const Real mass = shaft.rho * (area + I * k * k);
        const Real spin = shaft.rho * I * k * k * speed; // half the linear term
        const Real root = std::sqrt(spin * spin + mass * shaft.E * I * k * k * k * k);
        out.push_back((root - spin) / mass);
        out.push_back((root + spin) / mass);
    }
    std::sort(out.begin(), out.end());
    out.resize(static_cast<std::size_t>(wanted));
    return out;
}

} // namespace whirl::oracles

#include "oracles/influence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace whirl::oracles {

namespace {

constexpr double rigid_in_shear = 1e6;

/// Unit force or moment with the reactions of the supports (signs as they act on the shaft).
struct UnitLoad {
    Real z;
    bool moment;
    Real z1, z2;
    Real r1, r2;

    UnitLoad(Real place, bool is_moment, const std::vector<Real> &support)
        : z(place), moment(is_moment), z1(support[0]), z2(support[1]) {
        r2 = -(moment ? Real(1) : place - z1) / (z2 - z1);
        r1 = -(moment ? Real(0) : Real(1)) - r2;
    }
    /// Of everything left of x: sum f (x - z) - sum m.
    [[nodiscard]] Real bending(Real x) const {
        Real sum = 0;
        if (x > z)
            sum += moment ? Real(-1) : x - z;
        if (x > z1)
            sum += r1 * (x - z1);
        if (x > z2)
            sum += r2 * (x - z2);
        return sum;
    }
    [[nodiscard]] Real shear(Real x) const {
        return (x > z && !moment ? Real(1) : Real(0)) + (x > z1 ? r1 : Real(0)) +
               (x > z2 ? r2 : Real(0));
    }
};

/// Rows and columns w, phi at `places` with the deflections at `pinned` held.
RealMatrix held(const MasslessShaft &shaft, const std::vector<Real> &places,
                const std::vector<Real> &pinned) {
    std::vector<Real> all = places;
    all.insert(all.end(), pinned.begin(), pinned.end());
    const RealMatrix F = shaft.coefficients(all);
    const auto n = static_cast<Eigen::Index>(2 * places.size());
    const auto count = static_cast<Eigen::Index>(pinned.size());
    if (count == 0)
        return F;
    RealMatrix at_pins(count, count);
    RealMatrix to_pins(n, count);
    for (Eigen::Index j = 0; j < count; ++j) {
        to_pins.col(j) = F.col(n + 2 * j).head(n);
        for (Eigen::Index i = 0; i < count; ++i)
            at_pins(i, j) = F(n + 2 * i, n + 2 * j);
    }
    return F.topLeftCorner(n, n) - product(to_pins, solve(at_pins, to_pins.transpose()));
}

/// Deflections F of the forces square (mass, tilt) on those of the lumps, which come first.
RealMatrix of_forces(const RealMatrix &F, const Lumps &lumps, Real square) {
    RealMatrix out(F.rows(), 2 * static_cast<Eigen::Index>(lumps.z.size()));
    for (std::size_t i = 0; i < lumps.z.size(); ++i) {
        const auto k = 2 * static_cast<Eigen::Index>(i);
        out.col(k) = square * lumps.mass[i] * F.col(k);
        out.col(k + 1) = square * lumps.tilt[i] * F.col(k + 1);
    }
    return out;
}

} // namespace

MasslessShaft::MasslessShaft(const CaseRotor &rotor, Real factor, Real asymmetry_sign) {
    Real left = 0;
    for (const Segment &segment : rotor.shaft) {
        const Cylinder &c = segment.left;
        if (segment.outer_end != c.outer || segment.inner_end != c.inner)
            throw std::runtime_error("massless shaft of the oracles: no cones");
        const Real ro = static_cast<Real>(c.outer) / 2;
        const Real ri = static_cast<Real>(c.inner) / 2;
        const Real area = std::numbers::pi_v<Real> * (ro * ro - ri * ri);
        const Real I = area * (ro * ro + ri * ri) / 4;
        const Real m2 = ri * ri / (ro * ro);
        const Real s = (1 + m2) * (1 + m2);
        const Real nu = static_cast<Real>(c.E) / (2 * static_cast<Real>(c.G)) - 1;
        const Real cowper = 6 * (1 + nu) * s / ((7 + 6 * nu) * s + (20 + 12 * nu) * m2);
        const Real kappa = c.kappa > 0 ? static_cast<Real>(c.kappa) : cowper;
        // No shear strain where the case says "rigid in shear" by a coefficient beyond all sections
        const Real shear = c.kappa >= rigid_in_shear ? std::numeric_limits<Real>::infinity()
                                                     : factor * kappa * c.G * area;
        _parts.push_back({left, left + c.length,
                          factor * c.E * I * (1 + asymmetry_sign * segment.asymmetry), shear});
        left += c.length;
    }
    for (const Support &s : rotor.supports) {
        if (s.k[0][0] != s.k[1][1] || s.k[0][1] != 0 || s.k[1][0] != 0)
            throw std::runtime_error("massless shaft of the oracles: isotropic supports only");
        _support.push_back(s.z);
        _stiffness.push_back(s.k[0][0]);
    }
    if (_support.size() != 2)
        throw std::runtime_error("massless shaft of the oracles: two supports only");
}

Real MasslessShaft::virtual_work(Real place_i, bool moment_i, Real place_j, bool moment_j) const {
    const UnitLoad a(place_i, moment_i, _support);
    const UnitLoad b(place_j, moment_j, _support);
    Real sum = a.r1 * b.r1 / _stiffness[0] + a.r2 * b.r2 / _stiffness[1];
    for (const Part &part : _parts) {
        std::vector<Real> cuts{part.left, part.right};
        for (const Real z : {a.z, b.z, _support[0], _support[1]})
            if (z > part.left && z < part.right)
                cuts.push_back(z);
        std::sort(cuts.begin(), cuts.end());
        for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
            const Real h = cuts[i + 1] - cuts[i];
            if (h <= 0)
                continue;
            // Linear functions: Gauss's two points are exact
            for (const Real x : {-1 / std::sqrt(Real(3)), 1 / std::sqrt(Real(3))}) {
                const Real z = cuts[i] + h * (1 + x) / 2;
                sum +=
                    h / 2 *
                    (a.bending(z) * b.bending(z) / part.EI + a.shear(z) * b.shear(z) / part.shear);
            }
        }
    }
    return sum;
}

RealMatrix MasslessShaft::coefficients(const std::vector<Real> &places) const {
    const auto n = static_cast<Eigen::Index>(2 * places.size());
    RealMatrix out(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j <= i; ++j) {
            out(i, j) = virtual_work(places[static_cast<std::size_t>(i / 2)], i % 2 == 1,
                                     places[static_cast<std::size_t>(j / 2)], j % 2 == 1);
            out(j, i) = out(i, j);
        }
    return out;
}

Lumps lumps_of(const CaseRotor &rotor, int slices) {
    Lumps out;
    for (const RigidDisc &disc : rotor.discs) {
        out.z.push_back(disc.z);
        out.mass.push_back(disc.mass);
        out.tilt.push_back(static_cast<Real>(disc.Id) - disc.Ip);
    }
    Real left = 0;
    for (const Segment &segment : rotor.shaft) {
        const Cylinder &c = segment.left;
        const int parts = static_cast<int>(std::ceil(slices * c.length / rotor.length() - 1e-9));
        const Real h = static_cast<Real>(c.length) / std::max(1, parts);
        const Real ro = static_cast<Real>(c.outer) / 2;
        const Real ri = static_cast<Real>(c.inner) / 2;
        const Real mass = c.rho * std::numbers::pi_v<Real> * (ro * ro - ri * ri) * h;
        for (int i = 0; i < parts; ++i) {
            out.z.push_back(left + (static_cast<Real>(i) + 0.5L) * h);
            out.mass.push_back(mass);
            // rho I - 2 rho I of the slice; its length is left to the limit
            out.tilt.push_back(-mass * (ro * ro + ri * ri) / 4);
        }
        left += c.length;
    }
    return out;
}

std::vector<Real> lumped_critical_speeds(const MasslessShaft &shaft, const Lumps &lumps,
                                         const std::vector<Real> &pinned) {
    const RealMatrix F = held(shaft, lumps.z, pinned);
    std::vector<Real> out;
    for (const Complex &mu : eigenvalues(of_forces(F, lumps, 1))) // real: F is positive definite
        if (mu.real() > 0)
            out.push_back(1 / std::sqrt(mu.real()));
    std::sort(out.begin(), out.end());
    return out;
}

RealMatrix lumped_criterion_form(const MasslessShaft &shaft, const Lumps &lumps, Real speed,
                                 const std::vector<Real> &places) {
    std::vector<Real> all = lumps.z;
    all.insert(all.end(), places.begin(), places.end());
    const RealMatrix F = shaft.coefficients(all);
    const auto n = static_cast<Eigen::Index>(2 * lumps.z.size());
    const auto count = static_cast<Eigen::Index>(places.size());
    RealMatrix forces(F.rows(), count);
    for (Eigen::Index j = 0; j < count; ++j)
        forces.col(j) = F.col(n + 2 * j);
    const RealMatrix loaded = of_forces(F, lumps, speed * speed);
    RealMatrix own = -loaded.topRows(n);
    for (Eigen::Index k = 0; k < n; ++k)
        own(k, k) += 1;
    const RealMatrix moved = forces + product(loaded, solve(own, forces.topRows(n)));
    RealMatrix out(count, count);
    for (Eigen::Index i = 0; i < count; ++i)
        out.row(i) = speed * speed * moved.row(n + 2 * i);
    return out;
}

} // namespace whirl::oracles

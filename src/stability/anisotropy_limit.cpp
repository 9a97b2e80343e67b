#include "stability/anisotropy_limit.h"

#include "assembly/planar_part.h"
#include "balancers/balanced_position.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace whirl::stability {

namespace {

/// Polar inertia of shaft, discs, balancers and point masses.
double with_balancers(const assembly::Discretization &d) {
    double Ip = assembly::polar_inertia(d);
    for (const model::Balancer &balancer : d.rotor().balancers) {
        const balancers::AddedInertias added = balancers::added_inertias(balancer);
        Ip += added.parts + added.imbalance + added.own;
    }
    return Ip;
}

} // namespace

AnisotropyLimit anisotropy_limit(const assembly::Discretization &discretization,
                                 std::size_t index) {
    const model::Rotor &rotor = discretization.rotor();
    const model::Anisotropy &element = rotor.anisotropies[index];
    const auto here = [&](double z) {
        return std::abs(z - element.z) <= 1e-9 * rotor.shaft.length();
    };
    AnisotropyLimit out{0, false};
    double Id = 0;
    double Ip = 0;
    for (const model::Disc &disc : rotor.discs)
        if (here(disc.z)) {
            out.of_disc = true;
            Id += disc.Id;
            Ip += disc.Ip;
        }
    const double most = out.of_disc ? std::min(Id, Ip / 2) : with_balancers(discretization) / 2;
    // |others + dI| <= most, as complex numbers in the direction of the element.
    std::complex<double> others = 0;
    for (std::size_t i = 0; i < rotor.anisotropies.size(); ++i)
        if (i != index && here(rotor.anisotropies[i].z))
            others += rotor.anisotropies[i].dI *
                      std::polar(1.0, 2 * (rotor.anisotropies[i].angle - element.angle));
    const double along = std::sqrt(std::max(0.0, most * most - others.imag() * others.imag()));
    out.dI = std::max(0.0, along - others.real());
    return out;
}

} // namespace whirl::stability

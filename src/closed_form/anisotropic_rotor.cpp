#include "closed_form/anisotropic_rotor.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::closed_form {

namespace {

/// Relative allowance for |1 - C| = a and A = C, where the polynomial in Omega^2 loses its leading
/// term.
constexpr double rounding = 1e-12;

double squared(double value) { return value * value; }

std::optional<Band> between_roots(double leading, double half_middle, double constant) {
    const double discriminant = squared(half_middle) - leading * constant;
    if (half_middle <= 0.0 || discriminant <= 0.0)
        return std::nullopt;
    const double sum = half_middle + std::sqrt(discriminant);
    return Band{std::sqrt(constant / sum), std::sqrt(sum / leading)};
}

} // namespace

RotorType rotor_type(double diametral_inertia, double polar_inertia) {
    const double difference = diametral_inertia - polar_inertia;
    if (std::abs(difference) <= rounding * diametral_inertia)
        return RotorType::spherical;
    return difference > 0.0 ? RotorType::long_rotor : RotorType::short_rotor;
}

std::vector<double> critical_speeds(const AnisotropicRotor &rotor) {
    std::vector<double> speeds;
    for (const double inertia : {1.0 - rotor.polar_inertia + rotor.anisotropy,
                                 1.0 - rotor.polar_inertia - rotor.anisotropy}) {
        if (inertia > rounding)
            speeds.push_back(rotor.frequency / std::sqrt(inertia));
    }
    speeds.erase(std::unique(speeds.begin(), speeds.end()), speeds.end());
    return speeds;
}

std::optional<Band> unstable_band(const AnisotropicRotor &rotor) {
    const double slenderness = 1.0 - rotor.polar_inertia;
    const double a = std::abs(rotor.anisotropy);
    const double p2 = squared(rotor.frequency);
    if (a == 0.0 || slenderness < -a - rounding)
        return std::nullopt;

    // a4 = leading x^2 - 2 half_middle x + p^4, x = Omega^2.
    const double leading = (slenderness - a) * (slenderness + a);
    const double half_middle = p2 * slenderness - 0.5 * squared(rotor.damping);
    if (std::abs(std::abs(slenderness) - a) <= rounding) {
        if (half_middle <= 0.0)
            return std::nullopt;
        return Band{std::sqrt(p2 * p2 / (2.0 * half_middle)), std::nullopt};
    }
    if (leading > 0.0)
        return between_roots(leading, half_middle, p2 * p2);
    // One positive root; written so that neither sign of half_middle cancels.
    const double root = std::sqrt(squared(half_middle) - leading * p2 * p2);
    const double x =
        half_middle > 0.0 ? p2 * p2 / (half_middle + root) : (half_middle - root) / leading;
    return Band{std::sqrt(x), std::nullopt};
}

double permissible_anisotropy(const AnisotropicRotor &rotor, double spin_speed) {
    if (spin_speed == 0.0)
        return std::numeric_limits<double>::infinity();
    return std::hypot(squared(rotor.frequency / spin_speed) - (1.0 - rotor.polar_inertia),
                      rotor.damping / spin_speed);
}

PermissibleAnisotropy permissible_anisotropy(const AnisotropicRotor &rotor) {
    const double slenderness = 1.0 - rotor.polar_inertia;
    const double p = rotor.frequency;
    const double h = rotor.damping;
    const double excess = slenderness - squared(h / p) / 2.0;
    if (excess <= 0.0)
        return {std::abs(slenderness), std::nullopt};
    return {h / p * std::sqrt(slenderness - squared(h / p) / 4.0), p / std::sqrt(excess)};
}

PermissibleAnisotropy permissible_anisotropy(const AnisotropicRotor &rotor, double from,
                                             double to) {
    const PermissibleAnisotropy everywhere = permissible_anisotropy(rotor);
    if (everywhere.spin_speed && *everywhere.spin_speed >= from && *everywhere.spin_speed <= to)
        return everywhere;
    // Outside its least point the permissible value is monotone in speed: the least is at an end.
    const double at_from = permissible_anisotropy(rotor, from);
    const double at_to = permissible_anisotropy(rotor, to);
    return at_from < at_to ? PermissibleAnisotropy{at_from, from}
                           : PermissibleAnisotropy{at_to, to};
}

} // namespace whirl::closed_form

#pragma once

#include <cstddef>
#include <string>

namespace whirl::model {

/// What a number of a result is. Inside the program it is in its SI unit.
enum class Quantity {
    number,     ///< without a unit: ratios, counts, decrements
    speed,      ///< of the spin, and what is compared with it
    frequency,  ///< of whirl and of vibration
    rate,       ///< of growth and decay
    length,     ///< places and sizes
    amplitude,  ///< of vibration: the one that may be written from peak to peak
    deflection, ///< what does not vibrate: sag, clearances, orbits as they are drawn
    force,
    stiffness, ///< also cross coupling
    damping,
    mass,
    inertia,
    imbalance,          ///< mass times radius
    moment,             ///< also a torque
    coupling_stiffness, ///< force over an angle, moment over a deflection
    tilt_stiffness,     ///< moment over an angle
    tilt_damping,       ///< moment over an angular speed
    angular_momentum,
    energy,
    power,
    time,
    angle,    ///< in degrees for readers
    slope,    ///< of a shaft: in radians for readers, too
    velocity, ///< of vibration
    acceleration,
    pressure,
    density,
    receptance,  ///< deflection over force
    inverse_mass ///< deflection over imbalance and the square of the speed: the criterion
};

inline constexpr std::size_t quantities = static_cast<std::size_t>(Quantity::inverse_mass) + 1;

struct QuantityNames {
    const char *name; ///< of the enumerator
    const char *si;   ///< of files: "kg m2"; "" of a plain number
    const char *key;  ///< of [units], which sets another unit; "": the quantity stays in SI
};
[[nodiscard]] QuantityNames names_of(Quantity quantity);

/// A unit in which numbers are written.
struct Unit {
    std::string name;
    double factor = 1;         ///< from SI
    bool peak_to_peak = false; ///< as the factor is
};

} // namespace whirl::model

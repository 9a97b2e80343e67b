#include "model/quantity.h"

namespace whirl::model {

QuantityNames names_of(Quantity quantity) {
    switch (quantity) {
    case Quantity::number:
        break;
    case Quantity::speed:
        return {"rad/s", "speed"};
    case Quantity::frequency:
        return {"rad/s", "frequency"};
    case Quantity::rate:
        return {"1/s", ""};
    case Quantity::length:
        return {"m", "length"};
    case Quantity::amplitude:
    case Quantity::deflection:
        return {"m", "amplitude"};
    case Quantity::force:
        return {"N", "force"};
    case Quantity::stiffness:
        return {"N/m", "stiffness"};
    case Quantity::damping:
        return {"N s/m", "damping"};
    case Quantity::mass:
        return {"kg", "mass"};
    case Quantity::inertia:
        return {"kg m2", "inertia"};
    case Quantity::imbalance:
        return {"kg m", "imbalance"};
    case Quantity::moment:
        return {"N m", ""};
    case Quantity::tilt_stiffness:
        return {"N m/rad", ""};
    case Quantity::tilt_damping:
        return {"N m s/rad", ""};
    case Quantity::angular_momentum:
        return {"kg m2/s", ""};
    case Quantity::energy:
        return {"J", ""};
    case Quantity::power:
        return {"W", ""};
    case Quantity::time:
        return {"s", ""};
    case Quantity::angle:
        return {"rad", ""};
    case Quantity::inverse_mass:
        return {"1/kg", ""};
    }
    return {"", ""};
}

} // namespace whirl::model

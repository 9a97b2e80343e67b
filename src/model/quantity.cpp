#include "model/quantity.h"

#include <array>

namespace whirl::model {

QuantityNames names_of(Quantity quantity) {
    static constexpr std::array<QuantityNames, quantities> names{
        {// in the order of the enumerators
         {"number", "", ""},
         {"speed", "rad/s", "speed"},
         {"frequency", "rad/s", "frequency"},
         {"rate", "1/s", ""},
         {"length", "m", "length"},
         {"amplitude", "m", "amplitude"},
         {"deflection", "m", "amplitude"},
         {"force", "N", "force"},
         {"stiffness", "N/m", "stiffness"},
         {"damping", "N s/m", "damping"},
         {"mass", "kg", "mass"},
         {"inertia", "kg m2", "inertia"},
         {"imbalance", "kg m", "imbalance"},
         {"moment", "N m", ""},
         {"coupling_stiffness", "N", ""},
         {"tilt_stiffness", "N m/rad", ""},
         {"tilt_damping", "N m s/rad", ""},
         {"angular_momentum", "kg m2/s", ""},
         {"energy", "J", ""},
         {"power", "W", ""},
         {"time", "s", ""},
         {"angle", "rad", ""},
         {"slope", "rad", ""},
         {"velocity", "m/s", "velocity"},
         {"acceleration", "m/s2", ""},
         {"pressure", "Pa", ""},
         {"density", "kg/m3", ""},
         {"receptance", "m/N", "receptance"},
         {"inverse_mass", "1/kg", ""}}};
    return names.at(static_cast<std::size_t>(quantity));
}

} // namespace whirl::model

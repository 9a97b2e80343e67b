#pragma once

#include "stability/rotor_at_speeds.h"

namespace whirl::tests {

/// A rotor as stability looks at it in a form, whatever is chosen for its case.
inline stability::StabilityModel looked_at(const model::Rotor &rotor, results::Form form, int order,
                                           int harmonics = 0, double top = 0) {
    stability::StabilityModel model;
    model.rotor = rotor;
    model.form = form;
    model.order = order;
    model.harmonics = harmonics;
    model.top = top;
    return model;
}

} // namespace whirl::tests

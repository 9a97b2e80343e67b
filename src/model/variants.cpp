#include "model/variants.h"

namespace whirl::model {

Rotor without_damping(Rotor rotor) {
    for (Bearing &bearing : rotor.bearings) {
        for (BearingCoefficients &at : bearing.rows) {
            at.c.setZero();
            at.ct.setZero();
        }
        if (bearing.pedestal)
            bearing.pedestal->c = 0;
    }
    rotor.shaft.internal_damping = 0;
    return rotor;
}

} // namespace whirl::model

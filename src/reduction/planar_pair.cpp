#include "reduction/planar_pair.h"

#include "assembly/planar_part.h"

namespace whirl::reduction {

PlanarPair planar_pair(const assembly::Discretization &d, double speed) {
    using assembly::Term;
    return {assembly::planar_matrix(d, Term::mass, speed),
            assembly::planar_matrix(d, Term::gyroscopic, speed),
            assembly::planar_matrix(d, Term::stiffness, speed)};
}

} // namespace whirl::reduction

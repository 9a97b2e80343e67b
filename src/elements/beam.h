#pragma once

#include "elements/planar_matrices.h"
#include "elements/section.h"

#include <Eigen/Core>

#include <vector>

namespace whirl::elements {

/// Unknowns of a beam element in one plane: w0, phi0, w1, phi1 at its two nodes, then
/// internal_unknowns(order) amplitudes of functions that vanish at both nodes.
///
/// order 1: the classical two-node Timoshenko element, cubic w with constant shear strain
/// (Przemieniecki 1968, ch. 11; shear parameter Phi = 12 EI / (kappa G A h^2)).
/// order p >= 2: phi of degree p, w of degree p + 1, see beam.cpp.
[[nodiscard]] int internal_unknowns(int order);

/// Places of the internal unknowns of one order among those of a higher one, whose functions
/// contain them.
[[nodiscard]] std::vector<int> internal_places(const Beam &beam, int order, int higher);

/// Element matrices over (w0, phi0, w1, phi1, internal...), integrated exactly for polynomials:
/// energies 1/2 int EI phi'^2 + kappa G A (w' - phi)^2, 1/2 int rho A w'^2 + rho I phi'^2 (time
/// derivatives), G = 2 times the rotary inertia part; of an axial torque T the part that has a
/// potential, -T/2 int phi_i' phi_j - phi_i phi_j'. docs/theory.md, "Timoshenko beam".
[[nodiscard]] PlanarMatrices beam_matrices(const Beam &beam, int order);

/// Shape functions at xi in [0, 1]: deflection w, slope phi, each over all unknowns.
struct ShapeValues {
    Eigen::VectorXd w;
    Eigen::VectorXd phi;
};
[[nodiscard]] ShapeValues beam_shapes(const Beam &beam, int order, double xi);

} // namespace whirl::elements

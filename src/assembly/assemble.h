#pragma once

#include "assembly/discretization.h"

#include <Eigen/Core>

#include <complex>
#include <functional>
#include <span>

namespace whirl::assembly {

/// The matrices of M q'' + (C + speed G) q' + (K + speed Kc) q = f; docs/conventions.md.
enum class Term { mass, damping, gyroscopic, stiffness, circulatory };

/// Receives an axisymmetric block: the same in both planes, except that the gyroscopic and the
/// circulatory ones couple the planes: real form [0 B; -B 0] for (x; y).
using AddPlanar =
    std::function<void(Term, std::span<const int> unknowns, const Eigen::MatrixXd &block)>;

/// Visits the entries of such a block, with the unknowns of row and column.
template <class Visit>
void for_each_entry(std::span<const int> unknowns, const Eigen::MatrixXd &block,
                    const Visit &visit) {
    for (std::size_t i = 0; i < unknowns.size(); ++i)
        for (std::size_t j = 0; j < unknowns.size(); ++j)
            visit(unknowns[i], unknowns[j],
                  block(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
}

/// Receives a 2 x 2 block on (x, y) between the planar unknowns `row` and `column`.
using AddCoupling = std::function<void(Term, int row, int column, const Eigen::Matrix2d &block)>;

/// Shaft elements and discs: everything axisymmetric that turns.
void assemble_rotating_parts(const Discretization &discretization, const AddPlanar &add);

/// Receives a block of something that turns and is not axisymmetric; in rotating axes `factor`
/// times the block multiplies conj(u'' + speed^2 u) (Term::mass), conj(u') (damping) or conj(u)
/// (stiffness) of the planar unknowns u.
using AddConjugate = std::function<void(Term, std::span<const int> unknowns,
                                        const Eigen::MatrixXd &block, std::complex<double> factor)>;

/// Inertial anisotropies and segments with two bending stiffnesses (theory.md, "Rotating frame").
void assemble_asymmetry(const Discretization &discretization, const AddConjugate &add);

/// One of the bearings and seals with the coefficients it has at a spin speed (rad/s): between the
/// shaft and its pedestal or the ground.
void assemble_film(const Discretization &discretization, int bearing, double speed,
                   const AddCoupling &add);
/// The pedestal below it, where there is one.
void assemble_pedestal(const Discretization &discretization, int bearing, const AddCoupling &add);
/// All of them.
void assemble_bearings(const Discretization &discretization, double speed, const AddCoupling &add);

/// Axial torque.
void assemble_torque(const Discretization &discretization, const AddCoupling &add);

/// Damping of the shaft that does not turn with it: the same at every speed.
void assemble_outside_damping(const Discretization &discretization, const AddCoupling &add);

/// All that is the same for those who turn and those who do not, or acts from the fixed frame:
/// bearings, axial torque, damping of the shaft that does not turn.
void assemble_supports(const Discretization &discretization, double speed, const AddCoupling &add);

} // namespace whirl::assembly

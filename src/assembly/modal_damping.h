#pragma once

#include <Eigen/Core>

#include <array>

namespace whirl::assembly {

class Discretization;

/// Damping that gives the lowest undamped modes at rest the ratios shaft.modal_damping, one matrix
/// for x and one for y (planar_size() square): M V diag(2 ratio frequency) V^T M with V the modes
/// of that plane, V^T M V = 1 (Clough and Penzien, Dynamics of Structures, 2nd ed. 1993, sec.
/// 12-5). M and K are those of shaft, discs, pedestals and of the bearings at rest, without what
/// couples x and y, balancers and rotating anisotropy. Motions at frequency zero do not count.
using ModalDamping = std::array<Eigen::MatrixXd, 2>;

/// @throws model::BadInput for more ratios than there are modes; linalg::SolverError
[[nodiscard]] ModalDamping make_modal_damping(const Discretization &discretization);

} // namespace whirl::assembly

#pragma once

#include "model/case.h"
#include "results/critical.h"
#include "results/model_summary.h"

namespace whirl::analyses {

/// Critical speed map: the lowest critical speeds of either sense of whirl (half of campbell.modes
/// of each) of the rotor without damping, over the isotropic stiffness of all bearings together or
/// of the one that [critical_map] names. Seals, pedestals and the other bearings stay, with the
/// mean of their x and y coefficients, without damping, cross coupling and axial torque, tables
/// over the speed at the critical speed itself. Of asymmetric rotors: forward, balls held, both
/// directions of a motion.
///
/// Crossings: critical speeds of the rotor whose varied bearings have the kxx (kyy) of one bearing
/// as a table over the speed, in all directions; each is looked up again on the map at its
/// stiffness. So on isotropic bearings that are all alike they are those of the rotor itself.
///
/// @param model  gets notes
/// @throws model::BadInput without bearings; linalg::SolverError, model::AnalysisFailure
/// Collective under mpirun, the stiffnesses dealt out; complete on process 0.
[[nodiscard]] results::CriticalMap critical_map(const model::Case &scene,
                                                results::ModelSummary &model);

} // namespace whirl::analyses

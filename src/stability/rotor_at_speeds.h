#pragma once

#include "assembly/discretization.h"
#include "balancers/arrangement.h"
#include "model/case.h"
#include "results/formulation.h"

#include <memory>
#include <vector>

namespace whirl::stability {

struct StepExperience;

/// How `stability` treats a case: the rotor, the form and what they need. Chosen once a run and
/// used by all searches.
struct StabilityModel {
    model::Rotor rotor;
    results::Formulation formulation;
    results::Form form = results::Form::general; ///< general, rotating or hill
    /// The form in which single lines are followed: planar, planar_damped and hyperbolic too.
    results::Form form_of_lines = results::Form::general;
    bool conservative = false; ///< undamped, fixed frame, K > 0: nothing can grow
    /// Fixed axes, K > 0, and nothing but damping that resists does work: nothing can grow. By the
    /// parts of x^H Q(l) x = 0, 2 Re l x^H M x = -x^H C x where Im l is not zero, and where it is
    /// zero l^2 x^H M x + l x^H C x + x^H K x is positive for l >= 0.
    bool resisted = false;
    bool reduction = true; ///< whether a rotor reduced to few planar shapes may be searched first
    int order = 1;
    int harmonics = 0; ///< of the Hill series; 0: form hill by the monodromy matrix
    /// Of the steps in time that monodromy matrices need, shared with rotors that hardly differ;
    /// none: every rotor gathers its own.
    std::shared_ptr<StepExperience> experience;
    double top = 0;  ///< largest |speed| that will be looked at, rad/s
    double from = 0; ///< rad/s, least |speed| that the series describes
};

/// @param speeds  at which motions will be looked at, rad/s
/// @throws model::AnalysisFailure where the Hill series does not settle.
[[nodiscard]] StabilityModel stability_model(const model::Case &scene,
                                             const std::vector<double> &speeds);

/// No equation depends on the spin speed: fixed axes, no gyroscopic effect, no internal damping, no
/// bearing tables. Motions of one speed are then those of all.
[[nodiscard]] bool same_at_all_speeds(const StabilityModel &model,
                                      const assembly::Discretization &discretization);

/// The speeds at which a search for bands looks: those of the case, and more where they are few.
[[nodiscard]] std::vector<double> search_speeds(const model::SpeedRange &range);

/// A speed at which something can stand still in rotating axes.
struct ZeroRootSpeed {
    double speed = 0;   ///< rad/s
    bool exact = false; ///< the root is real: an eigenvalue passes zero there
};

/// Roots W of det[K + W Ks + W^2 Kss] = 0 of the rotor in rotating axes with 0 < Re W <= top and
/// |Im W| < Re W, ascending by Re W, equal ones once. With the balls frozen the forward critical
/// speeds, with the balls free the additional speeds: critical speeds of the rotor pinned at the
/// balancers. Bearings as at zero speed.
/// @param shapes  planar shapes with which the rotor's motions are known to be those of the whole
///                one (BandFinder): the roots are looked for with these and refined with the whole
///                rotor; none: all roots of the whole rotor
[[nodiscard]] std::vector<ZeroRootSpeed>
zero_root_speeds(const assembly::Discretization &discretization,
                 const balancers::Arrangement &arrangement, bool frozen, double top,
                 const Eigen::MatrixXd *shapes = nullptr);

} // namespace whirl::stability

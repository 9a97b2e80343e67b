#pragma once

#include "criterion/form.h"
#include "criterion/undamped_rotor.h"
#include "model/case.h"
#include "results/formulation.h"
#include "rigid/projection.h"

#include <vector>

namespace whirl::criterion {

/// At rest there is no criterion; this near to it nothing but zero speeds of a free rotor stand,
/// rad/s.
[[nodiscard]] inline double least_speed(const model::SpeedRange &range) { return 1e-6 * range.to; }

/// What all parts of the balancing analysis share: planes, range of speeds and discretised rotor.
struct BalanceScene {
    std::vector<model::CorrectionPlane> planes;
    std::vector<double> speeds; ///< of the grid, rad/s
    double from = 0;            ///< range of the bands, rad/s; never zero
    double to = 0;
    results::Formulation formulation;
    int harmonics = 0; ///< form hill: terms of the series in twice the spin speed
    int order = 1;
    model::Rotor rotor;     ///< without balancers, with all planes
    rigid::RigidRotor body; ///< it as a rigid body, bearings as at `from`
    double anisotropy = 0;  ///< half the difference of its diametral inertias, kg m2

    explicit BalanceScene(const model::Case &scene);

    [[nodiscard]] bool has_range() const { return to > from; }
    /// z of the planes, m.
    [[nodiscard]] std::vector<double> plane_positions() const;
    /// The criterion at the planes of `rotor`, discretised.
    [[nodiscard]] BalanceForm form_at_planes(const assembly::Discretization &d) const;
};

/// Deflections where some parts of a rotor are.
template <class Parts>
[[nodiscard]] std::vector<assembly::Combination> deflections_at(const assembly::Discretization &d,
                                                                const Parts &parts) {
    std::vector<assembly::Combination> out;
    for (const auto &part : parts)
        out.push_back(d.deflection_at(part.z));
    return out;
}

/// Where each plane alone can balance the rotor, then where several can together.
[[nodiscard]] std::vector<results::BalanceBands *> bands_of_each(results::BalanceResult &result);

/// Speeds at which signs of the criterion can change.
struct BalanceBreakpoints {
    bool sharp = false; ///< they change nowhere else, and the lists are complete
    std::vector<double> critical;
    std::vector<std::vector<double>> pinned; ///< at each plane alone, then at all of them
};

/// Critical speeds of the rotor, free and pinned, where signs change nowhere else: without damping,
/// bearing tables and coupling that is not symmetric.
[[nodiscard]] BalanceBreakpoints
balance_breakpoints(const BalanceScene &scene, const assembly::Discretization &d, bool undamped);

} // namespace whirl::criterion

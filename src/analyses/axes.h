#pragma once

#include "analyses/case_with.h"
#include "model/case.h"

#include <cstddef>
#include <map>
#include <vector>

namespace whirl::analyses {

/// The rotors over axes of [map] or [sweep]: each has entries of its own at values of the axes. An
/// axis over a dimensionless number changes its entries so that the rotor has that number.
class RotorsOver {
  public:
    /// @param axes  of entries, not of the spin speed
    RotorsOver(std::vector<model::SweepAxis> axes, CaseWith with);

    struct Rotor {
        model::Case scene;
        /// Of each axis: the value, factor or shift of its entries (model::SweepChange).
        std::vector<double> changes;
    };

    /// @param values  one of each axis
    /// @throws model::BadInput where there is no such rotor, or no value of the entries gives it
    ///         the number: with the range that it can have
    [[nodiscard]] Rotor at(const std::vector<double> &values) const;

  private:
    std::vector<model::SweepAxis> _axes;
    CaseWith _with;
    mutable std::vector<std::map<double, double>> _alone; ///< of each axis, see change_alone

    [[nodiscard]] model::Case scene(const std::vector<double> &changes) const;
    [[nodiscard]] double change_for(std::size_t axis, double number,
                                    std::vector<double> changes) const;
    [[nodiscard]] double change_alone(std::size_t axis, double number) const;
};

/// Spin speeds of an axis over these or over Omega = speed/omega_0, rad/s.
/// @throws model::BadInput where the rotor has no omega_0
[[nodiscard]] std::vector<double> speeds_over(const model::SweepAxis &axis,
                                              const model::Case &scene);

} // namespace whirl::analyses

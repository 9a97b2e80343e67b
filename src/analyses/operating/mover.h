#pragma once

#include "analyses/orbits/response_orbits.h"
#include "assembly/discretization.h"
#include "forced/forced_motion.h"

#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace whirl::analyses {

/// How far something moves, largest over a period: semi-major axes or readings.
struct Moving {
    double amplitude = 0;    ///< m; of a bearing's force N, which has no velocity
    double velocity = 0;     ///< m/s
    double velocity_rms = 0; ///< m/s
    double acceleration = 0; ///< m/s2
    double phase = std::numeric_limits<double>::quiet_NaN(); ///< of x or of the reading, rad
    double error = 0; ///< relative to the amplitude; infinite: not known

    /// With that of another frequency: as if the largest values came together.
    Moving &operator+=(const Moving &other);
    [[nodiscard]] Moving times(double factor) const;
    /// A resonance without damping.
    [[nodiscard]] static Moving without_limit();
};

/// The steady motion under one drive, over the spin speed.
class Mover {
  public:
    explicit Mover(bool of_imbalances) : _of_imbalances(of_imbalances) {}
    virtual ~Mover() = default;

    /// Of the imbalances (with the forces that act together with them): what is multiplied with
    /// them.
    [[nodiscard]] bool of_imbalances() const { return _of_imbalances; }

    /// @returns false: without limit
    [[nodiscard]] virtual bool solve(double speed, bool with_error) = 0;
    /// Of the last solution.
    [[nodiscard]] virtual Moving of(const forced::Quantity &quantity) const = 0;

    /// Between two of these speeds no quantity has a peak that neither of them shows: where it is
    /// looked at.
    struct Look {
        std::vector<double> speeds; ///< rad/s
        /// Resonances without damping: which quantity, and where.
        std::vector<std::pair<std::size_t, double>> without_limit;
    };
    [[nodiscard]] virtual Look look(double from, double to,
                                    const std::vector<forced::Quantity> &quantities) const = 0;

  private:
    bool _of_imbalances;
};

/// Of a rotor in any form but that of periodic equations.
/// @param motion_at  solves with errors, and tells resonances
[[nodiscard]] std::unique_ptr<Mover> forced_mover(const assembly::Discretization &d,
                                                  results::Form form, forced::Drive drive,
                                                  MotionAt motion_at);

} // namespace whirl::analyses

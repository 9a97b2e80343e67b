#pragma once

#include "model/case.h"

#include <optional>
#include <vector>

namespace whirl::simulation {

/// Prescribed spin of a rotor over time: speed piecewise linear and continuous, constant outside
/// the points of the run-up.
class Spin {
  public:
    /// Rotor angle, speed and acceleration at one moment.
    struct At {
        double angle = 0;        ///< rad, within the turn in which the piece began
        double speed = 0;        ///< rad/s
        double acceleration = 0; ///< rad/s2
    };

    /// Constant speed, rad/s.
    explicit Spin(double speed);
    /// @param run_up  (time s, speed rad/s), times ascending, at least one
    explicit Spin(const std::vector<std::pair<double, double>> &run_up);

    /// The same speed at all times.
    [[nodiscard]] bool constant() const {
        return _pieces.size() == 1 && _pieces.front().acceleration == 0;
    }
    /// Times at which the acceleration jumps, ascending, > 0.
    [[nodiscard]] std::vector<double> jumps() const;
    /// @param t      s
    /// @param piece  a time inside the piece whose acceleration counts at its ends
    [[nodiscard]] At at(double t, double piece) const;
    /// Whole angle turned until t, rad.
    [[nodiscard]] double turned(double t) const;
    /// When |speed| is this large for the first time, s; none: never.
    [[nodiscard]] std::optional<double> reaches(double speed) const;
    /// Largest |speed| until t, rad/s.
    [[nodiscard]] double fastest(double t) const;

  private:
    struct Piece {
        double start = 0;        ///< s
        double angle = 0;        ///< at the start, rad, whole
        double speed = 0;        ///< at the start, rad/s
        double acceleration = 0; ///< rad/s2
    };
    std::vector<Piece> _pieces; ///< ascending; the first starts at 0

    [[nodiscard]] const Piece &piece_at(double t) const;
};

} // namespace whirl::simulation

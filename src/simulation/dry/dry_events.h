#pragma once

#include "simulation/motion.h"
#include "simulation/ode_solver.h"

#include <functional>
#include <memory>
#include <optional>

namespace whirl::simulation {

/// Whatever changes which parts touch or stand: impacts, parts that come apart, come to rest or
/// begin to move. Found as roots between the ends of a step, which is integrated again.
class DryEvents {
  public:
    /// @param scale   rad/s: of the rates of the parts
    /// @param solver  of the motion, for steps that are integrated again
    DryEvents(RotorMotion &motion, double scale, std::unique_ptr<OdeSolver> solver);

    /// Parts in contact and at rest at the start, all others move.
    void begin(double t, Eigen::VectorXd &state);
    struct Event {
        double time = 0;
        Eigen::VectorXd state;
    };
    /// The first event in a step; none: there is none.
    [[nodiscard]] std::optional<Event> within(double from, const Eigen::VectorXd &before, double to,
                                              const double *after);
    /// Impacts change the velocities and take energy, booked as loss; then who touches and stands.
    void pass(Event &event);

    [[nodiscard]] long impacts() const { return _impacts; }
    /// Largest share by which one impact raised the energy of all: rounding.
    [[nodiscard]] double created() const { return _created; }
    /// A part was pulled off its race.
    [[nodiscard]] bool lifted() const { return _lifted; }

  private:
    RotorMotion &_motion;
    double _scale;
    std::unique_ptr<OdeSolver> _solver;
    std::vector<double> _rates;
    long _impacts = 0;
    double _created = 0;
    bool _lifted = false;
    double _last = -1; ///< s: of the last event
    long _at_once = 0; ///< events at that time

    /// What there is to be searched of a step, and the state at each moment of it.
    struct Piece {
        double from = 0, length = 0;
        std::function<const double *(double since)> state_at;
    };

    /// What touches or is at rest: it may be held, or let go.
    struct Candidates {
        std::vector<bool> gaps, parts;
    };

    [[nodiscard]] std::vector<double> values(double t, const double *state);
    [[nodiscard]] std::optional<double> dip(const Gap &gap, const double *before,
                                            const double *after, double length) const;
    [[nodiscard]] std::optional<double> first_moment(std::size_t i, const Piece &piece);
    void jump(double t, Eigen::VectorXd &state, const Eigen::VectorXd &change);
    void settle(double t, Eigen::VectorXd &state, const std::vector<bool> &which);
    void stop_parts_at_rest(double t, Eigen::VectorXd &state);
    void choose(double t, Eigen::VectorXd &state);
    bool amend(const Candidates &near, bool first);
    bool collide(double t, Eigen::VectorXd &state);
};

} // namespace whirl::simulation

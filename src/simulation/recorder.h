#pragma once

#include "results/simulate.h"
#include "simulation/motion.h"

#include <vector>

namespace whirl::simulation {

/// Share of the time at the end over which amplitudes count as final.
inline constexpr double final_share = 0.025;

/// Collects what a result needs while a motion is integrated.
class MotionRecorder {
  public:
    /// @param rows    of the deflections that are recorded, one for each plane
    /// @param end     of the motion, s
    /// @param points  of the time series
    MotionRecorder(const RotorMotion &motion, std::vector<reduction::Row> rows, double end,
                   int points);

    /// Output times, ascending; the last is the end.
    [[nodiscard]] const std::vector<double> &times() const { return _times; }
    /// After every step.
    void step(double t, const double *state);
    /// At an output time.
    void output(double t, const double *state);

    [[nodiscard]] const results::MotionSeries &series() const { return _series; }
    /// What the restart of a run needs, and back; the series may be taken apart from it.
    void save(model::Restart &restart) const;
    void resume(const model::Restart &restart, results::MotionSeries series);
    /// Largest |w| of each row over the last 2.5 % of the time.
    [[nodiscard]] const std::vector<double> &last_amplitudes() const { return _last; }

  private:
    const RotorMotion &_motion;
    std::vector<reduction::Row> _rows;
    double _last_from; ///< s
    std::vector<double> _times;
    std::vector<double> _largest; ///< since the last output
    std::vector<double> _last;
    results::MotionSeries _series;
};

} // namespace whirl::simulation

#pragma once

#include "results/simulate.h"
#include "simulation/motion.h"

#include <utility>
#include <vector>

namespace whirl::simulation {

/// The time series of a motion.
class MotionRecorder {
  public:
    /// @param rows    of the deflections that are recorded, one for each plane
    /// @param end     of the motion, s
    /// @param points  of the time series
    MotionRecorder(const RotorMotion &motion, std::vector<reduction::Row> rows, double end,
                   int points);

    /// Output times, ascending; the last is the end.
    [[nodiscard]] const std::vector<double> &times() const { return _times; }
    /// At an output time.
    /// @param largest  |w| of each row since the last one, m
    void output(double t, const double *state, const std::vector<double> &largest);

    [[nodiscard]] const results::MotionSeries &series() const { return _series; }
    /// Goes on with the series of an interrupted run.
    void resume(results::MotionSeries series) { _series = std::move(series); }

  private:
    const RotorMotion &_motion;
    std::vector<reduction::Row> _rows;
    std::vector<double> _times;
    results::MotionSeries _series;
};

} // namespace whirl::simulation

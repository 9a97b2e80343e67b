#include "simulation/recorder.h"

#include <algorithm>
#include <utility>

namespace whirl::simulation {

MotionRecorder::MotionRecorder(const RotorMotion &motion, std::vector<reduction::Row> rows,
                               double end, int points)
    : _motion(motion), _rows(std::move(rows)) {
    for (int i = 0; i < points; ++i)
        _times.push_back(i == points - 1 ? end : end * i / (points - 1));
    _series.amplitude.resize(_rows.size());
    _series.x.resize(_rows.size());
    _series.y.resize(_rows.size());
    _series.angles.resize(static_cast<std::size_t>(motion.parts().free_angles()));
}

void MotionRecorder::output(double t, const double *state, const std::vector<double> &largest) {
    _series.time.push_back(t);
    _series.speed.push_back(_motion.spin(t, state).speed);
    for (std::size_t i = 0; i < _rows.size(); ++i) {
        const Eigen::Vector2d w = _motion.deflection(_rows[i], state);
        _series.amplitude[i].push_back(std::max(largest[i], w.norm()));
        _series.x[i].push_back(w(0));
        _series.y[i].push_back(w(1));
    }
    for (std::size_t i = 0; i < _series.angles.size(); ++i)
        _series.angles[i].push_back(state[_motion.first_angle() + static_cast<int>(i)]);
}

} // namespace whirl::simulation

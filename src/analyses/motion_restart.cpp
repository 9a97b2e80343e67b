#include "analyses/motion_restart.h"

#include "model/errors.h"

#include <fmt/format.h>

#include <algorithm>

namespace whirl::analyses {

namespace {

using Eigen::Index;

std::vector<double> whole_rotor(const ReducedRotor &rotor, const double *p) {
    const Eigen::Map<const Eigen::MatrixXd> values(p, rotor.size(), 2);
    const Eigen::MatrixXd q = rotor.shapes * values;
    return {q.data(), q.data() + q.size()};
}

void on_shapes(const ReducedRotor &rotor, const std::vector<double> &whole, double *p) {
    const Eigen::Map<const Eigen::MatrixXd> q(whole.data(), rotor.shapes.rows(), 2);
    Eigen::Map<Eigen::MatrixXd>(p, rotor.size(), 2) = rotor.mass_times.transpose() * q;
}

} // namespace

model::Restart restart_of(const RotorMotion &motion, const double *state,
                          const MotionSeries &series) {
    const ReducedRotor &rotor = motion.parts().rotor;
    const int n = motion.coordinates();
    model::Restart restart;
    restart.displacements = whole_rotor(rotor, state);
    restart.velocities = whole_rotor(rotor, state + n);
    restart.angles.assign(state + motion.first_angle(), state + n);
    restart.rates.assign(state + n + motion.first_angle(), state + 2 * n);
    restart.spin.assign(state + 2 * n, state + motion.books());
    restart.books.assign(state + motion.books(), state + motion.size());
    restart.series = {series.time, series.speed};
    for (const auto *lists : {&series.amplitude, &series.x, &series.y, &series.angles})
        restart.series.insert(restart.series.end(), lists->begin(), lists->end());
    return restart;
}

Eigen::VectorXd state_of(const model::Restart &restart, const model::Case &scene,
                         const RotorMotion &motion) {
    const ReducedRotor &rotor = motion.parts().rotor;
    const int n = motion.coordinates();
    const auto whole = static_cast<std::size_t>(2 * rotor.shapes.rows());
    const std::size_t angles = motion.parts().free.size();
    const std::size_t planes = scene.rotor.balancers.size();
    const bool fits = restart.displacements.size() == whole && restart.velocities.size() == whole &&
                      restart.angles.size() == angles && restart.rates.size() == angles &&
                      restart.largest.size() == planes && restart.last.size() == planes &&
                      restart.books.size() == 3 &&
                      restart.spin.size() == (motion.parts().motor ? 2U : 0U) &&
                      restart.series.size() == 2 + 3 * planes + angles &&
                      std::all_of(restart.series.begin(), restart.series.end(),
                                  [&](const std::vector<double> &column) {
                                      return column.size() == restart.series.front().size();
                                  });
    if (!fits)
        throw model::BadInput(
            fmt::format("simulate.restart: expected the state of an interrupted run of this case, "
                        "got that of \"{}\" with other parts",
                        restart.case_name));
    if (!(restart.time < scene.simulate.time))
        throw model::BadInput(fmt::format("simulate.time: expected more than {} s, where the "
                                          "interrupted run stopped, got {} s",
                                          restart.time, scene.simulate.time));
    Eigen::VectorXd state(motion.size());
    on_shapes(rotor, restart.displacements, state.data());
    on_shapes(rotor, restart.velocities, state.data() + n);
    std::copy(restart.angles.begin(), restart.angles.end(), state.data() + motion.first_angle());
    std::copy(restart.rates.begin(), restart.rates.end(), state.data() + n + motion.first_angle());
    std::copy(restart.spin.begin(), restart.spin.end(), state.data() + 2 * n);
    std::copy(restart.books.begin(), restart.books.end(), state.data() + motion.books());
    return state;
}

MotionSeries series_of(const model::Restart &restart, std::size_t planes, std::size_t angles) {
    MotionSeries series;
    series.time = restart.series[0];
    series.speed = restart.series[1];
    auto next = restart.series.begin() + 2;
    for (auto *lists : {&series.amplitude, &series.x, &series.y})
        for (std::size_t i = 0; i < planes; ++i)
            lists->push_back(*next++);
    for (std::size_t i = 0; i < angles; ++i)
        series.angles.push_back(*next++);
    return series;
}

} // namespace whirl::analyses

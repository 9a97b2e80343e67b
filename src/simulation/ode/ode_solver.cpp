#include "simulation/ode/ode_solver.h"

#include "linalg/check.h"
#include "simulation/ode/exponential_adams.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace whirl::simulation {

void OdeProblem::rates_in_axes(double t, const double *y, double *out) const {
    rates(axes.speed == 0 ? t : 0, y, out);
    if (axes.speed == 0)
        return;
    for (const int first : axes.first)
        for (int i = first; i < first + axes.count; ++i) {
            out[i] += axes.speed * y[i + axes.count];
            out[i + axes.count] -= axes.speed * y[i];
        }
}

OdeSolver::OdeSolver(OdeProblem problem)
    : _problem(std::move(problem)), _resting(static_cast<std::size_t>(_problem.size)) {}

/// exp(i angle) times the vectors of y.
void OdeSolver::turn(double angle, double *y) const {
    const TurningAxes &axes = _problem.axes;
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    for (const int first : axes.first) {
        double *x = y + first;
        for (int i = 0; i < axes.count; ++i) {
            const double along = x[i];
            const double across = x[axes.count + i];
            x[i] = cosine * along - sine * across;
            x[axes.count + i] = sine * along + cosine * across;
        }
    }
}

const double *OdeSolver::in_resting_axes(const double *y, double at) {
    if (_problem.axes.speed == 0)
        return y;
    std::copy(y, y + _problem.size, _resting.begin());
    turn(_problem.axes.speed * at, _resting.data());
    return _resting.data();
}

void OdeSolver::start(double t, const double *y, double step) {
    _t = t;
    std::copy(y, y + _problem.size, _resting.begin());
    if (_problem.axes.speed != 0)
        turn(-_problem.axes.speed * t, _resting.data());
    start_in_axes(t, _resting.data(), step);
}

double OdeSolver::step(double end) {
    _before = _t;
    return _t = step_in_axes(end);
}

const double *OdeSolver::within(double share) {
    return in_resting_axes(within_in_axes(share), _t - (1 - share) * (_t - _before));
}

const double *OdeSolver::within_in_axes(double /*share*/) {
    throw linalg::SolverError("states within a step are not known");
}

std::unique_ptr<OdeSolver> ode_solver(OdeProblem problem, OdeMethod method) {
    if (method == OdeMethod::exponential)
        return std::make_unique<ExponentialAdams>(std::move(problem));
    return arkode(std::move(problem), method == OdeMethod::implicit_stiff);
}

} // namespace whirl::simulation

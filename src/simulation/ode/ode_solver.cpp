#include "simulation/ode/ode_solver.h"

#include "simulation/ode/arkode.h"
#include "simulation/ode/exponential_adams.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace whirl::simulation {

struct OdeSolver::Data {
    OdeProblem problem;
    std::unique_ptr<Integrator> integrator = nullptr; ///< of `problem`
    double t = 0;
    std::vector<double> resting = {}; ///< y in axes that stand still, where those of it turn

    [[nodiscard]] bool turns() const { return problem.axes.speed != 0; }

    /// exp(i angle) times the vectors of y.
    void turn(double cosine, double sine, double *y) const {
        const TurningAxes &axes = problem.axes;
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

    [[nodiscard]] const double *in_resting_axes(const double *y, double at) {
        if (!turns())
            return y;
        std::copy(y, y + problem.size, resting.begin());
        turn(std::cos(problem.axes.speed * at), std::sin(problem.axes.speed * at), resting.data());
        return resting.data();
    }
};

OdeSolver::OdeSolver(OdeProblem problem, OdeMethod method)
    : _data(std::make_unique<Data>(Data{std::move(problem)})) {
    Data &d = *_data;
    d.resting.resize(d.problem.size);
    if (method == OdeMethod::exponential)
        d.integrator = std::make_unique<ExponentialAdams>(d.problem);
    else
        d.integrator = std::make_unique<Arkode>(d.problem, method == OdeMethod::implicit_stiff);
}

OdeSolver::~OdeSolver() = default;

void OdeSolver::start(double t, const double *y, double step) {
    Data &d = *_data;
    d.t = t;
    std::copy(y, y + d.problem.size, d.resting.data());
    const double angle = d.problem.axes.speed * t;
    if (d.turns())
        d.turn(std::cos(angle), -std::sin(angle), d.resting.data());
    d.integrator->start(t, d.resting.data(), step);
}

double OdeSolver::step(double end) { return _data->t = _data->integrator->step(end); }

double OdeSolver::next_step() const { return _data->integrator->next_step(); }

const double *OdeSolver::state() const {
    return _data->in_resting_axes(_data->integrator->state(), _data->t);
}

const double *OdeSolver::within(double share) const {
    Integrator &integrator = *_data->integrator;
    return _data->in_resting_axes(integrator.within(share),
                                  _data->t - (1 - share) * integrator.last_step());
}

OdeCounts OdeSolver::counts() const { return _data->integrator->counts(); }

} // namespace whirl::simulation

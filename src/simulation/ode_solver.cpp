#include "simulation/ode_solver.h"

#include "linalg/check.h"
#include "simulation/runge_kutta.h"

#include <arkode/arkode_arkstep.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace whirl::simulation {

namespace {

/// Owns what a function of the library releases.
template <auto release> struct Release {
    template <class T> void operator()(T *resource) const { release(resource); }
};
template <class T, auto release>
using Handle = std::unique_ptr<std::remove_pointer_t<T>, Release<release>>;

void free_context(SUNContext context) { SUNContext_Free(&context); }
void free_stepper(void *memory) { ARKStepFree(&memory); }

/// What the integrator's own word for a failure means.
std::string in_words(int flag) {
    switch (flag) {
    case ARK_TOO_MUCH_ACC:
        return "the tolerance is below what double precision can follow";
    case ARK_ILL_INPUT:
    case ARK_TOO_CLOSE:
        return "the time is too short to make a step";
    case ARK_TOO_MUCH_WORK:
        return "too many steps";
    case ARK_ERR_FAILURE:
    case ARK_CONV_FAILURE:
        return "no step is small enough to meet the tolerance";
    case ARK_RHSFUNC_FAIL:
    case ARK_UNREC_RHSFUNC_ERR:
    case ARK_REPTD_RHSFUNC_ERR:
        return "the motion grows beyond all numbers";
    default:
        return "the integrator gave up (code " + std::to_string(flag) + ")";
    }
}

void require(int flag) {
    if (flag < 0)
        throw linalg::SolverError(in_words(flag));
}

void silent(int /*code*/, const char * /*module*/, const char * /*function*/, char * /*message*/,
            void * /*data*/) {}

/// Sums over the stages of a step take a good part of the time for small systems: one pass over
/// the entries, made for the compiler to vectorise, instead of one pass a stage.
int linear_combination(int count, double *factors, N_Vector *vectors, N_Vector out) {
    const auto size = static_cast<Eigen::Index>(N_VGetLength(out));
    const auto array = [size](N_Vector v) {
        return Eigen::Map<Eigen::ArrayXd>(N_VGetArrayPointer(v), size);
    };
    // `out` may be the first of the vectors, and none of the others.
    auto sum = array(out);
    sum = factors[0] * array(vectors[0]);
    int i = 1;
    for (; i + 2 < count; i += 3)
        sum += factors[i] * array(vectors[i]) + factors[i + 1] * array(vectors[i + 1]) +
               factors[i + 2] * array(vectors[i + 2]);
    for (; i < count; ++i)
        sum += factors[i] * array(vectors[i]);
    return 0;
}

} // namespace

void TurningAxes::turn(double angle, double *state) const {
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    for (const int from : first)
        for (double *x = state + from; x < state + from + count; ++x) {
            double &across = x[count];
            const double along = *x;
            *x = cosine * along - sine * across;
            across = sine * along + cosine * across;
        }
}

/// The integrator's memory. What is its own is destroyed from the last to the first.
struct OdeSolver::Arkode {
    OdeProblem problem;
    bool stiff;
    Handle<SUNContext, free_context> context = nullptr;
    Handle<N_Vector, N_VDestroy> y = nullptr;
    Handle<SUNMatrix, SUNMatDestroy> jacobian = nullptr;
    Handle<SUNLinearSolver, SUNLinSolFree> linear = nullptr;
    Handle<void *, free_stepper> stepper = nullptr;
    double t = 0;
    std::vector<double> resting;  ///< y in axes that stand still
    OdeCounts counts_before = {}; ///< of what ran before the last start

    Arkode(OdeProblem stated, OdeMethod method)
        : problem(std::move(stated)), stiff(method == OdeMethod::implicit_stiff),
          resting(static_cast<std::size_t>(problem.size)) {
        SUNContext made = nullptr;
        if (SUNContext_Create(nullptr, &made) != 0)
            throw linalg::SolverError("SUNDIALS: cannot start");
        context.reset(made);
        y.reset(N_VNew_Serial(problem.size, made));
        y->ops->nvlinearcombination = linear_combination;
        if (stiff) {
            jacobian.reset(SUNDenseMatrix(problem.size, problem.size, made));
            linear.reset(SUNLinSol_Dense(y.get(), jacobian.get(), made));
        }
    }

    void create() {
        stepper.reset(ARKStepCreate(stiff ? nullptr : rates, stiff ? rates : nullptr, t, y.get(),
                                    context.get()));
        if (!stepper)
            throw linalg::SolverError("the integrator cannot start");
        void *memory = stepper.get();
        require(ARKStepSetErrHandlerFn(memory, silent, nullptr));
        require(ARKStepSetUserData(memory, &problem));
        require(ARKStepWFtolerances(memory, weights));
        require(ARKStepSetMaxNumSteps(memory, -1));
        // Never asked for; the other kind evaluates the rates at every step.
        require(ARKStepSetInterpolantType(memory, ARK_INTERP_LAGRANGE));
        if (!stiff) {
            set_explicit_table();
            return;
        }
        require(ARKStepSetTableNum(memory, ARKODE_ARK548L2SA_DIRK_8_4_5, ARKODE_ERK_NONE));
        require(ARKStepSetLinearSolver(memory, linear.get(), jacobian.get()));
        require(ARKStepSetDeduceImplicitRhs(memory, 1));
    }

    void set_explicit_table() {
        RungeKuttaPair pair = verner_pair();
        std::vector<double> a;
        for (const auto &row : pair.a)
            a.insert(a.end(), row.begin(), row.end());
        const Handle<ARKodeButcherTable, ARKodeButcherTable_Free> table(ARKodeButcherTable_Create(
            RungeKuttaPair::stages, pair.order, pair.embedded, pair.c.data(), a.data(),
            pair.b.data(), pair.embedded_b.data()));
        if (!table)
            throw linalg::SolverError("the integrator cannot start");
        // The estimate is the error of order 7, and the solution goes on with order 8: it is taken
        // as it is.
        require(ARKStepSetErrorBias(stepper.get(), 1.0));
        require(ARKStepSetTables(stepper.get(), pair.order, pair.embedded, nullptr, table.get()));
    }

    static int rates(double t, N_Vector y, N_Vector out, void *stated) {
        const auto &problem = *static_cast<const OdeProblem *>(stated);
        double *values = N_VGetArrayPointer(out);
        const double *x = N_VGetArrayPointer(y);
        const TurningAxes &axes = problem.axes;
        problem.rates(axes.speed == 0 ? t : 0, x, values);
        for (const int first : axes.first) // less i speed x, for these turn away
            for (int i = first; i < first + axes.count; ++i) {
                values[i] += axes.speed * x[i + axes.count];
                values[i + axes.count] -= axes.speed * x[i];
            }
        // A trial step that is far too long may overflow: it is repeated with a shorter one.
        const bool finite = std::all_of(values, values + problem.size,
                                        [](double value) { return std::isfinite(value); });
        return finite ? 0 : 1;
    }

    static int weights(N_Vector y, N_Vector out, void *stated) {
        const auto &problem = *static_cast<const OdeProblem *>(stated);
        double *values = N_VGetArrayPointer(out);
        problem.allowed_error(N_VGetArrayPointer(y), values);
        std::transform(values, values + problem.size, values,
                       [](double allowed) { return 1 / allowed; });
        return 0;
    }
};

OdeSolver::OdeSolver(OdeProblem problem, OdeMethod method)
    : _arkode(std::make_unique<Arkode>(std::move(problem), method)) {}

OdeSolver::~OdeSolver() = default;

void OdeSolver::start(double t, const double *y, double step) {
    _arkode->counts_before = counts();
    double *own = N_VGetArrayPointer(_arkode->y.get());
    std::copy(y, y + _arkode->problem.size, own);
    _arkode->problem.axes.turn(-_arkode->problem.axes.speed * t, own);
    _arkode->t = t;
    _arkode->create();
    if (step > 0)
        require(ARKStepSetInitStep(_arkode->stepper.get(), step));
}

double OdeSolver::step(double end) {
    void *memory = _arkode->stepper.get();
    double &t = _arkode->t;
    require(ARKStepSetStopTime(memory, end));
    require(ARKStepEvolve(memory, end, _arkode->y.get(), &t, ARK_ONE_STEP));
    double last = 0;
    require(ARKStepGetLastStep(memory, &last));
    // Ever shorter steps towards a moment at which the rates cease to be numbers.
    if (t < end && std::abs(last) < 16 * std::numeric_limits<double>::epsilon() * std::abs(t))
        throw linalg::SolverError("the steps become too short to go on");
    return t;
}

const double *OdeSolver::state() const {
    const double *y = N_VGetArrayPointer(_arkode->y.get());
    const TurningAxes &axes = _arkode->problem.axes;
    if (axes.speed == 0)
        return y;
    std::copy(y, y + _arkode->problem.size, _arkode->resting.begin());
    axes.turn(axes.speed * _arkode->t, _arkode->resting.data());
    return _arkode->resting.data();
}

double OdeSolver::next_step() const {
    double step = 0;
    require(ARKStepGetCurrentStep(_arkode->stepper.get(), &step));
    return step;
}

OdeCounts OdeSolver::counts() const {
    OdeCounts total = _arkode->counts_before;
    void *memory = _arkode->stepper.get();
    if (memory == nullptr)
        return total;
    long explicit_rates = 0;
    long implicit_rates = 0;
    long steps = 0;
    long failed = 0;
    require(ARKStepGetNumSteps(memory, &steps));
    require(ARKStepGetNumErrTestFails(memory, &failed));
    require(ARKStepGetNumRhsEvals(memory, &explicit_rates, &implicit_rates));
    total.steps += steps;
    total.failed += failed;
    total.rates += explicit_rates + implicit_rates;
    return total;
}

} // namespace whirl::simulation

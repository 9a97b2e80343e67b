#include "linalg/check.h"
#include "simulation/ode/ode_solver.h"
#include "simulation/ode/runge_kutta.h"

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

class Arkode : public OdeSolver {
  public:
    Arkode(OdeProblem problem, bool stiff) : OdeSolver(std::move(problem)), _stiff(stiff) {
        SUNContext context = nullptr;
        if (SUNContext_Create(nullptr, &context) != 0)
            throw linalg::SolverError("SUNDIALS: cannot start");
        _context.reset(context);
        const int size = this->problem().size;
        _y.reset(N_VNew_Serial(size, context));
        _y->ops->nvlinearcombination = linear_combination;
        if (stiff) {
            _jacobian.reset(SUNDenseMatrix(size, size, context));
            _linear.reset(SUNLinSol_Dense(_y.get(), _jacobian.get(), context));
        }
    }

    [[nodiscard]] double next_step() const override {
        double step = 0;
        require(ARKStepGetCurrentStep(_stepper.get(), &step));
        return step;
    }

    [[nodiscard]] OdeCounts counts() const override {
        OdeCounts total = _counts_before;
        if (!_stepper)
            return total;
        long explicit_rates = 0;
        long implicit_rates = 0;
        long steps = 0;
        long failed = 0;
        void *memory = _stepper.get();
        require(ARKStepGetNumSteps(memory, &steps));
        require(ARKStepGetNumErrTestFails(memory, &failed));
        require(ARKStepGetNumRhsEvals(memory, &explicit_rates, &implicit_rates));
        total.steps += steps;
        total.failed += failed;
        total.rates += explicit_rates + implicit_rates;
        return total;
    }

  protected:
    void start_in_axes(double t, const double *y, double step) override {
        _counts_before = counts();
        std::copy(y, y + problem().size, N_VGetArrayPointer(_y.get()));
        _t = t;
        create();
        if (step > 0)
            require(ARKStepSetInitStep(_stepper.get(), step));
    }

    double step_in_axes(double end) override {
        void *memory = _stepper.get();
        require(ARKStepSetStopTime(memory, end));
        require(ARKStepEvolve(memory, end, _y.get(), &_t, ARK_ONE_STEP));
        double last = 0;
        require(ARKStepGetLastStep(memory, &last));
        // Ever shorter steps towards a moment at which the rates cease to be numbers.
        if (_t < end && std::abs(last) < 16 * std::numeric_limits<double>::epsilon() * std::abs(_t))
            throw linalg::SolverError("the steps become too short to go on");
        return _t;
    }

    [[nodiscard]] const double *state_in_axes() const override {
        return N_VGetArrayPointer(_y.get());
    }

  private:
    bool _stiff;
    // In the order of their making; destroyed from the last to the first.
    Handle<SUNContext, free_context> _context = nullptr;
    Handle<N_Vector, N_VDestroy> _y = nullptr;
    Handle<SUNMatrix, SUNMatDestroy> _jacobian = nullptr;
    Handle<SUNLinearSolver, SUNLinSolFree> _linear = nullptr;
    Handle<void *, free_stepper> _stepper = nullptr;
    double _t = 0;
    OdeCounts _counts_before; ///< of what ran before the last start

    static int rates(double t, N_Vector y, N_Vector out, void *self) {
        const OdeProblem &problem = static_cast<Arkode *>(self)->problem();
        double *values = N_VGetArrayPointer(out);
        problem.rates_in_axes(t, N_VGetArrayPointer(y), values);
        // A trial step that is far too long may overflow: it is repeated with a shorter one.
        const bool finite = std::all_of(values, values + problem.size,
                                        [](double value) { return std::isfinite(value); });
        return finite ? 0 : 1;
    }

    static int weights(N_Vector y, N_Vector out, void *self) {
        const OdeProblem &problem = static_cast<Arkode *>(self)->problem();
        double *values = N_VGetArrayPointer(out);
        problem.allowed_error(N_VGetArrayPointer(y), values);
        for (int i = 0; i < problem.size; ++i)
            values[i] = 1 / values[i];
        return 0;
    }

    void create() {
        _stepper.reset(ARKStepCreate(_stiff ? nullptr : rates, _stiff ? rates : nullptr, _t,
                                     _y.get(), _context.get()));
        if (!_stepper)
            throw linalg::SolverError("the integrator cannot start");
        void *memory = _stepper.get();
        require(ARKStepSetErrHandlerFn(memory, silent, nullptr));
        require(ARKStepSetUserData(memory, this));
        require(ARKStepWFtolerances(memory, weights));
        require(ARKStepSetMaxNumSteps(memory, -1));
        require(ARKStepSetInterpolantType(memory, ARK_INTERP_LAGRANGE));
        if (!_stiff) {
            set_explicit_table();
            return;
        }
        require(ARKStepSetTableNum(memory, ARKODE_ARK548L2SA_DIRK_8_4_5, ARKODE_ERK_NONE));
        require(ARKStepSetLinearSolver(memory, _linear.get(), _jacobian.get()));
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
        require(ARKStepSetErrorBias(_stepper.get(), 1.0));
        require(ARKStepSetTables(_stepper.get(), pair.order, pair.embedded, nullptr, table.get()));
    }
};

} // namespace

std::unique_ptr<OdeSolver> arkode(OdeProblem problem, bool stiff) {
    return std::make_unique<Arkode>(std::move(problem), stiff);
}

} // namespace whirl::simulation

#include "modes/spectrum.h"

#include "assembly/planes.h"
#include "balancers/arrangement.h"
#include "linalg/check.h"
#include "model/errors.h"
#include "modes/degenerate.h"
#include "modes/following/continuation.h"
#include "modes/following/followed_modes.h"
#include "modes/form_matrices.h"
#include "modes/general_spectrum.h"
#include "modes/hill/series_basis.h"
#include "modes/orbits.h"
#include "modes/planar_damped.h"
#include "modes/reduced/few_shapes.h"
#include "modes/rotating_spectrum.h"
#include "modes/symmetric_spectrum.h"
#include "modes/turning/few_turning.h"
#include "modes/turning/turning_basis.h"
#include "modes/turning/turning_pencil.h"
#include "modes/zero_modes.h"
#include "results/formulation.h"
#include "results/whirl.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace whirl::modes {

namespace {

/// v of the problem: signed and real in the symmetric forms.
double real_value(const WhirlMode &mode, results::Form form, double speed) {
    const bool negative =
        form == results::Form::planar && (mode.whirl == results::Whirl::forward) != (speed >= 0);
    return negative ? -mode.eigenvalue.imag() : mode.eigenvalue.imag();
}

bool all_followed(const Spectrum &spectrum) {
    return std::all_of(spectrum.modes.begin(), spectrum.modes.end(),
                       [](const WhirlMode &mode) { return mode.followed >= 0; });
}

/// @param found  Modes of a form
template <class Modes> Spectrum spectrum_of(double speed, Modes found) {
    return {speed, std::move(found.modes), std::move(found.overdamped), std::move(found.growing),
            found.complete_radius};
}

} // namespace

struct SpectrumSolver::Data {
    assembly::Discretization d;
    results::Form form;
    bool tables; ///< bearings change with speed: assemble again at every speed
    Stations stations;
    std::unique_ptr<SymmetricSpectrum> symmetric;
    std::unique_ptr<PlanarDamped> planar_damped;
    std::unique_ptr<GeneralSpectrum> general;
    std::vector<balancers::BalancerElement> balancers;
    std::unique_ptr<RotatingSpectrum> rotating;
    std::optional<FewTurning::Range> turning_range; ///< asked for
    std::unique_ptr<FewTurning> turning;            ///< form rotating; none: the whole rotor
    std::unique_ptr<TurningPencil> pencil;          ///< form rotating
    std::unique_ptr<SpectrumSolver> on_few;         ///< the rotor on those shapes
    std::shared_ptr<const Eigen::MatrixXd> shapes;  ///< this rotor is one on these
    int refinement;
    std::unique_ptr<Continuation> following; ///< none before follow()
    std::unique_ptr<FewShapes> few;          ///< none: the whole rotor

    Data(const model::Rotor &rotor, results::Form which, int order, int parts, int harmonics,
         std::shared_ptr<const Eigen::MatrixXd> few_shapes = nullptr)
        : d(rotor, order, parts), form(which), tables(rotor.bearings_depend_on_speed()),
          stations(Stations::for_orbits(d)), shapes(std::move(few_shapes)), refinement(parts) {
        if (results::in_rotating_axes(form)) {
            balancers =
                balancers::balancer_elements(rotor, balancers::arrangement_at_balance(rotor));
            rotating = std::make_unique<RotatingSpectrum>(
                shapes ? RotatingSpectrum::rough(d, balancers, *shapes)
                       : RotatingSpectrum(d, 0, balancers,
                                          form == results::Form::hill ? harmonics : 0));
        }
    }

    /// Made when it is asked for first, as all below are.
    template <class Made, class... Arguments>
    static Made &made(std::unique_ptr<Made> &known, const Arguments &...arguments) {
        if (!known)
            known = std::make_unique<Made>(arguments...);
        return *known;
    }

    /// Form rotating: from now on by few shapes, where they do.
    void take_turning(FewTurning::Range range) {
        if (form != results::Form::rotating || tables ||
            (turning_range && turning_range->covers(range)))
            return;
        if (turning_range)
            range = {std::min(range.from, turning_range->from),
                     std::max(range.to, turning_range->to),
                     std::max(range.wanted, turning_range->wanted)};
        turning_range = range;
        on_few.reset();
        turning = FewTurning::of(d, balancers, *rotating, range);
    }

    const FormMatrices &matrices() {
        return few      ? few->matrices()
               : shapes ? made(_matrices, d, rotating->system())
                        : made(_matrices, d, form, balancers);
    }

    /// None where the matrices are not symmetric.
    const SymmetricProblem *symmetric_matrices() {
        if (!_symmetric_problem)
            _symmetric_problem = SymmetricProblem::of(d, form);
        return _symmetric_problem->get();
    }

  private:
    std::unique_ptr<FormMatrices> _matrices;
    std::optional<std::unique_ptr<SymmetricProblem>> _symmetric_problem;
};

SpectrumSolver::SpectrumSolver(const model::Rotor &rotor, results::Form form, int order,
                               int refinement, int harmonics)
    : _data(std::make_unique<Data>(rotor, form, order, refinement, harmonics)) {}

SpectrumSolver::SpectrumSolver(std::unique_ptr<Data> data) : _data(std::move(data)) {}

SpectrumSolver::~SpectrumSolver() = default;

const Eigen::MatrixXd *SpectrumSolver::shapes() const { return _data->shapes.get(); }

const SpectrumSolver *SpectrumSolver::on_few_shapes(double from, double to, int wanted) const {
    if (!_data->turning)
        return nullptr;
    _data->take_turning({std::min(from, to), std::max(from, to), wanted});
    if (_data->turning && !_data->on_few)
        _data->on_few.reset(new SpectrumSolver(std::make_unique<Data>(
            _data->d.rotor(), _data->form, _data->d.order(), _data->refinement, 0,
            std::make_shared<const Eigen::MatrixXd>(_data->turning->shapes()))));
    return _data->on_few.get();
}

const assembly::Discretization &SpectrumSolver::discretization() const { return _data->d; }
results::Form SpectrumSolver::form() const { return _data->form; }
int SpectrumSolver::unknowns() const { return _data->matrices().size(); }

Spectrum SpectrumSolver::symmetric(double speed, int wanted) const {
    Spectrum spectrum;
    const bool planar = _data->form == results::Form::planar;
    spectrum.modes = _data->tables
                         ? SymmetricSpectrum(_data->d, planar, speed).modes(speed, wanted)
                         : Data::made(_data->symmetric, _data->d, planar, 0.0).modes(speed, wanted);
    for (const WhirlMode &mode : spectrum.modes)
        spectrum.complete_radius = std::max(spectrum.complete_radius, mode.eigenvalue.imag());
    return spectrum;
}

GeneralSpectrum::Modes SpectrumSolver::planar_damped(double speed, int wanted) const {
    return _data->tables ? PlanarDamped(_data->d, speed).modes(speed, wanted)
                         : Data::made(_data->planar_damped, _data->d, 0.0).modes(speed, wanted);
}

GeneralSpectrum::Modes SpectrumSolver::general(double speed, int wanted, Errors errors) const {
    return _data->tables ? GeneralSpectrum(_data->d, speed).modes(speed, wanted, errors)
                         : Data::made(_data->general, _data->d, 0.0).modes(speed, wanted, errors);
}

Spectrum SpectrumSolver::damped(double speed, int wanted, Errors errors) const {
    if (_data->few)
        return spectrum_of(speed, _data->few->modes(speed, wanted));
    if (_data->following)
        if (const FollowedSpeed *followed = _data->following->at(speed, wanted))
            return spectrum_of(speed, modes_of(_data->following->problem(), *followed));
    return spectrum_of(speed, _data->form == results::Form::planar_damped
                                  ? planar_damped(speed, wanted)
                                  : general(speed, wanted, errors));
}

bool SpectrumSolver::take_few_shapes(int modes) {
    if (_data->form == results::Form::general && !_data->tables)
        _data->few = FewShapes::of(_data->d, modes);
    return _data->few != nullptr;
}

double SpectrumSolver::left_out(double speed, const WhirlMode &mode) const {
    return _data->few ? _data->few->left_out(speed, mode) : 0;
}

void SpectrumSolver::follow(const std::vector<double> &speeds, int wanted) const {
    constexpr std::size_t several = 8; // fewer cost less one by one
    if (_data->few)
        return;
    if (results::in_rotating_axes(_data->form)) {
        if (speeds.size() >= several || _data->turning_range) {
            const auto [from, to] = std::minmax_element(speeds.begin(), speeds.end());
            _data->take_turning({*from, *to, wanted});
        }
        return;
    }
    if (!_data->following) {
        const SymmetricProblem *problem = _data->symmetric_matrices();
        if (problem == nullptr)
            return;
        const auto start = [this](double speed, int modes) {
            return starting_pairs(_data->form == results::Form::planar_damped
                                      ? planar_damped(speed, modes)
                                      : general(speed, modes, Errors::of_right_vectors),
                                  _data->form);
        };
        _data->following = std::make_unique<Continuation>(*problem, _data->d, start);
    }
    _data->following->follow(speeds, wanted);
}

bool SpectrumSolver::follows() const { return _data->following != nullptr; }

std::vector<WhirlMode> SpectrumSolver::near(double speed,
                                            const std::vector<WhirlMode> &guesses) const {
    if (_data->form == results::Form::rotating && !_data->tables) {
        const RotatingSpectrum &rotating = *_data->rotating;
        return turning_modes_near(
            rotating, Data::made(_data->pencil, rotating.system(), support_scale(_data->d)), speed,
            guesses);
    }
    const SymmetricProblem *problem = _data->symmetric_matrices();
    return problem == nullptr ? std::vector<WhirlMode>() : modes_near(*problem, speed, guesses);
}

Spectrum SpectrumSolver::rotating(double speed, int wanted, Errors errors) const {
    if (_data->turning && speed != 0) {
        _data->take_turning({speed, speed, wanted});
        if (_data->turning)
            if (std::optional<RotatingSpectrum::Modes> found = _data->turning->modes(speed, wanted))
                return spectrum_of(speed, *std::move(found));
    }
    RotatingSpectrum::Modes found =
        _data->tables
            ? RotatingSpectrum(_data->d, speed, _data->balancers, _data->rotating->harmonics())
                  .modes(speed, wanted, errors)
            : _data->rotating->modes(speed, wanted, errors);
    return spectrum_of(speed, std::move(found));
}

void SpectrumSolver::classify(Spectrum &spectrum) const {
    // At speed each mode in rotating axes comes with its dominant whirl, which is circular.
    if (results::is_planar(_data->form) ||
        (results::in_rotating_axes(_data->form) && spectrum.speed != 0))
        return;
    separate_degenerate(*this, _data->stations, spectrum.modes);
    for (WhirlMode &mode : spectrum.modes) {
        auto [x, y] = _data->stations.deflections_of_both(mode.shape);
        if (_data->form == results::Form::hyperbolic)
            y *= std::complex<double>(0, 1);
        const OrbitSense sense = orbit_sense(x, y, _data->stations, spectrum.speed);
        mode.whirl = sense.whirl;
        mode.forward_fraction = sense.forward_fraction;
    }
}

Spectrum SpectrumSolver::at(double speed, int wanted, Errors errors) const {
    try {
        const results::Form form = _data->form;
        Spectrum spectrum = results::in_rotating_axes(form) ? rotating(speed, wanted, errors)
                            : form == results::Form::general || form == results::Form::planar_damped
                                ? damped(speed, wanted, errors)
                                : symmetric(speed, wanted);
        spectrum.speed = speed;
        for (WhirlMode &mode : spectrum.modes)
            mode.eigenvalue = determined_value(mode);
        std::stable_sort(spectrum.modes.begin(), spectrum.modes.end(),
                         [](const WhirlMode &a, const WhirlMode &b) {
                             return a.eigenvalue.imag() < b.eigenvalue.imag();
                         });
        // No more than asked for: what follows modes to other speeds asks for as many there.
        if (static_cast<int>(spectrum.modes.size()) > wanted)
            spectrum.modes.resize(static_cast<std::size_t>(wanted));
        classify(spectrum);
        return spectrum;
    } catch (const linalg::SolverError &) {
        throw model::AnalysisFailure(fmt::format(
            "the eigenvalues at {:.6g} rad/s could not be found: the eigensolver did not converge "
            "or missed some ({} unknowns, {} modes asked for, {} form)",
            speed, unknowns(), wanted, results::form_name(_data->form)));
    }
}

namespace {

/// Of modes whose shapes and values are real.
ModeBasis real_basis(const QuadraticAt &problem, const Spectrum &spectrum, results::Form form) {
    const auto count = std::ssize(spectrum.modes);
    Eigen::VectorXd values(count);
    Eigen::MatrixXd X(problem.M.rows(), count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const WhirlMode &mode = spectrum.modes[static_cast<std::size_t>(i)];
        values(i) = real_value(mode, form, spectrum.speed);
        X.col(i) = mode.shape.real();
    }
    ModeBasis out = basis_of(problem, values, X);
    for (Eigen::VectorXcd *rates : {&out.rate_below, &out.rate_above})
        for (Eigen::Index i = 0; i < count; ++i)
            (*rates)(i) = {0, values(i) < 0 ? -(*rates)(i).real() : (*rates)(i).real()};
    return out;
}

} // namespace

ModeBasis SpectrumSolver::basis(const Spectrum &spectrum) const {
    const results::Form form = _data->form;
    const auto count = std::ssize(spectrum.modes);
    const FollowedSpeed *followed =
        _data->following ? _data->following->known(spectrum.speed) : nullptr;
    if (followed != nullptr && all_followed(spectrum))
        return basis_of(_data->following->problem(), *followed, spectrum.modes);
    const Eigen::Index n = _data->matrices().size();
    const auto mode = [&spectrum](Eigen::Index i) -> const WhirlMode & {
        return spectrum.modes[static_cast<std::size_t>(i)];
    };
    if (form == results::Form::planar || form == results::Form::hyperbolic)
        return real_basis(_data->matrices().at(spectrum.speed), spectrum, form);
    if (form == results::Form::hill)
        return series_basis(_data->matrices().mass(), 2 * _data->d.planar_size(), spectrum);
    if (form == results::Form::rotating)
        return turning_basis(_data->matrices().at(spectrum.speed), spectrum,
                             _data->matrices().mirrored());
    const bool planar = form == results::Form::planar_damped;
    Eigen::VectorXcd values(count);
    Eigen::MatrixXcd X(n, count);
    for (Eigen::Index i = 0; i < count; ++i) {
        values(i) = planar ? mode(i).rotating_value : mode(i).eigenvalue;
        X.col(i) = _data->few ? _data->few->amplitudes(mode(i).shape) : mode(i).shape;
    }
    if (planar) {
        ModeBasis out = basis_of(_data->matrices().complex_at(spectrum.speed), values, X);
        for (Eigen::VectorXcd *rates : {&out.rate_below, &out.rate_above})
            for (Eigen::Index i = 0; i < count; ++i)
                if (values(i).imag() < 0)
                    (*rates)(i) = std::conj((*rates)(i));
        return out;
    }
    const QuadraticAt problem = _data->matrices().at(spectrum.speed);
    const bool known = std::ranges::all_of(
        spectrum.modes, [n](const WhirlMode &one) { return one.left.size() == n; });
    if (!known || _data->matrices().mirrored())
        return basis_of(problem, values, X, _data->matrices().mirrored());
    Eigen::MatrixXcd Y(n, count);
    for (Eigen::Index i = 0; i < count; ++i)
        Y.col(i) = mode(i).left;
    return basis_of(problem, values, X, Y);
}

QuadraticAt SpectrumSolver::problem_at(double speed) const { return _data->matrices().at(speed); }

Eigen::VectorXcd SpectrumSolver::planar_x(const WhirlMode &mode) const {
    if (_data->form == results::Form::planar)
        return mode.shape;
    if (_data->form == results::Form::planar_damped) // w exp(l t) with Im l < 0 is as seen by
        return mode.rotating_value.imag() < 0        // x = Re(conj(w) exp(conj(l) t))
                   ? Eigen::VectorXcd(mode.shape.conjugate())
                   : mode.shape;
    return assembly::Planes(mode.shape).x;
}

Eigen::VectorXcd SpectrumSolver::planar_y(const WhirlMode &mode) const {
    const std::complex<double> i(0, 1);
    if (_data->form == results::Form::planar) {
        // w exp(i s t): y(t) = Re(-i w exp(i s t)) for s > 0, Re(+i w exp(i |s| t)) for s < 0.
        // A forward mode turns with the spin; the planar form is used with both signs of it.
        return mode.whirl == results::Whirl::forward ? Eigen::VectorXcd(-i * mode.shape)
                                                     : Eigen::VectorXcd(i * mode.shape);
    }
    if (_data->form == results::Form::planar_damped)
        return mode.rotating_value.imag() < 0 ? Eigen::VectorXcd(i * mode.shape.conjugate())
                                              : Eigen::VectorXcd(-i * mode.shape);
    const Eigen::VectorXcd y = assembly::Planes(mode.shape).y;
    return _data->form == results::Form::hyperbolic ? Eigen::VectorXcd(i * y) : y;
}

Eigen::VectorXcd SpectrumSolver::x_at(const WhirlMode &mode, const Stations &stations) const {
    return stations.deflections(planar_x(mode));
}

Eigen::VectorXcd SpectrumSolver::y_at(const WhirlMode &mode, const Stations &stations) const {
    return stations.deflections(planar_y(mode));
}

} // namespace whirl::modes

#include "modes/spectrum.h"

#include "assembly/frequency_scales.h"
#include "assembly/planes.h"
#include "balancers/arrangement.h"
#include "linalg/check.h"
#include "model/errors.h"
#include "modes/form_matrices.h"
#include "modes/general_spectrum.h"
#include "modes/hill/floquet_shapes.h"
#include "modes/hill/floquet_spectrum.h"
#include "modes/hill/series_modes_near.h"
#include "modes/orbits.h"
#include "modes/planar_whirl.h"
#include "modes/refined_spectrum.h"
#include "modes/rotating/rotating_pencil.h"
#include "modes/rotating/rotating_reduced_rotor.h"
#include "modes/rotating_spectrum.h"
#include "modes/solver/data.h"
#include "modes/solver/degenerate.h"
#include "modes/symmetric_spectrum.h"
#include "results/formulation.h"
#include "results/whirl.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace whirl::modes {

SpectrumSolver::SpectrumSolver(const model::Rotor &rotor, results::Form form, int order,
                               int refinement, int harmonics)
    : _data(std::make_unique<Data>(rotor, form, order, refinement, harmonics)) {}

SpectrumSolver::SpectrumSolver(std::unique_ptr<Data> data) : _data(std::move(data)) {}

SpectrumSolver::~SpectrumSolver() = default;

const Eigen::MatrixXd *SpectrumSolver::shapes() const { return _data->shapes.get(); }

const SpectrumSolver *SpectrumSolver::reduced_for(double from, double to, int wanted) const {
    if (!_data->reduced_rotor)
        return nullptr;
    _data->use_reduced_rotor({std::min(from, to), std::max(from, to), wanted});
    if (_data->reduced_rotor && !_data->reduced_solver)
        _data->reduced_solver.reset(new SpectrumSolver(std::make_unique<Data>(
            _data->d.rotor(), _data->form, _data->d.order(), _data->refinement, 0,
            std::make_shared<const Eigen::MatrixXd>(_data->reduced_rotor->shapes()))));
    return _data->reduced_solver.get();
}

const assembly::Discretization &SpectrumSolver::discretization() const { return _data->d; }
results::Form SpectrumSolver::form() const { return _data->form; }

int SpectrumSolver::unknowns() const {
    if (_data->shapes || results::in_rotating_axes(_data->form))
        return _data->matrices().size();
    return _data->d.planar_size() * (results::is_planar(_data->form) ? 1 : 2);
}

Spectrum SpectrumSolver::symmetric(double speed, int wanted) const {
    Spectrum spectrum;
    const bool planar = _data->form == results::Form::planar;
    spectrum.modes = _data->at_speed(_data->symmetric, speed, planar).modes(speed, wanted);
    for (const WhirlMode &mode : spectrum.modes)
        spectrum.complete_radius = std::max(spectrum.complete_radius, mode.eigenvalue.imag());
    return spectrum;
}

void SpectrumSolver::expect(const std::vector<double> &speeds, int wanted) const {
    const bool planar = _data->form == results::Form::planar;
    if ((planar || _data->form == results::Form::hyperbolic) && !_data->tables)
        _data->at_speed(_data->symmetric, 0, planar).expect(static_cast<int>(speeds.size()));
    if (!refines() || speeds.empty())
        return;
    const int all = wanted + _data->most_zero_modes(speeds.front());
    if (_data->reduced_roots)
        _data->refined().expect_reduced(speeds, all);
    else
        _data->refined().expect(speeds, all);
}

bool SpectrumSolver::carries_over(bool follow) const {
    // Shapes are of all that has been asked for.
    return _data->form == results::Form::rotating && follow && !_data->tables;
}

void SpectrumSolver::take_all_unknowns() const { _data->all_unknowns = true; }

void SpectrumSolver::take_reduced_roots() const { _data->reduced_roots = true; }

double SpectrumSolver::left_out() const {
    return refines() && _data->reduced_roots ? _data->refined().left_out() : 0;
}

bool SpectrumSolver::refines() const {
    return !_data->all_unknowns &&
           (_data->form == results::Form::general || _data->form == results::Form::planar_damped);
}

Spectrum SpectrumSolver::damped(double speed, int wanted, Errors errors) const {
    const bool planar = _data->form == results::Form::planar_damped;
    if (refines()) {
        try {
            const bool reduced = _data->reduced_roots || errors == Errors::of_right_vectors;
            Spectrum found = reduced ? _data->refined().reduced_modes(speed, wanted)
                                     : _data->refined().modes(speed, wanted);
            return _data->planar_as_real() ? as_planar(std::move(found), speed) : found;
        } catch (const linalg::SolverError &) { // all unknowns decide
        }
    }
    Spectrum found = _data->at_speed(_data->general, speed).modes(speed, wanted, errors);
    return planar ? as_planar(std::move(found), speed) : found;
}

void SpectrumSolver::follow(const std::vector<double> &speeds, int wanted) const {
    constexpr std::size_t several = 8; // fewer cost less one by one
    if (!results::in_rotating_axes(_data->form) ||
        (speeds.size() < several && !_data->reduced_range))
        return;
    const auto [from, to] = std::minmax_element(speeds.begin(), speeds.end());
    _data->use_reduced_rotor({*from, *to, wanted});
}

std::unique_ptr<SpectrumSolver> SpectrumSolver::by_monodromy(double from, double to,
                                                             int wanted) const {
    const int harmonics = _data->rotating->harmonics();
    Data::made(_data->series, _data->d, _data->balancers);
    auto reduced = std::make_unique<Data>(
        _data->d.rotor(), _data->form, _data->d.order(), _data->refinement, harmonics,
        floquet_shapes(_data->d, _data->balancers, *_data->series, from, to, wanted));
    reduced->floquet = std::make_unique<FloquetSpectrum>(reduced->d, *reduced->rotating,
                                                         reduced->balancers, reduced->shapes);
    return std::unique_ptr<SpectrumSolver>(new SpectrumSolver(std::move(reduced)));
}

bool SpectrumSolver::by_matrix() const { return _data->floquet != nullptr; }

bool SpectrumSolver::by_matrix(double speed, int wanted) const {
    return by_matrix() && _data->floquet->resolves(speed, wanted);
}

double SpectrumSolver::slow() const { return by_matrix() ? _data->floquet->slow() : 0; }

std::vector<WhirlMode> SpectrumSolver::near(double speed,
                                            const std::vector<WhirlMode> &guesses) const {
    if (_data->form == results::Form::rotating && !_data->tables) {
        const RotatingSpectrum &rotating = *_data->rotating;
        return rotating_modes_near(
            rotating,
            Data::made(_data->pencil, _data->matrices(), assembly::support_scale(_data->d)), speed,
            guesses);
    }
    if (_data->form == results::Form::hill)
        return series_modes_near(*_data->rotating,
                                 Data::made(_data->series, _data->d, _data->balancers), speed,
                                 guesses);
    return refines() && !_data->planar_as_real() ? _data->refined().near(speed, guesses)
                                                 : std::vector<WhirlMode>();
}

Spectrum SpectrumSolver::rotating(double speed, int wanted, Errors errors) const {
    if (_data->reduced_rotor && speed != 0) {
        _data->use_reduced_rotor({speed, speed, wanted});
        if (_data->reduced_rotor)
            if (std::optional<Spectrum> found = _data->reduced_rotor->modes(speed, wanted))
                return *std::move(found);
    }
    if (_data->floquet)
        return _data->floquet->modes(speed, wanted);
    return _data->tables
               ? RotatingSpectrum(_data->d, speed, _data->balancers, _data->rotating->harmonics())
                     .modes(speed, wanted, errors)
               : _data->rotating->modes(speed, wanted, errors);
}

void SpectrumSolver::classify(Spectrum &spectrum) const {
    // At speed each mode in rotating axes comes with its dominant whirl, which is a
    // circle, or a straight line (fixed_frame_whirl.h).
    if (results::is_planar(_data->form) ||
        (results::in_rotating_axes(_data->form) && spectrum.speed != 0))
        return;
    const bool hyperbolic = _data->form == results::Form::hyperbolic;
    const auto deflections = [&](const WhirlMode &mode) {
        auto both = _data->stations.deflections_of_both(mode.shape);
        if (hyperbolic)
            both.second *= std::complex<double>(0, 1);
        return both;
    };
    separate_degenerate(deflections, _data->stations, hyperbolic, spectrum.modes);
    for (WhirlMode &mode : spectrum.modes) {
        const auto [x, y] = deflections(mode);
        const OrbitSense sense = orbit_sense(x, y, _data->stations, spectrum.speed);
        mode.whirl = sense.whirl;
        mode.forward_fraction = sense.forward_fraction;
        mode.plane = sense.plane;
    }
}

Spectrum SpectrumSolver::at(double speed, int wanted, Errors errors) const {
    try {
        const results::Form form = _data->form;
        const int all = wanted + _data->most_zero_modes(speed);
        Spectrum spectrum = results::in_rotating_axes(form) ? rotating(speed, wanted, errors)
                            : form == results::Form::general || form == results::Form::planar_damped
                                ? damped(speed, all, errors)
                                : symmetric(speed, all);
        spectrum.speed = speed;
        for (WhirlMode &mode : spectrum.modes)
            mode.eigenvalue = determined_value(mode);
        // No more than asked for, whatever the way they were found: what follows modes to other
        // speeds asks for as many there.
        spectrum.keep_lowest(wanted);
        classify(spectrum);
        return spectrum;
    } catch (const linalg::SolverError &) {
        throw model::AnalysisFailure(model::Sentence(
            "the eigenvalues at {} could not be found: the eigensolver did "
            "not converge or missed some ({} unknowns, {} modes asked for, "
            "{} form)",
            model::as::speed(speed), unknowns(), wanted, results::form_name(_data->form)));
    }
}

std::pair<Eigen::VectorXcd, Eigen::VectorXcd> SpectrumSolver::planes(const WhirlMode &mode) const {
    const std::complex<double> i(0, 1);
    const results::Form form = _data->form;
    if (!results::is_planar(form)) {
        assembly::Planes both(mode.shape);
        if (form == results::Form::hyperbolic)
            both.y *= i;
        return {both.x, both.y};
    }
    // w exp(i s t): y(t) = Re(-i w exp(i s t)) for s > 0, Re(+i w exp(i |s| t)) for s < 0. The real
    // w of the planar form is used with both signs of the spin, with which a forward mode turns;
    // w exp(l t) with Im l < 0 is as seen by x = Re(conj(w) exp(conj(l) t)).
    const bool positive = form == results::Form::planar ? mode.whirl == results::Whirl::forward
                                                        : mode.rotating_value.imag() >= 0;
    const Eigen::VectorXcd x = positive ? mode.shape : Eigen::VectorXcd(mode.shape.conjugate());
    return {x, (positive ? -i : i) * x};
}

QuadraticAt SpectrumSolver::problem_at(double speed) const { return _data->matrices().at(speed); }

} // namespace whirl::modes

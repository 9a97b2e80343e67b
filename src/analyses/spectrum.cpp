#include "analyses/spectrum.h"

#include "analyses/arrangement.h"
#include "analyses/degenerate.h"
#include "analyses/general_spectrum.h"
#include "analyses/orbits.h"
#include "analyses/rotating_spectrum.h"
#include "analyses/symmetric_spectrum.h"
#include "analyses/zero_modes.h"
#include "linalg/check.h"
#include "model/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::analyses {

namespace {

Eigen::MatrixXcd complex_product(const Eigen::SparseMatrix<double> &S, const Eigen::MatrixXcd &X) {
    Eigen::MatrixXcd out(X.rows(), X.cols());
    out.real() = S * X.real();
    out.imag() = S * X.imag();
    return out;
}

/// Scales both so that each left column has length 1 in the energy product.
template <class Dense> void normalise(Dense &left, Dense &right) {
    for (Eigen::Index i = 0; i < left.cols(); ++i) {
        const double energy = std::real(left.col(i).dot(right.col(i)));
        const double scale = energy > 0 ? 1 / std::sqrt(energy) : 0;
        left.col(i) *= scale;
        right.col(i) *= scale;
    }
}

} // namespace

struct SpectrumSolver::Data {
    assembly::Discretization d;
    Form form;
    bool tables; ///< bearings change with speed: assemble again at every speed
    Stations stations;
    std::unique_ptr<SymmetricSpectrum> symmetric;
    std::unique_ptr<GeneralSpectrum> general;
    std::vector<elements::BalancerElement> balancers;
    std::unique_ptr<RotatingSpectrum> rotating;
    Eigen::SparseMatrix<double> K, M; // of the energy product

    Data(const model::Rotor &rotor, Form which, int order, int refinement, int harmonics)
        : d(rotor, order, refinement), form(which), tables(rotor.bearings_depend_on_speed()),
          stations(Stations::for_orbits(d)) {
        if (in_rotating_axes(form)) {
            prepare_rotating(rotor, which == Form::hill ? harmonics : 0);
            return;
        }
        if (form == Form::general) {
            general = std::make_unique<GeneralSpectrum>(d, 0);
            const Eigen::SparseMatrix<double> full = general->system().K.view();
            K = (full + Eigen::SparseMatrix<double>(full.transpose())) / 2;
            M = general->system().M.view();
        } else {
            symmetric = std::make_unique<SymmetricSpectrum>(d, form == Form::planar, 0);
            K = symmetric->K().view();
            M = symmetric->M().view();
        }
        // Free rigid motions have no elastic energy; a share of the mass lets them be compared.
        if (zero_modes(d, form, 0, 0).eigenvalues > 0)
            K += std::pow(0.1 * elastic_scale(d), 2) * M;
    }

    /// Modes in rotating axes are handed on as seen from the fixed frame; the energy product is
    /// that of mass and stiffness there, with a share of the mass as stiffness for motions (of
    /// balls, or free ones) that have no elastic energy.
    void prepare_rotating(const model::Rotor &rotor, int harmonics) {
        balancers = balancer_elements(rotor, arrangement_at_balance(rotor));
        rotating = std::make_unique<RotatingSpectrum>(d, 0, balancers, harmonics);
        const Eigen::SparseMatrix<double> full = rotating->system().K.view();
        const Eigen::SparseMatrix<double> mass = rotating->system().M.view();
        M = (mass + Eigen::SparseMatrix<double>(mass.transpose())) / 2;
        K = (full + Eigen::SparseMatrix<double>(full.transpose())) / 2 +
            std::pow(0.1 * elastic_scale(d), 2) * M;
    }
};

SpectrumSolver::SpectrumSolver(const model::Rotor &rotor, Form form, int order, int refinement,
                               int harmonics)
    : _data(std::make_unique<Data>(rotor, form, order, refinement, harmonics)) {}

SpectrumSolver::~SpectrumSolver() = default;

const assembly::Discretization &SpectrumSolver::discretization() const { return _data->d; }
Form SpectrumSolver::form() const { return _data->form; }
int SpectrumSolver::unknowns() const { return static_cast<int>(_data->M.rows()); }

Spectrum SpectrumSolver::symmetric(double speed, int wanted) const {
    Spectrum spectrum;
    const bool planar = _data->form == Form::planar;
    spectrum.modes = _data->tables ? SymmetricSpectrum(_data->d, planar, speed).modes(speed, wanted)
                                   : _data->symmetric->modes(speed, wanted);
    for (const WhirlMode &mode : spectrum.modes)
        spectrum.complete_radius = std::max(spectrum.complete_radius, mode.eigenvalue.imag());
    return spectrum;
}

Spectrum SpectrumSolver::general(double speed, int wanted) const {
    GeneralSpectrum::Modes found = _data->tables
                                       ? GeneralSpectrum(_data->d, speed).modes(speed, wanted)
                                       : _data->general->modes(speed, wanted);
    return {speed, std::move(found.modes), std::move(found.overdamped), found.complete_radius};
}

Spectrum SpectrumSolver::rotating(double speed, int wanted) const {
    RotatingSpectrum::Modes found =
        _data->tables
            ? RotatingSpectrum(_data->d, speed, _data->balancers, _data->rotating->harmonics())
                  .modes(speed, wanted)
            : _data->rotating->modes(speed, wanted);
    return {speed, std::move(found.modes), std::move(found.overdamped), found.complete_radius};
}

void SpectrumSolver::classify(Spectrum &spectrum) const {
    // At speed each mode in rotating axes comes with its dominant whirl, which is circular.
    if (_data->form == Form::planar || (in_rotating_axes(_data->form) && spectrum.speed != 0))
        return;
    separate_degenerate(*this, _data->stations, spectrum.modes);
    for (WhirlMode &mode : spectrum.modes) {
        const OrbitSense sense =
            orbit_sense(x_at(mode, _data->stations), y_at(mode, _data->stations), spectrum.speed);
        mode.whirl = sense.whirl;
        mode.forward_fraction = sense.forward_fraction;
    }
}

Spectrum SpectrumSolver::at(double speed, int wanted) const {
    try {
        Spectrum spectrum = in_rotating_axes(_data->form)  ? rotating(speed, wanted)
                            : _data->form == Form::general ? general(speed, wanted)
                                                           : symmetric(speed, wanted);
        spectrum.speed = speed;
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
            speed, unknowns(), wanted, form_name(_data->form)));
    }
}

EnergyBasis SpectrumSolver::energy_basis(const std::vector<WhirlMode> &modes) const {
    const bool real = _data->form == Form::planar || _data->form == Form::hyperbolic;
    const bool planar = _data->form == Form::planar;
    const Eigen::Index n = _data->M.rows();
    const auto count = static_cast<Eigen::Index>(modes.size());
    EnergyBasis out;
    Eigen::MatrixXcd X(real ? 0 : n, count);
    Eigen::MatrixXd W(real ? n : 0, count);
    Eigen::VectorXcd rates(count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const WhirlMode &mode = modes[static_cast<std::size_t>(i)];
        const bool negative = planar && mode.whirl == Whirl::backward;
        rates(i) = real ? (negative ? -1.0 : 1.0) * mode.eigenvalue.imag() : mode.eigenvalue;
        if (real)
            W.col(i) = mode.shape.real();
        else
            X.col(i) = mode.shape;
    }
    if (real) {
        out.left.resize(2 * n, count);
        out.right.resize(2 * n, count);
        out.left << W, W * rates.real().asDiagonal();
        out.right << _data->K * W, (_data->M * W) * rates.real().asDiagonal();
        normalise(out.left, out.right);
    } else {
        const Eigen::MatrixXcd V = X * rates.asDiagonal();
        out.complex_left.resize(2 * n, count);
        out.complex_right.resize(2 * n, count);
        out.complex_left << X, V;
        out.complex_right << complex_product(_data->K, X), complex_product(_data->M, V);
        normalise(out.complex_left, out.complex_right);
    }
    return out;
}

Eigen::MatrixXd overlaps(const EnergyBasis &a, const EnergyBasis &b) {
    if (a.complex_left.size() == 0)
        return (a.left.transpose() * b.right).cwiseAbs2();
    return (a.complex_left.adjoint() * b.complex_right).cwiseAbs2();
}

Eigen::VectorXcd SpectrumSolver::x_at(const WhirlMode &mode, const Stations &stations) const {
    if (_data->form == Form::planar)
        return stations.deflections(mode.shape);
    const Eigen::Index n = mode.shape.size() / 2;
    return stations.deflections(mode.shape(Eigen::seqN(0, n, 2)));
}

Eigen::VectorXcd SpectrumSolver::y_at(const WhirlMode &mode, const Stations &stations) const {
    const std::complex<double> i(0, 1);
    if (_data->form == Form::planar) {
        // w exp(i s t): y(t) = Re(-i w exp(i s t)) for s > 0, Re(+i w exp(i |s| t)) for s < 0.
        // A forward mode turns with the spin; the planar form is used with both signs of it.
        const Eigen::VectorXcd w = stations.deflections(mode.shape);
        return mode.whirl == Whirl::forward ? Eigen::VectorXcd(-i * w) : Eigen::VectorXcd(i * w);
    }
    const Eigen::Index n = mode.shape.size() / 2;
    const Eigen::VectorXcd y = stations.deflections(mode.shape(Eigen::seqN(1, n, 2)));
    return _data->form == Form::hyperbolic ? Eigen::VectorXcd(i * y) : y;
}

} // namespace whirl::analyses

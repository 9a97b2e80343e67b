#include "analyses/spectrum.h"

#include "analyses/degenerate.h"
#include "analyses/general_spectrum.h"
#include "analyses/orbits.h"
#include "analyses/symmetric_spectrum.h"
#include "linalg/check.h"
#include "model/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::analyses {

namespace {

/// Points inside each span at which orbits are judged; fine meshes have enough nodes.
int inner_stations(const assembly::Discretization &d) {
    return d.shaft_mesh().spans.size() > 60 ? 0 : 3;
}

} // namespace

struct SpectrumSolver::Data {
    assembly::Discretization d;
    Form form;
    bool tables; ///< bearings change with speed: assemble again at every speed
    Stations stations;
    std::unique_ptr<SymmetricSpectrum> symmetric;
    std::unique_ptr<GeneralSpectrum> general;
    Eigen::SparseMatrix<double> K, M; // of the energy product

    Data(const model::Rotor &rotor, Form which, int order, int refinement)
        : d(rotor, order, refinement), form(which), tables(rotor.bearings_depend_on_speed()),
          stations(d, inner_stations(d)) {
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
    }
};

SpectrumSolver::SpectrumSolver(const model::Rotor &rotor, Form form, int order, int refinement)
    : _data(std::make_unique<Data>(rotor, form, order, refinement)) {}

SpectrumSolver::~SpectrumSolver() = default;

const assembly::Discretization &SpectrumSolver::discretization() const { return _data->d; }
Form SpectrumSolver::form() const { return _data->form; }
int SpectrumSolver::unknowns() const { return static_cast<int>(_data->M.rows()); }

Spectrum SpectrumSolver::symmetric(double speed, int wanted) const {
    Spectrum spectrum;
    const bool planar = _data->form == Form::planar;
    spectrum.modes = _data->tables
                         ? SymmetricSpectrum(_data->d, planar, speed).modes(speed, wanted)
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

void SpectrumSolver::classify(Spectrum &spectrum) const {
    if (_data->form == Form::planar)
        return;
    separate_degenerate(*this, _data->stations, spectrum.modes);
    for (WhirlMode &mode : spectrum.modes) {
        const OrbitSense sense = orbit_sense(x_at(mode, _data->stations),
                                             y_at(mode, _data->stations), spectrum.speed);
        mode.whirl = sense.whirl;
        mode.forward_fraction = sense.forward_fraction;
    }
}

Spectrum SpectrumSolver::at(double speed, int wanted) const {
    try {
        Spectrum spectrum = _data->form == Form::general ? general(speed, wanted)
                                                         : symmetric(speed, wanted);
        spectrum.speed = speed;
        std::stable_sort(spectrum.modes.begin(), spectrum.modes.end(),
                         [](const WhirlMode &a, const WhirlMode &b) {
                             return a.eigenvalue.imag() < b.eigenvalue.imag();
                         });
        classify(spectrum);
        return spectrum;
    } catch (const linalg::SolverError &) {
        throw model::AnalysisFailure(fmt::format(
            "the eigenvalues at {:.6g} rad/s could not be found: the eigensolver did not converge "
            "or missed some ({} unknowns, {} modes asked for, {} form)",
            speed, unknowns(), wanted, form_name(_data->form)));
    }
}

Eigen::MatrixXd SpectrumSolver::overlaps(const std::vector<WhirlMode> &a,
                                         const std::vector<WhirlMode> &b) const {
    const bool planar = _data->form == Form::planar;
    const auto rate = [planar](const WhirlMode &mode) {
        // Sign of the planar frequency; the symmetric forms have real shapes and frequencies.
        const bool negative = planar && mode.whirl == Whirl::backward;
        return negative ? std::conj(mode.eigenvalue) : mode.eigenvalue;
    };
    const auto gathered = [&](const std::vector<WhirlMode> &modes) {
        Eigen::MatrixXcd X(_data->M.rows(), static_cast<Eigen::Index>(modes.size()));
        for (std::size_t i = 0; i < modes.size(); ++i)
            X.col(static_cast<Eigen::Index>(i)) = modes[i].shape;
        return X;
    };
    const auto rates = [&](const std::vector<WhirlMode> &modes) {
        Eigen::VectorXcd r(static_cast<Eigen::Index>(modes.size()));
        for (std::size_t i = 0; i < modes.size(); ++i)
            r(static_cast<Eigen::Index>(i)) = rate(modes[i]);
        return r;
    };
    const Eigen::MatrixXcd A = gathered(a);
    const Eigen::MatrixXcd B = gathered(b);
    const Eigen::VectorXcd ra = rates(a);
    const Eigen::VectorXcd rb = rates(b);
    const auto times = [](const Eigen::SparseMatrix<double> &S, const Eigen::MatrixXcd &X) {
        Eigen::MatrixXcd out(X.rows(), X.cols());
        out.real() = S * X.real();
        out.imag() = S * X.imag();
        return out;
    };
    const Eigen::MatrixXcd KB = times(_data->K, B);
    const Eigen::MatrixXcd MB = times(_data->M, B) * rb.asDiagonal();
    const Eigen::MatrixXcd cross =
        A.adjoint() * KB + ra.conjugate().asDiagonal() * (A.adjoint() * MB);
    const auto norms = [&](const Eigen::MatrixXcd &X, const Eigen::VectorXcd &r) {
        const Eigen::MatrixXcd KX = times(_data->K, X);
        const Eigen::MatrixXcd MX = times(_data->M, X);
        Eigen::VectorXd n(X.cols());
        for (Eigen::Index i = 0; i < X.cols(); ++i)
            n(i) = X.col(i).dot(KX.col(i)).real() + std::norm(r(i)) * X.col(i).dot(MX.col(i)).real();
        return n;
    };
    const Eigen::VectorXd na = norms(A, ra);
    const Eigen::VectorXd nb = norms(B, rb);
    Eigen::MatrixXd out = cross.cwiseAbs2();
    for (Eigen::Index i = 0; i < out.rows(); ++i)
        for (Eigen::Index j = 0; j < out.cols(); ++j)
            out(i, j) = na(i) * nb(j) > 0 ? out(i, j) / (na(i) * nb(j)) : 0;
    return out;
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

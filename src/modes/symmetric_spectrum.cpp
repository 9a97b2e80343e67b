#include "modes/symmetric_spectrum.h"

#include "assembly/frequency_scales.h"
#include "assembly/system.h"
#include "linalg/check.h"
#include "linalg/shifted_pencil.h"
#include "model/errors.h"
#include "results/formulation.h"
#include "results/whirl.h"

#include <algorithm>
#include <cmath>

namespace whirl::modes {

SymmetricSpectrum::SymmetricSpectrum(const assembly::Discretization &discretization, bool planar,
                                     double bearing_speed)
    : _discretization(discretization), _planar(planar), _bearing_speed(bearing_speed) {
    if (planar) {
        assembly::PlanarSystem system = assembly::assemble_planar(discretization, bearing_speed);
        _M = std::move(system.M);
        _K = std::move(system.K);
        _S = std::move(system.G);
    } else {
        assembly::FixedSystem system = assembly::assemble_fixed(discretization, bearing_speed);
        _M = std::move(system.M);
        _K = std::move(system.K);
        const linalg::Matrix coupling = assembly::hyperbolic_coupling(discretization);
        _S = linalg::Matrix::sum(-1, coupling, 0, coupling);
    }
    const results::Form form = planar ? results::Form::planar : results::Form::hyperbolic;
    _supported = zero_modes(discretization, form, bearing_speed, 0).eigenvalues == 0;
    if (!_supported)
        return;
    try {
        _pencil = std::make_unique<linalg::DefinitePencil>(_K, _M, _S);
    } catch (const linalg::SolverError &) {
        throw model::AnalysisFailure("the stiffness matrix is not positive definite: the shaft "
                                     "buckles under its axial force, a bearing has negative "
                                     "stiffness, or stiffnesses differ by more than double "
                                     "precision holds; formulation = \"general\" finds all "
                                     "eigenvalues");
    }
}

WhirlMode SymmetricSpectrum::mode_of(double w, const Eigen::VectorXd &x, double speed) const {
    WhirlMode mode;
    mode.eigenvalue = {0, std::abs(w)};
    mode.shape = x.cast<std::complex<double>>();
    if (_planar) {
        const bool forward = (w >= 0) == (speed >= 0);
        mode.whirl = forward ? results::Whirl::forward : results::Whirl::backward;
        mode.forward_fraction = forward ? 1 : 0;
    }
    return mode;
}

std::vector<WhirlMode> SymmetricSpectrum::modes_of(const std::vector<linalg::RealPair> &pairs,
                                                   double speed) const {
    std::vector<WhirlMode> out;
    for (const linalg::RealPair &pair : pairs) {
        if (!_planar && pair.value < 0)
            continue;
        out.push_back(mode_of(pair.value, pair.vector, speed));
        out.back().residual = pair.residual;
        out.back().rounding = pair.rounding;
    }
    return out;
}

void SymmetricSpectrum::expect(int speeds) {
    if (_pencil)
        _pencil->expect(speeds);
}

std::vector<WhirlMode> SymmetricSpectrum::modes(double speed, int wanted) const {
    if (!_supported)
        return free_modes(speed, wanted);
    // In hyperbolic form every mode stands twice, as +w and -w.
    const int eigenvalues = std::min(2 * _M.size(), _planar ? wanted : 2 * wanted);
    return modes_of(_pencil->smallest(speed, eigenvalues), speed);
}

std::vector<WhirlMode> SymmetricSpectrum::free_modes(double speed, int wanted) const {
    const results::Form form = _planar ? results::Form::planar : results::Form::hyperbolic;
    const ZeroModes zeros = zero_modes(_discretization, form, _bearing_speed, speed);
    std::vector<WhirlMode> out = zeros.modes;
    // In real form every mode stands twice, as +w and -w.
    linalg::ShiftedOptions options;
    options.null_space = zeros.motions;
    options.s = speed;
    options.shift = 0.3 * assembly::elastic_scale(_discretization);
    options.wanted = std::min(2 * _M.size() - 1, (_planar ? wanted : 2 * wanted) + 2);
    std::vector<linalg::RealPair> pairs = linalg::solve_shifted(_K, _M, _S, options);
    const auto known = std::min(pairs.size(), static_cast<std::size_t>(zeros.eigenvalues));
    pairs.erase(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(known));
    const std::vector<WhirlMode> moving = modes_of(pairs, speed);
    out.insert(out.end(), moving.begin(), moving.end());
    return out;
}

} // namespace whirl::modes

#include "forced/response_error.h"

#include "mesh_error/safety.h"
#include "modes/orbits.h"

#include <algorithm>
#include <cmath>

namespace whirl::forced {

namespace {

constexpr int highest_order = 30; ///< one above the highest order of the case, 29

double share(double difference, double size) {
    return difference == 0 ? 0 : mesh_error::estimate_safety * difference / size;
}

double orbit_error(const Phasor &a, const Phasor &b) {
    const double size =
        std::max(modes::ellipse_of(a.x, a.y).major, modes::ellipse_of(b.x, b.y).major);
    return share(modes::ellipse_of(a.x - b.x, a.y - b.y).major, size);
}

} // namespace

FinerMesh finer_mesh(int order) {
    const int finer = mesh_error::finer_order(order);
    return {std::min(finer, highest_order), finer > highest_order ? 2 : 1};
}

double error_share(std::complex<double> coarse, std::complex<double> fine) {
    return share(std::abs(coarse - fine), std::max(std::abs(coarse), std::abs(fine)));
}

ResponseError::ResponseError(const assembly::Discretization &coarse, results::Form form,
                             const Drive &drive) {
    if (coarse.rigid())
        return;
    const FinerMesh finer = finer_mesh(coarse.order());
    _fine = std::make_unique<assembly::Discretization>(coarse.rotor(), finer.order, finer.parts);
    _motion.emplace(*_fine, form, drive);
}

void ResponseError::solve(double speed) {
    if (_motion)
        _motion->solve(speed);
}

double ResponseError::at_rest(double z, std::complex<double> coarse) {
    return _motion ? error_share(coarse, _motion->at_rest(_fine->deflection_at(z))) : 0;
}

double ResponseError::force_at_rest(int bearing, std::complex<double> coarse) {
    return _motion ? error_share(coarse, _motion->bearing_force_at_rest(bearing)) : 0;
}

double ResponseError::at(double z, const Phasor &coarse) const {
    return _motion ? orbit_error(coarse, _motion->at(z)) : 0;
}

double ResponseError::of_force(int bearing, const Phasor &coarse) const {
    return _motion ? orbit_error(coarse, _motion->bearing_force(bearing)) : 0;
}

double ResponseError::of_stretch(int bearing, const Phasor &coarse) const {
    return _motion ? orbit_error(coarse, _motion->stretch(bearing)) : 0;
}

std::array<double, 2> ResponseError::of_components(double z, const Phasor &coarse) const {
    if (!_motion)
        return {0, 0};
    const Phasor fine = _motion->at(z);
    return {error_share(coarse.x, fine.x), error_share(coarse.y, fine.y)};
}

double ResponseError::of_quantity(const Quantity &quantity, const Phasor &seen) const {
    return _motion ? orbit_error(seen, _motion->of(quantity)) : 0;
}

double ResponseError::of_probe(const model::Probe &probe, const Phasor &coarse) const {
    return _motion
               ? error_share(reading(coarse, probe.angle),
                             reading(_motion->motion(stretch_of_probe(*_fine, probe)), probe.angle))
               : 0;
}

} // namespace whirl::forced

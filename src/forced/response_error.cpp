#include "forced/response_error.h"

#include "forced/forced_motion.h"
#include "mesh_error/safety.h"
#include "modes/orbits.h"
#include "results/formulation.h"

#include <algorithm>
#include <cmath>

namespace whirl::forced {

namespace {

constexpr int highest_order = 30;

double share(double difference, double size) {
    return difference == 0 ? 0 : mesh_error::estimate_safety * difference / size;
}

double share(std::complex<double> a, std::complex<double> b) {
    return share(std::abs(a - b), std::max(std::abs(a), std::abs(b)));
}

double orbit_error(const Phasor &a, const Phasor &b) {
    const double size =
        std::max(modes::ellipse_of(a.x, a.y).major, modes::ellipse_of(b.x, b.y).major);
    return share(modes::ellipse_of(a.x - b.x, a.y - b.y).major, size);
}

} // namespace

ResponseError::ResponseError(const assembly::Discretization &coarse, results::Form form,
                             Drive drive) {
    if (coarse.rigid())
        return;
    const int order = mesh_error::finer_order(coarse.order());
    _fine = std::make_unique<assembly::Discretization>(
        coarse.rotor(), std::min(order, highest_order), order > highest_order ? 2 : 1);
    if (drive.weight() || !CondensedMotion::describes(*_fine))
        _whole = std::make_unique<ForcedMotion>(*_fine, form, drive);
    else
        _motion = std::make_unique<CondensedMotion>(*_fine, form);
}

void ResponseError::solve(double speed) {
    if (_motion)
        _motion->solve(speed);
    if (_whole)
        _whole->solve(speed);
}

Phasor ResponseError::finer_at(double z) const {
    return _whole ? _whole->motion(_fine->deflection_at(z))
                  : _motion->at_node(_fine->shaft_mesh().node_at(z));
}

Phasor ResponseError::finer_force(int bearing) const {
    return _whole ? _whole->bearing_force(bearing) : _motion->bearing_force(bearing);
}

Phasor ResponseError::finer_stretch(int bearing) const {
    return _whole ? _whole->motion(stretch_of_bearing(*_fine, bearing)) : _motion->stretch(bearing);
}

double ResponseError::at_rest(double z, std::complex<double> coarse) const {
    if (!_whole)
        return 0;
    return share(coarse, _whole->at_rest(_fine->deflection_at(z)));
}

double ResponseError::force_at_rest(int bearing, std::complex<double> coarse) const {
    if (!_whole)
        return 0;
    return share(coarse, _whole->bearing_force_at_rest(bearing));
}

double ResponseError::at(double z, const Phasor &coarse) const {
    return _fine ? orbit_error(coarse, finer_at(z)) : 0;
}

double ResponseError::of_force(int bearing, const Phasor &coarse) const {
    return _fine ? orbit_error(coarse, finer_force(bearing)) : 0;
}

double ResponseError::of_stretch(int bearing, const Phasor &coarse) const {
    return _fine ? orbit_error(coarse, finer_stretch(bearing)) : 0;
}

double ResponseError::of_probe(double z, double angle, const Phasor &coarse) const {
    if (!_fine)
        return 0;
    return share(reading(coarse, angle), reading(finer_at(z), angle));
}

} // namespace whirl::forced

#include "forced/station_motion.h"

namespace whirl::forced {

StationMotion::StationMotion(const assembly::Discretization &discretization, results::Form form,
                             const Drive &drive, double acceptable)
    : _discretization(discretization), _whole(discretization, form, drive),
      _acceptable(acceptable) {
    if (drive.imbalances() && CondensedMotion::describes(discretization))
        _condensed.emplace(discretization, form);
}

bool StationMotion::condensed(double speed) {
    if (!_condensed || !solves(*_condensed, speed))
        return false;
    _rounding = _condensed->rounding();
    return _rounding <= _acceptable;
}

void StationMotion::solve_whole() {
    _whole.solve(_speed);
    _by_whole = true;
    _rounding = _whole.rounding();
}

void StationMotion::solve(double speed) {
    _speed = speed;
    _by_whole = false;
    if (!condensed(speed))
        solve_whole();
}

const ForcedMotion &StationMotion::whole() {
    if (!_by_whole)
        solve_whole();
    return _whole;
}

Phasor StationMotion::at(double z) const {
    return _by_whole ? _whole.motion(_discretization.deflection_at(z))
                     : _condensed->at_node(_discretization.shaft_mesh().node_at(z));
}

Phasor StationMotion::stretch(int bearing) const {
    return _by_whole ? _whole.motion(stretch_of_bearing(_discretization, bearing))
                     : _condensed->stretch(bearing);
}

Phasor StationMotion::of(const Quantity &quantity) const {
    if (quantity.film)
        return stretch(*quantity.film);
    return quantity.bearing == Quantity::deflection ? quantity.seen(at(quantity.z))
                                                    : bearing_force(quantity.bearing);
}

Phasor StationMotion::bearing_force(int bearing) const {
    return _by_whole ? _whole.bearing_force(bearing) : _condensed->bearing_force(bearing);
}

} // namespace whirl::forced

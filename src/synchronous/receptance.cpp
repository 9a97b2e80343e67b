#include "synchronous/receptance.h"

#include "assembly/planes.h"
#include "linalg/dense/products.h"
#include "synchronous/parts.h"

#include <cmath>
#include <limits>

namespace whirl::synchronous {

ForwardReceptance::ForwardReceptance(const assembly::Discretization &rotor, results::Form form,
                                     const std::vector<assembly::Combination> &places)
    : _rotor(rotor), _planar(form == results::Form::planar) {
    _solver.emplace(turned_system(rotor, _planar, 0));
    const Eigen::MatrixXcd w =
        assembly::unit_loads(places, rotor.planar_size()).cast<std::complex<double>>();
    // f = Re[(1, -i) exp(i s t)]: a vector that turns with the rotor
    _places = _planar
                  ? w
                  : Eigen::MatrixXcd(std::sqrt(0.5) * assembly::in_pairs(w, -assembly::i_unit * w));
}

Eigen::MatrixXcd ForwardReceptance::motion(double speed, const Eigen::MatrixXcd &forces) {
    if (_rotor.rotor().bearings_depend_on_speed())
        _solver.emplace(turned_system(_rotor, _planar, speed));
    return _solver->solve(speed, forces);
}

Eigen::MatrixXcd ForwardReceptance::at(double speed) {
    return speed * speed * linalg::adjoint_times(_places, motion(speed, _places));
}

double ForwardReceptance::rounding(double speed, const Eigen::VectorXcd &s) {
    const Eigen::MatrixXcd u = motion(speed, linalg::times(_places, s));
    return speed * speed * std::numeric_limits<double>::epsilon() * _solver->absolute_form(u);
}

Eigen::MatrixXcd hermitian_part(const Eigen::MatrixXcd &R) { return (R + R.adjoint()) / 2; }

} // namespace whirl::synchronous

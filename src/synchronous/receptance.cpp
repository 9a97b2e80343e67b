#include "synchronous/receptance.h"

#include "assembly/planes.h"
#include "linalg/dense/products.h"
#include "synchronous/parts.h"

#include <cmath>
#include <limits>

namespace whirl::synchronous {

namespace {

/// Unit imbalances at the places as loads on the unknowns of a form, a column each.
Eigen::MatrixXcd loads_of(results::Form form, const Eigen::MatrixXd &planar,
                          Eigen::Index unknowns) {
    const Eigen::MatrixXcd w = planar.cast<std::complex<double>>();
    if (form == results::Form::planar)
        return w;
    if (!results::in_rotating_axes(form)) // f = Re[(1, -i) exp(i s t)] turns with the rotor
        return std::sqrt(0.5) * assembly::in_pairs(w, -assembly::i_unit * w);
    // Behind the constant terms those of a series: the imbalances do not act on them.
    Eigen::MatrixXcd loads = Eigen::MatrixXcd::Zero(unknowns, 2 * w.cols());
    for (Eigen::Index i = 0; i < w.rows(); ++i)
        for (Eigen::Index j = 0; j < w.cols(); ++j)
            loads(2 * i, 2 * j) = loads(2 * i + 1, 2 * j + 1) = w(i, j);
    return loads;
}

} // namespace

ForwardReceptance::ForwardReceptance(const assembly::Discretization &rotor, results::Form form,
                                     const std::vector<assembly::Combination> &places,
                                     int harmonics)
    : _rotor(rotor), _form(form), _harmonics(harmonics) {
    _solver.emplace(system(0));
    _places = loads_of(form, assembly::unit_loads(places, rotor.planar_size()), _solver->size());
}

linalg::HarmonicTerms ForwardReceptance::system(double bearing_speed) const {
    if (results::in_rotating_axes(_form))
        return steady_in_rotating_axes(_rotor, bearing_speed, _harmonics);
    return turned_system(_rotor, _form == results::Form::planar, bearing_speed);
}

std::vector<double> ForwardReceptance::table_speeds() const {
    return synchronous::table_speeds(_rotor.rotor());
}

Eigen::MatrixXcd ForwardReceptance::motion(double speed, const Eigen::MatrixXcd &forces) {
    if (_rotor.rotor().bearings_depend_on_speed())
        _solver.emplace(system(speed));
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

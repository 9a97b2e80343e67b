// The planes of a mode in the fixed frame, by the form of its unknowns.

#include "assembly/planes.h"
#include "modes/orbits.h"
#include "modes/spectrum.h"
#include "results/whirl.h"

namespace whirl::modes {

Eigen::VectorXcd SpectrumSolver::planar_x(const WhirlMode &mode) const {
    if (form() == results::Form::planar)
        return mode.shape;
    if (form() == results::Form::planar_damped) // w exp(l t) with Im l < 0 is as seen by
        return mode.rotating_value.imag() < 0   // x = Re(conj(w) exp(conj(l) t))
                   ? Eigen::VectorXcd(mode.shape.conjugate())
                   : mode.shape;
    return assembly::Planes(mode.shape).x;
}

Eigen::VectorXcd SpectrumSolver::planar_y(const WhirlMode &mode) const {
    const std::complex<double> i(0, 1);
    if (form() == results::Form::planar) {
        // w exp(i s t): y(t) = Re(-i w exp(i s t)) for s > 0, Re(+i w exp(i |s| t)) for s < 0.
        // A forward mode turns with the spin; the planar form is used with both signs of it.
        return mode.whirl == results::Whirl::forward ? Eigen::VectorXcd(-i * mode.shape)
                                                     : Eigen::VectorXcd(i * mode.shape);
    }
    if (form() == results::Form::planar_damped)
        return mode.rotating_value.imag() < 0 ? Eigen::VectorXcd(i * mode.shape.conjugate())
                                              : Eigen::VectorXcd(-i * mode.shape);
    const Eigen::VectorXcd y = assembly::Planes(mode.shape).y;
    return form() == results::Form::hyperbolic ? Eigen::VectorXcd(i * y) : y;
}

Eigen::VectorXcd SpectrumSolver::x_at(const WhirlMode &mode, const Stations &stations) const {
    return stations.deflections(planar_x(mode));
}

Eigen::VectorXcd SpectrumSolver::y_at(const WhirlMode &mode, const Stations &stations) const {
    return stations.deflections(planar_y(mode));
}

} // namespace whirl::modes

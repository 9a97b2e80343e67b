// Left and right vectors of the modes of a spectrum, by the form of its unknowns.

#include "modes/hill/series_basis.h"
#include "modes/solver/data.h"
#include "modes/spectrum.h"
#include "results/formulation.h"
#include "results/whirl.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace whirl::modes {

namespace {

using Complex = std::complex<double>;
using results::Form;

/// Of the matrices of the form: signed where these are symmetric, or as seen from the rotor.
Complex value_of(const WhirlMode &mode, Form form, double speed) {
    const double frequency = mode.eigenvalue.imag();
    switch (form) {
    case Form::planar:
        return (mode.whirl == results::Whirl::forward) == (speed >= 0) ? frequency : -frequency;
    case Form::hyperbolic:
        return frequency;
    case Form::general:
        return mode.eigenvalue;
    default:
        return mode.rotating_value;
    }
}

/// Change of the eigenvalue in the fixed frame from that of the value in rotating axes: the mode
/// whirls at the spin speed plus or minus what is seen from the rotor.
Complex seen_from_ground(const WhirlMode &mode, double speed, Complex rate) {
    if (speed == 0)
        return std::numeric_limits<double>::quiet_NaN(); // both whirls at once
    const bool positive = (mode.whirl == results::Whirl::forward) == (speed > 0);
    const double turn = positive ? mode.eigenvalue.imag() : -mode.eigenvalue.imag();
    const double turn_rate = 1 + (turn >= speed ? rate.imag() : -rate.imag());
    return {rate.real(), positive ? turn_rate : -turn_rate};
}

/// Change of the eigenvalue in the fixed frame, Im >= 0, from that of value_of.
Complex rate_of(const WhirlMode &mode, Form form, double speed, Complex rate) {
    const Complex value = value_of(mode, form, speed);
    switch (form) {
    case Form::planar:
    case Form::hyperbolic:
        return {0, value.real() < 0 ? -rate.real() : rate.real()};
    case Form::planar_damped:
        return value.imag() < 0 ? std::conj(rate) : rate;
    case Form::rotating:
        return seen_from_ground(mode, speed, rate);
    default:
        return rate;
    }
}

/// Left and right vectors over the unknowns of the matrices.
struct Vectors {
    Eigen::VectorXcd values;
    Eigen::MatrixXcd right, left;
    bool left_known = true;
};

/// Left vectors of the damped forms and of rotating axes.
Eigen::MatrixXcd left_in(Form form, const FormMatrices &matrices, double speed, const Vectors &of) {
    if (form == Form::planar_damped) // complex symmetric
        return of.right;
    // Modes that share a frequency at rest are turned among themselves, their left vectors not.
    if (matrices.mirrored() && (form == Form::general || !of.left_known))
        return mirrored_vectors(of.right);
    return of.left_known ? of.left : left_vectors(matrices.at(speed), of.values, of.right);
}

ModeBasis basis_in(Form form, const FormMatrices &matrices, double speed, const Vectors &of) {
    if (form == Form::planar_damped)
        return basis_of(matrices.complex_at(speed), of.values, of.right);
    if (form == Form::planar || form == Form::hyperbolic)
        return basis_of(matrices.at(speed), Eigen::VectorXd(of.values.real()),
                        Eigen::MatrixXd(of.right.real()));
    return basis_of(matrices.at(speed), of.values, of.right, left_in(form, matrices, speed, of));
}

} // namespace

ModeBasis SpectrumSolver::basis(const Spectrum &spectrum) const {
    const Form form = _data->form;
    if (form == Form::hill)
        return hill_basis(spectrum);
    const FormMatrices &matrices = _data->matrices();
    const Eigen::Index n = matrices.size();
    const auto count = std::ssize(spectrum.modes);
    Vectors of{Eigen::VectorXcd(count), Eigen::MatrixXcd(n, count), Eigen::MatrixXcd(n, count)};
    for (Eigen::Index i = 0; i < count; ++i) {
        const WhirlMode &mode = spectrum.modes[static_cast<std::size_t>(i)];
        of.values(i) = value_of(mode, form, spectrum.speed);
        of.right.col(i) = form == Form::rotating ? mode.rotating_vector : mode.shape;
        of.left_known = of.left_known && mode.left.size() == n;
        if (of.left_known)
            of.left.col(i) = mode.left;
    }
    std::optional<ModeBasis> reduced;
    if (refines() && !_data->planar_as_real())
        reduced = _data->refined().basis(spectrum.speed, of.values, of.right,
                                         left_in(form, matrices, spectrum.speed, of));
    ModeBasis out = reduced ? *std::move(reduced) : basis_in(form, matrices, spectrum.speed, of);
    if (form == Form::rotating) {
        out.aliases = {out.complex_right.conjugate()};
        out.ways_back = {0};
    }
    for (Eigen::VectorXcd *side : {&out.rate_below, &out.rate_above})
        for (Eigen::Index i = 0; i < count; ++i)
            (*side)(i) = rate_of(spectrum.modes[static_cast<std::size_t>(i)], form, spectrum.speed,
                                 (*side)(i));
    return out;
}

ModeBasis SpectrumSolver::hill_basis(const Spectrum &spectrum) const {
    const auto &shapes = _data->shapes;
    return series_basis(_data->matrices().mass(),
                        2 * (shapes ? shapes->cols() : _data->d.planar_size()),
                        _data->rotating->harmonics(), std::abs(spectrum.speed) <= slow(), spectrum);
}

} // namespace whirl::modes

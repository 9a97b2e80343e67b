#include "mesh_error/shape_residual.h"

#include "assembly/planar_part.h"
#include "elements/beam.h"
#include "results/formulation.h"
#include "results/whirl.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace whirl::mesh_error {

namespace {

using Complex = std::complex<double>;
constexpr Complex i_unit(0, 1);

/// The next function of either parity.
constexpr int further_orders = 2;

} // namespace

ShapeResidual::ShapeResidual(const assembly::Discretization &discretization, results::Form form)
    : _discretization(discretization), _form(form),
      _mass(assembly::planar_part(discretization, assembly::Term::mass)) {
    const assembly::Discretization &d = discretization;
    if (d.rigid())
        return;
    const int order = d.order();
    const int higher = order + further_orders;
    for (int span = 0; span < static_cast<int>(d.shaft_mesh().spans.size()); ++span) {
        const elements::Beam beam = elements::beam_of(
            d.rotor().shaft, d.shaft_mesh().spans[static_cast<std::size_t>(span)]);
        std::vector<int> own{0, 1, 2, 3};
        for (const int place : elements::internal_places(beam, order, higher))
            own.push_back(4 + place);
        std::vector<int> further;
        for (int i = 4; i < 4 + elements::internal_unknowns(higher); ++i)
            if (std::find(own.begin(), own.end(), i) == own.end())
                further.push_back(i);
        const elements::PlanarMatrices m = elements::beam_matrices(beam, higher);
        _elements.push_back({span, m.M(further, own), m.G(further, own),
                             (m.K + m.K_axial)(further, own), m.M(further, further),
                             m.G(further, further), (m.K + m.K_axial)(further, further)});
    }
}

Eigen::VectorXcd ShapeResidual::own_motion(int span, const Eigen::VectorXcd &plane) const {
    const std::vector<int> unknowns = _discretization.beam_unknowns(span);
    const int internal = elements::internal_unknowns(_discretization.order());
    Eigen::VectorXcd out = Eigen::VectorXcd::Zero(4 + internal);
    for (int end = 0; end < 2; ++end) {
        for (const auto &[unknown, value] : _discretization.deflection_at_node(span + end))
            out(2 * end) += value * plane(unknown);
        for (const auto &[unknown, value] : _discretization.slope_at_node(span + end))
            out(2 * end + 1) += value * plane(unknown);
    }
    for (int i = 0; i < internal; ++i)
        out(4 + i) = plane(unknowns[unknowns.size() - static_cast<std::size_t>(internal - i)]);
    return out;
}

/// Of w = x + i y, w(t) = w exp(rate t), or of x - i y with the speed reversed.
double ShapeResidual::energy(const Eigen::VectorXcd &plane, Complex rate, double speed) const {
    const Complex squared = rate * rate;
    const Complex coupling = -i_unit * rate * speed;
    double sum = 0;
    for (const Element &e : _elements) {
        const Eigen::VectorXcd u = own_motion(e.span, plane);
        const Eigen::VectorXcd residual =
            squared * (e.M * u) + coupling * (e.G * u) + Eigen::VectorXcd(e.K * u);
        const Eigen::MatrixXcd Q2 =
            squared * e.M2.cast<Complex>() + coupling * e.G2.cast<Complex>() + e.K2.cast<Complex>();
        sum += std::abs(residual.dot(Q2.partialPivLu().solve(residual)));
    }
    return sum;
}

double ShapeResidual::of(const modes::WhirlMode &mode, double speed) const {
    const double size = std::abs(mode.eigenvalue);
    if (_elements.empty() || size == 0)
        return 0;
    const auto kinetic = [&](const Eigen::VectorXcd &plane) {
        return size * size * std::abs(plane.dot(Eigen::VectorXcd(_mass * plane)));
    };
    if (_form == results::Form::planar) {
        const bool positive = (mode.whirl == results::Whirl::forward) == (speed >= 0);
        const Complex rate = i_unit * (positive ? size : -size);
        return energy(mode.shape, rate, speed) / kinetic(mode.shape);
    }
    if (_form == results::Form::planar_damped)
        return energy(mode.shape, mode.rotating_value, speed) / kinetic(mode.shape);
    const Eigen::Index n = _mass.rows();
    const Eigen::VectorXcd x = mode.shape(Eigen::seqN(0, n, 2));
    // In hyperbolic form y stands for -i y.
    const Eigen::VectorXcd y = (_form == results::Form::hyperbolic ? i_unit : Complex(1)) *
                               mode.shape(Eigen::seqN(1, n, 2));
    const Eigen::VectorXcd with = x + i_unit * y;
    const Eigen::VectorXcd against = x - i_unit * y;
    return (energy(with, mode.eigenvalue, speed) + energy(against, mode.eigenvalue, -speed)) /
           (kinetic(with) + kinetic(against));
}

} // namespace whirl::mesh_error

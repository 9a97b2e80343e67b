#include "mesh_error/shape_residual.h"

#include "assembly/planar_part.h"
#include "assembly/planes.h"
#include "elements/beam.h"
#include "results/formulation.h"
#include "results/whirl.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl::mesh_error {

namespace {

using Complex = std::complex<double>;
constexpr Complex i_unit(0, 1);

/// The next function of either parity.
constexpr int further_orders = 2;

/// A block on the unknowns of an element as rows over those of the shaft.
void add_rows(std::vector<Eigen::Triplet<double>> &entries, const Eigen::MatrixXd &block,
              const std::vector<assembly::Combination> &own, int first) {
    for (int row = 0; row < static_cast<int>(block.rows()); ++row)
        for (std::size_t j = 0; j < own.size(); ++j)
            for (const auto &[place, value] : own[j])
                entries.emplace_back(first + row, place,
                                     value * block(row, static_cast<Eigen::Index>(j)));
}

} // namespace

ShapeResidual::ShapeResidual(const assembly::Discretization &discretization, results::Form form)
    : _discretization(discretization), _form(form),
      _mass(assembly::planar_part(discretization, assembly::Term::mass)) {
    const assembly::Discretization &d = discretization;
    if (d.rigid())
        return;
    const int order = d.order();
    const int higher = order + further_orders;
    std::vector<Eigen::Triplet<double>> M;
    std::vector<Eigen::Triplet<double>> G;
    std::vector<Eigen::Triplet<double>> K;
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
        _further = static_cast<int>(further.size());
        add_rows(M, m.M(further, own), own_motion(span), _further * span);
        add_rows(G, m.G(further, own), own_motion(span), _further * span);
        add_rows(K, (m.K + m.K_axial)(further, own), own_motion(span), _further * span);
        Element e{m.M(further, further), m.G(further, further),
                  (m.K + m.K_axial)(further, further)};
        e.like_last = span > 0 && e.M2 == _elements.back().M2 && e.G2 == _elements.back().G2 &&
                      e.K2 == _elements.back().K2;
        _elements.push_back(std::move(e));
    }
    const auto rows = static_cast<Eigen::Index>(_elements.size()) * _further;
    for (auto &[matrix, entries] : {std::pair(&_M, &M), std::pair(&_G, &G), std::pair(&_K, &K)}) {
        matrix->resize(rows, d.planar_size());
        matrix->setFromTriplets(entries->begin(), entries->end());
    }
}

/// Unknowns of an element by those of the shaft.
std::vector<assembly::Combination> ShapeResidual::own_motion(int span) const {
    const std::vector<int> unknowns = _discretization.beam_unknowns(span);
    const auto internal =
        static_cast<std::size_t>(elements::internal_unknowns(_discretization.order()));
    std::vector<assembly::Combination> out;
    for (int end = 0; end < 2; ++end) {
        out.push_back(_discretization.deflection_at_node(span + end));
        out.push_back(_discretization.slope_at_node(span + end));
    }
    for (std::size_t i = unknowns.size() - internal; i < unknowns.size(); ++i)
        out.push_back({{unknowns[i], 1.0}});
    return out;
}

/// Of w = x + i y, w(t) = w exp(rate t), or of x - i y with the speed reversed.
double ShapeResidual::energy(const Eigen::VectorXcd &plane, Complex rate, double speed) const {
    const Complex squared = rate * rate;
    const Complex coupling = -i_unit * rate * speed;
    const Eigen::VectorXcd residual =
        squared * (_M * plane) + coupling * (_G * plane) + Eigen::VectorXcd(_K * plane);
    Eigen::PartialPivLU<Eigen::MatrixXcd> Q2;
    double sum = 0;
    for (std::size_t i = 0; i < _elements.size(); ++i) {
        const Element &e = _elements[i];
        if (!e.like_last)
            Q2.compute(squared * e.M2.cast<Complex>() + coupling * e.G2.cast<Complex>() +
                       e.K2.cast<Complex>());
        const Eigen::VectorXcd r =
            residual.segment(static_cast<Eigen::Index>(i) * _further, _further);
        sum += std::abs(r.dot(Q2.solve(r)));
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
    assembly::Planes planes(mode.shape.head(2 * _mass.rows())); // moving masses are none of them
    if (_form == results::Form::hyperbolic)                     // y stands for -i y
        planes.y *= i_unit;
    const Eigen::VectorXcd with = planes.towards();
    const Eigen::VectorXcd against = planes.against();
    return (energy(with, mode.eigenvalue, speed) + energy(against, mode.eigenvalue, -speed)) /
           (kinetic(with) + kinetic(against));
}

} // namespace whirl::mesh_error

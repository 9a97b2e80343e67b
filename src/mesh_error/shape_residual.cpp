#include "mesh_error/shape_residual.h"

#include "assembly/planar_part.h"
#include "elements/beam.h"
#include "results/formulation.h"
#include "results/whirl.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl::mesh_error {

namespace {

/// The next function of either parity.
constexpr int further_orders = 2;

/// Further functions of an element of order 1, the most: 2 * (1 + further_orders) - 1.
constexpr int most_further = 5;
using Block = Eigen::Matrix<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                            most_further, most_further>;

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

std::vector<ShapeResidual::Plane> ShapeResidual::planes_of(const At &at) const {
    const modes::WhirlMode &mode = *at.mode;
    const Eigen::Index n = _mass.rows();
    std::complex<double> rate = mode.eigenvalue;
    if (_form == results::Form::planar) {
        const bool positive = (mode.whirl == results::Whirl::forward) == (at.speed >= 0);
        rate = {0, positive ? std::abs(rate) : -std::abs(rate)};
    } else if (_form == results::Form::planar_damped)
        rate = mode.rotating_value;
    if (results::is_planar(_form))
        return {{mode.shape.head(n), rate, at.speed}};
    // Of w = x + i y; x - i y is as seen with the speed reversed. Moving masses are none of them.
    const auto planes = mode.shape.head(2 * n).reshaped(2, n);
    const bool turned = _form == results::Form::hyperbolic; // y stands for -i y
    const std::complex<double> factor = turned ? -1.0 : std::complex<double>(0, 1);
    const Eigen::VectorXcd x = planes.row(0).transpose();
    const Eigen::VectorXcd i_y = factor * planes.row(1).transpose();
    return {{x + i_y, rate, at.speed}, {x - i_y, rate, -at.speed}};
}

void ShapeResidual::add_energies(const Plane &plane, double &residual, double &kinetic) const {
    const std::complex<double> squared = plane.rate * plane.rate;
    const std::complex<double> coupling = -std::complex<double>(0, 1) * plane.rate * plane.speed;
    const Eigen::VectorXcd r = _K * plane.w + squared * (_M * plane.w) + coupling * (_G * plane.w);
    // Further functions vanish at the nodes and are far stiffer than the modes: no pivot comes near
    // zero.
    Eigen::PartialPivLU<Block> Q2;
    for (std::size_t i = 0; i < _elements.size(); ++i) {
        const Element &e = _elements[i];
        if (!e.like_last)
            Q2.compute(e.K2 + squared * e.M2 + coupling * e.G2);
        const auto own = r.segment(static_cast<Eigen::Index>(i) * _further, _further);
        residual += std::abs(own.dot(Q2.solve(own)));
    }
    kinetic += std::norm(plane.rate) * plane.w.dot(_mass * plane.w).real();
}

std::vector<double> ShapeResidual::of(const std::vector<At> &modes) const {
    std::vector<double> out(modes.size());
    if (_elements.empty())
        return out;
    for (std::size_t i = 0; i < modes.size(); ++i) {
        if (modes[i].mode->eigenvalue == 0.0)
            continue;
        double residual = 0;
        double kinetic = 0;
        for (const Plane &plane : planes_of(modes[i]))
            add_energies(plane, residual, kinetic);
        out[i] = residual / kinetic;
    }
    return out;
}

} // namespace whirl::mesh_error

#include "assembly/discretization.h"

#include "elements/beam.h"

namespace whirl::assembly {

Discretization::Discretization(const model::Rotor &rotor, int order, int refinement)
    : _rotor(rotor), _mesh(mesh::make_mesh(rotor, refinement)), _order(order),
      _internal(elements::internal_unknowns(order)) {
    const int last = static_cast<int>(_mesh.nodes.size()) - 1;
    _size = rigid() ? 2 : node_base(last) + 2;
    for (const model::Bearing &bearing : _rotor.bearings)
        _pedestals.push_back(bearing.pedestal ? _size++ : -1);
    for (const mesh::Span &span : _mesh.spans)
        _beams.push_back(elements::beam_matrices(elements::beam_of(_rotor.shaft, span), order));
}

std::vector<int> Discretization::beam_unknowns(int span) const {
    const int first = node_base(span);
    const int second = node_base(span + 1);
    std::vector<int> unknowns{first, first + 1, second, second + 1};
    for (int i = 0; i < _internal; ++i)
        unknowns.push_back(first + 2 + i);
    return unknowns;
}

Combination Discretization::deflection_at_node(int node) const {
    if (!rigid())
        return {{node_base(node), 1.0}};
    const double arm = _mesh.nodes[static_cast<std::size_t>(node)] - _rotor.shaft.length() / 2;
    return {{0, 1.0}, {1, arm}};
}

Combination Discretization::slope_at_node(int node) const {
    return {{rigid() ? 1 : node_base(node) + 1, 1.0}};
}

Combination Discretization::deflection_at(double z) const {
    return deflection_at_node(_mesh.node_at(z));
}

Combination Discretization::slope_at(double z) const { return slope_at_node(_mesh.node_at(z)); }

int Discretization::pedestal_unknown(int bearing) const {
    return _pedestals[static_cast<std::size_t>(bearing)];
}

Combination Discretization::deflection_inside(int span, double xi) const {
    const mesh::Span &s = _mesh.spans[static_cast<std::size_t>(span)];
    if (rigid())
        return {{0, 1.0}, {1, s.z + xi * s.length - _rotor.shaft.length() / 2}};
    const elements::ShapeValues values =
        elements::beam_shapes(elements::beam_of(_rotor.shaft, s), _order, xi);
    Combination out;
    const std::vector<int> unknowns = beam_unknowns(span);
    for (std::size_t i = 0; i < unknowns.size(); ++i)
        out.emplace_back(unknowns[i], values.w(static_cast<int>(i)));
    return out;
}

std::vector<double> Discretization::rigid_motion(bool tilt) const {
    std::vector<double> motion(static_cast<std::size_t>(_size), 0.0);
    const auto set = [&motion](int unknown, double value) {
        motion[static_cast<std::size_t>(unknown)] = value;
    };
    if (rigid()) {
        set(0, tilt ? _rotor.shaft.length() / 2 : 1);
        set(1, tilt ? 1 : 0);
    } else {
        for (std::size_t node = 0; node < _mesh.nodes.size(); ++node) {
            const int base = node_base(static_cast<int>(node));
            set(base, tilt ? _mesh.nodes[node] : 1);
            set(base + 1, tilt ? 1 : 0);
        }
    }
    for (std::size_t b = 0; b < _pedestals.size(); ++b)
        if (_pedestals[b] >= 0)
            set(_pedestals[b], tilt ? _rotor.bearings[b].z : 1);
    return motion;
}

} // namespace whirl::assembly

#include "assembly/discretization.h"

#include "elements/beam.h"
#include "linalg/dense/products.h"

#include <algorithm>

namespace whirl::assembly {

namespace {

/// A span is short below this share of the mean length of the spans: two digits of the others would
/// be lost under its stiffness.
constexpr double short_share = 1.0 / 64;
/// Longest row of nodes that depart one from another: the motion of the last one is that of all.
constexpr int longest_row = 16;

void add_to(Combination &sum, const Combination &terms, double factor) {
    for (const auto &[unknown, value] : terms) {
        const auto same = std::find_if(sum.begin(), sum.end(), [index = unknown](const auto &term) {
            return term.first == index;
        });
        if (same == sum.end())
            sum.emplace_back(unknown, factor * value);
        else
            same->second += factor * value;
    }
}

} // namespace

Discretization::Discretization(const model::Rotor &rotor, int order, int refinement)
    : _rotor(rotor), _mesh(mesh::make_mesh(rotor, refinement)), _order(order),
      _internal(elements::internal_unknowns(order)) {
    const int last = static_cast<int>(_mesh.nodes.size()) - 1;
    _size = rigid() ? 2 : node_base(last) + 2;
    for (const model::Bearing &bearing : _rotor.bearings)
        _pedestals.push_back(bearing.pedestal ? _size++ : -1);
    if (!rigid())
        make_motions();
    for (int span = 0; span < last; ++span) {
        const mesh::Span &geometry = _mesh.spans[static_cast<std::size_t>(span)];
        elements::PlanarMatrices beam =
            elements::beam_matrices(elements::beam_of(_rotor.shaft, geometry), order);
        _beams.push_back(rigid() ? std::move(beam) : over_unknowns(std::move(beam), span));
    }
}

void Discretization::make_motions() {
    const double mean = _rotor.shaft.length() / static_cast<double>(_mesh.spans.size());
    int row = 0;
    for (std::size_t node = 0; node < _mesh.nodes.size(); ++node) {
        const double h = node > 0 ? _mesh.spans[node - 1].length : mean;
        row = h < short_share * mean && row < longest_row ? row + 1 : 0;
        const int base = node_base(static_cast<int>(node));
        NodeMotion motion{{{base, 1.0}}, {{base + 1, 1.0}}};
        if (row > 0) {
            add_to(motion.deflection, _motions.back().deflection, 1);
            add_to(motion.deflection, _motions.back().slope, h);
            add_to(motion.slope, _motions.back().slope, 1);
        }
        _motions.push_back(std::move(motion));
        _relative.push_back(row > 0);
    }
}

/// Columns of T: beam_unknowns(span); rows: unknowns of the element. What a short span is strained
/// by is the departure of its second node alone: its stiffness is written down, not formed by
/// differences.
elements::PlanarMatrices Discretization::over_unknowns(elements::PlanarMatrices beam,
                                                       int span) const {
    const auto node = static_cast<std::size_t>(span);
    if (!_relative[node] && !_relative[node + 1])
        return beam;
    const std::vector<int> unknowns = beam_unknowns(span);
    const auto column = [&unknowns](int unknown) {
        return std::find(unknowns.begin(), unknowns.end(), unknown) - unknowns.begin();
    };
    Eigen::MatrixXd T =
        Eigen::MatrixXd::Zero(4 + _internal, static_cast<Eigen::Index>(unknowns.size()));
    for (int end = 0; end < 2; ++end) {
        for (const auto &[unknown, value] : deflection_at_node(span + end))
            T(2 * end, column(unknown)) = value;
        for (const auto &[unknown, value] : slope_at_node(span + end))
            T(2 * end + 1, column(unknown)) = value;
    }
    for (int i = 0; i < _internal; ++i)
        T(4 + i, column(node_base(span) + 2 + i)) = 1;
    Eigen::MatrixXd strained = T;
    if (_relative[node + 1])
        for (std::size_t i = 0; i < unknowns.size(); ++i)
            if (unknowns[i] < node_base(span) + 2 || // not internal: a motion of the first node
                (unknowns[i] >= node_base(span + 1) + 2))
                strained.col(static_cast<Eigen::Index>(i)).setZero();
    return {linalg::congruent(beam.M, T),
            linalg::congruent(beam.G, T),
            linalg::congruent(beam.K, strained),
            linalg::congruent(beam.K_axial, T),
            linalg::congruent(beam.K_bending, strained),
            beam.torque.size() > 0 ? linalg::congruent(beam.torque, T) : Eigen::MatrixXd()};
}

std::vector<int> Discretization::beam_unknowns(int span) const {
    std::vector<int> unknowns;
    for (int end = 0; end < 2; ++end)
        for (const Combination &motion :
             {deflection_at_node(span + end), slope_at_node(span + end)})
            for (const auto &[unknown, value] : motion)
                if (std::find(unknowns.begin(), unknowns.end(), unknown) == unknowns.end())
                    unknowns.push_back(unknown);
    for (int i = 0; i < _internal; ++i)
        unknowns.push_back(node_base(span) + 2 + i);
    return unknowns;
}

Combination Discretization::deflection_at_node(int node) const {
    if (!rigid())
        return _motions[static_cast<std::size_t>(node)].deflection;
    const double arm = _mesh.nodes[static_cast<std::size_t>(node)] - _rotor.shaft.length() / 2;
    return {{0, 1.0}, {1, arm}};
}

Combination Discretization::slope_at_node(int node) const {
    if (!rigid())
        return _motions[static_cast<std::size_t>(node)].slope;
    return {{1, 1.0}};
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
    for (int end = 0; end < 2; ++end) {
        add_to(out, deflection_at_node(span + end), values.w(2 * end));
        add_to(out, slope_at_node(span + end), values.w(2 * end + 1));
    }
    for (int i = 0; i < _internal; ++i)
        out.emplace_back(node_base(span) + 2 + i, values.w(4 + i));
    return out;
}

const ModalDamping &Discretization::modal_damping() const {
    if (!_modal_damping)
        _modal_damping = std::make_shared<const ModalDamping>(make_modal_damping(*this));
    return *_modal_damping;
}

std::vector<int> Discretization::places_in(const Discretization &finer) const {
    std::vector<int> places(static_cast<std::size_t>(_size));
    const auto set = [&places](int unknown, int place) {
        places[static_cast<std::size_t>(unknown)] = place;
    };
    const auto nodes = static_cast<int>(_mesh.nodes.size());
    for (int node = 0; node < nodes && !rigid(); ++node) {
        set(node_base(node), finer.node_base(node));
        set(node_base(node) + 1, finer.node_base(node) + 1);
        if (node + 1 == nodes)
            break;
        const std::vector<int> internal = elements::internal_places(
            elements::beam_of(_rotor.shaft, _mesh.spans[static_cast<std::size_t>(node)]), _order,
            finer._order);
        for (int i = 0; i < _internal; ++i)
            set(node_base(node) + 2 + i,
                finer.node_base(node) + 2 + internal[static_cast<std::size_t>(i)]);
    }
    for (int i = 0; i < 2 && rigid(); ++i)
        set(i, i);
    for (std::size_t b = 0; b < _pedestals.size(); ++b)
        if (_pedestals[b] >= 0)
            set(_pedestals[b], finer._pedestals[b]);
    return places;
}

Eigen::VectorXd Discretization::rigid_motion(bool tilt) const {
    Eigen::VectorXd motion = Eigen::VectorXd::Zero(_size);
    if (rigid()) {
        motion(0) = tilt ? _rotor.shaft.length() / 2 : 1;
        motion(1) = tilt ? 1 : 0;
    } else {
        for (std::size_t node = 0; node < _mesh.nodes.size(); ++node) {
            const int base = node_base(static_cast<int>(node));
            motion(base) = _relative[node] ? 0 : (tilt ? _mesh.nodes[node] : 1);
            motion(base + 1) = tilt && !_relative[node] ? 1 : 0;
        }
    }
    for (std::size_t b = 0; b < _pedestals.size(); ++b)
        if (_pedestals[b] >= 0)
            motion(_pedestals[b]) = tilt ? _rotor.bearings[b].z : 1;
    return motion;
}

Eigen::MatrixXd unit_loads(const std::vector<Combination> &quantities, Eigen::Index planar_size) {
    Eigen::MatrixXd loads =
        Eigen::MatrixXd::Zero(planar_size, static_cast<Eigen::Index>(quantities.size()));
    for (std::size_t i = 0; i < quantities.size(); ++i)
        for (const auto &[unknown, value] : quantities[i])
            loads(unknown, static_cast<Eigen::Index>(i)) += value;
    return loads;
}

} // namespace whirl::assembly

#pragma once

#include "assembly/modal_damping.h"
#include "elements/planar_matrices.h"
#include "mesh/shaft_mesh.h"

#include <memory>
#include <utility>
#include <vector>

namespace whirl::assembly {

/// A quantity as a combination of planar unknowns: sum of coefficient times unknown.
using Combination = std::vector<std::pair<int, double>>;

/// A rotor with its mesh, its planar unknowns and its shaft element matrices, which do not depend
/// on spin speed and are computed once.
///
/// Planar unknowns: at each node (w, phi), between nodes the internal unknowns of the element, at
/// the end one w for each pedestal. For a rigid shaft: w at the centre of the shaft and phi, then
/// the pedestals. In real form planar unknown i becomes 2 i (x) and 2 i + 1 (y).
///
/// A node at the end of a span far shorter than the mean (a disc beside a station) has the two
/// unknowns by which it departs from the rigid motion of the node before it: the large stiffness of
/// such a span then stands on their diagonal alone, and no digits of the others are lost under it.
class Discretization {
  public:
    /// @param order       of the shaft elements (1: classical)
    /// @param refinement  every element is split into that many
    Discretization(const model::Rotor &rotor, int order, int refinement = 1);

    [[nodiscard]] const model::Rotor &rotor() const { return _rotor; }
    [[nodiscard]] const mesh::ShaftMesh &shaft_mesh() const { return _mesh; }
    [[nodiscard]] int order() const { return _order; }
    [[nodiscard]] bool rigid() const { return _rotor.shaft.rigid; }
    [[nodiscard]] int planar_size() const { return _size; }

    /// Element matrices of span i over beam_unknowns(i) (rigid shaft: over the unknowns of the
    /// element, elements/beam.h).
    [[nodiscard]] const elements::PlanarMatrices &beam(int span) const {
        return _beams[static_cast<std::size_t>(span)];
    }
    /// Planar unknowns of span i, elastic shaft: those its nodes move with (w0, phi0, w1, phi1;
    /// more beside short spans), internal.
    [[nodiscard]] std::vector<int> beam_unknowns(int span) const;

    [[nodiscard]] Combination deflection_at_node(int node) const;
    [[nodiscard]] Combination slope_at_node(int node) const;
    [[nodiscard]] Combination deflection_at(double z) const;
    [[nodiscard]] Combination slope_at(double z) const;
    /// Deflection of the pedestal below a bearing that has one.
    [[nodiscard]] int pedestal_unknown(int bearing) const;
    /// Deflection and slope anywhere inside span i, xi in [0, 1].
    [[nodiscard]] Combination deflection_inside(int span, double xi) const;
    /// Rigid motion of all (translation: tilt = false; unit slope about z = 0: true) as unknowns.
    [[nodiscard]] Eigen::VectorXd rigid_motion(bool tilt) const;

    /// Made when it is asked for first; of a rotor with shaft.modal_damping.
    [[nodiscard]] const ModalDamping &modal_damping() const;

    /// Planar unknowns among those of a discretization of higher order on the same mesh, whose
    /// functions contain these.
    [[nodiscard]] std::vector<int> places_in(const Discretization &finer) const;

  private:
    model::Rotor _rotor;
    mesh::ShaftMesh _mesh;
    int _order;
    int _internal;
    int _size = 0;
    std::vector<int> _pedestals;
    std::vector<elements::PlanarMatrices> _beams;
    struct NodeMotion {
        Combination deflection, slope;
    };
    std::vector<NodeMotion> _motions; ///< of the nodes, elastic shaft
    mutable std::shared_ptr<const ModalDamping> _modal_damping;
    std::vector<bool> _relative; ///< the node departs from the rigid motion of the one before

    [[nodiscard]] int node_base(int node) const { return node * (2 + _internal); }
    void make_motions();
    [[nodiscard]] elements::PlanarMatrices over_unknowns(elements::PlanarMatrices beam,
                                                         int span) const;
};

/// Unit loads that work on these quantities, a column each, over the unknowns of one plane.
[[nodiscard]] Eigen::MatrixXd unit_loads(const std::vector<Combination> &quantities,
                                         Eigen::Index planar_size);

} // namespace whirl::assembly

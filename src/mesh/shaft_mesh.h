#pragma once

#include "model/rotor.h"

#include <vector>

namespace whirl::mesh {

/// A piece of shaft between two neighbouring nodes; diameters vary linearly along it.
struct Span {
    double z = 0;           ///< start, m
    double length = 0;      ///< m
    double outer_start = 0; ///< diameters, m
    double outer_end = 0;
    double inner_start = 0;
    double inner_end = 0;
    int segment = 0; ///< index of the segment of the shaft it belongs to
};

/// Nodes and spans of a shaft: span i lies between nodes i and i + 1.
struct ShaftMesh {
    std::vector<double> nodes; ///< z of the nodes, ascending, m
    std::vector<Span> spans;

    /// Index of the node at z (made there by make_mesh for everything attached), else the nearest.
    [[nodiscard]] int node_at(double z) const;
};

/// Nodes at all segment ends, at the ends of the elements of each segment, and wherever something
/// is attached; `refinement` splits every resulting span into that many equal ones.
[[nodiscard]] ShaftMesh make_mesh(const model::Rotor &rotor, int refinement = 1);

} // namespace whirl::mesh

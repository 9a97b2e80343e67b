#include "mesh/shaft_mesh.h"

#include <algorithm>
#include <cmath>

namespace whirl::mesh {

namespace {

std::vector<double> attachment_positions(const model::Rotor &rotor) {
    std::vector<double> positions;
    const auto collect = [&positions](const auto &items) {
        for (const auto &item : items)
            positions.push_back(item.z);
    };
    collect(rotor.discs);
    collect(rotor.bearings);
    collect(rotor.anisotropies);
    collect(rotor.balancers);
    collect(rotor.planes);
    collect(rotor.imbalances);
    collect(rotor.forces);
    collect(rotor.probes);
    collect(rotor.stations);
    return positions;
}

/// Element ends of one segment [start, end], with attachments inside it, ascending.
std::vector<double> segment_nodes(double start, double end, int elements,
                                  const std::vector<double> &attached, double merge) {
    std::vector<double> nodes;
    for (int i = 0; i <= elements; ++i)
        nodes.push_back(i == elements ? end : start + (end - start) * i / elements);
    for (const double z : attached) {
        const bool present =
            std::ranges::any_of(nodes, [&](double node) { return std::abs(node - z) <= merge; });
        if (z > start && z < end && !present)
            nodes.push_back(z);
    }
    std::ranges::sort(nodes);
    return nodes;
}

Span span_of(const model::Segment &segment, int index, double start, double z0, double z1) {
    const auto at = [&](double from, double to, double z) {
        return from + (to - from) * ((z - start) / segment.length);
    };
    return {z0,
            z1 - z0,
            at(segment.outer_start, segment.outer_end, z0),
            at(segment.outer_start, segment.outer_end, z1),
            at(segment.inner_start, segment.inner_end, z0),
            at(segment.inner_start, segment.inner_end, z1),
            index};
}

} // namespace

int ShaftMesh::node_at(double z) const {
    const auto after = std::ranges::lower_bound(nodes, z); // they ascend
    const auto k = after - nodes.begin();
    const bool before = after == nodes.end() || (k > 0 && z - *(after - 1) <= *after - z);
    return static_cast<int>(before ? k - 1 : k);
}

ShaftMesh make_mesh(const model::Rotor &rotor, int refinement) {
    const std::vector<double> attached = attachment_positions(rotor);
    const double merge = 1e-9 * rotor.shaft.length(); // input rounded to nine digits is one node
    ShaftMesh mesh;
    mesh.nodes.push_back(0);
    double start = 0;
    for (std::size_t s = 0; s < rotor.shaft.segments.size(); ++s) {
        const model::Segment &segment = rotor.shaft.segments[s];
        const std::vector<double> ends =
            segment_nodes(start, start + segment.length, segment.elements, attached, merge);
        for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
            for (int part = 0; part < refinement; ++part) {
                const double width = (ends[i + 1] - ends[i]) / refinement;
                const double z0 = ends[i] + part * width;
                const double z1 = part + 1 == refinement ? ends[i + 1] : z0 + width;
                mesh.spans.push_back(span_of(segment, static_cast<int>(s), start, z0, z1));
                mesh.nodes.push_back(z1);
            }
        }
        start += segment.length;
    }
    return mesh;
}

} // namespace whirl::mesh

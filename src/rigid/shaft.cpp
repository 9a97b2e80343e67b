#include "rigid/shaft.h"

#include "elements/quadrature.h"
#include "elements/section.h"
#include "mesh/shaft_mesh.h"

#include <cmath>
#include <map>

namespace whirl::rigid {

namespace {

bool uniform(const model::Segment &s) {
    return s.outer_start == s.outer_end && s.inner_start == s.inner_end;
}

bool has_layers_or_other_mass(const model::Segment &s) {
    return s.mass_outer > 0 || !s.layers.empty();
}

/// One section and material: the two are one segment.
bool continues(const model::Segment &a, const model::Segment &b) {
    return uniform(a) && uniform(b) && a.outer_start == b.outer_start &&
           a.inner_start == b.inner_start && a.material.E == b.material.E &&
           a.material.G == b.material.G && a.material.rho == b.material.rho &&
           a.asymmetry == b.asymmetry && a.asymmetry_angle == b.asymmetry_angle &&
           a.shear_coefficient == b.shear_coefficient && !has_layers_or_other_mass(a) &&
           !has_layers_or_other_mass(b);
}

model::Rotor joined_segments(model::Rotor rotor) {
    std::vector<model::Segment> joined;
    for (const model::Segment &segment : rotor.shaft.segments)
        if (!joined.empty() && continues(joined.back(), segment))
            joined.back().length += segment.length;
        else
            joined.push_back(segment);
    rotor.shaft.segments = joined;
    return rotor;
}

} // namespace

double bending_stiffness(const model::Rotor &rotor) {
    // EI of a cone has degree 4 in z: three Gauss points are exact.
    const elements::Quadrature &rule = elements::gauss_legendre(3);
    const mesh::ShaftMesh mesh = mesh::make_mesh(rotor);
    double integral = 0;
    for (const mesh::Span &span : mesh.spans) {
        const elements::Beam beam = elements::beam_of(rotor.shaft, span);
        for (std::size_t q = 0; q < rule.points.size(); ++q)
            integral += beam.at(rule.points[q]).EI * rule.weights[q] * span.length;
    }
    return 48 * integral / std::pow(rotor.shaft.length(), 4);
}

int element_count(const model::Rotor &rotor) {
    return static_cast<int>(mesh::make_mesh(rotor).spans.size());
}

std::vector<model::Rotor> meshes_to_coarsest(const model::Rotor &rotor, int most) {
    std::map<int, model::Rotor, std::greater<>> meshes; // by number of elements
    model::Rotor mesh = joined_segments(rotor);
    for (int elements = 1; elements <= most; elements *= 2) {
        for (model::Segment &segment : mesh.shaft.segments)
            segment.elements = elements;
        if (elements > 1 && element_count(mesh) > most)
            break;
        meshes.emplace(element_count(mesh), mesh);
    }
    if (element_count(rotor) <= most)
        meshes.emplace(element_count(rotor), rotor);
    std::vector<model::Rotor> out;
    for (const auto &[elements, coarser] : meshes)
        out.push_back(coarser);
    return out;
}

} // namespace whirl::rigid

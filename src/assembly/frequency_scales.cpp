#include "assembly/frequency_scales.h"

#include "elements/section.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace whirl::assembly {

double support_scale(const Discretization &d) {
    double stiffness = 0;
    for (const model::Bearing &bearing : d.rotor().bearings)
        stiffness += bearing.at(0).k.trace() / 2;
    double mass = 0;
    for (const mesh::Span &span : d.shaft_mesh().spans)
        mass += elements::beam_of(d.rotor().shaft, span).at(0.5).rhoA * span.length;
    for (const model::Disc &disc : d.rotor().discs)
        mass += disc.mass;
    const double scale = std::sqrt(std::max(stiffness, 0.0) / mass);
    // Rigid supports say nothing about a flexible rotor.
    const bool telling = scale > 0 && (d.rigid() || scale < elastic_scale(d));
    return telling ? scale : elastic_scale(d);
}

double elastic_scale(const Discretization &d) {
    double EI = 0;
    double mass = 0;
    for (const mesh::Span &span : d.shaft_mesh().spans) {
        const elements::Section mid = elements::beam_of(d.rotor().shaft, span).at(0.5);
        EI += mid.EI * span.length;
        mass += mid.rhoA * span.length;
    }
    for (const model::Disc &disc : d.rotor().discs)
        mass += disc.mass;
    const double L = d.rotor().shaft.length();
    return std::pow(std::numbers::pi / L, 2) * std::sqrt(EI / mass);
}

} // namespace whirl::assembly

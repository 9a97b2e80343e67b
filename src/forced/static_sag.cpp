#include "forced/static_sag.h"

#include "forced/forced_motion.h"
#include "forced/response_places.h"
#include "modes/free_motions.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace whirl::forced {

namespace {

/// Relative distance; none of two that are both nothing beside the scale.
double apart(std::complex<double> one, std::complex<double> other, double scale) {
    const double size = std::max(std::abs(one), std::abs(other));
    return size > 1e-14 * scale ? std::abs(one - other) / size : 0; // else it is rounding of zero
}

/// What rounding leaves of a direction in which nothing moves is nothing.
std::complex<double> without_rounding(std::complex<double> value) {
    const double least = 1e-14 * std::abs(value);
    return {std::abs(value.real()) > least ? value.real() : 0,
            std::abs(value.imag()) > least ? value.imag() : 0};
}

} // namespace

std::optional<results::StaticSag> static_sag(const assembly::Discretization &d, double gravity) {
    if (d.rotor().supports().empty() ||
        modes::free_motions(d, results::Form::general, 0, 0).motions.cols() > 0)
        return std::nullopt;
    const assembly::Discretization halved(d.rotor(), d.order(), 2);
    const results::Form form = form_under_weight(d.rotor());
    ForcedMotion motion(d, form, {gravity});
    ForcedMotion finer(halved, form, {gravity});
    motion.solve(0);
    finer.solve(0);
    results::StaticSag sag;
    sag.gravity = gravity;
    const double weight = gravity * weight_loads(d).cwiseAbs().sum();
    double deepest = 0;
    double steepest = 0;
    struct Pair {
        std::complex<double> here, finer;
    };
    std::vector<Pair> deflections;
    std::vector<Pair> slopes;
    for (const auto &[node, name] : attached_nodes(d)) {
        const double z = d.shaft_mesh().nodes[static_cast<std::size_t>(node)];
        deflections.push_back(
            {motion.at_rest(d.deflection_at_node(node)), finer.at_rest(halved.deflection_at(z))});
        slopes.push_back(
            {motion.at_rest(d.slope_at_node(node)), finer.at_rest(halved.slope_at(z))});
        deepest = std::max(deepest, std::abs(deflections.back().here));
        steepest = std::max(steepest, std::abs(slopes.back().here));
        const std::complex<double> u = without_rounding(deflections.back().here);
        const std::complex<double> phi = without_rounding(slopes.back().here);
        sag.stations.push_back({z, name, u.real(), u.imag(), phi.real(), phi.imag(), 0, 0});
    }
    const double rounding = motion.rounding() + finer.rounding();
    for (std::size_t i = 0; i < sag.stations.size(); ++i) {
        sag.stations[i].error =
            apart(deflections[i].here, deflections[i].finer, deepest) + rounding;
        sag.stations[i].slope_error = apart(slopes[i].here, slopes[i].finer, steepest) + rounding;
    }
    for (int i = 0; i < static_cast<int>(d.rotor().supports().size()); ++i) {
        const std::complex<double> force = without_rounding(motion.bearing_force_at_rest(i));
        const model::Bearing &bearing = d.rotor().bearings[static_cast<std::size_t>(i)];
        sag.bearings.push_back({bearing.z, bearing.name, -force.imag(), force.real(),
                                apart(force, finer.bearing_force_at_rest(i), weight) + rounding});
    }
    return sag;
}

} // namespace whirl::forced

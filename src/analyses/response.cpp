#include "analyses/response.h"

#include "analyses/discretization_error.h"
#include "analyses/forced_motion.h"
#include "analyses/orbits.h"
#include "analyses/speeds.h"
#include "linalg/check.h"
#include "model/errors.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <map>

namespace whirl::analyses {

namespace {

/// Above this relative error by rounding an amplitude is not worth its digits: only an undamped
/// resonance comes near it.
constexpr double rounding_to_report = 1e-3;

void refuse_what_is_missing(const model::Case &scene) {
    if (scene.rotor.imbalances.empty())
        throw model::BadInput(fmt::format("{}: imbalance: expected at least one [[imbalance]] to "
                                          "drive the response, got none",
                                          scene.file.string()));
}

/// Nodes of the mesh with the names of what is attached there; the ends are always among them.
std::map<int, std::string> attached_nodes(const assembly::Discretization &d) {
    std::map<int, std::string> nodes;
    const auto &mesh = d.shaft_mesh();
    nodes[0];
    nodes[static_cast<int>(mesh.nodes.size()) - 1];
    const auto collect = [&](const auto &items) {
        for (const auto &item : items) {
            std::string &name = nodes[mesh.node_at(item.z)];
            if (!item.name.empty())
                name += name.empty() ? item.name : ", " + item.name;
        }
    };
    const model::Rotor &rotor = d.rotor();
    collect(rotor.discs);
    collect(rotor.bearings);
    collect(rotor.imbalances);
    collect(rotor.balancers);
    collect(rotor.planes);
    return nodes;
}

/// Solves at one speed and lists amplitude, phase, major, minor of each node, then the force of
/// each bearing, then the rounding.
std::vector<double> response_row(const assembly::Discretization &d, ForcedMotion &forced,
                                 const std::map<int, std::string> &nodes, double speed) {
    try {
        forced.solve(speed);
    } catch (const linalg::SolverError &) {
        throw model::AnalysisFailure(
            fmt::format("no steady motion at {:.6g} rad/s: the rotor is at a resonance without "
                        "damping, or free to move under its imbalance",
                        speed));
    }
    std::vector<double> row;
    for (const auto &[node, name] : nodes) {
        const Phasor u = forced.motion(d.deflection_at_node(node));
        const Ellipse orbit = ellipse_of(u.x, u.y);
        row.insert(row.end(), {orbit.major, std::arg(u.x), orbit.major, orbit.minor});
    }
    const auto bearings = static_cast<int>(d.rotor().bearings.size());
    for (int bearing = 0; bearing < bearings; ++bearing) {
        const Phasor force = forced.bearing_force(bearing);
        row.push_back(ellipse_of(force.x, force.y).major);
    }
    row.push_back(forced.rounding());
    return row;
}

/// Empty lists with places and names.
void prepare_lists(ResponseResult &result, const assembly::Discretization &d,
                   const std::map<int, std::string> &nodes) {
    for (const auto &[node, name] : nodes)
        result.nodes.push_back(
            {d.shaft_mesh().nodes[static_cast<std::size_t>(node)], name, {}, {}, {}, {}});
    for (const model::Bearing &bearing : d.rotor().bearings)
        result.bearings.push_back({bearing.z, bearing.name, {}});
}

void append_row(ResponseResult &result, const std::vector<double> &row) {
    auto next = row.begin();
    for (ResponseNode &node : result.nodes)
        for (auto *list : {&node.amplitude, &node.phase, &node.major, &node.minor})
            list->push_back(*next++);
    for (ResponseBearing &bearing : result.bearings)
        bearing.force.push_back(*next++);
}

void note_resonances(ResponseResult &result, const std::vector<std::vector<double>> &rows) {
    std::string speeds;
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (rows[i].back() > rounding_to_report)
            speeds += fmt::format("{}{:.6g}", speeds.empty() ? "" : ", ", result.speeds[i]);
    if (!speeds.empty())
        result.model.notes.push_back(
            fmt::format("resonance without damping at {} rad/s: the amplitudes there have no "
                        "limit, and the numbers are decided by rounding",
                        speeds));
}

} // namespace

Formulation response_formulation(const model::Case &scene) {
    model::Case without = scene; // the response leaves balancers out
    without.rotor.balancers.clear();
    if (without.rotor.rotating_anisotropy() || scene.formulation == model::FormChoice::rotating) {
        const Formulation formulation = choose_formulation(without);
        if (formulation.form == Form::hill)
            throw model::AnalysisFailure(
                "the response of an asymmetric rotor on bearings that differ between their "
                "directions has many frequencies and is not computed; use bearings that are the "
                "same from every direction, or remove the asymmetry");
        return formulation;
    }
    const bool isotropic = scene.rotor.bearings_isotropic();
    if (scene.formulation == model::FormChoice::planar && !isotropic)
        throw model::BadInput("formulation: expected one that can describe the scene, got "
                              "\"planar\": a bearing differs between x and y or couples them");
    if (scene.formulation == model::FormChoice::planar)
        return {Form::planar, "asked for by the case"};
    if (scene.formulation != model::FormChoice::automatic)
        return {Form::general, "asked for by the case: forced motion in x and y"};
    if (isotropic)
        return {Form::planar, "isotropic bearings, axisymmetric rotor: the motion is circular and "
                              "w = x + i y halves the unknowns"};
    return {Form::general, "a bearing differs between x and y or couples them: forced motion in "
                           "x and y"};
}

ResponseResult unbalance_response(const model::Case &scene) {
    const auto start = std::chrono::steady_clock::now();
    refuse_what_is_missing(scene);
    const std::vector<double> speeds = required_speeds(scene).values();
    ResponseResult result;
    result.model.formulation = response_formulation(scene);
    model::Case free_choice = scene; // the order is judged by frequencies, in their best form
    free_choice.rotor.balancers.clear();
    free_choice.formulation = model::FormChoice::automatic;
    result.model.order = resolve_order(free_choice, choose_formulation(free_choice));
    const assembly::Discretization d(scene.rotor, result.model.order);
    ForcedMotion forced(d, result.model.formulation.form);
    const std::map<int, std::string> nodes = attached_nodes(d);
    const std::vector<std::vector<double>> rows =
        rows_at(speeds, [&](double speed) { return response_row(d, forced, nodes, speed); });
    if (rows.empty())
        return {};
    result.model.elements = static_cast<int>(d.shaft_mesh().spans.size());
    result.model.unknowns = forced.unknowns();
    result.speeds = speeds;
    prepare_lists(result, d, nodes);
    for (const std::vector<double> &row : rows)
        append_row(result, row);
    note_resonances(result, rows);
    if (!scene.rotor.balancers.empty())
        result.model.notes.emplace_back("the response is that of the rotor without its balancers");
    result.model.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

} // namespace whirl::analyses

#include "input/validate.h"

#include "input/size.h"

#include "balancers/kind.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace whirl::input {
namespace {

/// Moves a position onto the shaft that misses an end by rounding only, refuses others.
void check_position(double &z, const std::string &path, double length, const Check &check) {
    const double margin = 1e-9 * length;
    if (z < -margin || z > length + margin)
        check.fail(path, fmt::format("expected a place on the shaft, 0 to {} m, got {}",
                                     digits_apart(length, z),
                                     as_written(find_path(check.tree, path), z, "m", length)));
    else if (!std::isnan(z))
        z = std::clamp(z, 0.0, length);
}

template <class Items>
void check_positions(Items &items, const std::string &section, double length, const Check &check) {
    for (std::size_t i = 0; i < items.size(); ++i)
        check_position(items[i].z, fmt::format("{}[{}].z", section, i), length, check);
}

void check_disc(const model::Disc &disc, const std::string &path, const Check &check) {
    // Ip = 2 Id for an infinitely thin disc; published inertias are rounded.
    constexpr double tolerance = 1e-6;
    if (disc.Id < disc.Ip / 2 * (1 - tolerance))
        check.fail(path + ".Id",
                   fmt::format("expected at least Ip/2 = {} kg m2 for a rigid disc, got {} kg m2",
                               digits_apart(disc.Ip / 2, disc.Id),
                               digits_apart(disc.Id, disc.Ip / 2)));
    if (disc.mass == 0 && (disc.Id > 0 || disc.Ip > 0))
        check.fail(path + ".mass",
                   "expected a mass in kg greater than 0 where Id or Ip is given, got 0");
    // Each size may be finite and the product of density and volume not.
    if (std::isinf(disc.mass) || std::isinf(disc.Id) || std::isinf(disc.Ip))
        check.fail(path, "expected a finite mass and finite inertias, got an overflow");
}

/// One list of angles for each balancer, one angle for each ball.
void check_ball_angles(const model::Case &scene, const std::vector<std::vector<double>> &angles,
                       const std::string &path, const Check &check) {
    const auto &rotor_balancers = scene.rotor.balancers;
    if (angles.empty())
        return;
    if (angles.size() != rotor_balancers.size()) {
        check.fail(path, fmt::format("expected {} lists, one for each balancer, got {}",
                                     rotor_balancers.size(), angles.size()));
        return;
    }
    for (std::size_t i = 0; i < angles.size(); ++i) {
        const auto kind = balancers::kind_of(rotor_balancers[i]);
        const bool masses = !kind->circled().empty();
        if (angles[i].size() != kind->start_angles())
            check.fail(fmt::format("{}[{}]", path, i),
                       fmt::format("expected {} angles, one for each {}, got {}",
                                   kind->start_angles(),
                                   masses ? kind->name() : "pair of tied " + kind->parts(),
                                   angles[i].size()));
    }
}

/// Modes at rest say something of the damping at speed where the bearings stay as they are and both
/// planes have modes of their own.
void check_modal_damping(const model::Rotor &rotor, const Check &check) {
    if (rotor.shaft.modal_damping.empty())
        return;
    const char *path = "shaft.modal_damping";
    const bool coupled = !rotor.bearings_orthotropic();
    if (rotor.bearings_depend_on_speed())
        check.fail(path, "expected bearings that are the same at every speed, got a bearing table: "
                         "its modes at rest are not those at speed");
    else if (coupled)
        check.fail(path, "expected bearings that do not couple x and y, whose modes at rest are "
                         "those of one plane, got one that does");
    const bool held = std::ranges::any_of(rotor.balancers, &model::Balancer::held);
    if (rotor.shaft.asymmetric() || !rotor.anisotropies.empty() || held)
        check.fail(path, "expected an axisymmetric rotor, got [[anisotropy]], an asymmetric "
                         "segment or a balancer with held = true: its modes at rest turn with it");
}

} // namespace

void validate(model::Case &scene, const Check &check) {
    model::Rotor &rotor = scene.rotor;
    const double length = rotor.shaft.length();
    if (std::isinf(length))
        check.fail("shaft", "expected segments of finite length together, got an overflow");
    // Without a sound shaft there are no places on it to compare with.
    if (length > 0) {
        check_positions(rotor.discs, "disc", length, check);
        const auto bearings = std::span(rotor.bearings).first(rotor.supports().size());
        const auto seals = std::span(rotor.bearings).subspan(bearings.size());
        check_positions(bearings, "bearing", length, check);
        check_positions(seals, "seal", length, check);
        check_positions(rotor.anisotropies, "anisotropy", length, check);
        check_positions(rotor.balancers, "balancer", length, check);
        check_positions(rotor.planes, "plane", length, check);
        check_positions(rotor.imbalances, "imbalance", length, check);
        check_positions(rotor.forces, "force", length, check);
        check_positions(rotor.probes, "probe", length, check);
        for (std::size_t i = 0; i < scene.response.receptances.size(); ++i) {
            model::Receptance &asked = scene.response.receptances[i];
            // A single one may stand without a list around it.
            const std::string path = find_path(check.tree, "response.receptance.from")
                                         ? "response.receptance"
                                         : fmt::format("response.receptance[{}]", i);
            check_position(asked.from, path + ".from", length, check);
            check_position(asked.to, path + ".to", length, check);
        }
        check_positions(scene.simulate.imbalances, "simulate.imbalance", length, check);
        check_positions(scene.simulate.forces, "simulate.force", length, check);
        if (scene.weights)
            for (std::size_t i = 0; i < scene.weights->stations.size(); ++i)
                check_position(scene.weights->stations[i], fmt::format("weights.stations[{}]", i),
                               length, check);
        if (scene.level1)
            check_position(scene.level1->z, "level1.z", length, check);
    }
    for (std::size_t i = 0; i < rotor.discs.size(); ++i)
        check_disc(rotor.discs[i], fmt::format("disc[{}]", i), check);
    check_counts(scene, check);
    check_modal_damping(rotor, check);
    check_anisotropies(rotor, check);
    check_ball_positions(scene, check);
    check_ball_angles(scene, scene.simulate.ball_angles, "simulate.ball_angles", check);
    for (std::size_t i = 0; i < scene.simulate.other_starts.size(); ++i) {
        const std::string path = fmt::format("simulate.other_starts[{}]", i);
        if (scene.simulate.other_starts[i].empty() && !rotor.balancers.empty())
            check.fail(path, fmt::format("expected {} lists, one for each balancer, got none",
                                         rotor.balancers.size()));
        check_ball_angles(scene, scene.simulate.other_starts[i], path, check);
    }
}

} // namespace whirl::input

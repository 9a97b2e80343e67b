#include "benchmarks/workloads.h"

#include "analyses/balance.h"
#include "analyses/campbell.h"
#include "analyses/critical.h"
#include "analyses/response.h"
#include "analyses/samples/samples.h"
#include "analyses/stability.h"
#include "benchmarks/dense_baseline.h"
#include "forced/forced_motion.h"
#include "forced/response_places.h"
#include "input/case_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <stdexcept>

namespace whirl::benchmarks {

namespace {

using Overrides = std::vector<std::string>;

/// A case whose analyses may read it again with further entries changed.
struct Scene {
    Scene(const std::string &path, const Overrides &overrides)
        : scene(input::load_case(path, overrides)), with([path, overrides](const Overrides &more) {
              Overrides both = overrides;
              both.insert(both.end(), more.begin(), more.end());
              return input::load_case(path, both);
          }) {}
    model::Case scene;
    analyses::CaseWith with;
};

/// The shaft of the three discs in four segments between them, as many elements in each.
std::string three_discs_shaft(int elements) {
    std::string segments;
    for (const double length : {0.2, 0.3, 0.5, 0.3})
        segments +=
            fmt::format(R"({}{{length = {}, outer = 0.1, material = "steel", elements = {}}})",
                        segments.empty() ? "" : ", ", length, elements);
    return fmt::format("shaft.segments=[{}]", segments);
}

/// 100 N s/m in both bearings and directions.
Overrides light_damping() {
    return {"bearing[0].cxx=100", "bearing[0].cyy=100", "bearing[1].cxx=100", "bearing[1].cyy=100"};
}

Scene three_discs(const std::string &folder, Overrides overrides) {
    const Overrides damping = light_damping();
    overrides.insert(overrides.end(), damping.begin(), damping.end());
    return {folder + "/lalanne_three_discs", overrides};
}

/// One eigendecomposition of the state matrix at the last speed, on `refinement` classical elements
/// in each span: its time does not depend on speed.
std::function<void()> dense_eigenvectors(const model::Case &scene, int refinement) {
    const auto matrix = std::make_shared<const Eigen::MatrixXd>(
        state_matrix(scene.rotor, 1, refinement, scene.speeds->to));
    return [matrix] { (void)dense_frequencies(*matrix, true); };
}

/// Analysis of a case as it is.
template <class Result>
std::function<void()> on(const Scene &scene, Result (*analysis)(const model::Case &)) {
    return [scene, analysis] { (void)analysis(scene.scene); };
}

/// Analysis that reads the case again.
template <class Result>
std::function<void()> on(const Scene &scene,
                         Result (*analysis)(const model::Case &, const analyses::CaseWith &)) {
    return [scene, analysis] { (void)analysis(scene.scene, scene.with); };
}

/// The steady motion of the stations at all speeds, without errors or peaks.
void solve_at_all_speeds(const model::Case &scene) {
    const assembly::Discretization discretization(scene.rotor, scene.rotor.shaft.order);
    forced::ForcedMotion motion(discretization, forced::response_formulation(scene).form);
    for (const double speed : scene.speeds->values())
        motion.solve(speed);
}

/// @throws std::runtime_error where the dense route has another motion: it would be no comparison.
void check_same_motion(const model::Case &scene, const DenseHarmonic &problem, double speed) {
    const assembly::Discretization discretization(scene.rotor, scene.rotor.shaft.order);
    forced::ForcedMotion motion(discretization, forced::response_formulation(scene).form);
    motion.solve(speed);
    const Eigen::VectorXcd dense = dense_motion(problem);
    double apart = 0;
    double size = 0;
    for (const auto &[node, name] : forced::attached_nodes(discretization)) {
        const double z = discretization.shaft_mesh().nodes[static_cast<std::size_t>(node)];
        std::complex<double> x;
        std::complex<double> y;
        for (const auto &[unknown, value] : discretization.deflection_at(z)) {
            x += value * dense(2 * unknown);
            y += value * dense(2 * unknown + 1);
        }
        const forced::Phasor mine = motion.at(z);
        apart = std::max(apart, std::hypot(std::abs(mine.x - x), std::abs(mine.y - y)));
        size = std::max(size, std::hypot(std::abs(x), std::abs(y)));
    }
    if (!(apart <= 1e-6 * size))
        throw std::runtime_error("the dense route does not give the motion of the program");
}

void add_campbells(std::vector<Workload> &list, const std::string &folder) {
    const Scene discs = three_discs(folder, {"speeds.count=101", "campbell.modes=12"});
    const Scene friswell(folder + "/friswell_5_9_1", {"speeds.count=101", "campbell.modes=12"});
    const Scene keyway(folder + "/keyway_shaft", {});
    const Scene extractor(folder + "/extractor_two_plane", {});
    list.push_back({.name = "campbell_three_discs",
                    .what = "campbell of lalanne_three_discs: 101 speeds; 12 modes",
                    .run = on(discs, analyses::campbell),
                    .dense = {unit_of_time(folder), 101}});
    list.push_back({.name = "campbell_two_discs",
                    .what = "campbell of friswell_5_9_1 (undamped): 101 speeds; 12 modes",
                    .run = on(friswell, analyses::campbell),
                    .dense = {dense_eigenvectors(friswell.scene, 16), 101}});
    list.push_back({.name = "campbell_keyway",
                    .what = "campbell of keyway_shaft",
                    .run = on(keyway, analyses::campbell)});
    list.push_back({.name = "campbell_extractor",
                    .what = "campbell of extractor_two_plane",
                    .run = on(extractor, analyses::campbell)});
}

void add_responses(std::vector<Workload> &list, const std::string &folder) {
    const Scene discs =
        three_discs(folder, {"speeds.count=500", "shaft.order=1", three_discs_shaft(48)});
    const double speed = discs.scene.speeds->to;
    const auto problem = std::make_shared<const DenseHarmonic>(
        dense_harmonic(discs.scene.rotor, discs.scene.rotor.shaft.order, speed));
    check_same_motion(discs.scene, *problem, speed);
    const DenseRoute dense{[problem] { (void)dense_motion(*problem); }, 500};
    list.push_back(
        {.name = "response_motion",
         .what =
             "motion of the stations of lalanne_three_discs on 192 classical elements: 500 speeds",
         .run = on(discs, solve_at_all_speeds),
         .dense = dense});
    list.push_back({.name = "response_with_peaks",
                    .what = "response of the same with orbits and errors and peaks",
                    .run = on(discs, analyses::unbalance_response),
                    .dense = dense});
}

/// A steel shaft in the place of the rigid one: seven bands between 50 and 1300 rad/s, one of them
/// 0.23 rad/s wide.
Scene flexible_hill(const std::string &folder) {
    return {folder + "/hill_rotor",
            {"material.light.E=2.11e11",
             "material.light.rho=7810",
             "shaft.rigid=false",
             "shaft.order=6",
             "disc[0].z=0.4",
             "disc[0].Id=0.3",
             "disc[0].Ip=0.2",
             "anisotropy[0].z=0.4",
             "anisotropy[0].dI=0.05",
             "bearing[0].kxx=4e6",
             "bearing[0].kyy=6e6",
             "bearing[1].kxx=4e6",
             "bearing[1].kyy=6e6",
             "bearing[0].cxx=34.45",
             "bearing[0].cyy=34.45",
             "bearing[1].cxx=34.45",
             "bearing[1].cyy=34.45",
             "speeds.from=50",
             "speeds.to=1300",
             "speeds.count=251"}};
}

void add_stability(std::vector<Workload> &list, const std::string &folder) {
    for (const auto &[name, scene] : {std::pair{"stability_five_balls", "centrifuge_five_balls"},
                                      std::pair{"stability_extractor", "extractor_two_plane"}})
        list.push_back({.name = name,
                        .what = fmt::format("stability of {}", scene),
                        .run = on(Scene(folder + "/" + scene, {}), analyses::stability)});
    list.push_back(
        {.name = "stability_hill",
         .what = "stability of hill_rotor: 771 speeds",
         .run = on(Scene(folder + "/hill_rotor", {"speeds.count=771"}), analyses::stability)});
    list.push_back({.name = "stability_flexible_hill",
                    .what = "stability of hill_rotor with a steel shaft of order 6: 251 speeds",
                    .run = on(flexible_hill(folder), analyses::stability)});
}

void add_others(std::vector<Workload> &list, const std::string &folder) {
    list.push_back({.name = "critical_damped",
                    .what = "critical of lalanne_three_discs",
                    .run = on(
                        three_discs(folder, {}), +[](const model::Case &scene) {
                            return analyses::critical_speeds(scene);
                        })});
    list.push_back({.name = "balance_extractor",
                    .what = "balance of extractor_two_plane: all tiers; 16 motions in time",
                    .run = on(
                        Scene(folder + "/extractor_two_plane", {}),
                        +[](const model::Case &scene) { return analyses::balance(scene); })});
    constexpr int count = 6;
    const std::string samples = fmt::format(
        R"(samples={{count = {}, of = ["critical", "peaks"], vary = [)"
        R"({{path = "bearing[0].kxx", distribution = "normal", relative = true, deviation = 0.1}}, )"
        R"({{path = "disc[1].mass", distribution = "uniform", from = 44, to = 48}}]}})",
        count);
    list.push_back({.name = "samples_three_discs",
                    .what = "samples of lalanne_three_discs (critical speeds and peaks): one of 6",
                    .run = on(three_discs(folder, {samples}), analyses::samples),
                    .parts = count});
}

} // namespace

std::vector<Workload> all_workloads(const std::string &folder) {
    std::vector<Workload> list;
    add_campbells(list, folder);
    add_responses(list, folder);
    add_stability(list, folder);
    add_others(list, folder);
    return list;
}

std::function<void()> unit_of_time(const std::string &folder) {
    // One element between two neighbours of discs and ends: four spans.
    const Scene discs = three_discs(folder, {three_discs_shaft(1)});
    constexpr int refinement = 12;
    const assembly::Discretization discretization(discs.scene.rotor, 1, refinement);
    if (4 * discretization.planar_size() != 392)
        throw std::runtime_error("the unit of time is not one of a 392 x 392 matrix");
    return dense_eigenvectors(discs.scene, refinement);
}

} // namespace whirl::benchmarks

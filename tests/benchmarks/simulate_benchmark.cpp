// A thousand revolutions of a shaft of thirty nodes with two four-ball balancers, and the same
// motion of the shaft with all its modes.

#include "analyses/simulate.h"
#include "benchmarks/stopwatch.h"
#include "support/balancer_scenes.h"

#include <benchmark/benchmark.h>

#include <numbers>

namespace whirl::benchmarks {

namespace {

constexpr double speed = 150; // rad/s, above the first critical speed

/// 29 classical elements of 50 mm: thirty nodes, two of them at the discs and balancers.
model::Case thirty_nodes(double revolutions) {
    model::Case scene;
    scene.name = "thirty_nodes";
    scene.rotor.shaft = tests::uniform_shaft(1.45, 0.05, tests::steel());
    scene.rotor.shaft.segments.front().elements = 29;
    scene.rotor.shaft.order = 1;
    scene.rotor.discs = {tests::disc_at(0.5, 32.6, 0.178, 0.33),
                         tests::disc_at(1.0, 51.5, 0.424, 0.805)};
    scene.rotor.bearings = {tests::isotropic_bearing(0, 1e6, 500),
                            tests::isotropic_bearing(1.45, 1e6, 500)};
    scene.rotor.balancers = {tests::ball_balancer(0.5, 4, 0.05, 0.1, 0.5, 0.005),
                             tests::ball_balancer(1.0, 4, 0.05, 0.1, 0.5, 0.006)};
    scene.speeds = model::SpeedRange{speed, speed, 1};
    scene.simulate.time = revolutions * 2 * std::numbers::pi / speed;
    return scene;
}

void thousand_revolutions(benchmark::State &state) {
    results::SimulateResult result;
    for (auto _ : state)
        result = analyses::simulate(thirty_nodes(1000));
    state.counters["shapes"] = result.shapes;
    state.counters["evaluations"] = static_cast<double>(result.rate_evaluations);
    state.counters["reduction_error"] = result.response_error;
    state.counters["energy_error"] = result.audit.energy_error / result.audit.energy_scale;
}

/// Seconds a revolution with few shapes and with all of them: the fastest mode sets the steps.
void against_whole_shaft(benchmark::State &state) {
    constexpr double revolutions = 2;
    double reduced = 0;
    double whole = 0;
    for (auto _ : state) {
        reduced = seconds_of([] { (void)analyses::simulate(thirty_nodes(50 * revolutions)); }) / 50;
        model::Case scene = thirty_nodes(revolutions);
        scene.simulate.modes = 10000;
        whole = seconds_of([&] { (void)analyses::simulate(scene); });
    }
    state.counters["reduced_s_per_rev"] = reduced / revolutions;
    state.counters["whole_s_per_rev"] = whole / revolutions;
    state.counters["ratio"] = whole / reduced;
}

BENCHMARK(thousand_revolutions)->Unit(benchmark::kSecond);
BENCHMARK(against_whole_shaft)->Unit(benchmark::kSecond)->Iterations(1);

} // namespace

} // namespace whirl::benchmarks

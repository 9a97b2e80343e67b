// Analyses without the start of the program, and the dense state matrix beside the Campbell
// diagram.

#include "analyses/campbell.h"
#include "analyses/critical.h"
#include "analyses/response.h"
#include "benchmarks/dense_baseline.h"
#include "benchmarks/stopwatch.h"
#include "input/case_file.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace whirl::benchmarks {

namespace {

constexpr int speeds = 101;

model::Case scene_of(const std::string &name) {
    return input::load_case(std::string(WHIRL_ROOT "/cases/") + name,
                            {"speeds.count=" + std::to_string(speeds)});
}

/// Largest relative error of the frequencies at the last speed against those of `exact`.
double error_of(const DenseSolve &dense, const results::CampbellResult &exact) {
    std::vector<double> frequencies;
    for (const results::CampbellMode &mode : exact.modes)
        if (mode.frequency.back())
            frequencies.push_back(*mode.frequency.back());
    std::sort(frequencies.begin(), frequencies.end());
    double largest = 0;
    for (std::size_t i = 0; i < frequencies.size(); ++i)
        largest = std::max(largest, std::abs(dense.frequencies.at(i) / frequencies[i] - 1));
    return largest;
}

/// Seconds of a Campbell diagram by the dense state matrix, from one solve at its last speed:
/// the time does not depend on speed.
void count_dense(benchmark::State &state, const model::Case &scene, int order, int refinement,
                 const std::string &name, const results::CampbellResult &result, double seconds) {
    for (const bool vectors : {false, true}) {
        const DenseSolve dense =
            dense_solve(scene.rotor, order, refinement, scene.speeds->to, vectors, 5);
        const std::string key = name + (vectors ? "_vectors" : "");
        state.counters[key + "_s"] = speeds * dense.seconds;
        state.counters[key + "_ratio"] = speeds * dense.seconds / seconds;
        if (vectors)
            continue;
        state.counters[name + "_states"] = dense.states;
        state.counters[name + "_digits"] = -std::log10(error_of(dense, result));
    }
}

/// Ten digits of twelve modes: whirl's campbell (modes, tracking, error estimates, crossings)
/// against nothing but the eigenvalues of the state matrix: 48 usual elements (error 1e-5), and
/// the same ten-digit model.
void campbell_against_dense(benchmark::State &state) {
    const model::Case scene = scene_of("friswell_5_9_1");
    results::CampbellResult result;
    double seconds = std::numeric_limits<double>::infinity();
    for (auto _ : state) {
        seconds = std::min(seconds, seconds_of([&] { result = analyses::campbell(scene); }));
    }
    state.counters["best_s"] = seconds;
    count_dense(state, scene, 1, 16, "dense48", result, seconds);
    count_dense(state, scene, scene.rotor.shaft.order, 1, "dense10", result, seconds);
}

template <class Analysis>
void repeat(benchmark::State &state, const std::string &name, const Analysis &analysis) {
    const model::Case scene = scene_of(name);
    int unknowns = 0;
    for (auto _ : state)
        unknowns = analysis(scene).model.unknowns;
    state.counters["unknowns"] = unknowns;
}

void campbell(benchmark::State &state, const std::string &name) {
    repeat(state, name, analyses::campbell);
}

void critical(benchmark::State &state, const std::string &name) {
    repeat(state, name, [](const model::Case &scene) { return analyses::critical_speeds(scene); });
}

void response(benchmark::State &state, const std::string &name) {
    repeat(state, name, analyses::unbalance_response);
}

BENCHMARK(campbell_against_dense)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(campbell, orthotropic, "friswell_5_9_2")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(campbell, general, "lalanne_three_discs")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(critical, planar, "friswell_5_9_1")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(critical, general, "lalanne_three_discs")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(response, general, "lalanne_three_discs")->Unit(benchmark::kMillisecond);

} // namespace

} // namespace whirl::benchmarks

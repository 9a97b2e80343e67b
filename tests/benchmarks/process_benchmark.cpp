// The whole program, from its start to its end, as a user waits for it.

#include "cases/program_run.h"

#include <benchmark/benchmark.h>

#include <filesystem>
#include <string>
#include <unistd.h>
#include <vector>

namespace whirl::benchmarks {

namespace {

/// A folder of this process below the folder for temporary files, removed at the end.
class Scratch {
  public:
    Scratch() { std::filesystem::create_directories(_path); }
    ~Scratch() {
        std::error_code ignored;
        std::filesystem::remove_all(_path, ignored);
    }
    Scratch(const Scratch &) = delete;
    Scratch &operator=(const Scratch &) = delete;
    Scratch(Scratch &&) = delete;
    Scratch &operator=(Scratch &&) = delete;

    [[nodiscard]] std::string path(const std::string &name) const { return _path / name; }

  private:
    std::filesystem::path _path =
        std::filesystem::temp_directory_path() / ("whirl_benchmark_" + std::to_string(getpid()));
};

/// Wall time of one command of the program; fails the benchmark where the program fails.
void whole_process(benchmark::State &state, const std::vector<std::string> &arguments,
                   bool pictures) {
    const Scratch scratch;
    std::vector<std::string> words = arguments;
    words.insert(words.end(), pictures
                                  ? std::initializer_list<std::string>{"--out", scratch.path("out")}
                                  : std::initializer_list<std::string>{"--json"});
    for (auto _ : state) {
        const tests::ProgramRun run =
            tests::run_program(WHIRL_PROGRAM, words, scratch.path("errors"));
        if (run.status != 0) {
            state.SkipWithError(run.errors.c_str());
            return;
        }
    }
}

const std::vector<std::string> version{"--version"};
const std::vector<std::string> show{"show", WHIRL_ROOT "/cases/friswell_5_9_1"};
const std::vector<std::string> campbell{"campbell", WHIRL_ROOT "/cases/friswell_5_9_1",
                                        "--set",    "speeds.count=101",
                                        "--set",    "campbell.modes=12"};

BENCHMARK_CAPTURE(whole_process, version, version, false)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(whole_process, show, show, false)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(whole_process, campbell, campbell, false)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(whole_process, campbell_with_pictures, campbell, true)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

} // namespace

} // namespace whirl::benchmarks

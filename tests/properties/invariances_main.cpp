// Scenes drawn at random, each seen in other ways that must not change the answers.
//
//   invariances [scenes [first [one in .. for the long commands, 0: none]]]
//   invariances --case NUMBER      the case file of one of them (without bearing tables)

#include "properties/invariance_checks.h"

#include "linalg/session.h"
#include "properties/case_text.h"
#include "properties/random_scenes.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>

namespace {

namespace properties = whirl::properties;

/// How often an invariance was tried and broken.
struct Tally {
    int tried = 0;
    int broken = 0;
    double seconds = 0; ///< of the processor
};

/// Of this program, s.
double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// One scene through every invariance that applies to it.
void try_scene(int number, int long_commands, std::map<std::string, Tally> &tallies) {
    properties::InvarianceScene scene(number);
    const bool long_too = long_commands > 0 && number % long_commands == 0;
    for (const properties::Invariance &check : properties::invariances()) {
        // A Hill series takes seconds for each spectrum.
        if ((check.long_running || scene.series()) && !long_too)
            continue;
        const double start = processor_time();
        std::optional<std::string> difference;
        try {
            difference = check.difference(scene);
        } catch (const std::exception &failure) {
            difference = fmt::format("no answer: {}", failure.what());
        }
        Tally &tally = tallies[check.name];
        const double taken = processor_time() - start;
        tally.seconds += taken;
        if (taken > 2)
            fmt::print(stderr, "scene {} ({}): {} took {:.1f} s\n", number, scene.words(),
                       check.name, taken);
        if (!difference)
            continue;
        ++tally.tried;
        if (difference->empty())
            continue;
        if (++tally.broken <= 12) {
            fmt::print("{}: scene {} ({}): {}\n", check.name, number, scene.words(), *difference);
            std::fflush(stdout);
        }
    }
}

} // namespace

int main(int argc, char **argv) {
    if (argc == 3 && std::string(argv[1]) == "--case") {
        fmt::print("{}", properties::case_text(properties::random_scene(std::atoi(argv[2]))));
        return 0;
    }
    const int scenes = argc > 1 ? std::atoi(argv[1]) : 500;
    const int first = argc > 2 ? std::atoi(argv[2]) : 0;
    const int long_commands = argc > 3 ? std::atoi(argv[3]) : 10;
    const whirl::linalg::Session session;
    std::map<std::string, Tally> tallies;
    for (int number = first; number < first + scenes; ++number) {
        try_scene(number, long_commands, tallies);
        if (number % 20 == 19) {
            fmt::print(stderr, "{} scenes\n", number - first + 1);
            std::fflush(stderr);
        }
    }
    int broken = 0;
    fmt::print("\n{:<44}{:>8}{:>8}{:>10}\n", "invariance", "tried", "broken", "seconds");
    for (const auto &[name, tally] : tallies) {
        fmt::print("{:<44}{:>8}{:>8}{:>10.1f}\n", name, tally.tried, tally.broken, tally.seconds);
        broken += tally.broken;
    }
    return broken == 0 ? 0 : 1;
}

// Every case with every command, in units of length, mass and time that are powers of two of the
// usual ones: the same digits scaled, the same words.
//
//   units [case or "all" [command or "all" [length mass time]]]    exponents of two

#include "linalg/session.h"
#include "properties/scaling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <optional>

namespace {

namespace fs = std::filesystem;
namespace properties = whirl::properties;

std::vector<std::string> case_names(const std::string &wanted) {
    std::vector<std::string> names;
    for (const auto &item : fs::directory_iterator(fs::path(WHIRL_ROOT) / "cases"))
        if (item.is_directory() && (wanted == "all" || item.path().filename() == wanted))
            names.push_back(item.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

/// Each dimension alone, and all at once.
std::vector<properties::Units> units_of(int argc, char **argv) {
    const auto two = [](int power) { return std::ldexp(1.0, power); };
    if (argc > 5)
        return {{two(std::atoi(argv[3])), two(std::atoi(argv[4])), two(std::atoi(argv[5]))}};
    return {{two(-9), two(14), two(6)}};
}

/// Rounding of iterations that end by a tolerance; near a resonance, where the response is a small
/// difference of large forces, of those.
double digits_of(const std::string &command) { return command == "response" ? 1e-6 : 1e-8; }

/// Prints what differs; how much did.
int compare(const std::string &name, const std::string &command,
            const std::vector<properties::Units> &units) {
    const fs::path file = fs::path(WHIRL_ROOT) / "cases" / name;
    const std::clock_t start = std::clock();
    const properties::CommandOutput here = properties::run_in_units(command, file, {});
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    int differences = 0;
    for (const properties::Units &u : units) {
        const auto found = properties::scaling_differences(
            here, properties::run_in_units(command, file, u), digits_of(command));
        differences += static_cast<int>(found.size());
        for (const std::string &sentence : found)
            fmt::print("{} {} (length x {:g}, mass x {:g}, time x {:g}): {}\n", command, name,
                       u.length, u.mass, u.time, sentence);
    }
    if (seconds > 3)
        fmt::print(stderr, "{} {}: {:.1f} s\n", command, name, seconds);
    return differences;
}

} // namespace

int main(int argc, char **argv) {
    const std::string wanted_case = argc > 1 ? argv[1] : "all";
    const std::string wanted_command = argc > 2 ? argv[2] : "all";
    const whirl::linalg::Session session;
    int compared = 0;
    int differences = 0;
    for (const std::string &name : case_names(wanted_case))
        for (const std::string &command : properties::commands())
            if (wanted_command == "all" || wanted_command == command) {
                ++compared;
                differences += compare(name, command, units_of(argc, argv));
                std::fflush(stdout);
            }
    fmt::print("{} answers compared, {} differences\n", compared, differences);
    return differences == 0 ? 0 : 1;
}

#pragma once

#include "broken_case.h"

namespace whirl::tests {

/// Mistakes in [sweep].
inline std::vector<BrokenCase> broken_sweep() {
    // The shaft's outer diameter is an entry of every one; keys start on line 9.
    const std::string begin = sound_case + "[sweep]\n";
    const auto over = [](const std::string &rest) {
        return "x = {path = \"shaft.segments[0].outer\"" + rest + "}\n";
    };
    const std::string range = ", from = 0.04, to = 0.06, count = 3";
    const std::string balanced = sound_case + "[[balancer]]\nz = 0.2\nn = 2\nmass = 0.1\n"
                                              "radius = 0.1\n[sweep]\n"; // next is line 14
    const std::string of_mass = "x = {path = \"balancer[0].mass\", dimensionless = ";
    return {
        {"nothing changes", 8, "sweep.x", "missing, expected a table {path", begin},
        {"no such swept entry", 9, "sweep.x.path",
         "expected a numeric entry of the case, got \"shaft.colour\"",
         begin + "x = {path = \"shaft.colour\", from = 1, to = 2, count = 2}\n"},
        {"an entry without a name", 9, "sweep.x.path", "got \"\"",
         begin + "x = {path = \"\", from = 1, to = 2, count = 2}\n"},
        {"an empty list of entries", 9, "sweep.x.path", "at least one numeric entry",
         begin + "x = {path = [], from = 1, to = 2, count = 2}\n"},
        {"one swept value", 9, "sweep.x.count", "from 2 to 1000000, got 1",
         begin + over(", from = 0.04, to = 0.06, count = 1")},
        {"a range that falls", 9, "sweep.x.to", "expected more than from",
         begin + over(", from = 0.06, to = 0.04, count = 3")},
        {"a logarithm of nothing", 9, "sweep.x.from", "greater than 0",
         begin + over(", from = 0, to = 0.06, count = 3, spacing = \"log\"")},
        {"no swept values", 9, "sweep.x.values", "at least one value",
         begin + over(", values = []")},
        {"values and a range", 9, "sweep.x.from", "got both",
         begin + over(", values = [0.05], from = 0.04")},
        {"an unknown change", 9, "sweep.x.change", "did you mean \"factor\"?",
         begin + over(", change = \"facter\"" + range)},
        {"a factor of a default", 9, "sweep.x.path", "is left at its default",
         begin + "x = {path = \"shaft.internal_damping\", change = \"factor\", from = 1, to = 2, "
                 "count = 2}\n"},
        {"lengths and densities", 9, "sweep.x.path", "expected entries of one quantity",
         begin + "x = {path = [\"shaft.segments[0].outer\", \"material.steel.rho\"], from = 1, to "
                 "= 2, count = 2}\n"},
        {"a swept entry twice", 8, "sweep", "expected each entry once",
         begin + over(range) + "y" + over(range).substr(1)},
        {"no dimensionless number", 9, "sweep.x.dimensionless",
         "expected one of the numbers of show, \"C\", \"A\", ",
         begin + over(", dimensionless = \"q\"" + range)},
        {"the speed in a sweep", 9, "sweep.x.dimensionless", "got \"Omega\"",
         begin + over(", dimensionless = \"Omega\"" + range)},
        {"a number of no balancer", 9, "sweep.x.dimensionless", "the case has no balancer",
         begin + over(", dimensionless = \"m\"" + range)},
        {"a balancer that is not there", 9, "sweep.x.balancer", "the case has none",
         begin + over(", dimensionless = \"C\", balancer = 0" + range)},
        {"a balancer without its number", 9, "sweep.x.balancer", "expected none without",
         begin + over(", balancer = 0" + range)},
        {"a number of one of two balancers", 17, "sweep.x.dimensionless",
         "expected whose of the 2 balancers, as balancer = 0, got \"m\" alone",
         sound_case +
             "[[balancer]]\nz = 0.2\nmass = 0.1\nradius = 0.1\n[[balancer]]\nz = 0.5\n"
             "mass = 0.1\nradius = 0.1\n[sweep]\n" +
             over(", dimensionless = \"m\"" + range)},
        {"a balancer without mass", 14, "sweep.x.from",
         "greater than 0, got 0: the parts of every balancer have mass",
         balanced + of_mass + "\"m\", from = 0, to = 0.1, count = 3}\n"},
        {"one of several balancers without inertia", 14, "sweep.x.values[1]",
         "greater than 0, got 0: the parts of every balancer have mass",
         balanced + of_mass + "\"A_m\", values = [0.1, 0]}\n"},
        {"a dimensionless number of balls", 14, "sweep.x.path",
         "expected an entry that may have any value, of which one gives the rotor its m, got "
         "\"balancer[0].n\", a whole number",
         balanced + "x = {path = \"balancer[*].n\", dimensionless = \"m\"" + range + "}\n"},
        {"a number of the speed", 9, "map.x.dimensionless", "expected \"Omega\" of the spin speed",
         sound_case +
             "[map]\nx = {path = \"speed\", dimensionless = \"m\", from = 0, to = 2, count "
             "= 2}\ny = {path = \"shaft.segments[0].outer\"" +
             range + "}\n"},
        {"margins of what does not run", 9, "sweep.of", "expected operating speeds in [operation]",
         begin + "of = [\"margins\"]\n" + over(range)},
        {"damping at no speed", 8, "sweep.at", "missing, expected spin speeds",
         begin + "of = [\"damping\"]\n" + over(range)},
        {"an unknown key of a sweep", 9, "sweep.z", "unknown key", begin + "z = 1\n" + over(range)},
    };
}

} // namespace whirl::tests

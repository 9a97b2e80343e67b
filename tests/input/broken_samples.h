#pragma once

#include "broken_case.h"

namespace whirl::tests {

/// Mistakes in [samples].
inline std::vector<BrokenCase> broken_samples() {
    // The shaft's outer diameter is an entry of every one; keys start on line 10.
    const std::string begin = sound_case + "[samples]\ncount = 9\n";
    const auto varying = [](const std::string &rest) {
        return "vary = [{path = \"shaft.segments[0].outer\", " + rest + "}]\n";
    };
    const std::string sound = varying("distribution = \"uniform\", from = 0.04, to = 0.06");
    return {
        {"no number of samples", 8, "samples.count", "missing, expected a whole number of 1",
         sound_case + "[samples]\n" + sound},
        {"no samples", 9, "samples.count", "from 1 to 1000000, got 0",
         sound_case + "[samples]\ncount = 0\n" + sound},
        {"half a seed", 10, "samples.seed", "expected a whole number from 0",
         begin + "seed = 0.5\n" + sound},
        {"nothing varies", 8, "samples.vary", "missing, expected a list of tables", begin},
        {"a list of nothing varies", 10, "samples.vary", "at least one entry of the case, got none",
         begin + "vary = []\n"},
        {"an unknown answer", 10, "samples.of[1]", "did you mean \"critical\"?",
         begin + "of = [\"ends\", \"critcal\"]\n" + sound},
        {"no answer", 10, "samples.of", "expected a list of \"critical\" or",
         begin + "of = []\n" + sound},
        {"a quantile of everything", 10, "samples.quantiles[1]", "in (0, 1), got 1",
         begin + "quantiles = [0.5, 1]\n" + sound},
        {"no quantiles", 10, "samples.quantiles", "at least one number",
         begin + "quantiles = []\n" + sound},
        {"an unknown entry", 10, "samples.vary[0].path",
         "expected a numeric entry of the case, got \"material.steel.nv\", did you mean "
         "\"material.steel.nu\"?",
         begin + "vary = [{path = \"material.steel.nv\", distribution = \"normal\"}]\n"},
        {"no entry", 10, "samples.vary[0].path", "missing, expected a numeric entry",
         begin + "vary = [{distribution = \"normal\", mean = 1}]\n"},
        {"samples of samples", 10, "samples.vary[0].path", "a numeric entry of the case",
         begin + "vary = [{path = \"samples.count\", distribution = \"normal\"}]\n"},
        {"an entry twice", 11, "samples.vary[1].path", "expected each entry once",
         begin +
             "vary = [{path = \"material.steel.E\", distribution = \"values\", values = "
             "[2e11]},\n" +
             "{path = \"material.steel.E\", distribution = \"values\", values = [2e11]}]\n"},
        {"an unknown distribution", 10, "samples.vary[0].distribution",
         "expected \"normal\" or \"uniform\" or \"values\", got \"norml\", did you mean "
         "\"normal\"?",
         begin + varying("distribution = \"norml\"")},
        {"no distribution", 10, "samples.vary[0].distribution", "missing, expected \"normal\" or",
         begin + varying("from = 1")},
        {"a deviation of nothing", 10, "samples.vary[0].deviation", "greater than 0, got 0",
         begin + varying("distribution = \"normal\", deviation = 0")},
        {"no deviation", 10, "samples.vary[0].deviation", "missing, expected a length in m",
         begin + varying("distribution = \"normal\"")},
        {"a deviation in kg", 10, "samples.vary[0].deviation",
         "a length in m greater than 0, got \"1 kg\"",
         begin + varying("distribution = \"normal\", deviation = \"1 kg\"")},
        {"a share of nothing", 10, "samples.vary[0].relative", "expected a mean other than 0",
         begin + varying("distribution = \"normal\", mean = 0, relative = true, deviation = 0.1")},
        {"a range that ends before it starts", 10, "samples.vary[0].to",
         "more than from = 2, got 1",
         begin + varying("distribution = \"uniform\", from = 2, to = 1")},
        {"a list of no values", 10, "samples.vary[0].values", "at least one value, got none",
         begin + varying("distribution = \"values\", values = []")},
        {"no values", 10, "samples.vary[0].values", "missing, expected a list of values",
         begin + varying("distribution = \"values\"")},
        {"a key of another distribution", 10, "samples.vary[0].mean", "unknown key",
         begin + varying("distribution = \"uniform\", from = 1, to = 2, mean = 1")},
    };
}

} // namespace whirl::tests

#pragma once

#include "broken_case.h"

namespace whirl::tests {

/// Mistakes in [critical_map] and [units].
inline std::vector<BrokenCase> broken_maps() {
    const std::string &base = sound_case;
    const std::string supported =
        base + "[[bearing]]\nname = \"left\"\nz = 0\nk = 1\n"; // next is line 12
    return {
        {"map of supports backwards", 10, "critical_map.to", "more than from = 100 N/m, got 10",
         base + "[critical_map]\nfrom = 100\nto = 10\n"},
        {"map of supports of one point", 9, "critical_map.points", "from 2 to 10000, got 1",
         base + "[critical_map]\npoints = 1\n"},
        {"map over no bearing", 9, "critical_map.bearing", "expected a bearing, the case has none",
         base + "[critical_map]\nbearing = 0\n"},
        {"map over an unknown bearing", 13, "critical_map.bearing",
         "expected the name of a bearing or its place, 0 to 0, got \"lift\", did you mean "
         "\"left\"?",
         supported + "[critical_map]\nbearing = \"lift\"\n"},
        {"map over a bearing too many", 13, "critical_map.bearing", "0 to 0, got 1",
         supported + "[critical_map]\nbearing = 1\n"},
        {"map from no stiffness", 9, "critical_map.from", "greater than 0, got 0",
         base + "[critical_map]\nfrom = 0\n"},
        {"length in kilograms", 9, "units.length",
         "expected the unit of a length in m or another one, got \"kg\"",
         base + "[units]\nlength = \"kg\"\n"},
        {"speed that does not say turns", 9, "units.speed", "expected the unit of an angular speed",
         base + "[units]\nspeed = \"1/s\"\n"},
        {"unknown preset", 9, "units.preset", "\"mm-rpm\"", base + "[units]\npreset = \"mm\"\n"},
        {"unit of nothing", 9, "units.sped", "did you mean \"speed\"?",
         base + "[units]\nsped = \"Hz\"\n"},
    };
}

} // namespace whirl::tests

#pragma once

#include "broken_case.h"

namespace whirl::tests {

/// Mistakes in masses, pedestals and tables of bearings, and in damping and torque of the shaft.
inline std::vector<BrokenCase> broken_bearings() {
    const std::string bearing = sound_case + "[[bearing]]\nz = 0\n"; // its keys start on line 10
    const std::string table = bearing + "table = \"b.csv\"\n";
    const std::string shaft = sound_case; // its further keys start on line 8
    return {
        {"pedestal in x alone", 8, "bearing[0].pedestal_ky",
         "missing, expected a stiffness in N/m beside pedestal_kx",
         bearing + "k = 1\npedestal_kx = 5\n"},
        {"pedestal alike and not", 11, "bearing[0].pedestal_mass", "got both",
         bearing + "k = 1\npedestal_mass = 5\npedestal_mass_x = 5\npedestal_k = 1\n"
                   "pedestal_mass_y = 1\n"},
        {"stiffness below none", 10, "bearing[0].k",
         "0 or more, got -5; negative ones are given as kxx and kyy", bearing + "k = -5\n"},
        {"damping below none", 11, "bearing[0].c",
         "0 or more, got \"-2 N s/mm\"; negative ones are given as cxx and cyy",
         bearing + "k = 1\nc = \"-2 N s/mm\"\n"},
        {"one bearing twice", 11, "bearing",
         "[[bearing]] above each, as there may be several, got [bearing] twice, first in line 8",
         sound_case + "[bearing]\nz = 0\nk = 1\n[bearing]\nz = 1\nk = 1\n"},
        {"a bearing and a list of them", 8, "bearing",
         "expected [[bearing]], as in line 11, got [bearing]",
         sound_case + "[bearing]\nz = 0\nk = 1\n[[bearing]]\nz = 1\nk = 1\n"},
        {"a list of bearings and one", 11, "bearing",
         "expected [[bearing]], as in line 8, got [bearing]",
         sound_case + "[[bearing]]\nz = 0\nk = 1\n[bearing]\nz = 1\nk = 1\n"},
        {"m and mxx", 11, "bearing[0].m", "got both", bearing + "k = 1\nm = 1\nmxx = 1\n"},
        {"mass that drives", 11, "bearing[0].mxx", "got -1 kg in one",
         bearing + "k = 1\nmxx = -1\n"},
        {"mass that drives along y", 12, "bearing[0].myy", "got -2 kg in one",
         bearing + "k = 1\nmxx = 1\nmyy = -2\n"},
        {"mass that drives askew", 11, "bearing[0].mxx", "resist acceleration in every direction",
         bearing + "k = 1\nmxx = 1\nmxy = 2\nmyx = 2\nmyy = 1\n"},
        {"mass that varies",
         3,
         "m",
         "the same mass coefficients at every speed",
         table,
         {{"b.csv", "speed,k,m\n10,1,1\n20,1,2\n"}},
         "b.csv"},
        {"mass in and beside a table",
         10,
         "bearing[0].table",
         "in the table or beside it, got both",
         table + "m = 1\n",
         {{"b.csv", "speed,k,m\n10,1,1\n20,1,1\n"}}},
        {"spline through nothing", 11, "bearing[0].interpolation", "got no table",
         bearing + "k = 1\ninterpolation = \"spline\"\n"},
        {"unknown interpolation", 11, "bearing[0].interpolation",
         "expected \"linear\" or \"spline\"", bearing + "k = 1\ninterpolation = \"cubic\"\n"},
        {"damping of a negative share", 8, "shaft.alpha", "0 or more", shaft + "alpha = -1\n"},
        {"damping in metres", 8, "shaft.beta", "expected a time in s", shaft + "beta = \"1 m\"\n"},
        {"critical modal damping", 8, "shaft.modal_damping[1]", "[0, 1)",
         shaft + "modal_damping = [0.1, 1]\n"},
        {"modes at rest of a table",
         8,
         "shaft.modal_damping",
         "the same at every speed",
         shaft + "modal_damping = [0.1]\n[[bearing]]\nz = 0\ntable = \"b.csv\"\n",
         {{"b.csv", "speed,k\n10,1\n20,2\n"}}},
        {"modes at rest of two planes", 8, "shaft.modal_damping", "do not couple x and y",
         shaft + "modal_damping = [0.1]\n[[bearing]]\nz = 0\nkxx = 1\nkxy = 1\n"},
        {"modes that turn", 8, "shaft.modal_damping", "expected an axisymmetric rotor",
         shaft + "modal_damping = [0.1]\n[[anisotropy]]\nz = 0\ndI = 0\n"},
        {"torque in newtons", 8, "shaft.axial_torque", "expected a torque in N m",
         shaft + "axial_torque = \"5 N\"\n"},
        {"torque of nobody", 8, "shaft.torque_kind", "\"semitangential\"",
         shaft + "torque_kind = \"conservative\"\n"},
    };
}

} // namespace whirl::tests

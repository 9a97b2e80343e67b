#pragma once

#include "broken_case.h"

namespace whirl::tests {

/// Mistakes in seals, operating speeds and added cross coupling.
inline std::vector<BrokenCase> broken_operation() {
    const std::string &base = sound_case;
    const std::string running = base + "[operation]\nfrom = 100\nto = 200\n"; // next is line 11
    const std::string seal = base + "[[seal]]\nz = 0.5\n";                    // on line 10
    const std::string stage = running + "[level1]\nz = 0.5\n[[level1.stage]]\npower = 1e6\n"
                                        "diameter = 0.4\n"; // next is line 16
    return {
        {"stage without a width", 13, "level1.stage[0].width", "missing, expected a length", stage},
        {"stage wider than it is large", 16, "level1.stage[0].width",
         "expected less than diameter = 0.4 m, got 12 m", stage + "width = 12\n"},
        {"blades of a density ratio", 18, "level1.stage[0].density_ratio",
         "expected none of an axial stage",
         stage + "width = 0.01\nkind = \"axial\"\ndensity_ratio = 1.2\n"},
        {"stage of another kind", 17, "level1.stage[0].kind",
         "expected \"centrifugal\" or \"axial\", got \"radial\"",
         stage + "width = 0.01\nkind = \"radial\"\n"},
        {"stage without power", 14, "level1.stage[0].power", "greater than 0, got 0",
         running + "[level1]\nz = 0.5\n[[level1.stage]]\npower = 0\ndiameter = 1\nwidth = 0.1\n"},
        {"stages and what they sum up to", 13, "level1.anticipated", "got both",
         running + "[level1]\nz = 0.5\nanticipated = 1e5\n[[level1.stage]]\npower = 1e6\n"
                   "diameter = 0.4\nwidth = 0.01\n"},
        {"operation without an end", 8, "operation.to", "missing, expected an angular speed",
         base + "[operation]\nfrom = 100\n"},
        {"operation that ends before it starts", 10, "operation.to", "more than from = 200 rad/s",
         base + "[operation]\nfrom = 200\nto = 100\n"},
        {"operation that ends before it starts, in rpm", 10, "operation.to",
         "expected more than from = \"3000 rpm\", got \"50 Hz\"",
         base + "[operation]\nfrom = \"3000 rpm\"\nto = \"50 Hz\"\n"},
        {"trip in rpm", 11, "operation.trip", "at least to = 200 rad/s, got \"1500 rpm\"",
         running + "trip = \"1500 rpm\"\n"},
        {"operation backwards", 9, "operation.from", "0 or more, got -100",
         base + "[operation]\nfrom = -100\nto = 100\n"},
        {"trip while it runs", 11, "operation.trip", "at least to = 200 rad/s, got 150",
         running + "trip = 150\n"},
        {"operation in hours", 9, "operation.from", "expected an angular speed in rad/s",
         base + "[operation]\nfrom = \"2 h\"\nto = 200\n"},
        {"key of operation", 11, "operation.max", "unknown", running + "max = 300\n"},
        {"coupling without operating speeds", 8, "level1", "expected a section [operation]",
         base + "[level1]\nz = 0.5\n"},
        {"coupling beyond the shaft", 12, "level1.z", "expected a place on the shaft, 0 to 1 m",
         running + "[level1]\nz = 1.5\n"},
        {"coupling nowhere", 11, "level1.z", "missing, expected a length", running + "[level1]\n"},
        {"coupling of one point", 13, "level1.count", "from 2 to 10000, got 1",
         running + "[level1]\nz = 0.5\ncount = 1\n"},
        {"coupling expected below zero", 13, "level1.anticipated", "greater than 0, got -1",
         running + "[level1]\nz = 0.5\nanticipated = -1\n"},
        {"seal of nothing", 8, "seal[0]", "got a seal with none", seal},
        {"seal beyond the shaft", 9, "seal[0].z", "expected a place on the shaft, 0 to 1 m",
         base + "[[seal]]\nz = 2\nk = 1\n"},
        {"seal beyond the shaft, in mm", 9, "seal[0].z",
         "expected a place on the shaft, 0 to 1 m, got \"1420 mm\"",
         base + "[[seal]]\nz = \"1420 mm\"\nk = 1\n"},
        {"seal beyond the shaft, of many digits", 9, "seal[0].z", "0 to 1 m, got 1.42 m",
         base + "[[seal]]\nz = 1.4200000000000004\nk = 1\n"},
        {"seal of negative mass", 10, "seal[0].m", "0 or more, got -1", seal + "m = -1\n"},
        {"seal on a pedestal", 11, "seal[0].pedestal_k", "unknown",
         seal + "k = 1\npedestal_k = 1\n"},
        {"seal of two stiffnesses", 10, "seal[0].k", "got both", seal + "k = 1\nkxx = 1\n"},
        {"bearing of negative mass", 11, "bearing[0].m", "0 or more, got -1",
         base + "[[bearing]]\nz = 0\nk = 1\nm = -1\n"},
    };
}

} // namespace whirl::tests

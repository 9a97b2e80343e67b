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
    const std::string to_300 = "[speeds]\nto = 300\n";      // two lines
    const std::string two = "[[bearing]]\nz = 0\nk = 1e7\n[[bearing]]\nz = 1\nk = 1e7\n";
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
        {"normal speed below the range", 11, "operation.normal",
         "at least from = 100 rad/s, got 50", running + "normal = 50\n"},
        {"normal speed above the range", 11, "operation.normal", "at most to = 200 rad/s",
         running + "normal = \"6000 rpm\"\n"},
        {"limits without operating speeds", 8, "limits", "expected a section [operation]",
         base + "[limits]\nclearance = 0.75\n"},
        {"limits of nothing", 11, "limits", "at least one of shaft", running + "[limits]\n"},
        {"limit that does not say how it is read", 11, "limits.shaft_reading",
         "missing, expected \"peak to peak\" or \"peak\"",
         running + "[limits]\nshaft = \"50 um\"\n"},
        {"velocity that does not say how it is read", 11, "limits.velocity_reading",
         "missing, expected \"rms\" or \"peak\"", running + "[limits]\nvelocity = \"4.5 mm/s\"\n"},
        {"velocity in micrometres", 12, "limits.velocity", "expected a velocity in m/s",
         running + "[limits]\nvelocity = \"50 um\"\nvelocity_reading = \"rms\"\n"},
        {"standard without a zone", 11, "limits.zone", "missing, expected \"A/B\"",
         running + "[limits]\nshaft_standard = \"iso20816-3\"\n"},
        {"standard without a group", 11, "limits.group", "missing, expected 1",
         running + "[limits]\npedestal_standard = \"iso20816-3\"\nzone = \"A/B\"\nsupport = "
                   "\"rigid\"\n"},
        {"group of no standard", 13, "limits.group", "only with pedestal_standard",
         running + "[limits]\nclearance = 1\ngroup = 1\n"},
        {"zone of a standard without zones", 13, "limits.zone", "a standard that has zones",
         running + "[limits]\nshaft_standard = \"api617\"\nzone = \"A/B\"\n"},
        {"unknown zone of a standard without zones", 13, "limits.zone", "got \"api617\" alone",
         running + "[limits]\nshaft_standard = \"api617\"\nzone = \"D\"\n"},
        {"standard that is not known", 12, "limits.shaft_standard", "expected \"api617\"",
         running + "[limits]\nshaft_standard = \"api618\"\n"},
        {"scale of no clearance", 14, "limits.scaled", "only with clearance",
         running + "[limits]\nshaft = 1e-5\nshaft_reading = \"peak\"\nscaled = false\n"},
        {"scale below one", 13, "limits.scale_most", "1 or more",
         running + "[limits]\nclearance = 1\nscale_most = 0.5\n"},
        {"key of limits", 13, "limits.shat", "unknown",
         running + "[limits]\nclearance = 1\nshat = 1\n"},
        {"probe on no pedestal", 10, "probe[0].on", "a bearing with a pedestal",
         base + "[[probe]]\nz = 0\non = \"pedestal\"\n"},
        {"probe of an unknown bearing", 10, "probe[0].bearing", "expected the name of a bearing",
         base + "[[probe]]\nz = 0\nbearing = \"x\"\n[[bearing]]\nz = 0\nk = 1\n"},
        {"probe on a pedestal at two places", 10, "probe[0].z", "got both",
         base + "[[probe]]\non = \"pedestal\"\nz = 0\nbearing = 0\n[[bearing]]\nz = 0\nk = "
                "1\npedestal_k = 1\n"},
        {"probe on a pedestal that measures against it", 10, "probe[0].relative", "reads the shaft",
         base + "[[probe]]\non = \"pedestal\"\nrelative = true\nbearing = 0\n[[bearing]]\nz = "
                "0\nk = 1\npedestal_k = 1\n"},
        {"probe nowhere", 8, "probe[0].z", "missing", base + "[[probe]]\nangle = 0\n"},
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
        {"standard runs without operating speeds", 10, "standard", "expected a section [operation]",
         base + to_300 + "[standard]\nunbalance = \"api617\"\n" + two},
        {"standard runs without speeds", 11, "standard", "expected a section [speeds]",
         running + "[standard]\nunbalance = \"api617\"\n" + two},
        {"standard runs of nothing", 13, "standard", "expected unbalance or clearances",
         running + to_300 + "[standard]\n"},
        {"imbalances of another standard", 14, "standard.unbalance", "expected \"api617\"",
         running + to_300 + "[standard]\nunbalance = \"iso\"\n" + two},
        {"imbalances of a rotor on one bearing", 14, "standard.unbalance", "two bearings",
         running + "[speeds]\nto = 300\n[standard]\nunbalance = \"api617\"\n"
                   "[[bearing]]\nz = 0\nk = 1e7\n"},
        {"imbalances of a rotor on two bearings at one place", 14, "standard.unbalance",
         "a distance between them",
         running + "[speeds]\nto = 300\n[standard]\nunbalance = \"api617\"\n"
                   "[[bearing]]\nz = 0\nk = 1e7\n[[bearing]]\nz = 0\nk = 1e7\n"},
        {"imbalances of a rotor with a balancer", 14, "standard.unbalance", "without balancers",
         running + to_300 +
             "[standard]\nunbalance = \"api617\"\n"
             "[[balancer]]\nz = 0.5\nmass = 0.01\nradius = 0.1\n" +
             two},
        {"imbalances of a rotor with two inertias", 14, "standard.unbalance",
         "the same from every direction",
         running + to_300 +
             "[standard]\nunbalance = \"api617\"\n"
             "[[anisotropy]]\nz = 0.5\ndI = 1e-3\n" +
             two},
        {"clearances without tables", 14, "standard.clearances[0]", "with table_min",
         running + to_300 + "[standard]\nclearances = [\"min\"]\n"},
        {"clearance of another kind", 14, "standard.clearances[0]", "expected \"min\" or \"max\"",
         running + to_300 + "[standard]\nclearances = [\"mean\"]\n"},
        {"clearances that are no list", 14, "standard.clearances", "expected a list",
         running + to_300 + "[standard]\nclearances = \"min\"\n"},
        {"table of a clearance alone", 11, "bearing[0].table_min", "expected it beside table",
         base + "[[bearing]]\nz = 0\nk = 1e7\ntable_min = \"min.csv\"\n"},
        {"clearance of no table", 11, "bearing[0].clearance_max", "only with table_max",
         base + "[[bearing]]\nz = 0\nk = 1e7\nclearance_max = \"0.2 mm\"\n"},
        {"clearances that change places",
         14,
         "bearing[0].clearance_max",
         "more than clearance_min = \"0.2 mm\"",
         base + "[[bearing]]\nz = 0\ntable = \"a.csv\"\ntable_min = \"a.csv\"\n"
                "clearance_min = \"0.2 mm\"\ntable_max = \"a.csv\"\n"
                "clearance_max = \"0.1 mm\"\n",
         {{"a.csv", "speed [rad/s], k\n0, 1e7\n10, 2e7\n"}}},
        {"mistake in a table of a clearance",
         2,
         "k",
         "0 or more, got \"-1\"",
         base + "[[bearing]]\nz = 0\ntable = \"a.csv\"\ntable_min = \"min.csv\"\n",
         {{"a.csv", "speed [rad/s], k\n0, 1e7\n10, 2e7\n"},
          {"min.csv", "speed [rad/s], k\n0, -1\n"}},
         "min.csv"},
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

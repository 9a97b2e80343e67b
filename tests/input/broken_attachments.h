#pragma once

#include "broken_case.h"

namespace whirl::tests {

/// Mistakes in discs, bearings and whatever else is attached to the shaft.
inline std::vector<BrokenCase> broken_attachments() {
    const std::string &base = sound_case;
    const std::string bearing = base + "[[bearing]]\nz = 0\n"; // its keys start on line 10
    const std::string ball = base + "[[balancer]]\nz = 0\nmass = 0.1\nradius = 0.1\n"; // on 12
    const std::string rows = base + "[[balancer]]\nz = 0\nrows = [";                   // on line 10
    const std::string table = bearing + "table = \"b.csv\"\n";
    return {
        {"rows and a mass", 11, "balancer[0].mass", "expected either rows or n, mass",
         rows + "{mass = 0.1, radius = 0.1}]\nmass = 1\n"},
        {"no rows", 10, "balancer[0].rows", "at least one row", rows + "]\n"},
        {"row without a radius", 10, "balancer[0].rows[0].radius", "missing, expected a length",
         rows + "{mass = 0.1}]\n"},
        {"row of a colour", 10, "balancer[0].rows[0].colour", "unknown",
         rows + "{mass = 0.1, radius = 0.1, colour = 1}]\n"},
        {"stiffness in kg", 10, "bearing[0].kxx", "expected a stiffness in N/m, got \"5 kg\"",
         bearing + "kxx = \"5 kg\"\n"},
        {"tilt stiffness", 11, "bearing[0].kt", "expected a tilt stiffness in N m/rad",
         bearing + "k = 1\nkt = \"5 N/m\"\n"},
        {"disc as a table", 8, "disc", "expected a list of tables, [[disc]], got a table",
         base + "[disc]\nz = 0\nmass = 1\n"},
        {"disc beyond the shaft", 9, "disc[0].z", "expected a place on the shaft, 0 to 1 m, got 2",
         base + "[[disc]]\nz = 2\nmass = 1\n"},
        {"disc without a place", 8, "disc[0].z", "missing, expected a length in m",
         base + "[[disc]]\nmass = 1\n"},
        {"disc without mass", 10, "disc[0].mass", "0 or more, got -1",
         base + "[[disc]]\nz = 0.5\nmass = -1\n"},
        {"inertia without mass", 10, "disc[0].mass", "greater than 0 where Id or Ip",
         base + "[[disc]]\nz = 0\nmass = 0\nId = 1\nIp = 1\n"},
        {"Id below Ip/2", 11, "disc[0].Id", "at least Ip/2 = 0.5 kg m2",
         base + "[[disc]]\nz = 0\nmass = 1\nId = 0.4\nIp = 1\n"},
        {"Id alone", 8, "disc[0].Ip", "missing, expected an inertia in kg m2",
         base + "[[disc]]\nz = 0\nmass = 1\nId = 0.4\n"},
        {"disc twice", 11, "disc[0].outer", "got both",
         base + "[[disc]]\nz = 0\nmass = 1\nouter = 0.3\n"},
        {"disc of nothing", 8, "disc[0].mass", "missing, expected mass",
         base + "[[disc]]\nz = 0\n"},
        {"hole in a disc", 10, "disc[0].inner", "below the outer one",
         base + "[[disc]]\nz = 0\ninner = 0.3\nouter = 0.2\nwidth = 0.01\n"},
        {"disc of a galaxy", 8, "disc[0]", "expected a finite mass",
         base + "[[disc]]\nz = 0\nouter = 1e200\nwidth = 1e200\n"},
        {"second bearing beyond", 12, "bearing[1].z", "expected a place on the shaft",
         bearing + "k = 1\n[[bearing]]\nz = -0.1\nk = 1\n"},
        {"bearing of nothing", 8, "bearing[0]", "got a bearing with neither",
         base + "[[bearing]]\nz = 0\nk = 0\n"},
        {"k and kxx", 10, "bearing[0].k", "got both", bearing + "k = 1e6\nkxx = 1e6\n"},
        {"negative k", 10, "bearing[0].k", "0 or more, got -1", bearing + "k = -1\n"},
        {"negative c", 11, "bearing[0].c", "0 or more, got \"-2 N s/m\"",
         bearing + "k = 1\nc = \"-2 N s/m\"\n"},
        {"floating pedestal", 8, "bearing[0].pedestal_k", "missing, expected a stiffness",
         bearing + "k = 1\npedestal_mass = 5\n"},
        {"table and k", 10, "bearing[0].table", "got both", table + "k = 1\n"},
        {"speeds that descend",
         3,
         "speed",
         "expected speeds that ascend",
         table,
         {{"b.csv", "speed,k\n10,1\n5,1\n"}},
         "b.csv"},
        {"no speeds", 1, "speed", "missing", table, {{"b.csv", "k\n10\n"}}, "b.csv"},
        {"turns or radians",
         1,
         "speed",
         "got \"1/min\"",
         table,
         {{"b.csv", "speed [1/min],k\n10,1\n"}},
         "b.csv"},
        {"anisotropy of nan", 10, "anisotropy[0].dI", "finite, got nan",
         base + "[[anisotropy]]\nz = 0\ndI = nan\n"},
        {"angle in metres", 11, "anisotropy[0].angle", "expected an angle in rad",
         base + "[[anisotropy]]\nz = 0\ndI = 0\nangle = \"3 m\"\n"},
        {"no balls", 12, "balancer[0].n", "whole number from 1", ball + "n = 0\n"},
        {"ball with an arm", 12, "balancer[0].arm", "only with kind = \"pendulum4\"",
         ball + "arm = 0.1\n"},
        {"three angles of two balls", 12, "balancer[0].position", "expected 2 angles",
         ball + "position = [0, 1, 2]\n"},
        {"unknown balancer", 12, "balancer[0].kind", "expected \"ball\" or \"pendulum4\"",
         ball + "kind = \"rings\"\n"},
        {"plane beyond the shaft", 9, "plane[0].z", "expected a place on the shaft",
         base + "[[plane]]\nz = 1.01\n"},
        {"imbalance of nothing", 8, "imbalance[0].mr", "missing, expected an imbalance in kg m",
         base + "[[imbalance]]\nz = 0\n"},
        {"probe beyond the shaft", 9, "probe[0].z", "expected a place on the shaft, 0 to 1 m",
         base + "[[probe]]\nz = -0.1\n"},
        {"probe without a place", 8, "probe[0].z", "missing, expected a length in m",
         base + "[[probe]]\nangle = 0\n"},
        {"probe that looks into metres", 10, "probe[0].angle", "expected an angle in rad",
         base + "[[probe]]\nz = 0\nangle = \"45 mm\"\n"},
        {"probe of an unknown kind", 10, "probe[0].direction", "unknown",
         base + "[[probe]]\nz = 0\ndirection = 0\n"},
        {"probe as a table", 8, "probe", "expected a list of tables, [[probe]], got a table",
         base + "[probe]\nz = 0\n"},
    };
}

/// Mistakes in the settings of the analyses.
inline std::vector<BrokenCase> broken_settings() {
    const std::string &base = sound_case;
    const std::string map = base + "[map]\nx = {path = \"speed\", from = 0, to = 9, count = 2}\n";
    return {
        {"speeds that end before they start", 10, "speeds.to", "more than from = 100 rad/s",
         base + "[speeds]\nfrom = 100\nto = 50\n"},
        {"many speeds, no end", 8, "speeds.to", "missing", base + "[speeds]\ncount = 5\n"},
        {"speeds in hours", 9, "speeds.from", "expected an angular speed in rad/s, got \"2 h\"",
         base + "[speeds]\nfrom = \"2 h\"\n"},
        {"no modes", 9, "campbell.modes", "from 1 to 1000, got 0",
         base + "[campbell]\nmodes = 0\n"},
        {"negative multiple", 9, "campbell.multiples[1]", "greater than 0, got -1",
         base + "[campbell]\nmultiples = [1, -1]\n"},
        {"no time", 8, "simulate.time", "missing, expected a time in s",
         base + "[simulate]\ntolerance = 1e-6\n"},
        {"times that descend", 10, "simulate.run_up[1]", "times that ascend",
         base + "[simulate]\ntime = 1\nrun_up = [[1, 0], [0.5, \"10 rpm\"]]\n"},
        {"angles of no balls", 10, "simulate.ball_angles", "expected 0 lists",
         base + "[simulate]\ntime = 1\nball_angles = [[0, 1]]\n"},
        {"map over nothing", 10, "map.y.path", "did you mean \"material.steel.nu\"?",
         map + "y = {path = \"material.steel.nv\", from = 0, to = 1, count = 2}\n"},
        {"map over itself", 10, "map.y.path", "or a numeric entry of the case",
         map + "y = {path = \"map.x.from\", from = 0, to = 1, count = 2}\n"},
        {"map of one column", 10, "map.y.count", "whole number from 2",
         map + "y = {path = \"shaft.segments[0].outer\", from = 0.01, to = 1, count = 1}\n"},
        {"half a map", 8, "map.y", "missing", map},
        {"a map of speed over speed", 10, "map.y", "expected another entry than x, got \"speed\"",
         map + "y = {path = \"speed\", from = 0, to = 1, count = 3}\n"},
    };
}

} // namespace whirl::tests

#pragma once

#include "broken_case.h"

namespace whirl::tests {

/// Anisotropies that no body has, balls that do not balance, balancers off the shaft.
inline std::vector<BrokenCase> broken_rotating_parts() {
    const std::string &base = sound_case;
    const std::string disc = base + "[[disc]]\nz = 0.5\nmass = 5\nId = 0.02\nIp = 0.03\n"; // 8-12
    const std::string skew = "[[anisotropy]]\nz = 0.5\n";
    const std::string ball = base + "[[balancer]]\nz = 0.5\nmass = 0.1\nradius = 0.1\n"; // 8-11
    const std::string balls = ball + "imbalance = 0.01\nn = ";                           // 12, 13
    return {
        {"anisotropy beyond half Ip", 15, "anisotropy[0].dI",
         "at most half the polar inertia of the disc there, 0.015 kg m2, got 0.01500001 kg m2",
         disc + skew + "dI = 0.01500001\n"},
        {"anisotropy beyond half Ip, negative", 15, "anisotropy[0].dI", "got 0.016 kg m2",
         disc + skew + "dI = -0.016\n"},
        // 0.01 + 0.01 exp(2 i 0.3): modulus 0.02 cos 0.3 = 0.019107.
        {"anisotropies that add up", 15, "anisotropy[0].dI", "got 0.0191067297825",
         disc + skew + "dI = 0.01\n" + skew + "dI = 0.01\nangle = 0.3\n"},
        {"anisotropy of a point mass", 13, "anisotropy[0].dI", "polar inertia of the disc there, 0",
         base + "[[disc]]\nz = 0.5\nmass = 5\n" + skew + "dI = 1e-6\n"},
        // Ip of the shaft: 7800 pi/32 0.05^4 = 0.0047860.
        {"anisotropy beyond the bare shaft", 10, "anisotropy[0].dI",
         "of the rotor (no disc stands at this place), 0.0023930", base + skew + "dI = 0.0024\n"},
        {"balls off balance", 14, "balancer[0].position",
         "mean of cosines -1/E = -0.5 and mean of sines 0 within 1e-6, got -0.41614684 and",
         balls + "2\nposition = [2, -2]\n"},
        {"balls aside", 14, "balancer[0].position", "got -0.5 and 0.8660254",
         balls + "2\nposition = [\"120 deg\", \"120 deg\"]\n"},
        {"balls too light to stand in balance", 14, "balancer[0].position", "-1/E = -2 and",
         ball + "imbalance = 0.04\nn = 2\nposition = [\"180 deg\", \"180 deg\"]\n"},
        {"balls that balance nothing", 12, "balancer[0].position", "-1/E = 0 and",
         ball + "position = [0, 0.1]\n"},
        {"one ball too heavy", 13, "balancer[0].n", "exactly 1 for one ball, got E = 2",
         ball + "imbalance = 0.005\nn = 1\n"},
        {"one ball for nothing", 12, "balancer[0].n", "got E = inf", ball + "n = 1\n"},
        {"balls off balance by their imbalance's phase", 15, "balancer[0].position",
         "got -0.5 and 0.8660254",
         balls + "2\nimbalance_phase = \"60 deg\"\nposition = [\"180 deg\", \"180 deg\"]\n"},
        {"held balls that cannot balance, without a place", 14, "balancer[0].held",
         "the place of balls that cannot balance (capacity E = n m R/(m0 R0) = 0.5), position or "
         "simulate.ball_angles, got neither",
         ball + "imbalance = 0.04\nn = 2\nheld = true\n"},
        {"held balls in two places", 14, "balancer[0].position",
         "one place of balls that are held, got another one in simulate.ball_angles[0]",
         balls + "2\nposition = [1, 2]\nheld = true\n" +
             "[simulate]\ntime = 1\nball_angles = [[1, 2.5]]\n"},
        {"held by a word", 14, "balancer[0].held", "true or false", balls + "2\nheld = \"yes\"\n"},
        {"damping ratios of a rotor with held balls", 8, "shaft.modal_damping",
         "a balancer with held = true",
         base + "modal_damping = [0.01]\n[[balancer]]\nz = 0.5\nmass = 0.1\nradius = 0.1\nheld = "
                "true\n"},
        {"another start without a balancer's balls", 14, "simulate.other_starts[0]",
         "expected 1 lists, one for each balancer, got 2",
         ball + "[simulate]\ntime = 1\nother_starts = [[[0, 1], [2, 3]]]\n"},
        {"another start with too many balls", 14, "simulate.other_starts[1][0]",
         "expected 2 angles, one for each ball, got 3",
         ball + "[simulate]\ntime = 1\nother_starts = [[[0, 1]], [[0, 1, 2]]]\n"},
        {"another start with nothing", 14, "simulate.other_starts[0]", "got none",
         ball + "[simulate]\ntime = 1\nother_starts = [[]]\n"},
        {"other starts that are one", 14, "simulate.other_starts[0]",
         "expected a list of angles for each balancer, got 0.5",
         ball + "[simulate]\ntime = 1\nother_starts = [0.5]\n"},
        {"too few points to tell the outcome", 14, "simulate.output_points", "from 400 to",
         ball + "[simulate]\ntime = 1\noutput_points = 10\n"},
        {"designs without pendulums", 13, "balance.designs",
         "expected only with a balancer of kind",
         ball + "[balance]\ndesigns = [{arm = 0.1, pivot = 0.02}]\n"},
        {"weight that is no acceleration", 9, "response.gravity",
         "expected an acceleration in m/s2, got \"5 kg\"",
         base + "[response]\ngravity = \"5 kg\"\n"},
        {"balancer beyond the shaft", 9, "balancer[0].z", "expected a place on the shaft",
         base + "[[balancer]]\nz = 1.2\nmass = 0.1\nradius = 0.1\n"},
    };
}

} // namespace whirl::tests

#pragma once

#include "broken_case.h"

namespace whirl::tests {

/// Mistakes in what moves a rotor, and in balls that touch or resist rolling.
inline std::vector<BrokenCase> broken_motion() {
    const std::string &base = sound_case;
    const std::string motion = base + "[simulate]\ntime = 1\n";                // next is line 10
    const std::string force = motion + "[[simulate.force]]\nz = 0.5\n";        // next is line 12
    const std::string harmonic = base + "[[force]]\nz = 0.5\namplitude = 1\n"; // next is line 11
    const std::string ball = base + "[[balancer]]\nz = 0.5\nmass = 0.1\nradius = 0.1\n"; // 8-11
    return {
        {"harmonic force of no frequency", 8, "force[0].multiple",
         "missing, expected the multiple of the spin speed at which the force acts, or its "
         "frequency",
         harmonic},
        {"harmonic force of two frequencies", 12, "force[0].frequency",
         "expected either multiple (of the spin speed) or frequency, got both",
         harmonic + "multiple = 2\nfrequency = \"50 Hz\"\n"},
        {"harmonic force against itself", 10, "force[0].amplitude", "0 or more, got -1",
         base + "[[force]]\nz = 0.5\namplitude = -1\nmultiple = 2\n"},
        {"harmonic force at rest", 11, "force[0].frequency", "greater than 0, got 0",
         harmonic + "frequency = 0\n"},
        {"harmonic force along z", 12, "force[0].direction",
         "expected \"x\" or \"y\" or \"forward\" or \"backward\", got \"z\"",
         harmonic + "multiple = 2\ndirection = \"z\"\n"},
        {"harmonic force beside the shaft", 9, "force[0].z", "expected a place on the shaft",
         base + "[[force]]\nz = 1.5\namplitude = 1\nmultiple = 2\n"},
        {"harmonic force with a torque's unit", 10, "force[0].amplitude",
         "expected a force in N, 0 or more, got \"5 N m\"",
         base + "[[force]]\nz = 0.5\namplitude = \"5 N m\"\nmultiple = 2\n"},
        {"receptance at no frequency", 8, "response.frequencies",
         "missing, expected receptance (between which stations) and frequencies",
         base + "[response]\nreceptance = {from = 0, to = 1}\n"},
        {"receptance from beside the shaft", 9, "response.receptance.from",
         "expected a place on the shaft, 0 to 1 m, got -1",
         base + "[response]\nreceptance = {from = -1, to = 1}\nfrequencies = {to = 100}\n"},
        {"second receptance to beside the shaft", 9, "response.receptance[1].to",
         "expected a place on the shaft, 0 to 1 m, got 2",
         base + "[response]\nreceptance = [{from = 0, to = 1}, {from = 0, to = 2}]\n"
                "frequencies = {to = 100}\n"},
        {"receptance over falling frequencies", 10, "response.frequencies.to",
         "expected more than from = 200 rad/s, got 100",
         base + "[response]\nreceptance = {from = 0, to = 1}\n"
                "frequencies = {from = 200, to = 100}\n"},
        {"run-up to nowhere", 10, "simulate.run_up.to", "missing, expected an angular speed",
         motion + "run_up = {from = 0, duration = 5}\n"},
        {"run-up in no time", 10, "simulate.run_up.duration", "greater than 0, got 0",
         motion + "run_up = {to = 100, duration = 0}\n"},
        {"run-up that is a number", 10, "simulate.run_up",
         "expected a list of pairs [time, speed] or {from, to, duration}, got 5",
         motion + "run_up = 5\n"},
        {"start in motion", 10, "simulate.start", "expected \"rest\" or \"steady\"",
         motion + "start = \"moving\"\n"},
        {"blade that leaves too late", 12, "simulate.imbalance[0].time",
         "before the end of the motion, 1 s, got 2 s",
         motion + "[[simulate.imbalance]]\nz = 0.5\ntime = 2\nmr = 1e-3\n"},
        {"blade beside the shaft", 11, "simulate.imbalance[0].z", "expected a place on the shaft",
         motion + "[[simulate.imbalance]]\nz = 1.5\ntime = 0.2\nmr = 1e-3\n"},
        {"force of nothing", 10, "simulate.force[0].x",
         "missing, expected a force in N in x or in y", force},
        {"force that ends before it begins", 14, "simulate.force[0].to",
         "expected more than from = 0.5 s, got 0.1 s", force + "x = 1\nfrom = 0.5\nto = 0.1\n"},
        {"foundation two ways",
         12,
         "simulate.base.x",
         "expected either a table or a harmonic acceleration, got both",
         motion + "[simulate.base]\ntable = \"base.csv\"\nx = 1\n",
         {{"base.csv", "time,x\n0,1\n1,2\n"}}},
        {"steady start with balls", 15, "simulate.start", "expected \"rest\" where the rotor has",
         ball + "imbalance = 0.01\n[simulate]\ntime = 1\nstart = \"steady\"\n"},
        {"restitution of nothing", 12, "balancer[0].restitution", "only with contact = true",
         ball + "restitution = 0.5\n"},
        {"restitution above one", 13, "balancer[0].restitution", "in [0, 1], got 1.5",
         ball + "contact = true\nrestitution = 1.5\n"},
        {"balls without room", 14, "balancer[0].contact",
         "expected balls that fit beside each other in their race, got 20 of 0.05 m",
         ball + "n = 20\nball_diameter = 0.05\ncontact = true\n"},
        {"ball larger than its race", 12, "balancer[0].ball_diameter", "less than twice the radius",
         ball + "ball_diameter = 0.3\n"},
        {"contact under a motor", 15, "simulate.torque", "expected a prescribed speed",
         ball + "contact = true\n[simulate]\ntime = 1\ntorque = 5\n"},
    };
}

} // namespace whirl::tests

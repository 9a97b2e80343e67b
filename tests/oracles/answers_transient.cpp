#include "oracles/answers.h"
#include "oracles/duhamel.h"

#include <cmath>

namespace whirl::oracles {

namespace {

using Long = Duhamel::Long;
using Complex = Duhamel::Complex;

/// A point mass on the sum of the springs and dampers; half way between equal supports translation
/// and tilt do not mix.
Duhamel::Spring spring_of(const CaseRotor &rotor) {
    if (!rotor.rigid || rotor.discs.size() != 1 || rotor.supports.size() != 2)
        no_answer("simulate: more than one disc on two supports");
    Duhamel::Spring spring{rotor.discs.front().mass, 0, 0};
    for (const Support &support : rotor.supports) {
        spring.stiffness += support.k[0][0];
        spring.damping += support.c[0][0];
    }
    return spring;
}

Complex turned(const Imbalance &imbalance, const Ramp &ramp, Long t) {
    return ramp.force(imbalance.mr, t) * std::exp(Complex(0, imbalance.phase));
}

Duhamel::Peak peak_of(const CaseRotor &rotor, const Ramp &ramp) {
    const Duhamel::Spring spring = spring_of(rotor);
    const auto force = [&](Long t) {
        Complex sum = 0;
        for (const Imbalance &imbalance : rotor.imbalances)
            sum += turned(imbalance, ramp, t);
        for (const SuddenImbalance &sudden : rotor.run_up.sudden)
            if (t > sudden.time)
                sum += turned(sudden.imbalance, ramp, t);
        return sum;
    };
    Duhamel::Motion start{0, 0};
    if (rotor.run_up.steady_start) {
        const Complex swing(0, ramp.from);
        Complex load = 0;
        for (const Imbalance &imbalance : rotor.imbalances)
            load += ramp.from * ramp.from * imbalance.mr * std::exp(Complex(0, imbalance.phase));
        start.w = load / (spring.stiffness + swing * spring.damping + swing * swing * spring.mass);
        start.v = swing * start.w;
    }
    // Panels end where the force jumps.
    Long panel = 0.2L / std::sqrt(spring.stiffness / spring.mass);
    const Long jump = !rotor.run_up.sudden.empty() ? rotor.run_up.sudden.front().time
                      : ramp.duration > 0          ? ramp.duration
                                                   : Long(rotor.time);
    panel = jump / std::ceil(jump / panel);
    return Duhamel::largest(spring, force, panel, rotor.time, start);
}

} // namespace

Answer answer_transient(const Request &request) {
    const CaseRotor &rotor = request.rotor;
    const RunUp &run_up = rotor.run_up;
    const Ramp ramp{run_up.from, run_up.to, run_up.duration};
    const Duhamel::Spring spring = spring_of(rotor);
    const Long natural = std::sqrt(spring.stiffness / spring.mass);
    const Long ratio = spring.damping / (2 * spring.mass * natural);
    const std::string path = request.path.substr(request.path.rfind('/') + 1);
    if (path == "peak")
        return {"Duhamel's integral", {static_cast<Real>(peak_of(rotor, ramp).value)}, {}, {}};
    if (path == "peak_speed")
        return {"Duhamel's integral",
                {static_cast<Real>(ramp.speed(peak_of(rotor, ramp).time))},
                {},
                {}};
    if (path == "steady_peak" && rotor.imbalances.size() == 1)
        return {"closed form of the damped oscillator",
                {static_cast<Real>(rotor.imbalances.front().mr / spring.mass /
                                   (2 * ratio * std::sqrt(1 - ratio * ratio)))},
                {},
                {}};
    if (path == "steady_peak_speed")
        return {"closed form of the damped oscillator",
                {static_cast<Real>(natural / std::sqrt(1 - 2 * ratio * ratio))},
                {},
                {}};
    no_answer("simulate: no oracle for " + request.path);
}

} // namespace whirl::oracles

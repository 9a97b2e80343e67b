// Whirl speeds, critical speeds and responses.

#include "oracles/answers.h"
#include "oracles/continuum_spectrum.h"
#include "oracles/dense_rotor.h"
#include "oracles/forces.h"
#include "oracles/influence.h"
#include "oracles/rigid_rotor.h"
#include "oracles/weight.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace whirl::oracles {

namespace {

/// A uniform shaft rigid in shear on two supports as stiff as pins: nothing else on it.
bool pinned_rayleigh(const CaseRotor &rotor) {
    return rotor.shaft.size() == 1 && rotor.discs.empty() && rotor.supports.size() == 2 &&
           rotor.shaft[0].left.kappa >= 1e6 && rotor.supports[0].k[0][0] >= 1e13 &&
           rotor.supports[1].k[0][0] >= 1e13;
}

std::vector<Complex> eigenvalues(const Request &request, std::string &oracle) {
    const CaseRotor &rotor = request.rotor;
    const double speed = rotor.speed_from;
    std::vector<Complex> out;
    if (pinned_rayleigh(rotor)) {
        oracle = "closed form of the pinned shaft";
        for (const Real omega : pinned_rayleigh_frequencies(rotor.shaft[0].left, speed,
                                                            static_cast<int>(request.wanted)))
            out.emplace_back(0, omega);
    } else if (rotor.classical) {
        oracle = "dense two-node elements";
        for (const auto &lambda : whirl_eigenvalues(dense_rotor(rotor.at_speed(speed)), speed))
            out.emplace_back(lambda);
    } else {
        oracle = "transfer matrix";
        if (rotor.axial_force != 0)
            no_answer("the transfer matrix has no axial force");
        out = continuum_eigenvalues(rotor, speed, static_cast<int>(request.wanted));
    }
    return out;
}

/// Values next to each other of one motion, listed once.
std::vector<Real> once(std::vector<Real> values) {
    const auto same = [](Real a, Real b) { return b - a < 1e-12L * b; };
    values.erase(std::unique(values.begin(), values.end(), same), values.end());
    return values;
}

/// det[K - W^2 (M - G -+ a)] of one disc on a massless shaft, or of both bending stiffnesses.
std::vector<Real> massless_critical_speeds(const CaseRotor &rotor) {
    Real dI = 0;
    for (const InertialAnisotropy &item : rotor.anisotropies)
        dI += static_cast<Real>(item.dI);
    std::vector<Real> out;
    for (const int sign : {-1, 1}) {
        Lumps lumps = lumps_of(rotor, 0);
        lumps.tilt.front() += sign * dI;
        for (const Real speed : lumped_critical_speeds(MasslessShaft(rotor, 1, sign), lumps))
            out.push_back(speed);
    }
    std::sort(out.begin(), out.end());
    return once(out);
}

} // namespace

Answer answer_campbell(const Request &request) {
    Answer out;
    if (request.path == "crossings") {
        if (!request.rotor.classical)
            no_answer("crossings: two-node elements only");
        out.oracle = "dense two-node elements";
        for (const Crossing &c : crossings(dense_rotor(request.rotor), request.multiple))
            if (c.speed <= request.rotor.speed_to)
                out.values.push_back(c.speed);
        return out;
    }
    for (const Complex &lambda : eigenvalues(request, out.oracle)) {
        if (request.path == "frequencies")
            out.values.push_back(lambda.imag());
        else if (request.path == "real")
            out.values.push_back(lambda.real());
        else if (request.path == "natural_frequencies")
            out.values.push_back(std::abs(lambda));
        else if (request.path == "damping_ratio")
            out.values.push_back(-lambda.real() / std::abs(lambda));
        else
            no_answer("campbell: no oracle for " + request.path);
    }
    return out;
}

Answer answer_critical(const Request &request) {
    const CaseRotor &rotor = request.rotor;
    if (request.path.rfind("/margins", 0) == 0)
        return answer_operation(request);
    if (request.path != "critical_speeds")
        no_answer("critical: no oracle for " + request.path);
    if (rotor.rigid && !rotor.balancers.empty())
        return {
            "closed form of the composite rotor", split_resonances(composite_rotor(rotor)), {}, {}};
    if (rotor.rigid)
        return {"closed form of the anisotropic rotor",
                once(split_resonances(bare_rotor(rotor))),
                {},
                {}};
    if (rotor.classical) {
        if (rotor.damped())
            no_answer("critical speeds with damping: no oracle");
        Answer out;
        out.oracle = "dense two-node elements";
        for (const Crossing &c : crossings(dense_rotor(rotor))) {
            out.values.push_back(c.speed);
            out.whirl.emplace_back(c.forward ? "forward" : "backward");
        }
        return out;
    }
    if (rotor.discs.size() == 1)
        return {"influence coefficients", massless_critical_speeds(rotor), {}, {}};
    no_answer("critical: no oracle for this rotor");
}

// Golden section, which finds the place to the root of rounding, then vertices of parabolas through
// points where the curve has fallen by 1e-4 and half as far out, extrapolated to none.
double top_between(const std::function<double(double)> &f, double low, double high) {
    const double golden = (std::sqrt(5.0) - 1) / 2;
    double left = high - golden * (high - low);
    double right = low + golden * (high - low);
    double at_left = f(left);
    double at_right = f(right);
    while (high - low > 1e-8 * high) {
        if (at_left < at_right) {
            low = left;
            left = right;
            at_left = at_right;
            at_right = f(right = low + golden * (high - low));
        } else {
            high = right;
            right = left;
            at_right = at_left;
            at_left = f(left = high - golden * (high - low));
        }
    }
    const double top = (low + high) / 2;
    const double value = f(top);
    double h = 1e-7 * top;
    while (f(top + h) > value * (1 - 1e-4))
        h *= 1.5;
    const auto vertex = [&](double d) {
        const double below = f(top - d);
        const double above = f(top + d);
        return top + d / 2 * (below - above) / (below - 2 * value + above);
    };
    return (4 * vertex(h / 2) - vertex(h)) / 3;
}

namespace {

/// Local maxima of the semi-major axis over the range of the case: where it is larger than at both
/// neighbours among many speeds.
Answer response_peaks(const Request &request, bool speeds) {
    const CaseRotor &rotor = request.rotor;
    const auto size = [&](double speed) { return semi_major(rotor, speed, request.node); };
    constexpr int steps = 400;
    const double step = (rotor.speed_to - rotor.speed_from) / steps;
    std::vector<double> at;
    for (int i = 0; i <= steps; ++i)
        at.push_back(size(rotor.speed_from + i * step));
    Answer out{"dense two-node elements, looked for at many speeds", {}, {}, {}};
    for (std::size_t i = 1; i < steps; ++i) {
        if (at[i] <= at[i - 1] || at[i] <= at[i + 1])
            continue;
        const double top = top_between(size, rotor.speed_from + static_cast<double>(i - 1) * step,
                                       rotor.speed_from + static_cast<double>(i + 1) * step);
        out.values.push_back(speeds ? top : size(top));
    }
    return out;
}

/// Motion of the disc under its weight.
Answer under_weight(const Request &request) {
    const CaseRotor &rotor = request.rotor;
    if (rotor.discs.size() != 1 || rotor.discs[0].z != request.node)
        no_answer("response: the weight of one disc on a massless shaft only");
    Answer out{"massless shaft by influence coefficients, harmonic balance", {}, {}, {}};
    if (request.path.find("peak") == std::string::npos) {
        const WeightMotion motion = disc_under_weight(rotor, rotor.gravity, rotor.speed_from);
        out.values = {request.path == "static" ? motion.still : motion.twice};
        return out;
    }
    out.values = weight_peaks(rotor, rotor.gravity);
    if (request.path == "twice_peak_values")
        for (Real &value : out.values)
            value = disc_under_weight(rotor, rotor.gravity, value).twice;
    return out;
}

/// Numbers of the disc under each of the forces, and of its receptance, at JSON pointers.
Answer of_forces(const Request &request) {
    const CaseRotor &rotor = request.rotor;
    const Real speed = rotor.speed_from;
    const std::string &path = request.path;
    const std::string key = path.substr(path.rfind('/') + 1);
    Answer out;
    out.oracle = "massless shaft, a force and its image that turn";
    const auto number_of = [&key](Complex value) {
        return key.find("phase") == std::string::npos ? std::abs(value) : std::arg(value);
    };
    if (path.rfind("/receptance/receptances/0/", 0) == 0) {
        for (const double frequency : rotor.frequencies) {
            const DiscReceptance at = disc_receptance(rotor, speed, frequency);
            out.values.push_back(
                number_of(path.find("/yx/") == std::string::npos ? at.along : at.across));
        }
        return out;
    }
    const std::size_t which = path.rfind("/forces/1/", 0) == 0 ? 1 : 0;
    const HarmonicForce &force = rotor.forces.at(which);
    const Real frequency = force.multiple > 0 ? force.multiple * speed : Real(force.frequency);
    const DiscReceptance at = disc_receptance(rotor, speed, frequency);
    const Complex push = std::polar(static_cast<Real>(force.amplitude), Real(force.phase));
    const bool y = key.front() == 'y';
    if (force.turns && y)
        no_answer("y of a circle");
    out.values = {number_of(push * (force.turns ? at.round : y ? at.across : at.along))};
    return out;
}

} // namespace

Answer answer_response(const Request &request) {
    const CaseRotor &rotor = request.rotor;
    if (request.path.rfind("/margins", 0) == 0 || request.path.rfind("/runs", 0) == 0)
        return answer_operation(request);
    if (request.path == "static" || request.path.rfind("twice", 0) == 0)
        return under_weight(request);
    if (request.path.rfind("/forces/", 0) == 0 || request.path.rfind("/receptance/", 0) == 0)
        return of_forces(request);
    if (request.path == "peak_speeds" || request.path == "peak_values") {
        if (!rotor.classical)
            no_answer("response: peaks of classical elements only");
        return response_peaks(request, request.path == "peak_speeds");
    }
    if (request.path != "major")
        no_answer("response: semi-major axes and peaks only");
    // Four parts of every element of higher order: an error of 1e-4 in sharp peaks
    const int parts = rotor.classical ? 1 : 4;
    return {rotor.classical ? "dense two-node elements" : "dense two-node elements, refined",
            {semi_major(rotor, rotor.speed_from, request.node, parts)},
            {},
            {}};
}

} // namespace whirl::oracles

// Critical speeds against operating speeds, and stability under added cross coupling.

#include "oracles/answers.h"
#include "oracles/dense_rotor.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace whirl::oracles {

namespace {

using Cplx = std::complex<double>;

/// Place where a function with values of two signs at the ends is zero: bisection.
double zero_between(const std::function<double(double)> &f, double low, double high) {
    const bool rises = f(low) < 0;
    for (int i = 0; i < 200 && high - low > 1e-15 * high; ++i) {
        const double middle = (low + high) / 2;
        ((f(middle) < 0) == rises ? low : high) = middle;
    }
    return (low + high) / 2;
}

/// A critical speed by the probe that reads most there.
struct ProbePeak {
    double speed = 0, value = 0, amplification = 0;
};

/// The peak of a curve over speed between two speeds, with its half-power points.
ProbePeak peak_between(const std::function<double(double)> &reading, double low, double high) {
    ProbePeak out;
    out.speed = top_between(reading, low, high);
    out.value = reading(out.speed);
    const auto over = [&](double speed) { return reading(speed) - out.value / std::sqrt(2.0); };
    double below = out.speed;
    double above = out.speed;
    while (over(below) > 0)
        below *= 0.98;
    while (over(above) > 0)
        above *= 1.02;
    out.amplification =
        out.speed / (zero_between(over, out.speed, above) - zero_between(over, below, out.speed));
    return out;
}

/// The lowest peak of the probes in the range of the case; of the probe that reads most.
ProbePeak lowest_peak(const CaseRotor &rotor) {
    constexpr int steps = 300;
    ProbePeak best;
    for (const Probe &probe : rotor.probes) {
        const auto at = [&](int i) {
            return rotor.speed_from + (rotor.speed_to - rotor.speed_from) * i / steps;
        };
        double before = 0;
        double here = 0;
        for (int i = 1; i <= steps; ++i) {
            const double next = probe_reading(rotor, at(i), probe);
            if (here > before && here > next) {
                const ProbePeak peak =
                    peak_between([&](double speed) { return probe_reading(rotor, speed, probe); },
                                 at(i - 2), at(i));
                if (peak.value > best.value)
                    best = peak;
                break;
            }
            before = here;
            here = next;
        }
    }
    return best;
}

/// A number of a row of the operating speeds: at each of them every probe, every support, every
/// pedestal. Probes say what they measure against.
double operating_number(const CaseRotor &rotor, const std::string &path) {
    std::vector<double> speeds{rotor.operation.from};
    for (const double speed : {rotor.operation.normal, rotor.operation.to, rotor.operation.trip})
        if (speed > 0)
            speeds.push_back(speed);
    std::size_t used = 0;
    const std::size_t row = std::stoul(path, &used);
    const std::string key = path.substr(used + 1);
    std::vector<std::size_t> pedestals;
    for (std::size_t i = 0; i < rotor.mounts.size(); ++i)
        if (rotor.mounts[i].pedestal_k[0] > 0)
            pedestals.push_back(i);
    const std::size_t probes = rotor.probes.size();
    const std::size_t supports = rotor.supports.size();
    const std::size_t rows = probes + supports + pedestals.size();
    const double speed = speeds.at(row / rows);
    const std::size_t at = row % rows;
    const ForcedPlaces places = forced_places(rotor, speed);
    if (key == "force" && at >= probes && at < probes + supports)
        return major_of(places.forces[at - probes]);
    const double amplitude = at < probes ? probe_reading(rotor, speed, rotor.probes[at])
                             : at < probes + supports
                                 ? major_of(places.films[at - probes])
                                 : major_of(places.pedestals[pedestals[at - probes - supports]]);
    if (key == "amplitude")
        return amplitude;
    if (key == "velocity")
        return speed * amplitude;
    if (key == "value") // of a pedestal, velocity rms
        return speed * amplitude / std::sqrt(2.0);
    no_answer("operating speeds: no oracle for " + key);
}

/// 17 (1 - 1/(AF - 1.5)) % of the minimum operating speed, at most 16 %, for peaks below it.
double number_of(const std::string &key, const ProbePeak &peak, const Operation &operation) {
    if (key == "speed")
        return peak.speed;
    if (key == "amplification")
        return peak.amplification;
    if (key == "found")
        return 100 * (operation.from - peak.speed) / operation.from;
    if (key == "required")
        return std::min(16.0, 17 * (1 - 1 / (peak.amplification - 1.5)));
    no_answer("margins: no oracle for " + key);
}

/// The rotor at its highest operating speed.
struct Running {
    explicit Running(const CaseRotor &rotor)
        : dense(dense_rotor(rotor.at_speed(rotor.operation.to))), speed(rotor.operation.to),
          at(dense.deflection(rotor.operation.level1_z)) {}
    DenseRotor dense;
    double speed;
    Eigen::Index at; ///< x there; y lies planar() further

    /// q with which the forward one of the two motions at the place goes round at w for ever: with
    /// H the receptance there and F = -q J u, u = H F, J = [0 1; -1 0], 1/q is an eigenvalue of -H
    /// J.
    [[nodiscard]] Cplx coupling(double w) const {
        const Eigen::Index n = dense.planar();
        const Eigen::MatrixXcd Z =
            dense.K + speed * dense.Kc - w * w * dense.M + Cplx(0, w) * (dense.C + speed * dense.G);
        Eigen::MatrixXcd unit = Eigen::MatrixXcd::Zero(2 * n, 2);
        unit(at, 0) = unit(n + at, 1) = 1;
        const Eigen::MatrixXcd u = Z.partialPivLu().solve(unit);
        Eigen::Matrix2cd H;
        H << u(at, 0), u(at, 1), u(n + at, 0), u(n + at, 1);
        Eigen::Matrix2cd J;
        J << 0, 1, -1, 0;
        const Eigen::Vector2cd inverse =
            Eigen::ComplexEigenSolver<Eigen::MatrixXcd>(Eigen::MatrixXcd(-H * J), false)
                .eigenvalues();
        return 1.0 / (inverse[0].real() > inverse[1].real() ? inverse[0] : inverse[1]);
    }
    /// The eigenvalue nearest to one, with coupling q.
    [[nodiscard]] Cplx eigenvalue(double q, Cplx near) const {
        DenseRotor coupled = dense;
        const Eigen::Index n = dense.planar();
        coupled.K(at, n + at) += q;
        coupled.K(n + at, at) -= q;
        const auto all = whirl_eigenvalues(coupled, speed);
        return *std::min_element(all.begin(), all.end(), [near](Cplx a, Cplx b) {
            return std::abs(a - near) < std::abs(b - near);
        });
    }
};

/// The slowest whirl that some coupling keeps going.
double border_frequency(const Running &running) {
    const auto imaginary = [&](double w) { return running.coupling(w).imag(); };
    constexpr int steps = 200;
    for (int i = 1; i < steps; ++i) {
        const double low = running.speed * i / steps;
        const double high = running.speed * (i + 1) / steps;
        if (imaginary(low) < 0 && imaginary(high) >= 0)
            return zero_between(imaginary, low, high);
    }
    no_answer("level1: no whirl that cross coupling keeps going");
}

double log_dec(const Running &running, double w, double from, double to) {
    constexpr int steps = 100;
    Cplx l(0, w);
    for (int i = 1; i <= steps; ++i)
        l = running.eigenvalue(from + (to - from) * i / steps, l);
    return -2 * std::numbers::pi * l.real() / l.imag();
}

// Of [standard]: rotors that are the same from either end, with two clearances of their bearings.

/// "/runs/3/margins/0/speed": 3 and "/margins/0/speed".
std::pair<std::size_t, std::string> entry_of(const std::string &path, const std::string &list) {
    std::size_t used = 0;
    const std::size_t index = std::stoul(path.substr(list.size()), &used);
    return {index, path.substr(list.size() + used)};
}

CaseRotor with_clearance(CaseRotor rotor, std::size_t index) {
    rotor.tables = rotor.tables_of_clearances.at(index);
    return rotor;
}

double mass_of(const CaseRotor &rotor) {
    double mass = 0;
    for (const Segment &s : rotor.shaft)
        mass += s.left.rho * std::numbers::pi / 4 * s.left.length *
                (s.left.outer * s.left.outer - s.left.inner * s.left.inner);
    for (const RigidDisc &disc : rotor.discs)
        mass += disc.mass;
    return mass;
}

/// Twice 4 W/N oz in, W in lb, N in rpm: of the whole rotor at mid-span, where its first bending
/// mode deflects most because it is the same from either end.
Imbalance first_bending(const CaseRotor &rotor) {
    constexpr double lb = 0.45359237;
    constexpr double ounce_inch = lb / 16 * 0.0254; // kg m
    const double rpm = rotor.operation.to * 30 / std::numbers::pi;
    return {rotor.length() / 2, 2 * 4 * (mass_of(rotor) / lb) / rpm * ounce_inch, 0};
}

/// The run `first bending`, the first with the least clearance; any other: with the largest.
Answer of_run(const Request &request, std::size_t index, const std::string &path) {
    Request own = request;
    own.rotor = with_clearance(request.rotor, index == 0 ? 0 : 1);
    own.rotor.imbalances = {first_bending(request.rotor)};
    own.path = path;
    if (path == "/unbalance/0/mr")
        return {"4 W/N oz in by hand", {own.rotor.imbalances[0].mr}, {}, {}};
    if (path == "/unbalance/0/z")
        return {"symmetry", {own.rotor.imbalances[0].z}, {}, {}};
    const std::string resonance = "/resonances/0/";
    if (path.rfind(resonance, 0) != 0)
        return answer_operation(own);
    const auto middle = [&](double speed) {
        return semi_major(own.rotor, speed, own.rotor.length() / 2);
    };
    const ProbePeak near = lowest_peak(own.rotor); // of the probes: at nearly the same speed
    constexpr double around = 0.05;
    return {"dense two-node elements, half-power points",
            {number_of(path.substr(resonance.size()),
                       peak_between(middle, (1 - around) * near.speed, (1 + around) * near.speed),
                       own.rotor.operation)},
            {},
            {}};
}

/// The largest growth over the speeds of the case, of motions no faster than the rotor.
double growth_of(const CaseRotor &rotor) {
    double largest = -HUGE_VAL;
    for (int i = 0; i < rotor.speed_count; ++i)
        for (const Cplx l :
             whirl_eigenvalues(dense_rotor(rotor.at_speed(rotor.speed(i))), rotor.speed(i)))
            if (std::abs(l) <= rotor.speed(i))
                largest = std::max(largest, l.real());
    return largest;
}

} // namespace

Answer answer_operation(const Request &request) {
    const CaseRotor &rotor = request.rotor;
    if (!rotor.classical)
        no_answer("operating speeds: two-node elements only");
    if (request.path.rfind("/runs/", 0) == 0) {
        const auto [index, rest] = entry_of(request.path, "/runs/");
        return of_run(request, index, rest);
    }
    if (request.path.rfind("/clearances/", 0) == 0) {
        const auto [index, rest] = entry_of(request.path, "/clearances/");
        Request own = request;
        own.rotor = with_clearance(rotor, index);
        own.path = rest;
        return rest == "/growth" ? Answer{"dense two-node elements", {growth_of(own.rotor)}, {}, {}}
                                 : answer_operation(own);
    }
    const std::string margins = "/margins/0/";
    if (request.path.rfind(margins, 0) == 0)
        return {
            "dense two-node elements, half-power points",
            {number_of(request.path.substr(margins.size()), lowest_peak(rotor), rotor.operation)},
            {},
            {}};
    const std::string operating = "/operating/";
    if (request.path.rfind(operating, 0) == 0)
        return {"dense two-node elements, supports and pedestals",
                {operating_number(rotor, request.path.substr(operating.size()))},
                {},
                {}};
    const Running running(rotor);
    const double w = border_frequency(running);
    const double q = running.coupling(w).real();
    Answer out{"dense two-node elements, receptance at the place", {}, {}, {}};
    if (request.path == "/level1/critical_cross_coupling")
        out.values = {q};
    else if (request.path == "/level1/critical_frequency")
        out.values = {w};
    else if (request.path == "/level1/anticipated_log_dec")
        out.values = {log_dec(running, w, q, rotor.operation.anticipated)};
    else if (request.path == "/level1/log_dec/0")
        out.values = {log_dec(running, w, q, 0)};
    else
        no_answer("operating speeds: no oracle for " + request.path);
    return out;
}

} // namespace whirl::oracles

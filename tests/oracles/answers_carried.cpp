// Rings and several rows of balls on a rigid rotor.

#include "oracles/answers.h"
#include "oracles/ball_motion.h"
#include "oracles/balls.h"
#include "oracles/carried.h"
#include "oracles/rotating_state.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::oracles {

namespace {

const std::string of_lagrange = "Lagrange's equations of all balls or rings";

/// Where something grows; `noise` is above the rounding of the roots that are zero (the family of
/// positions, rings that turn about themselves).
std::vector<Band> unstable(const CaseRotor &rotor, Real to) {
    constexpr Real noise = 1e-13L;
    const std::vector<Real> angles = balanced_angles(rotor);
    return bands_where(
        [&](Real speed) { return grows(CarriedRotor(rotor, speed).eigenvalues(angles), noise); },
        rotor.speed_from, to, 240);
}

/// Largest real part of what is not zero for all speeds, 1/s.
Real growth(const CaseRotor &rotor) {
    Real out = -std::numeric_limits<Real>::infinity();
    for (const Complex &lambda :
         CarriedRotor(rotor, rotor.speed_from).eigenvalues(balanced_angles(rotor)))
        if (std::abs(lambda) > 1e-9L * rotor.speed_from)
            out = std::max(out, lambda.real());
    return out;
}

/// Sum of m R^2 exp(2 i alpha) over sum of m R^2.
Complex weighted_harmonic(const CaseRotor &rotor) {
    const std::vector<Bead> beads = beads_of(rotor);
    const std::vector<Real> angles = balanced_angles(rotor);
    Complex sum = 0;
    Real weight = 0;
    for (std::size_t k = 0; k < beads.size(); ++k) {
        const Real inertia = beads[k].mass * beads[k].radius * beads[k].radius;
        sum += inertia * std::polar(Real(1), 2 * angles[k]);
        weight += inertia;
    }
    return sum / weight;
}

Answer shown(const CaseRotor &rotor, const std::string &path) {
    const std::string position = "balanced position";
    const Balancer &balancer = rotor.balancers.front();
    if (path == "/balancers/0/E")
        return {position, {capacity(balancer)}, {}, {}};
    if (path == "/balancers/0/D_c")
        return {position, {weighted_harmonic(rotor).real()}, {}, {}};
    if (path == "/balancers/0/D_interval") {
        const HarmonicInterval interval = harmonic_interval(balancer.rows, balancer.imbalance);
        return {"search over balanced positions", {interval.least, interval.most}, {}, {}};
    }
    if (path == "/Ip") {
        Real sum = bare_rotor(rotor).C;
        for (const Bead &bead : beads_of(rotor))
            sum += bead.mass * bead.radius * bead.radius + bead.inertia;
        return {"sum over the parts", {sum}, {}, {}};
    }
    no_answer("show: no oracle for " + path);
}

Answer balanced(const CaseRotor &rotor, const std::string &path) {
    if (path == "/balanced_position/bands/0") {
        const std::vector<Band> bands = unstable(rotor, rotor.speed_to);
        if (bands.size() != 1 || bands[0].first > rotor.speed_from)
            no_answer("balance: stable above one speed only");
        return {of_lagrange, {bands[0].second, static_cast<Real>(rotor.speed_to)}, {}, {}};
    }
    const RigidRotor body = bare_rotor(rotor);
    if (path == "/planes/0/bands/0" && body.k1 == 0 && body.c1 == 0 &&
        static_cast<Real>(rotor.planes.front()) == body.centre)
        // translation alone: Re 1/(k - M W^2 + i c W) < 0
        return {"one mass on a spring",
                {std::sqrt(body.k0 / body.mass), static_cast<Real>(rotor.speed_to)},
                {},
                {}};
    no_answer("balance: no oracle for " + path);
}

Answer moved(const CaseRotor &rotor, const std::string &path) {
    if (path == "/linear_growth")
        return {of_lagrange, {growth(rotor)}, {}, {}};
    const BallOutcome end = ball_motion(rotor, rotor.speed_from, rotor.ball_angles, rotor.time);
    if (path == "/outcome")
        return {of_lagrange + " in time", {}, end.name(), {}};
    if (path == "/balls/0/0")
        return {of_lagrange + " in time", {end.angles.at(0).at(0)}, {}, {}};
    no_answer("simulate: no oracle for " + path);
}

} // namespace

Answer answer_carried(const Request &request) {
    const CaseRotor &rotor = request.rotor;
    if (!rotor.rigid)
        no_answer("rings and rows of balls: on a rigid rotor only");
    if (request.command == "show")
        return shown(rotor, request.path);
    if (request.command == "balance")
        return balanced(rotor, request.path);
    if (request.command == "simulate")
        return moved(rotor, request.path);
    if (request.command != "stability")
        no_answer("rings and rows of balls: no oracle for the command " + request.command);
    const std::vector<Band> bands = unstable(rotor, rotor.speed_to);
    if (request.path == "/unstable")
        return {of_lagrange, flat(bands), {}, {}};
    if (request.path == "/unstable/0/1")
        return {of_lagrange, {bands.at(0).second}, {}, {}};
    no_answer("stability: no oracle for " + request.path);
}

} // namespace whirl::oracles

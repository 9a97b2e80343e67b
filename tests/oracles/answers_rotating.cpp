// Rotors that are not axisymmetric: stability, and what `show` says of them.

#include "oracles/answers.h"
#include "oracles/balls.h"
#include "oracles/criterion.h"
#include "oracles/floquet.h"
#include "oracles/rotating_state.h"

#include <algorithm>
#include <cmath>

namespace whirl::oracles {

namespace {

/// The rotor with balls that are held; those that are free are not of its body.
RigidRotor body_of(const CaseRotor &rotor) {
    const bool held = std::any_of(rotor.balancers.begin(), rotor.balancers.end(),
                                  [](const Balancer &b) { return b.held; });
    return held ? composite_rotor(rotor) : bare_rotor(rotor);
}

bool round(const Block &b) { return b[0][0] == b[1][1] && b[0][1] == 0 && b[1][0] == 0; }

Answer unstable_bands(const CaseRotor &rotor) {
    const Real from = rotor.speed_from;
    const Real to = rotor.speed_to;
    const bool isotropic = std::all_of(rotor.supports.begin(), rotor.supports.end(),
                                       [](const Support &s) { return round(s.k) && round(s.c); });
    if (rotor.rigid && !isotropic) {
        const auto grows = [&](Real speed) {
            return floquet_growth(rigid_periodic(rotor, speed)) > 0;
        };
        return {"Floquet multipliers", flat(bands_where(grows, from, to, 120)), {}, {}};
    }
    // Below the growth of a thousandth of a step of the search, above the rounding of double roots
    const Real noise = rotor.damped() ? Real(0) : 2e-9L;
    if (rotor.rigid && !rotor.balancers.empty() && !rotor.balancers.front().held)
        return {"rotating state matrix, balls free",
                flat(growing_bands(rotating_composite(rotor), from, to, 600, noise)),
                {},
                {}};
    if (rotor.rigid)
        return {"rotating state matrix",
                flat(growing_bands(rotating_body(body_of(rotor)), from, to, 600, noise)),
                {},
                {}};
    if (rotor.discs.size() == 1 && isotropic)
        return {"rotating state matrix, influence coefficients",
                flat(growing_bands(rotating_disc(rotor), from, to, 16000, noise)),
                {},
                {}};
    no_answer("stability: no oracle for this rotor");
}

/// Largest growth over a range of speeds: on a grid, then by golden sections beside the best.
Real worst_growth(const RotatingRotor &rotor, Real from, Real to) {
    constexpr int steps = 120;
    const auto speed = [&](int k) { return from + (to - from) * k / steps; };
    int best = 1;
    Real most = rotor.growth(speed(1));
    for (int k = 2; k <= steps; ++k)
        if (const Real growth = rotor.growth(speed(k)); growth > most) {
            most = growth;
            best = k;
        }
    const Real golden = (std::sqrt(Real(5)) - 1) / 2;
    Real a = speed(best - 1);
    Real b = speed(std::min(best + 1, steps));
    for (int k = 0; k < 45; ++k) {
        const Real left = b - golden * (b - a);
        const Real right = a + golden * (b - a);
        (rotor.growth(left) > rotor.growth(right) ? b : a) =
            rotor.growth(left) > rotor.growth(right) ? right : left;
    }
    return std::max(most, rotor.growth((a + b) / 2));
}

/// Largest dI for which nothing grows at any speed of the range, by the state matrix.
Real permissible_anisotropy(const CaseRotor &rotor) {
    RigidRotor body = bare_rotor(rotor);
    Real low = 0;
    Real high = body.A;
    for (int step = 0; step < 40; ++step) {
        const Real middle = (low + high) / 2;
        body.a = middle;
        const Real growth = worst_growth(rotating_body(body), rotor.speed_from, rotor.speed_to);
        (growth > 0 ? high : low) = middle;
    }
    return low;
}

/// Dimensionless numbers of the composite rotor: m = n m/M_s, A_m = n m R^2/A_Sigma,
/// A_m0 = m0 R0^2/A_Sigma, C = C_s/A_Sigma, about its centre of mass (Gorbenko).
Real dimensionless(const CaseRotor &rotor, const std::string &name) {
    const RigidRotor body = composite_rotor(rotor);
    const Balancer &b = rotor.balancers.front();
    const Real balls = b.n * static_cast<Real>(b.mass);
    if (name == "m")
        return balls / body.mass;
    if (name == "A_m")
        return balls * b.radius * b.radius / body.A;
    if (name == "A_m0")
        return b.imbalance * static_cast<Real>(b.imbalance_radius) / body.A;
    if (name == "C")
        return body.C / body.A;
    if (name == "A")
        return std::abs(body.a) / body.A;
    no_answer("show: no oracle for the dimensionless " + name);
}

Answer answer_balls(const CaseRotor &rotor, const std::string &path) {
    const Balancer &balancer = rotor.balancers.front();
    const Real E = capacity(balancer);
    const std::string position = "balanced position";
    const std::string numbers = "/balancers/0/dimensionless/";
    if (path == "/balancers/0/E")
        return {position, {E}, {}, {}};
    if (path == "/balancers/0/D_c")
        return {position, {second_harmonic(balanced_position(balancer)).real()}, {}, {}};
    if (path == "/balancers/0/D_interval") {
        const HarmonicInterval interval = harmonic_interval(balancer.rows, balancer.imbalance);
        return {"search over balanced positions", {interval.least, interval.most}, {}, {}};
    }
    if (path == "/balancers/0/dA")
        return {position, {std::abs(ball_inertia(balancer).a)}, {}, {}};
    if (path == "/balancers/0/dA_paper")
        return {position, {ball_inertia(balancer).a_paper}, {}, {}};
    if (path == "/balancers/0/bare_rotor/Ip_over_Id")
        return {position, {bare_rotor(rotor).C / bare_rotor(rotor).A}, {}, {}};
    if (path.rfind(numbers, 0) == 0)
        return {"composite rotor", {dimensionless(rotor, path.substr(numbers.size()))}, {}, {}};
    no_answer("show: no oracle for " + path);
}

} // namespace

Answer answer_stability(const Request &request) {
    const CaseRotor &rotor = request.rotor;
    if (request.path.rfind("/level1", 0) == 0 || request.path.rfind("/clearances", 0) == 0)
        return answer_operation(request);
    if (request.path.rfind("/state", 0) == 0)
        return answer_states(request);
    if (request.path == "/unstable")
        return unstable_bands(rotor);
    if (request.path == "/additional_speeds" && rotor.rigid)
        return {"closed form of the composite rotor",
                split_additional_speeds(composite_rotor(rotor), rotor.balancers.front().z),
                {},
                {}};
    if (request.path == "/permissible/0/dI" && rotor.rigid)
        return {"rotating state matrix", {permissible_anisotropy(rotor)}, {}, {}};
    if (request.path == "/permissible/0/closed_form" && rotor.rigid) {
        const AnisotropicRotor closed(body_of(rotor));
        return {"closed form of the anisotropic rotor", {closed.permissible() * closed.A}, {}, {}};
    }
    no_answer("stability: no oracle for " + request.path);
}

Answer answer_show(const Request &request) {
    const CaseRotor &rotor = request.rotor;
    const std::string &path = request.path;
    const std::string anisotropic = "closed form of the anisotropic rotor";
    if (path == "/dI")
        return {"the case itself", {std::abs(body_of(rotor).a)}, {}, {}};
    if (path.rfind("/anisotropy/", 0) == 0) {
        const AnisotropicRotor closed(body_of(rotor));
        if (path == "/anisotropy/critical_speeds")
            return {anisotropic, closed.critical_speeds(), {}, {}};
        if (path == "/anisotropy/unstable/0")
            return {anisotropic, closed.unstable(), {}, {}};
        if (path == "/anisotropy/permissible")
            return {anisotropic, {closed.permissible()}, {}, {}};
        if (path == "/anisotropy/permissible_speed")
            return {anisotropic, {closed.permissible_speed()}, {}, {}};
    }
    if (path.rfind("/balancers/0/", 0) == 0)
        return answer_balls(rotor, path);
    no_answer("show: no oracle for " + path);
}

} // namespace whirl::oracles

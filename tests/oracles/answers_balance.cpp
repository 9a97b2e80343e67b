// The empirical criterion, four pendulums, the rigid limit and ends of motions in time.

#include "oracles/answers.h"
#include "oracles/ball_motion.h"
#include "oracles/balls.h"
#include "oracles/criterion.h"
#include "oracles/fixed_frame_balls.h"
#include "oracles/influence.h"
#include "oracles/pendulums.h"
#include "oracles/receptance.h"
#include "oracles/rigid_rotor.h"
#include "oracles/steady_states.h"
#include "oracles/walled_race.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

namespace whirl::oracles {

namespace {

const std::string rigid_form = "closed form of the rigid rotor";
const std::string exact_form = "criterion of the transfer matrix";

/// The number after a part of a path, "/planes/" in "/planes/1/bands"; -1 where there is none.
int index_after(const std::string &path, const std::string &part) {
    const auto at = path.find(part);
    return at == std::string::npos ? -1 : std::atoi(path.c_str() + at + part.size());
}

bool ends_with(const std::string &text, const std::string &end) {
    return text.size() >= end.size() &&
           text.compare(text.size() - end.size(), end.size(), end) == 0;
}

Answer criterion(const CaseRotor &rotor, const std::vector<double> &planes, bool joint) {
    if (rotor.damped())
        no_answer("bands of the criterion: without damping only");
    if (rotor.rigid) {
        const RigidRotor body = bare_rotor(rotor);
        return {rigid_form,
                flat(joint ? rigid_joint_bands(body, rotor.speed_to)
                           : rigid_bands(body, planes.front(), rotor.speed_to)),
                {},
                {}};
    }
    return {exact_form,
            flat(criterion_bands(stepped(rotor), rotor.speed_from, rotor.speed_to, planes)),
            {},
            {}};
}

Answer answer_joint(const CaseRotor &rotor, const std::string &path) {
    if (path == "/joint/bands")
        return criterion(rotor, rotor.planes, true);
    if (path == "/joint/rigid_bands")
        return {rigid_form, flat(rigid_joint_bands(bare_rotor(rotor), rotor.speed_to)), {}, {}};
    if (path == "/joint/rank")
        return {
            rigid_form, {static_cast<Real>(rigid_rank(bare_rotor(rotor), rotor.planes))}, {}, {}};
    if (path == "/joint/signature/0/eigenvalues" && !rotor.rigid)
        return {exact_form,
                signature(criterion_form(stepped(rotor), rotor.speed_from, rotor.planes)),
                {},
                {}};
    if (path == "/joint/pinned_critical_speeds" && !rotor.rigid)
        return {exact_form,
                pinned_speeds(stepped(rotor), rotor.speed_from, rotor.speed_to, rotor.planes),
                {},
                {}};
    no_answer("balance: no oracle for " + path);
}

/// Critical speeds of the disc on its massless shaft, and with the first plane held.
std::vector<Real> elastic_speeds(const CaseRotor &rotor, Real factor) {
    const MasslessShaft shaft(rotor, factor);
    const Lumps lumps = lumps_of(rotor, 0);
    std::vector<Real> out = lumped_critical_speeds(shaft, lumps);
    out.push_back(
        lumped_critical_speeds(shaft, lumps, {static_cast<Real>(rotor.planes.at(0))}).at(0));
    return out;
}

std::vector<Real> rigid_speeds(const CaseRotor &rotor) {
    const RigidRotor body = bare_rotor(rotor);
    std::vector<Real> out = resonances(body);
    out.push_back(additional_speeds(body, rotor.planes.at(0)).at(0));
    return out;
}

/// Largest relative difference of the elastic from the rigid speeds.
Real worst_difference(const CaseRotor &rotor, Real factor) {
    const std::vector<Real> rigid = rigid_speeds(rotor);
    const std::vector<Real> elastic = elastic_speeds(rotor, factor);
    Real worst = 0;
    for (std::size_t i = 0; i < rigid.size(); ++i)
        worst = std::max(worst, std::abs(elastic.at(i) / rigid[i] - 1));
    return worst;
}

/// Factor of E and G at which the worst of the speeds is 1 % from the rigid one.
Real one_percent_factor(const CaseRotor &rotor) {
    Real low = 1e-3L;
    Real high = 1e6L;
    for (int step = 0; step < 100; ++step) {
        const Real middle = std::sqrt(low * high);
        (worst_difference(rotor, middle) > 0.01L ? low : high) = middle;
    }
    return low;
}

/// Exponent of the stiffness in the difference, between 1e5 and 1e6 times the shaft's.
Real rate_of(const CaseRotor &rotor, std::size_t row) {
    const auto difference = [&](Real factor) {
        return std::abs(elastic_speeds(rotor, factor).at(row) / rigid_speeds(rotor).at(row) - 1);
    };
    return std::log10(difference(1e6L) / difference(1e5L));
}

/// What two planes need on a rigid shaft: forces and moments in balance; one plane its own
/// imbalances.
std::vector<Complex> needed_on_rigid_shaft(const CaseRotor &rotor) {
    if (!rotor.rigid || rotor.planes.empty() || rotor.planes.size() > 2)
        no_answer("needed: one plane or two of a rigid rotor only");
    std::vector<Complex> out(rotor.planes.size());
    for (const Imbalance &own : rotor.imbalances) {
        const Complex u = std::polar<Real>(own.mr, own.phase);
        if (out.size() == 1 && own.z != rotor.planes[0])
            no_answer("needed: one plane against its own imbalances only");
        const Real share =
            out.size() == 1 ? 0 : (own.z - rotor.planes[0]) / (rotor.planes[1] - rotor.planes[0]);
        out[0] -= (1 - share) * u;
        if (out.size() > 1)
            out[1] -= share * u;
    }
    return out;
}

/// Motions of the planes, probes and bearings of an elastic shaft, and what its planes need to
/// stand still.
struct SuppliedShaft {
    std::vector<Complex> needed;    ///< kg m
    std::vector<Complex> nothing;   ///< m
    std::vector<Complex> balancers; ///< m
};
SuppliedShaft supplied_shaft(const CaseRotor &rotor, Real speed) {
    std::vector<double> places = rotor.planes;
    for (const Probe &probe : rotor.probes)
        places.push_back(probe.z);
    for (const Support &support : rotor.supports)
        places.push_back(support.z);
    const std::size_t seen = places.size();
    for (const Imbalance &own : rotor.imbalances)
        places.push_back(own.z);
    const ComplexMatrix R =
        receptance(stepped(rotor), Complex(0, speed), speed, places) * Complex(speed * speed);
    const auto n = static_cast<Eigen::Index>(rotor.planes.size());
    SuppliedShaft out;
    ComplexMatrix w(static_cast<Eigen::Index>(seen), 1);
    w.setZero();
    for (std::size_t i = 0; i < rotor.imbalances.size(); ++i)
        w += R.col(static_cast<Eigen::Index>(seen + i)).head(w.rows()) *
             std::polar<Real>(rotor.imbalances[i].mr, rotor.imbalances[i].phase);
    const ComplexMatrix u = solve(R.topLeftCorner(n, n), ComplexMatrix(-w.topRows(n)));
    const ComplexMatrix left = w + R.topLeftCorner(w.rows(), n) * u;
    out.needed.assign(u.data(), u.data() + u.size());
    out.nothing.assign(w.data(), w.data() + w.size());
    out.balancers.assign(left.data(), left.data() + left.size());
    return out;
}

Answer answer_supply_of_shaft(const CaseRotor &rotor, const std::string &path) {
    const SuppliedShaft found = supplied_shaft(rotor, rotor.speed_from);
    const std::string exact = "exact dynamic stiffness of the shaft";
    const int plane = index_after(path, "/planes/");
    if (plane >= 0) {
        const Complex needed = found.needed.at(static_cast<std::size_t>(plane));
        return {exact,
                {path.find("/mr") != std::string::npos ? std::abs(needed) : std::arg(needed)},
                {},
                {}};
    }
    const auto place = static_cast<std::size_t>(index_after(path, "/residual/"));
    if (path.find("/nothing/0") != std::string::npos)
        return {exact, {std::abs(found.nothing.at(place))}, {}, {}};
    if (path.find("/balancers/0") != std::string::npos)
        return {exact, {std::abs(found.balancers.at(place))}, {}, {}};
    no_answer("balance: no oracle for " + path);
}

Answer answer_supply(const CaseRotor &rotor, const std::string &path) {
    if (!rotor.rigid && !ends_with(path, "/capacity"))
        return answer_supply_of_shaft(rotor, path);
    const std::string closed = "planar rotor, closed form";
    const int plane = index_after(path, "/planes/");
    if (plane >= 0 && path.find("/needed/") != std::string::npos) {
        const Complex needed = needed_on_rigid_shaft(rotor).at(static_cast<std::size_t>(plane));
        const Real value =
            path.find("/mr") != std::string::npos ? std::abs(needed) : std::arg(needed);
        return {"forces and moments of a rigid shaft",
                std::vector<Real>(static_cast<std::size_t>(rotor.speed_count), value),
                {},
                {}};
    }
    if (plane >= 0 && ends_with(path, "/capacity")) {
        const Balancer &race = rotor.balancers.at(static_cast<std::size_t>(plane));
        return {"n m R", {static_cast<Real>(race.n) * race.mass * race.radius}, {}, {}};
    }
    const PlanarBallRotor planar = planar_ball_rotor(rotor);
    const Real speed = rotor.speed_from;
    if (path == "/residual/0/nothing/0")
        return {closed,
                {speed * speed * std::abs(planar.imbalance) /
                 std::abs(Complex(planar.k - planar.mass * speed * speed, planar.c * speed))},
                {},
                {}};
    if (path == "/residual/0/balancers/0")
        return {closed, {left_beyond_capacity(planar, speed)}, {}, {}};
    no_answer("balance: no oracle for " + path);
}

} // namespace

namespace {

/// Of a pair with a ball at a wall, which among states is the second one.
Answer answer_walled(const Request &request, const WalledPair &pair) {
    const std::string closed = "pairs of places in the race by bisection";
    if (ends_with(request.path, "/balls/0"))
        return {closed, {pair.first, pair.second}, {}, {}};
    if (ends_with(request.path, "/angles/0"))
        return {closed, {pair.second, pair.first}, {}, {}};
    if (ends_with(request.path, "/wall_forces/0/1"))
        return {closed, {pair.force}, {}, {}};
    if (ends_with(request.path, "/residual") || ends_with(request.path, "/amplitude"))
        return {closed, {pair.deflection}, {}, {}};
    no_answer("walled race: no oracle for " + request.path);
}

} // namespace

Answer answer_states(const Request &request) {
    const std::string &path = request.path;
    if (!request.rotor.balancers.empty() && !request.rotor.balancers[0].walls.empty()) {
        // In the program's list the states with both balls free come first.
        const auto pairs = walled_pairs(request.rotor, request.rotor.speed_from);
        const int all = index_after(path, "/states/");
        const int free = free_pairs(request.rotor, request.rotor.speed_from);
        if (all < free)
            no_answer("walled race: no oracle for free balls");
        return answer_walled(request, pairs.at(static_cast<std::size_t>(all - free)));
    }
    const std::string closed = "planar rotor with two balls, closed form and its small motions";
    const PlanarBallRotor planar = planar_ball_rotor(request.rotor);
    const int border = index_after(path, "/state_borders/");
    if (border >= 0) {
        const PlanarBorder found =
            planar_borders(planar, request.rotor.speed_from, request.rotor.speed_to)
                .at(static_cast<std::size_t>(border));
        return {closed, {ends_with(path, "/speed") ? found.speed : found.frequency}, {}, {}};
    }
    const int index = index_after(path, "/states/");
    if (index < 0)
        no_answer("steady states: no oracle for " + path);
    const PlanarState state =
        planar_states(planar, request.rotor.speed_from).at(static_cast<std::size_t>(index));
    if (ends_with(path, "/kind"))
        return {closed, {}, state.kind, {}};
    if (ends_with(path, "/residual"))
        return {closed, {std::abs(state.deflection)}, {}, {}};
    if (ends_with(path, "/growth"))
        return {closed, {state.growth}, {}, {}};
    if (ends_with(path, "/angles"))
        return {closed, state.angles, {}, {}};
    no_answer("steady states: no oracle for " + path);
}

Answer answer_balance(const Request &request) {
    const CaseRotor &rotor = request.rotor;
    const std::string &path = request.path;
    if (path.rfind("/state", 0) == 0)
        return answer_states(request);
    if (path.rfind("/residual/", 0) == 0 || path.find("/needed") != std::string::npos ||
        ends_with(path, "/capacity"))
        return answer_supply(rotor, path);
    if (path.rfind("/pendulum/", 0) == 0)
        return answer_pendulums(request);
    if (path.rfind("/joint/", 0) == 0)
        return answer_joint(rotor, path);
    if (path == "/rigid/Id")
        return {rigid_form, {bare_rotor(rotor).A}, {}, {}};
    if (path == "/rigid/Ip")
        return {rigid_form, {bare_rotor(rotor).C}, {}, {}};
    const int plane = index_after(path, "/planes/");
    if (plane < 0 || !ends_with(path, "/bands"))
        no_answer("balance: no oracle for " + path);
    return criterion(rotor, {rotor.planes.at(static_cast<std::size_t>(plane))}, false);
}

Answer answer_pendulums(const Request &request) {
    const CaseRotor &rotor = request.rotor;
    const std::string &path = request.path;
    const std::string steady = "steady motion of the pendulums";
    PendulumRotor pendulums = pendulum_rotor(rotor);
    std::vector<Real> ratios; // R_w
    const int design = index_after(path, "/designs/");
    const int damping = index_after(path, "/dampings/");
    const bool exact = path.find("/exact") != std::string::npos;
    if (design >= 0 || damping >= 0) {
        // Figures of the paper: designs without damping, dampings of the first; 241 ratios to 3
        pendulums = pendulum_rotor(rotor, rotor.designs.at(std::max(0, design)));
        pendulums.H = damping < 0 ? 0 : rotor.external_dampings.at(damping);
        const int point =
            std::max(index_after(path, "/exact/"), index_after(path, "/approximate/"));
        if (point >= 0 && point != 240)
            no_answer("pendulums: only the last ratio of the figures, 3, is known");
        ratios = {3};
    } else {
        for (int i = 0; i < rotor.speed_count; ++i)
            ratios.push_back(rotor.speed(i) / pendulums.omega0);
    }
    if (ends_with(path, "/rho"))
        return {steady, {pendulums.rho()}, {}, {}};
    if (ends_with(path, "/threshold"))
        return {steady, {pendulums.threshold()}, {}, {}};
    if (ends_with(path, "/limit"))
        return {steady, {pendulums.limit()}, {}, {}};
    if (!rotor.rigid || (!exact && path.find("/approximate") == std::string::npos))
        no_answer("pendulums: no oracle for " + path);
    Answer out{steady, {}, {}, {}};
    for (const Real ratio : ratios)
        out.values.push_back(exact ? exact_efficiency(pendulums, ratio)
                                   : approximate_efficiency(pendulums, ratio));
    return out;
}

Answer answer_rigid_limit(const Request &request) {
    const CaseRotor &rotor = request.rotor;
    const std::string &path = request.path;
    const int row = index_after(path, "/rows/");
    const std::string influence = "influence coefficients";
    if (path == "/one_percent/factor")
        return {influence, {one_percent_factor(rotor)}, {}, {}};
    if (row < 0)
        no_answer("rigid-limit: no oracle for " + path);
    const auto index = static_cast<std::size_t>(row);
    if (ends_with(path, "/closed_form") || (rotor.rigid && ends_with(path, "/fe")))
        return {rigid_form, {rigid_speeds(rotor).at(index)}, {}, {}};
    if (ends_with(path, "/fe/0"))
        return {influence, {elastic_speeds(rotor, 1).at(index)}, {}, {}};
    if (ends_with(path, "/rate"))
        return {influence, {rate_of(rotor, index)}, {}, {}};
    no_answer("rigid-limit: no oracle for " + path);
}

namespace {

/// Balls on supports that differ between x and y, and what they leave there.
Answer answer_at_rest(const Request &request) {
    const CaseRotor &rotor = request.rotor;
    const BallsAtRest end =
        fixed_frame_balls(rotor, rotor.speed_from, rotor.ball_angles, rotor.time);
    const std::string oracle = "Newton's equations in time, fixed axes";
    constexpr double still = 0.05; // rad
    if (request.path == "/outcome" && end.swing < still) {
        CaseRotor without = rotor;
        without.balancers.clear();
        const std::vector<double> all =
            fixed_frame_balls(without, rotor.speed_from, {}, rotor.time).amplitudes;
        bool balanced = true;
        for (std::size_t s = 0; s < all.size(); ++s)
            balanced = balanced && end.amplitudes[s] < 0.1 * all[s];
        return {oracle, {}, balanced ? "balanced" : "offset", {}};
    }
    if (request.path == "/balls/0" && end.swing < still) {
        std::vector<Real> angles(end.angles.at(0).begin(), end.angles.at(0).end());
        return {oracle, angles, {}, {}};
    }
    // Stations are the places of the case, ascending.
    std::vector<double> places{0, rotor.length()};
    const auto add = [&places](const auto &parts) {
        for (const auto &part : parts)
            places.push_back(part.z);
    };
    add(rotor.discs);
    add(rotor.supports);
    add(rotor.imbalances);
    add(rotor.balancers);
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    const int station = index_after(request.path, "/stations/");
    for (std::size_t s = 0; s < rotor.supports.size() && station >= 0; ++s)
        if (rotor.supports[s].z == places.at(static_cast<std::size_t>(station)) &&
            ends_with(request.path, "/amplitude"))
            return {oracle, {static_cast<Real>(end.amplitudes[s])}, {}, {}};
    no_answer("simulate: no oracle for " + request.path);
}

/// A sweep in time of two balls: they rest in the coincident state that keeps, while there is one.
Answer answer_held(const Request &request) {
    const std::string closed = "closed form of two balls at one angle";
    const PlanarBallRotor planar = planar_ball_rotor(request.rotor);
    const auto kept = [&planar](double speed) -> std::optional<Real> {
        for (const PlanarState &state : planar_states(planar, speed))
            if (state.kind == "coincident" && state.growing == 0)
                return std::abs(state.deflection);
        return std::nullopt;
    };
    if (request.path == "/sweep_jumps/0/from") {
        std::size_t last = 0;
        while (kept(request.rotor.held.at(last + 1)))
            ++last;
        return {closed, {request.rotor.held.at(last)}, {}, {}};
    }
    const int row = index_after(request.path, "/sweep/");
    if (row >= 0 && ends_with(request.path, "/planes/0"))
        if (const auto amplitude = kept(request.rotor.held.at(static_cast<std::size_t>(row))))
            return {closed, {*amplitude}, {}, {}};
    no_answer("simulate: no oracle for " + request.path);
}

} // namespace

Answer answer_simulate(const Request &request) {
    const CaseRotor &rotor = request.rotor;
    if (rotor.balancers.empty())
        return answer_transient(request);
    if (request.path.rfind("/sweep", 0) == 0)
        return answer_held(request);
    const Balancer &balancer = rotor.balancers.front();
    if (!balancer.walls.empty()) {
        // Both balls start between the walls where one rests and one is free.
        for (const WalledPair &pair : walled_pairs(rotor, rotor.speed_from))
            if (pair.resting == 1 && pair.deflection < 1e-4L)
                return answer_walled(request, pair);
        no_answer("walled race: no such end");
    }
    const bool alike = std::all_of(rotor.supports.begin(), rotor.supports.end(), [](const auto &s) {
        return s.k[0][0] == s.k[1][1] && s.c[0][0] == s.c[1][1];
    });
    if (rotor.rigid && !balancer.pendulums && !alike)
        return answer_at_rest(request);
    if (request.path == "/balls/0" && !balancer.pendulums)
        return {"balanced position", symmetric_position(balancer.n, capacity(balancer)), {}, {}};
    if (request.path == "/outcome" && balancer.pendulums && rotor.rigid) {
        const PendulumRotor pendulums = pendulum_rotor(rotor);
        const std::vector<double> &start = rotor.ball_angles.at(0);
        return {"motion of the pendulums in time",
                {},
                pendulum_motion(pendulums, rotor.speed_from / pendulums.omega0, start.at(0),
                                start.at(1), rotor.time)
                    .name(),
                {}};
    }
    const int other = index_after(request.path, "/other_starts/");
    if (rotor.rigid && !balancer.pendulums && ends_with(request.path, "/outcome")) {
        const auto &angles =
            other < 0 ? rotor.ball_angles : rotor.other_starts.at(static_cast<std::size_t>(other));
        return {"motion of the balls in time",
                {},
                ball_motion(rotor, rotor.speed_from, angles, rotor.time).name(),
                {}};
    }
    no_answer("simulate: no oracle for " + request.path);
}

} // namespace whirl::oracles

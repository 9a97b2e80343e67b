#include "oracles/steady_states.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

namespace whirl::oracles {

namespace {

constexpr Real pi = std::numbers::pi_v<Real>;

/// k - (M + n m) W^2 + i c W
Complex dynamic(const PlanarBallRotor &rotor, Real speed, Real balls) {
    return {rotor.k - (rotor.mass + balls) * speed * speed, rotor.c * speed};
}
Complex dynamic(const PlanarBallRotor &rotor, Real speed) {
    return dynamic(rotor, speed, static_cast<Real>(rotor.n) * rotor.ball);
}

/// Small motions of u + i v = w and all angles in turning axes, a = w'' + 2 i W w' - W^2 w:
///   (M + n m) a + c (w' + i W w) + k w = sum m R e^(i q) [(W + q')^2 - i q'']  (+ U W^2)
///   R q'' + (h/m) R q' + Im(e^(-i q) a) = 0
/// differentiated about the state.
void add_small_motions(const PlanarBallRotor &rotor, Real speed, PlanarState &state) {
    const int size = 2 + rotor.n;
    Eigen::MatrixXd M = Eigen::MatrixXd::Zero(size, size), C = M, K = M;
    // A complex factor of a real unknown j or of w, into rows u and v.
    const auto add_w = [](Eigen::MatrixXd &to, Complex factor) {
        const auto re = static_cast<double>(factor.real());
        const auto im = static_cast<double>(factor.imag());
        to(0, 0) += re;
        to(0, 1) -= im;
        to(1, 0) += im;
        to(1, 1) += re;
    };
    const auto add_q = [](Eigen::MatrixXd &to, int column, Complex factor) {
        to(0, column) += static_cast<double>(factor.real());
        to(1, column) += static_cast<double>(factor.imag());
    };
    const Complex i(0, 1);
    const Real all = rotor.mass + static_cast<Real>(rotor.n) * rotor.ball;
    add_w(M, all);
    add_w(C, 2.0L * i * speed * all + rotor.c);
    add_w(K, dynamic(rotor, speed));
    for (int j = 0; j < rotor.n; ++j) {
        const int q = 2 + j;
        const Complex e = std::polar(1.0L, state.angles[static_cast<std::size_t>(j)]);
        const Complex pull = rotor.ball * rotor.radius * e;
        add_q(M, q, i * pull);
        add_q(C, q, -2.0L * speed * pull);
        add_q(K, q, -i * speed * speed * pull);
        M(q, q) += static_cast<double>(rotor.radius);
        C(q, q) += static_cast<double>(rotor.drag / rotor.ball * rotor.radius);
        // Im(e^(-i q) x) of x = u + i v: -sin q u + cos q v; x = a.
        const auto add_a = [&](Eigen::MatrixXd &to, Complex factor) {
            to(q, 0) += static_cast<double>((std::conj(e) * factor).imag());
            to(q, 1) += static_cast<double>((std::conj(e) * factor * i).imag());
        };
        add_a(M, 1.0L);
        add_a(C, 2.0L * i * speed);
        add_a(K, -speed * speed);
        // d/dq of e^(-i q) at a = -W^2 w.
        K(q, q) +=
            static_cast<double>((i * std::conj(e) * speed * speed * state.deflection).imag());
    }
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * size, 2 * size);
    const Eigen::MatrixXd inverse = M.inverse();
    // Rates over the spin speed, so that entries are of one size.
    const auto unit = static_cast<double>(speed);
    A.topRightCorner(size, size) = unit * Eigen::MatrixXd::Identity(size, size);
    A.bottomLeftCorner(size, size) = -inverse * K / unit;
    A.bottomRightCorner(size, size) = -inverse * C;
    const Eigen::VectorXcd roots = Eigen::EigenSolver<Eigen::MatrixXd>(A, false).eigenvalues();
    state.growth = roots.real().maxCoeff();
    double least = HUGE_VAL;
    for (const std::complex<double> &root : roots) {
        state.growing += root.real() > 1e-12 * unit ? 1 : 0;
        if (std::abs(root.real()) < least) {
            least = std::abs(root.real());
            state.next_frequency = std::abs(root.imag());
        }
    }
}

Real wrapped(Real angle) { return std::remainder(angle, 2 * pi); }

/// A branch of states: number of growing roots, -1 where there is none.
struct Branch {
    std::string kind;
    std::size_t index = 0; ///< among those of its kind
    bool operator<(const Branch &other) const {
        return std::tie(kind, index) < std::tie(other.kind, other.index);
    }
};

std::map<Branch, PlanarState> branches_at(const PlanarBallRotor &rotor, Real speed) {
    std::map<Branch, PlanarState> out;
    std::map<std::string, std::size_t> count;
    for (const PlanarState &state : planar_states(rotor, speed))
        out[{state.kind, count[state.kind]++}] = state;
    return out;
}

} // namespace

PlanarBallRotor planar_ball_rotor(const CaseRotor &rotor) {
    const auto refuse = [](const char *why) { throw std::runtime_error(why); };
    if (!rotor.rigid || rotor.discs.size() != 1 || rotor.balancers.size() != 1 ||
        rotor.supports.size() != 2 || rotor.balancers[0].pendulums || rotor.balancers[0].ring ||
        rotor.balancers[0].imbalance != 0)
        refuse("steady states: one disc, one race and two bearings only");
    const Balancer &race = rotor.balancers[0];
    PlanarBallRotor out;
    out.mass = rotor.discs[0].mass;
    for (const Support &support : rotor.supports) {
        out.k += support.k[0][0];
        out.c += support.c[0][0];
        if (support.k[0][0] != rotor.supports[0].k[0][0] ||
            support.c[0][0] != rotor.supports[0].c[0][0])
            refuse("steady states: equal bearings only");
    }
    const double middle = (rotor.supports[0].z + rotor.supports[1].z) / 2;
    if (rotor.discs[0].z != middle || race.z != middle)
        refuse("steady states: disc and race amid the bearings only");
    for (const Imbalance &own : rotor.imbalances) {
        if (own.z != middle)
            refuse("steady states: imbalances amid the bearings only");
        out.imbalance += std::polar<Real>(own.mr, own.phase);
    }
    out.n = race.n;
    out.ball = race.mass;
    out.radius = race.radius;
    out.drag = race.damping;
    return out;
}

std::vector<PlanarState> planar_states(const PlanarBallRotor &rotor, Real speed) {
    if (rotor.n != 2)
        throw std::runtime_error("steady states: two balls only");
    const Complex D = dynamic(rotor, speed);
    const Real U = std::abs(rotor.imbalance), towards = std::arg(rotor.imbalance);
    const Real moment = rotor.ball * rotor.radius;
    std::vector<PlanarState> out;
    const auto add = [&](const char *kind, std::vector<Real> angles) {
        PlanarState state;
        state.kind = kind;
        Complex load = rotor.imbalance;
        for (Real &angle : angles) {
            load += std::polar(moment, angle);
            angle = wrapped(angle);
        }
        state.angles = angles;
        state.deflection = state.kind == "balanced" ? 0 : speed * speed * load / D;
        add_small_motions(rotor, speed, state);
        out.push_back(state);
    };
    if (U <= 2 * moment) {
        const Real apart = std::acos(U / (2 * moment));
        add("balanced", {towards + pi - apart, towards + pi + apart});
    }
    // Im(w e^(-i q)) = 0 with s balls more on the side of q: sin(q - towards + arg D) = -s m R/U
    // sin(arg D).
    const Real turn = std::arg(D);
    const Real sine = -2 * moment / U * std::sin(turn);
    if (std::abs(sine) <= 1) {
        Real first = wrapped(towards + std::asin(sine) - turn);
        Real second = wrapped(towards + pi - std::asin(sine) - turn);
        if (first < second)
            std::swap(first, second);
        add("coincident", {first, first});
        add("coincident", {second, second});
    }
    add("split", {towards - turn, towards - turn + pi});
    return out;
}

std::vector<PlanarBorder> planar_borders(const PlanarBallRotor &rotor, Real from, Real to) {
    constexpr int steps = 2000; // between the two no number changes twice
    std::vector<PlanarBorder> out;
    const auto growing = [&](const Branch &branch, Real speed) {
        const auto all = branches_at(rotor, speed);
        const auto found = all.find(branch);
        return found == all.end() ? -1 : found->second.growing;
    };
    for (const Branch &branch : {Branch{"balanced", 0}, Branch{"coincident", 0},
                                 Branch{"coincident", 1}, Branch{"split", 0}})
        for (int step = 0; step < steps; ++step) {
            Real low = from + (to - from) * step / steps;
            Real high = from + (to - from) * (step + 1) / steps;
            const int below = growing(branch, low);
            const int above = growing(branch, high);
            if (below == above)
                continue;
            for (int halving = 0; halving < 60; ++halving) {
                const Real middle = (low + high) / 2;
                (growing(branch, middle) == below ? low : high) = middle;
            }
            const bool ends = below < 0 || above < 0;
            // Both coincident states end there.
            if (ends && branch.index > 0)
                continue;
            out.push_back(
                {(low + high) / 2, ends ? 0 : branches_at(rotor, low).at(branch).next_frequency});
        }
    std::sort(out.begin(), out.end(),
              [](const PlanarBorder &a, const PlanarBorder &b) { return a.speed < b.speed; });
    return out;
}

Real left_beyond_capacity(const PlanarBallRotor &rotor, Real speed) {
    const Complex A = speed * speed / dynamic(rotor, speed, 0);
    const Real all = static_cast<Real>(rotor.n) * rotor.ball * rotor.radius;
    const Real across = A.imag() * all;
    return A.real() * all + std::sqrt(std::norm(A) * std::norm(rotor.imbalance) - across * across);
}

} // namespace whirl::oracles

// Rigid rotors on supports with mass coefficients and pedestals.

#include "oracles/answers.h"
#include "oracles/rigid_rotor.h"
#include "oracles/rotating_state.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace whirl::oracles {

namespace {

/// M q'' + (C + W G) q' + K q = 0 in the fixed axes; q: x, y of the centre of mass, slopes in x and
/// y, then x and y of every pedestal.
struct Mounted {
    RigidRotor body;
    RealMatrix M, C, G, K;

    explicit Mounted(const CaseRotor &rotor) : body(bare_rotor(rotor)) {
        Eigen::Index n = 4;
        for (const Mount &mount : rotor.mounts)
            n += mount.pedestal_k[0] > 0 ? 2 : 0;
        M = C = G = K = RealMatrix::Zero(n, n);
        M.diagonal().head(4) << body.mass, body.mass, body.A, body.A;
        // A phi'' - i C W phi' on phi = phi_x + i phi_y
        G(2, 3) = body.C;
        G(3, 2) = -body.C;
        Eigen::Index pedestal = 4;
        for (std::size_t i = 0; i < rotor.supports.size(); ++i)
            add(rotor.supports[i], rotor.mounts[i], pedestal);
    }

    void add(const Support &support, const Mount &mount, Eigen::Index &pedestal) {
        // displacement of the film: R q, against the pedestal's where there is one
        RealMatrix R = RealMatrix::Zero(2, M.rows());
        R(0, 0) = R(1, 1) = 1;
        R(0, 2) = R(1, 3) = static_cast<Real>(support.z) - body.centre;
        if (mount.pedestal_k[0] > 0) {
            for (const Eigen::Index axis : {0, 1}) {
                const auto a = static_cast<std::size_t>(axis);
                R(axis, pedestal + axis) = -1;
                M(pedestal + axis, pedestal + axis) += mount.pedestal_mass[a];
                C(pedestal + axis, pedestal + axis) += mount.pedestal_c[a];
                K(pedestal + axis, pedestal + axis) += mount.pedestal_k[a];
            }
            pedestal += 2;
        }
        const auto film = [&R](const Block &b) -> RealMatrix {
            RealMatrix block(2, 2);
            block << b[0][0], b[0][1], b[1][0], b[1][1];
            return R.transpose() * block * R;
        };
        M += film(mount.m);
        C += film(support.c);
        K += film(support.k);
    }

    /// Semi-major axis (m) at z under the imbalances.
    [[nodiscard]] Real major(const CaseRotor &rotor, Real W, Real z) const {
        const Complex i(0, 1);
        const ComplexMatrix D =
            (K - W * W * M).cast<Complex>() + i * W * (C + W * G).cast<Complex>();
        ComplexMatrix force = ComplexMatrix::Zero(M.rows(), 1);
        for (const Imbalance &imbalance : rotor.imbalances) {
            const Complex f = static_cast<Real>(imbalance.mr) * W * W *
                              std::polar(Real(1), static_cast<Real>(imbalance.phase));
            const Real arm = static_cast<Real>(imbalance.z) - body.centre;
            force(0, 0) += f;
            force(1, 0) -= i * f;
            force(2, 0) += arm * f;
            force(3, 0) -= i * arm * f;
        }
        const ComplexMatrix q = solve(D, force);
        const Complex x = q(0, 0) + (z - body.centre) * q(2, 0);
        const Complex y = q(1, 0) + (z - body.centre) * q(3, 0);
        return (std::abs(x + i * y) + std::abs(x - i * y)) / 2;
    }
};

} // namespace

Answer answer_mounted(const Request &request) {
    const CaseRotor &rotor = request.rotor;
    if (!rotor.rigid || !rotor.anisotropies.empty() || !rotor.balancers.empty())
        no_answer("mass coefficients and pedestals: on a rigid round rotor only");
    const Mounted mounted(rotor);
    const Real speed = rotor.speed_from;
    Answer out{"rigid rotor and its pedestals", {}, {}, {}};
    if (request.command == "response" && request.path == "major") {
        out.values = {mounted.major(rotor, speed, request.node)};
        return out;
    }
    if (request.command != "campbell" || (request.path != "frequencies" && request.path != "real"))
        no_answer("mass coefficients and pedestals: frequencies and amplitudes only");
    std::vector<Complex> values = state_eigenvalues(mounted.M, mounted.C + speed * mounted.G,
                                                    mounted.K, std::max(speed, Real(1)));
    std::erase_if(values, [](const Complex &l) { return l.imag() <= 0; });
    std::sort(values.begin(), values.end(),
              [](const Complex &a, const Complex &b) { return a.imag() < b.imag(); });
    for (const Complex &lambda : values)
        out.values.push_back(request.path == "real" ? lambda.real() : lambda.imag());
    return out;
}

} // namespace whirl::oracles

// A slender uniform shaft that carries a torque, at rest on springs at its ends.

#include "oracles/answers.h"

#include <Eigen/Core>
#include <Eigen/LU>

#include <cmath>
#include <numbers>

namespace whirl::oracles {

namespace {

using Matrix = Eigen::Matrix<Complex, 4, 4>;

/// EI w'''' - i T w''' = rho A W^2 w with w = x + i y over 0 <= z <= 1 (lengths in L, forces in
/// EI/L^2). At the ends EI w''' - i T w'' = -+ k w and EI w'' - i s T w' = 0, s = 1, 1/2, 0 for an
/// axial, semitangential and tangential torque (Ziegler 1968, Principles of Structural Stability).
struct TwistedShaft {
    Real EI = 0, mass = 0, length = 0; ///< N m2, kg/m, m
    Real torque = 0, spring = 0;       ///< T L/EI, k L^3/EI
    Real share = 1;                    ///< s

    explicit TwistedShaft(const CaseRotor &rotor) {
        const Cylinder &c = rotor.shaft.at(0).left;
        const auto ro = static_cast<Real>(c.outer) / 2;
        const auto ri = static_cast<Real>(c.inner) / 2;
        const Real area = std::numbers::pi_v<Real> * (ro * ro - ri * ri);
        EI = c.E * area * (ro * ro + ri * ri) / 4;
        mass = c.rho * area;
        length = c.length;
        torque = rotor.axial_torque * length / EI;
        spring = rotor.supports.at(0).k[0][0] * length * length * length / EI;
        if (rotor.torque_kind == "semitangential")
            share = 0.5L;
        else if (rotor.torque_kind == "tangential")
            share = 0;
    }

    /// (w, w', w'', w''') carried over the length: exp(A) by its series over 64th parts.
    [[nodiscard]] Matrix carried(Real load) const {
        constexpr int halvings = 6;
        Matrix A = Matrix::Zero();
        A(0, 1) = A(1, 2) = A(2, 3) = Real(1);
        A(3, 0) = load;
        A(3, 3) = Complex(0, torque);
        A /= static_cast<Real>(1 << halvings);
        Matrix sum = Matrix::Identity();
        Matrix term = sum;
        for (int n = 1; n < 30; ++n) {
            term = (term * A / static_cast<Real>(n)).eval();
            sum += term;
        }
        for (int k = 0; k < halvings; ++k)
            sum = (sum * sum).eval();
        return sum;
    }

    /// Zero at the frequencies, real: the differential equation is the same seen from the other end
    /// with x - i y, so that only exp(i torque/2) is to be taken out.
    [[nodiscard]] Real determinant(Real frequency) const {
        const Real load = mass * frequency * frequency * length * length * length * length / EI;
        const Complex i(0, 1);
        Eigen::Matrix<Complex, 2, 4> left, right;
        left << spring, 0, -i * torque, 1, 0, -i * share * torque, 1, 0;
        right << -spring, 0, -i * torque, 1, 0, -i * share * torque, 1, 0;
        Matrix both;
        both << left, right * carried(load);
        const Complex value = both.determinant() * std::polar(Real(1), -torque / 2);
        if (std::abs(value.imag()) > 1e-9L * std::abs(value.real()) + 1e-12L * spring * spring)
            no_answer("torque: the determinant is not real");
        return value.real();
    }
};

Real root_between(const TwistedShaft &shaft, Real low, Real high) {
    const bool sign = shaft.determinant(low) > 0;
    for (int step = 0; step < 80; ++step) {
        const Real middle = (low + high) / 2;
        ((shaft.determinant(middle) > 0) == sign ? low : high) = middle;
    }
    return low;
}

} // namespace

Answer answer_twisted(const Request &request) {
    const CaseRotor &rotor = request.rotor;
    if (request.command != "campbell" || request.path != "frequencies" || rotor.speed_from != 0 ||
        rotor.shaft.size() != 1 || !rotor.discs.empty() || rotor.supports.size() != 2 ||
        rotor.rotary_inertia || rotor.shaft[0].left.kappa < 1e6)
        no_answer("torque: frequencies at rest of a slender shaft on two springs only");
    const TwistedShaft shaft(rotor);
    // The first frequency of the pinned shaft without torque
    const Real pinned = std::pow(std::numbers::pi_v<Real> / shaft.length, Real(2)) *
                        std::sqrt(shaft.EI / shaft.mass);
    Answer out{"beam under torque, boundary determinant", {}, {}, {}};
    const Real step = pinned / 50;
    for (Real low = step / 7; out.values.size() < request.wanted; low += step)
        if ((shaft.determinant(low) > 0) != (shaft.determinant(low + step) > 0)) {
            const Real root = root_between(shaft, low, low + step);
            out.values.push_back(root); // of forward
            out.values.push_back(root); // and of backward whirl
        }
    return out;
}

} // namespace whirl::oracles

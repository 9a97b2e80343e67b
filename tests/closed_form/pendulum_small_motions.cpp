#include "closed_form/pendulum_small_motions.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace whirl::closed_form {

using namespace std::complex_literals;

PendulumRotor pendulum_rotor(double disc_mass, double pendulum_mass, double arm, double pivot) {
    PendulumRotor rotor;
    rotor.mass_ratio = 2.0 * pendulum_mass / (disc_mass + 4.0 * pendulum_mass);
    rotor.pivot_ratio = pivot / arm;
    return rotor;
}

double balancer_resonance(const PendulumRotor &rotor) {
    return 1.0 / std::sqrt(1.0 + rotor.effectiveness());
}

std::vector<std::complex<double>> pendulum_polynomial(const PendulumRotor &rotor,
                                                      double speed_ratio) {
    const double R = speed_ratio;
    const double H = rotor.external_damping;
    const double h = rotor.hinge_damping;
    const double hinge = rotor.pivot_ratio * R * R;
    const double Rm = rotor.mass_ratio;
    // First factor l^2 + b l + c; mu^2 = (l + i R)^4.
    const std::complex<double> b = 2i * R + H;
    const std::complex<double> c = 1.0 - R * R + 1i * R * H;
    return {1.0 - Rm, b + h - 4i * Rm * R, c + b * h + hinge + 6.0 * Rm * R * R,
            c * h + b * hinge + 4i * Rm * R * R * R, c * hinge - Rm * R * R * R * R};
}

double small_motion_growth(const PendulumRotor &rotor, double speed_ratio) {
    const auto a = pendulum_polynomial(rotor, speed_ratio);
    Eigen::MatrixXcd companion = Eigen::MatrixXcd::Zero(4, 4);
    companion.bottomLeftCorner<3, 3>().setIdentity();
    for (int row = 0; row < 4; ++row)
        companion(row, 3) = -a[4 - row] / a[0];
    const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(companion, false);
    return solver.eigenvalues().real().maxCoeff();
}

std::vector<Band> unstable_speed_ratios(const PendulumRotor &rotor, double from, double to,
                                        int samples) {
    // Undamped roots lie on the imaginary axis within rounding: growth below this is none.
    constexpr double rounding = 1e-6;
    const auto unstable = [&](double R) { return small_motion_growth(rotor, R) > rounding; };
    const auto change_between = [&](double below, double above) {
        const bool state = unstable(below);
        while (above - below > 1e-12 * above) {
            const double middle = 0.5 * (below + above);
            (unstable(middle) == state ? below : above) = middle;
            if (middle == below && middle == above)
                break;
        }
        return 0.5 * (below + above);
    };
    std::vector<Band> bands;
    double previous = from;
    bool inside = unstable(from);
    if (inside)
        bands.push_back({from, to});
    for (int i = 1; i <= samples; ++i) {
        const double R = from + (to - from) * i / samples;
        if (unstable(R) != inside) {
            const double end = change_between(previous, R);
            if (inside)
                bands.back().to = end;
            else
                bands.push_back({end, to});
            inside = !inside;
        }
        previous = R;
    }
    return bands;
}

} // namespace whirl::closed_form

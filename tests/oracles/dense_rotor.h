#pragma once

#include "oracles/case_rotor.h"

#include <Eigen/Core>

#include <array>
#include <complex>
#include <vector>

namespace whirl::oracles {

/// Two-node Timoshenko element in one plane, unknowns w, phi of both ends (m, rad): cubic w whose
/// shear strain w' - phi is the constant -EI/(kappa G A) w''', the static solution (Przemieniecki
/// 1968, Theory of Matrix Structural Analysis; Nelson 1980, J. Mech. Des. 102, 793).
struct BeamMatrices {
    Eigen::Matrix4d stiffness;  ///< integral of EI phi'^2 + kappa G A (w' - phi)^2 + N w'^2
    Eigen::Matrix4d bending;    ///< of EI phi'^2 alone
    Eigen::Matrix4d mass;       ///< of rho A w^2 + rho I phi^2
    Eigen::Matrix4d gyroscopic; ///< of 2 rho I phi^2: a section's polar inertia is twice its other
};
[[nodiscard]] BeamMatrices beam_matrices(const Cylinder &cylinder, double axial_force = 0);

/// M q'' + (C + Omega G) q' + (K + Omega Kc) q = 0 in the fixed frame, Omega positive from x to y;
/// q: w and phi at every node in x, then w of every pedestal in x, then the same in y.
struct DenseRotor {
    std::vector<double> z; ///< of the nodes, m
    Eigen::MatrixXd M, C, G, K, Kc;
    std::vector<Eigen::Index> pedestals; ///< row in x of that of each support; -1: it has none

    [[nodiscard]] Eigen::Index planar() const { return M.rows() / 2; }
    /// Row of the deflection in x at a node; throws where there is none.
    [[nodiscard]] Eigen::Index deflection(double place) const;
};

/// The cylinder of an element from `left` to `right`, both measured from the beginning of its
/// segment, m: a cone by the diameters of the element's middle.
[[nodiscard]] Cylinder element_between(const Segment &segment, double left, double right);

/// Elements as the case asks for, each cut into `parts`; nodes wherever something is attached.
/// Internal damping eta: C_i = eta K of the shaft, Kc = [0 C_i; -C_i 0].
[[nodiscard]] DenseRotor dense_rotor(const CaseRotor &rotor, int parts = 1);

/// Eigenvalues lambda (1/s) of the state matrix with Im > 0, by ascending imaginary part.
/// Overdamped motions are left out.
[[nodiscard]] std::vector<std::complex<double>> whirl_eigenvalues(const DenseRotor &rotor,
                                                                  double speed);

/// Eigenvalues l (1/s) of motions that turn with the rotor's own speed l/i, damping ratio below
/// 1/sqrt(2): l^2 (M - i G) + l (C - i Kc) + K = 0 with Im l > |Re l|, by ascending imaginary part.
[[nodiscard]] std::vector<std::complex<double>> synchronous_eigenvalues(const DenseRotor &rotor);

/// A speed (rad/s) at which a whirl frequency is `multiple` times the speed.
struct Crossing {
    double speed = 0;
    bool forward = true; ///< larger part of the motion
};

/// All crossings, ascending: (K - w^2 (M - i G/multiple)) q = 0, w = multiple x speed. For rotors
/// without damping on bearings with kxy = kyx, stiffness positive, which is Hermitian.
[[nodiscard]] std::vector<Crossing> crossings(const DenseRotor &rotor, double multiple = 1);

/// Semi-major axis (m) of the orbit at z under the imbalances of the case; elements cut as above.
[[nodiscard]] double semi_major(const CaseRotor &rotor, double speed, double z, int parts = 1);

/// The motion under the imbalances of the case, elements as it asks for: phasors exp(i speed t).
struct ForcedPlaces {
    using Pair = std::array<std::complex<double>, 2>; ///< x and y
    std::vector<Pair> films;     ///< m, of the shaft in each support, against its pedestal
    std::vector<Pair> forces;    ///< N
    std::vector<Pair> pedestals; ///< m; zero where there is none
};
[[nodiscard]] ForcedPlaces forced_places(const CaseRotor &rotor, double speed);
/// Semi-major axis of what goes (x, y) exp(i speed t).
[[nodiscard]] double major_of(const ForcedPlaces::Pair &motion);

/// What a probe reads of the same, m; elements as the case asks for.
[[nodiscard]] double probe_reading(const CaseRotor &rotor, double speed, const Probe &probe);

} // namespace whirl::oracles

#pragma once

#include "assembly/hill_system.h"
#include "assembly/rotating_system.h"
#include "linalg/eigenpair.h"
#include "linalg/quadratic/quadratic_eigen.h"
#include "modes/orbits.h"
#include "modes/whirl_mode.h"

#include <array>
#include <complex>
#include <optional>
#include <utility>
#include <vector>

namespace whirl::modes {

/// Eigenvalues and whirl modes of a rotor in axes that turn with it: forms rotating and hill.
class RotatingSpectrum {
  public:
    /// Bearings as at `bearing_speed` (rad/s).
    /// @param balancers  at their balanced positions
    /// @param harmonics  of the Hill series; 0 where the bearings are the same from every direction
    /// @param shapes     planar shapes to reduce the rotor to (reduction/), or none; modes() is
    /// then
    ///                   not to be asked for
    RotatingSpectrum(const assembly::Discretization &discretization, double bearing_speed,
                     const std::vector<balancers::BalancerElement> &balancers, int harmonics,
                     const Eigen::MatrixXd *shapes = nullptr);

    /// The same for a reduced rotor without harmonics, whose eigenvalues are initial guesses:
    /// unrefined and without error estimates, at half the cost.
    static RotatingSpectrum rough(const assembly::Discretization &discretization,
                                  const std::vector<balancers::BalancerElement> &balancers,
                                  const Eigen::MatrixXd &shapes);

    /// Eigenvalues in rotating axes, Im >= 0; shape over the unknowns of the rotating system.
    struct Eigenvalues {
        std::vector<linalg::ComplexPair> pairs; ///< by modulus, ascending
        double complete_radius = 0;             ///< all of smaller modulus are in `pairs`
        double shift = 0;                       ///< that they were found from
        bool exhausted = false;                 ///< from its shift no more can be resolved
    };
    /// All of modulus up to `radius` (1/s), and at least `least`, or all there are.
    /// @throws linalg::SolverError
    [[nodiscard]] Eigenvalues eigenvalues(double speed, double radius, int least) const;

    /// Hill's series, every motion found at all its places 2 i speed apart that the cut leaves
    /// accurate: motions that resonate meet at one of them, which need not be that of the largest
    /// constant part. Vectors over all terms of the series. All places within `radius` of 0, and at
    /// least `least`, or all there are.
    /// @throws linalg::SolverError
    [[nodiscard]] Eigenvalues aliases(double speed, double radius, int least) const;

    /// Of deflections along the shaft, in x and y: a measure that no unit or mesh changes.
    [[nodiscard]] double motion_energy(const Eigen::VectorXcd &xy) const;

    /// Number k of the harmonic 2 k speed of Hill's series in which a motion is largest.
    [[nodiscard]] int largest_term(const Eigen::VectorXcd &vector) const;

    /// At least the `wanted` modes with the lowest frequencies in the fixed frame, or all:
    /// eigenvalue and shape of the dominant harmonic as seen from there, where the motion is
    /// Re(shape exp(eigenvalue t)) over real unknowns (x, y).
    /// @throws linalg::SolverError
    [[nodiscard]] Spectrum modes(double speed, int wanted,
                                 Errors errors = Errors::with_left_vectors) const;

    /// The eigenvalues that these modes are among.
    struct Lowest {
        Eigenvalues found;
        double highest = 0;  ///< modulus of the last of them as seen from the fixed frame, 1/s
        bool enough = false; ///< as many as wanted are complete
    };
    /// @throws linalg::SolverError
    [[nodiscard]] Lowest lowest(double speed, int wanted) const;
    /// Of eigenvalues over the unknowns of this rotor.
    [[nodiscard]] Spectrum modes_of(const Eigenvalues &found, double speed) const;
    /// Whether it is up to a modulus as seen from the fixed frame, 1/s, or grows.
    [[nodiscard]] bool asked_for(const linalg::ComplexPair &pair, double speed,
                                 double highest) const;
    /// Whether it is an artificial root of the one-diameter constraint of moving parts, not a mode.
    [[nodiscard]] bool held(const Eigen::VectorXcd &vector) const;
    [[nodiscard]] WhirlMode in_fixed_frame(const linalg::ComplexPair &pair, double speed) const;

    [[nodiscard]] const assembly::RotatingSystem &system() const { return _system; }
    [[nodiscard]] const Stations &stations() const { return _stations; }
    /// The constant terms of Hill's series at a speed.
    [[nodiscard]] assembly::SystemAtSpeed hill_system(double speed) const;
    [[nodiscard]] int harmonics() const { return _harmonics; }

  private:
    const assembly::Discretization &_discretization;
    int _harmonics;
    assembly::RotatingSystem _system;
    std::optional<assembly::PeriodicSupports> _supports;
    Eigen::SparseMatrix<double> _M, _C, _Cs, _K, _Ks, _Kss; ///< of the system, to be combined
    Eigen::Index _parts = 0;                                ///< first unknown of balancers' parts
    /// First unknowns and diameters of parts that move across one alone (SmallMotions).
    std::vector<std::pair<Eigen::Index, std::complex<double>>> _held;
    Stations _stations;
    /// Of a reduced rotor all motions are found.
    linalg::QuadraticMethod _method = linalg::QuadraticMethod::automatic;
    bool _rough = false;
    std::array<Eigen::MatrixXd, 6> _full; ///< of a rough one: _M, _C, ... as full matrices
    mutable int _usual = 6; ///< pairs that were enough last time: the first try of the next

    /// Aliases of a motion that are accurate.
    enum class Keep {
        best,    ///< the one whose constant part is largest
        accurate ///< those whose largest term has neighbours on both sides in the series
    };
    /// The modulus up to which none is missing, 1/s.
    enum class Reach {
        asked,   ///< the radius
        farthest ///< as far as double precision goes: modes beyond are known to be missing
    };
    /// What a shift gives from which no more can be had, however many are asked for.
    struct Exhausted {
        double shift = 0;
        Keep keep = Keep::best;
        Eigenvalues found;
        double sought = 0; ///< radius up to which a more complete answer was sought
    };
    mutable double _exhausted_speed = 0;
    mutable std::vector<Exhausted> _exhausted; ///< at that speed
    [[nodiscard]] Eigenvalues up_to(double speed, double radius, int least, Keep keep,
                                    Reach reach) const;
    [[nodiscard]] Eigenvalues up_to(double speed, double radius, int least, Keep keep, Reach reach,
                                    double shift) const;
    /// @param radius  needed, as far as double precision goes
    [[nodiscard]] Eigenvalues solve(double speed, int wanted, double radius, double shift,
                                    Keep keep) const;
    /// @param radius  as of solve()
    [[nodiscard]] linalg::QuadraticResult solve_hill(double speed, int wanted, double radius,
                                                     double shift) const;
    static void take_self_conjugate(double speed, std::vector<linalg::ComplexPair> &all,
                                    linalg::ComplexPair &pair);
    [[nodiscard]] bool cut_off(const Eigen::VectorXcd &series) const;
    /// Residual and rounding by left vectors of the motions up to a modulus as seen from the fixed
    /// frame, 1/s, and of all that grow: a factorisation each.
    void judge(Eigenvalues &found, double speed, double highest) const;
};

} // namespace whirl::modes

#pragma once

#include <array>
#include <complex>
#include <vector>

/// Independent answers to compare the program with. Nothing here uses the program's code.
namespace whirl::oracles {

using Real = long double;
using Complex = std::complex<long double>;
using Block = std::array<std::array<double, 2>, 2>; ///< [xx xy; yx yy]

/// A length of uniform hollow shaft; SI units throughout.
struct Cylinder {
    double length = 0;
    double outer = 0; ///< diameter, m
    double inner = 0; ///< diameter, m
    double E = 0;
    double G = 0;
    double rho = 0;
    double kappa = 0; ///< shear coefficient; 0: Cowper, J. Appl. Mech. 33 (1966) 335
};

struct RigidDisc {
    double z = 0;
    double mass = 0;
    double Id = 0;
    double Ip = 0;
};

/// Spring and damper to the ground, or to an isotropic pedestal on the ground.
struct Support {
    double z = 0;
    Block k{};  ///< N/m
    Block c{};  ///< N s/m
    Block kt{}; ///< on the slopes, N m
    Block ct{}; ///< on the slopes, N m s
    bool pedestal = false;
    double pedestal_mass = 0; ///< kg
    double pedestal_k = 0;    ///< N/m
    double pedestal_c = 0;    ///< N s/m
};

struct SteppedRotor {
    std::vector<Cylinder> shaft;
    std::vector<RigidDisc> discs;
    std::vector<Support> supports;
    double internal_damping = 0; ///< s; moduli E(1 + this d/dt), G(1 + this d/dt) in the rotor

    [[nodiscard]] double length() const;
};

/// Which motions: circular ones of w = x + i y (forward) or of x - i y (backward), where the
/// supports do not couple them, or both at once.
enum class Motion { forward, backward, both };

/// At a fixed spin speed, or with the spin speed lambda / i (critical speeds).
struct Question {
    Motion motion = Motion::forward;
    double speed = 0; ///< rad/s
    bool synchronous = false;
};

/// value * 2^exponent
struct Scaled {
    Complex value;
    long exponent = 0;
};

template <class Number> struct Dynamics;

/// Exact motion of a stepped Timoshenko shaft with everything attached to it, proportional to
/// exp(lambda t): transfer matrices of the beam's differential equation, summed as power series
/// over lengths short against the wave, the subspace of free left ends made orthonormal after each.
/// So neither long lengths (growing exponentials) nor gaps of 1e-9 of the length cost digits.
class Continuum {
  public:
    explicit Continuum(const SteppedRotor &rotor);

    /// Supports couple forward and backward motion.
    [[nodiscard]] bool coupled() const { return _coupled; }
    /// No damping and symmetric stiffness: frequencies are real and can be counted.
    [[nodiscard]] bool conservative() const { return _conservative; }

    /// Analytic in lambda; zero exactly at the eigenvalues.
    [[nodiscard]] Scaled determinant(Complex lambda, const Question &question) const;

    /// The same at lambda = i omega; real where no support couples x with y.
    /// @param below  if given, set to the number of frequencies in (0, omega), by the inertia of
    /// the left
    ///               part at each station (Wittrick and Williams 1971); conservative rotors with
    ///               positive stiffness
    [[nodiscard]] Scaled determinant_at(Real omega, const Question &question,
                                        int *below = nullptr) const;

    /// sqrt(EI / (mass of unit length L^4)) of the first segment, for first guesses.
    [[nodiscard]] Real reference_frequency() const;

    /// Between two stations, in units of the length and of the first segment's bending stiffness.
    struct Piece {
        Real length, EI, GA, mass, inertia;
    };
    /// Attached at a station, in the same units, but for the supports, which are in SI.
    struct Point {
        Real mass = 0, Id = 0, Ip = 0;
        std::vector<Support> supports;
    };
    struct Units {
        Real force = 1;  ///< L^3/EI
        Real moment = 1; ///< L/EI
    };

  private:
    std::vector<Piece> _pieces;
    std::vector<Point> _points; ///< before each piece, and after the last
    Units _units;
    Real _internal_damping = 0;
    bool _coupled = false;
    bool _real = true;
    bool _conservative = true;

    template <class Number, int planes>
    Scaled walk(const Dynamics<Number> &dynamics, Motion motion, int *below) const;
    Scaled dispatch(bool real, Complex lambda, const Question &question, int *below) const;
};

} // namespace whirl::oracles

#pragma once

#include "analyses/formulation.h"
#include "analyses/show_result.h"

#include <complex>
#include <optional>
#include <string>
#include <vector>

namespace whirl::analyses {

/// Sense of the orbits of a whirl mode against the spin.
enum class Whirl {
    forward,
    backward,
    mixed ///< some stations whirl forward and some backward, or all move on straight lines
};

/// "forward", "backward" or "mixed".
[[nodiscard]] std::string whirl_name(Whirl whirl);

/// What every result says of the model behind it.
struct ModelSummary {
    Formulation formulation;
    int order = 0;                  ///< of the shaft elements; 1: classical
    int elements = 0;               ///< of the shaft
    int unknowns = 0;               ///< of the eigenproblem or the linear systems
    double seconds = 0;             ///< wall time of the computation, without input and output
    std::vector<std::string> notes; ///< what a user must know beside the numbers
};

/// One whirl mode along the spin speeds; each list has one entry a speed.
struct CampbellMode {
    std::string label;                                ///< "1B", "1F", "2B", ..., "3M"
    std::vector<std::optional<double>> frequency;     ///< rad/s
    std::vector<std::string> absent;                  ///< why there is no frequency, in a word
    std::vector<std::optional<double>> real;          ///< 1/s
    std::vector<std::optional<double>> damping_ratio; ///< -Re/|lambda|
    std::vector<std::optional<double>> log_dec;       ///< -2 pi Re/Im
    std::vector<Whirl> whirl;
    std::vector<double> forward_fraction;        ///< share of the orbits that is forward, 0..1
    std::vector<std::optional<double>> error;    ///< relative estimate for |lambda|
    std::vector<std::optional<double>> residual; ///< relative, of the eigenpair
    std::vector<std::optional<double>> frequency_rotating; ///< rad/s; rotating forms only
};

/// A mode's frequency equals a multiple of the spin speed.
struct Crossing {
    double multiple = 1;
    double speed = 0;     ///< rad/s
    double frequency = 0; ///< rad/s
    int mode = 0;         ///< index into CampbellResult::modes
};

struct CampbellResult {
    ModelSummary model;
    std::vector<double> speeds; ///< rad/s
    std::vector<CampbellMode> modes;
    std::vector<Crossing> crossings;
    /// The largest real eigenvalue that grows at each speed, 1/s: divergence.
    std::vector<std::optional<double>> divergence;
};

struct CriticalSpeed {
    double speed = 0; ///< rad/s
    Whirl whirl = Whirl::forward;
    double real = 0;  ///< 1/s, of the synchronous eigenvalue
    double error = 0; ///< relative estimate
    double residual = 0;
};

struct CriticalResult {
    ModelSummary model;
    std::vector<CriticalSpeed> critical_speeds; ///< ascending
};

/// A mode shape at one speed, at stations fine enough to draw.
struct ModeShape {
    std::string label;
    std::complex<double> eigenvalue; ///< 1/s
    Whirl whirl = Whirl::forward;
    double forward_fraction = 1;
    std::vector<std::complex<double>> x; ///< deflections, largest modulus 1
    std::vector<std::complex<double>> y;
};

struct ModesResult {
    ModelSummary model;
    double speed = 0;      ///< rad/s
    std::vector<double> z; ///< m
    std::vector<ModeShape> modes;
};

/// What the scene is.
struct ShowResult {
    ModelSummary model;
    double mass = 0;           ///< kg, with balls and point-mass imbalances
    double center_of_mass = 0; ///< m
    double Id = 0;             ///< mean diametral, about the centre of mass, kg m2
    double Ip = 0;             ///< polar, kg m2
    std::string type;          ///< "long", "spherical" or "short"
    double shaft_mass = 0;     ///< kg
    double length = 0;         ///< m
    std::vector<std::pair<std::string, Formulation>> formulations; ///< command, what it will use
    std::optional<double> dI;       ///< principal diametral inertias Id -+ dI, kg m2
    std::optional<double> dI_angle; ///< axis of the smaller one in the rotor, rad
    std::vector<BalancerNumbers> balancers;
    std::optional<AnisotropyChart> anisotropy;
};

struct AccuracyRow {
    std::string family; ///< "classical" or "order-p"
    int order = 1;
    int elements = 1; ///< of the whole shaft
    int unknowns = 0;
    double seconds = 0;
    std::optional<double> error_estimate; ///< largest relative over the modes
    std::optional<double> true_error;     ///< against `reference`
};

struct AccuracyResult {
    ModelSummary model;
    std::string reference;                     ///< what true_error is measured against
    double speed = 0;                          ///< rad/s
    std::vector<double> reference_frequencies; ///< rad/s
    std::vector<AccuracyRow> rows;
};

} // namespace whirl::analyses

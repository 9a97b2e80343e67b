#pragma once

#include "model/attachments.h"
#include "model/operation.h"
#include "results/critical.h"
#include "results/error_parts.h"
#include "results/margins.h"
#include "results/model_summary.h"
#include "results/operating.h"
#include "results/orbits.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::results {

/// Semi-axes of the motion at a multiple of the spin speed, one entry a speed, m.
struct ResponseHarmonic {
    int multiple = 3;
    std::vector<double> major;
    std::vector<double> minor; ///< negative: backward
};

/// Orbit of a station over speed: x(t) = |x| cos(speed t + x_phase), y(t) likewise, an ellipse.
/// One entry a speed; infinite or NaN at a resonance without damping.
struct ResponseNode {
    double z = 0;
    std::string name;                ///< of what is attached there, or empty
    std::vector<double> amplitude;   ///< largest radius of the orbit = semi-major axis, m
    std::vector<double> phase;       ///< that of x, rad
    std::vector<double> major;       ///< semi-axes of the ellipse, m
    std::vector<double> minor;       ///< negative: backward orbit, m
    std::vector<double> x;           ///< |x|, m
    std::vector<double> y;           ///< |y|, m
    std::vector<double> x_phase;     ///< rad
    std::vector<double> y_phase;     ///< rad
    std::vector<double> inclination; ///< of the major axis, from x towards y, (-pi/2, pi/2]; NaN
                                     ///< where the orbit is a circle
    std::vector<double> error;       ///< estimated relative error, see response.h
    /// Of an asymmetric rotor on bearings that differ between their directions: what it moves at
    /// other multiples; `amplitude` is then the largest radius of all together.
    std::vector<ResponseHarmonic> harmonics{};
};

/// Reading of a probe over speed: amplitude cos(speed t + phase).
struct ResponseProbe {
    double z = 0;
    double angle = 0; ///< direction in which it looks, from x towards y, rad
    std::string name;
    std::vector<double> amplitude; ///< m
    std::vector<double> phase;     ///< rad
    std::vector<double> error;     ///< estimated, relative to the amplitude
};

struct ResponseBearing {
    double z = 0;
    std::string name;
    std::vector<double> force; ///< largest over a turn, N
    std::vector<double> error; ///< estimated, relative
};

/// What a local maximum over the spin speed is.
enum class PeakKind {
    resonance,
    heavily_damped, ///< a resonance with an amplification factor below 2.5 (Damping)
    flank,          ///< no resonance of its own: beside a higher peak of the same place, to which
                    ///< the curve rises before it has fallen to the half-power point
    plateau         ///< likewise: it does not fall that far within the range
};

/// "resonance", "heavily damped", "flank" or "plateau".
[[nodiscard]] std::string peak_kind_name(PeakKind kind);

/// A local maximum over the spin speed, found as a root of the derivative of the whole curve.
struct ResponsePeak {
    std::string of; ///< "station", "bearing" or "probe"
    int place = 0;  ///< among those of its kind, as in the lists of the result
    double z = 0;   ///< m
    std::string name;
    double speed = 0; ///< rad/s
    double value = 0; ///< semi-major axis or reading, m, or largest force, N; infinite: no damping
    double phase = 0; ///< of x or of the reading, rad; NaN without damping
    std::optional<double> angle; ///< in which a probe looks, rad
    /// Speed over the distance of the half-power points; none where one of them is not reached.
    std::optional<double> amplification;
    std::optional<double> lower, upper; ///< half-power points: 1/sqrt(2) of the value, rad/s
    double error = 0;                   ///< estimated relative error of the value; NaN: not known
    double speed_error = 0;             ///< the same of the speed
    /// Name of the line of the Campbell diagram that is nearest to resonance there; empty: none is
    /// near, or not known.
    std::string mode;
    ErrorParts error_parts{};               ///< of `error`
    PeakKind kind = PeakKind::plateau;      ///< resonances_of()
    std::optional<std::size_t> resonance{}; ///< place among those of the motion; none: of no one
};

/// What the peaks of several places at one speed, or nearly, are of.
struct Resonance {
    /// The largest of the stations, without one with an amplification factor of the probes, then of
    /// the bearings: its factor is that of the resonance.
    ResponsePeak peak;
    std::vector<std::size_t> peaks; ///< all that are of it, places in the list of peaks, ascending
};

/// The curves with points wherever they bend, to draw: a list over the speeds for each station,
/// then for each bearing, then for each probe.
struct ResponseCurves {
    std::vector<double> speeds;              ///< rad/s
    std::vector<std::vector<double>> values; ///< semi-major axes, m, and forces, N
    std::vector<std::vector<double>> phases; ///< of x, rad
};

/// Under the weight of a rotor: its deflection stands still in the fixed frame, sag_x + i sag_y,
/// and, where the rotor is not axisymmetric, goes round a circle at twice the spin speed besides.
/// One entry a speed; infinite or NaN at a resonance without damping.
struct GravityStation {
    double z = 0;
    std::string name;
    std::vector<double> sag, sag_x, sag_y; ///< m
    std::vector<double> twice;             ///< radius of the circle, m
    std::vector<double> phase;             ///< of x: twice cos(2 speed t + phase), rad
    std::vector<double> error, sag_error;  ///< estimated, relative: of twice, of the sag
};

struct GravityBearing {
    double z = 0;
    std::string name;
    std::vector<double> carried;              ///< what stands still of the force, N
    std::vector<double> twice;                ///< radius of what turns at twice the spin speed, N
    std::vector<double> error, carried_error; ///< estimated, relative: of twice, of the force
};

struct GravityResponse {
    double gravity = 0; ///< m/s2 towards -y
    std::vector<GravityStation> stations;
    std::vector<GravityBearing> bearings;
    std::vector<ResponsePeak> peaks; ///< of the part at twice the spin speed
    ResponseCurves curves;           ///< the same, of stations and bearings
    std::vector<Resonance> resonances{};
};

/// Motion of one frequency over the spin speed.
struct HarmonicMotion {
    std::vector<ResponseNode> nodes;
    std::vector<ResponseBearing> bearings;
    std::vector<ResponseProbe> probes;
    /// Every local maximum strictly inside the range, by place, then by speed.
    std::vector<ResponsePeak> peaks;
    ResponseCurves curves;               ///< empty where the range is one speed
    std::vector<Resonance> resonances{}; ///< what the peaks are of, ascending
};

/// What all forces of one frequency do together. Phases count from cos(frequency t).
struct ForceResponse : HarmonicMotion {
    std::optional<double> multiple;  ///< of the spin speed
    std::optional<double> frequency; ///< rad/s; one of the two is there
    struct Acting {
        double z = 0; ///< m
        std::string name;
        double amplitude = 0;  ///< N
        double phase = 0;      ///< rad
        std::string direction; ///< "x", "y", "forward" or "backward"
    };
    std::vector<Acting> forces;
};

/// A deflection over a harmonic force, at one spin speed: x over a force along x (xx), x over one
/// along y (xy), and so on. One entry a frequency; infinite or NaN at a resonance without damping.
struct ReceptanceDirection {
    std::string name;              ///< "xx", "xy", "yx" or "yy": deflection, then force
    std::vector<double> amplitude; ///< m/N
    std::vector<double> phase;     ///< of the deflection before the force, rad
    std::vector<double> error;     ///< estimated, relative
    ResponseCurves curve;          ///< to draw: of this direction alone, over the frequency
};

struct Receptance {
    double from = 0; ///< z of the force, m
    double to = 0;   ///< z of the deflection, m
    std::vector<ReceptanceDirection> directions;
};

/// A local maximum of a receptance over the frequency.
struct ReceptancePeak {
    int receptance = 0; ///< among those of the result
    std::string direction;
    double from = 0, to = 0; ///< m
    double frequency = 0;    ///< rad/s
    double value = 0;        ///< m/N; infinite: no damping
    double phase = 0;        ///< rad; NaN without damping
    std::optional<double> amplification;
    std::optional<double> lower, upper; ///< half-power points, rad/s
    double error = 0;                   ///< estimated, relative, of the value; NaN: not known
    double frequency_error = 0;         ///< the same of the frequency
};

struct ReceptanceResponse {
    double speed = 0;                ///< spin speed, rad/s
    std::vector<double> frequencies; ///< rad/s
    std::vector<Receptance> receptances;
    std::vector<ReceptancePeak> peaks; ///< by receptance, direction, frequency
};

/// The response to imbalances that a standard places, with one clearance of the bearings: what it
/// is judged by.
struct StandardRun {
    std::string name; ///< "first bending", "overhung left", ... or "imbalance of the case"
    model::BearingFit fit = model::BearingFit::given;
    std::vector<double> placed_by; ///< critical speeds whose shapes place them, rad/s
    std::vector<model::Imbalance> unbalance;
    OperatingResponse operating;
    std::vector<ResponsePeak> peaks; ///< as of HarmonicMotion, without names of modes
    std::vector<SeparationMargin> margins;
    std::vector<CriticalSpeed> critical_speeds; ///< with this clearance
    std::vector<Sentence> notes; ///< on peaks and critical speeds that have no margin
};

/// "run first bending", with the clearance where that is not the one given.
[[nodiscard]] Sentence run_name(const StandardRun &run);

struct ResponseResult : HarmonicMotion { ///< to the imbalances
    ModelSummary model;
    std::vector<double> speeds; ///< rad/s
    /// At the speeds of the case, or at peaks; resonances without damping have none.
    std::vector<Orbits> orbits;
    std::vector<DeflectedShape> shapes;
    std::vector<ClearanceUse> clearances; ///< of every bearing and seal with one
    /// Where the case has operating speeds, as in CriticalResult.
    std::optional<std::vector<SeparationMargin>> margins;
    /// Where the case has operating speeds and something that drives the rotor.
    std::optional<OperatingResponse> operating;
    /// Where the case asks for it; the lists above are empty without an imbalance.
    std::optional<GravityResponse> gravity;
    /// Forces of each frequency of their own: the motions add, their amplitudes do not.
    std::vector<ForceResponse> forces;
    std::optional<ReceptanceResponse> receptance;
    /// With [standard]: by clearance, then by name.
    std::vector<StandardRun> runs;
    std::optional<std::size_t> worst_run;
    Sentence worst_run_text; ///< which that is, and by what
    Sentence no_runs;        ///< why there are none although the case asks for them
    /// The case has no imbalance of its own: everything beside the runs is that of the first.
    bool of_first_run = false;
};

} // namespace whirl::results

#pragma once

// The pictures of the reports, one source each; the small ones stand with their command.

#include "model/case.h"
#include "report/common/drawing.h"
#include "report/common/units.h"
#include "report/pictures/chart.h"
#include "report/pictures/style.h"

#include <string>
#include <vector>

namespace whirl::results {
struct AnisotropyChart;
struct BalanceResult;
struct CampbellMode;
struct CampbellResult;
struct CriticalMap;
struct ForceResponse;
struct HeldSweep;
struct ManyStarts;
struct HarmonicMotion;
struct Level1;
struct ModeShape;
struct ModesResult;
struct PendulumBalance;
struct Placement;
struct ReceptanceResponse;
struct ResponseResult;
struct RigidLimitResult;
struct SampledAnswer;
struct SamplesResult;
struct ShowResult;
struct SimulateResult;
struct StabilityResult;
struct SteadyStates;
struct SweepResult;
struct FoundCycle;
struct Waterfall;
struct WeightsResult;
} // namespace whirl::results

namespace whirl::report {

/// Campbell diagram: whirl frequencies over spin speed, with the lines of the multiples and their
/// crossings; a second panel for the low range where the spin line would lie at the bottom, and one
/// for the logarithmic decrements of a damped rotor.
[[nodiscard]] Chart campbell_chart(const model::Case &scene, const results::CampbellResult &result,
                                   const Units &units);

/// Whether the mode grows at the index-th speed by more than its own error estimate.
[[nodiscard]] bool grows(const results::CampbellMode &mode, std::size_t index);

/// Unbalance response over spin speed: amplitudes (logarithmic), phases and bearing forces.
[[nodiscard]] Chart response_chart(const model::Case &scene, const results::ResponseResult &result,
                                   const Units &units);

/// The same under forces of one frequency.
[[nodiscard]] Chart force_chart(const model::Case &scene, const std::vector<double> &speeds,
                                const results::ForceResponse &response, const Units &units);
/// "2x" or "50 Hz": the frequency of forces.
[[nodiscard]] std::string excitation_text(const Units &units,
                                          const results::ForceResponse &response);

/// Deflections over forces over the frequency: amplitudes (logarithmic) and phases.
[[nodiscard]] Chart receptance_chart(const model::Case &scene,
                                     const results::ReceptanceResponse &response,
                                     const Units &units);
/// "xx, 0.8 m to 0.5 m"
[[nodiscard]] std::string direction_text(const Units &units, const std::string &direction,
                                         double from, double to);

/// Motion under the weight over spin speed: radius of the circle at twice the spin speed
/// (logarithmic), the deflection that stands still, bearing forces at twice the spin speed.
/// @param result  with the response to gravity
[[nodiscard]] Chart gravity_chart(const model::Case &scene, const results::ResponseResult &result,
                                  const Units &units);

/// Indices of the nodes that are drawn: all of them, or of many those with names first, filled up
/// with others that are spread along the shaft.
[[nodiscard]] std::vector<std::size_t> drawn_nodes(const results::HarmonicMotion &result);

/// Deflection of a mode in the two planes at the instants that tell its whirl: y a quarter period
/// after x, so that circular forward whirl has equal and backward whirl opposite curves. Where the
/// planes move rather in step, as in a straight orbit aslant, y would vanish then: both are at one
/// instant. Of all instants the one with the largest sum of squares along the shaft.
struct ModeCurves {
    std::vector<double> x;
    std::vector<double> y;
    std::vector<double> envelope; ///< major semi-axis of the orbit at each station
    bool at_one_instant = false;  ///< y not a quarter period later
};
[[nodiscard]] ModeCurves mode_curves(const results::ModeShape &mode);

/// One panel a mode: the orbits' envelope, the x and y curves and the rotor's outline.
[[nodiscard]] Chart modes_chart(const model::Case &scene, const results::ModesResult &result,
                                const Units &units);
/// "1F · 13.97 Hz · forward", with the damping ratio where there is damping; at critical speeds
/// these for the frequencies.
[[nodiscard]] std::vector<std::string> mode_headings(const std::vector<results::ModeShape> &modes,
                                                     const Units &units, bool critical);

/// Growth over speed with the unstable bands shaded, critical and additional speeds marked, and
/// the intervals over the arrangements of the balls as bars; with a map its picture below.
[[nodiscard]] Chart stability_chart(const model::Case &scene,
                                    const results::StabilityResult &result, const Units &units);

/// Critical speeds over the stiffness of the supports, both logarithmic, with the stiffness of the
/// bearings over speed and its crossings; below, the deflections of the forward motions at the soft
/// and the stiff end.
[[nodiscard]] Chart critical_map_chart(const model::Case &scene, const results::CriticalMap &map,
                                       const Units &units);

/// Logarithmic decrement over added cross coupling, its root and what is anticipated marked.
[[nodiscard]] Chart level1_chart(const model::Case &scene, const results::Level1 &level1,
                                 const Units &units);

/// Motion over time: amplitudes at the balancers, below them the angles of balls or pendulums in
/// the rotor (for balls that lag: their speed over that of the rotor), and the speed where it
/// changes. Without balancers amplitudes of the stations, their peaks marked; where the speed
/// changes over it too, beside the steady response, else deflections over time.
[[nodiscard]] Chart simulate_chart(const model::Case &scene, const results::SimulateResult &result,
                                   const Units &units);

/// Spectra one behind the other, over speed where that only rises or only falls, else over time;
/// multiples of the spin speed as lines.
[[nodiscard]] Chart waterfall_chart(const model::Case &scene, const results::Waterfall &waterfall,
                                    const Units &units);

/// Relative differences between model and rigid closed forms, logarithmic: over the stiffness of
/// the shaft, with a guide of slope -1 and the stiffness of 1 %, and over the number of elements.
[[nodiscard]] Chart rigid_limit_chart(const model::Case &scene,
                                      const results::RigidLimitResult &result, const Units &units);

/// One panel an answer, for the first of them: histogram of the samples, quantiles with their
/// intervals, and the case as it is.
[[nodiscard]] Chart samples_chart(const model::Case &scene, const results::SamplesResult &result,
                                  const Units &units);
/// Of what an answer says.
[[nodiscard]] ChartAxis answer_axis(const Units &units, const results::SampledAnswer &answer);

/// Answers over the first entry: a panel for those of one kind, a curve each; with two entries a
/// panel an answer, a curve for each value of the second.
[[nodiscard]] Chart sweep_chart(const model::Case &scene, const results::SweepResult &result,
                                const Units &units);

/// Bands over spin speed for each plane and for all together, flexible above rigid, and below them
/// the eigenvalues of the joint form, coloured by their sign, on an axis that is logarithmic away
/// from zero.
[[nodiscard]] Chart balance_chart(const model::Case &scene, const results::BalanceResult &result,
                                  const Units &units);

/// What stays over spin speed, a panel a probe (without any: a bearing or plane): with nothing, the
/// best weights, the balancers and both; below, what the planes need over what they can supply.
/// @param result  with an answer to what the balancers supply
[[nodiscard]] Chart residual_chart(const model::Case &scene, const results::BalanceResult &result,
                                   const Units &units);

/// Steady states: the largest amplitude of the balancers' planes over spin speed, or over the entry
/// that they are followed over, branch by branch,
/// coloured by what the balls do, stable ones solid and unstable ones dashed, with their borders.
[[nodiscard]] Chart states_chart(const model::Case &scene, const results::SteadyStates &states,
                                 const Units &units);

/// Limit cycles along a branch: largest and least amplitude over a period over spin speed, with
/// folds and borders of stability.
/// @param found  with a branch
[[nodiscard]] Chart cycle_chart(const model::Case &scene, const results::FoundCycle &found,
                                const Units &units);

/// The same with the motions of a sweep in time over them, up and down.
[[nodiscard]] Chart held_sweep_chart(const model::Case &scene, const results::HeldSweep &sweep,
                                     const Units &units);

/// Where motions end, over two of the angles at which their balls start: a coloured cell each of a
/// grid, a point each of random starts; and the angles of the states.
[[nodiscard]] Chart starts_chart(const model::Case &scene, const results::ManyStarts &starts,
                                 const Units &units);

/// Where along the shaft one balancer, and two, would work: the criterion over position and speed
/// with the rotor below it, and over two positions at one speed.
[[nodiscard]] Chart placement_chart(const model::Case &scene, const results::Placement &map,
                                    const Units &units);

/// Efficiency of a four-pendulum balancer over spin speed: planar forms, and the steady motions on
/// the flexible shaft by their stability.
[[nodiscard]] Chart pendulum_chart(const model::Case &scene,
                                   const results::PendulumBalance &balancer, const Units &units);

/// Efficiency of the planar rotor over the speed ratio: designs of the balancer side by side, and
/// its own design at several external dampings; exact by stability, and for small angles.
[[nodiscard]] Chart pendulum_designs_chart(const model::Case &scene,
                                           const results::PendulumBalance &balancer,
                                           const Units &units);

/// The composite rotor over the mass of the balls at the case's capacity: inertia of the balls and
/// diametral inertias, anisotropy, polar inertia, and the diametral inertia over the angle of its
/// axis; with the signed D, and with the unsigned D_A of the paper beside it.
///
/// @param index  of a balancer with curves
[[nodiscard]] Chart composite_chart(const model::Case &scene, const results::ShowResult &result,
                                    std::size_t index, const Units &units);

/// Tilt of the rigid rotor: critical speeds, stability limits and the unstable region ("-") over
/// the anisotropy, and over the polar inertia at the case's anisotropy.
[[nodiscard]] Chart anisotropy_chart(const model::Case &scene,
                                     const results::AnisotropyChart &chart, const Units &units);

/// Side view of the rotor to scale: shaft with bores and cones, discs, bearings, balancers,
/// correction planes and anisotropies. Diameters of very slender rotors are enlarged, and the
/// drawing says so.
[[nodiscard]] Drawing scene_drawing(const model::Case &scene, const Units &units);

/// The same with a line of mass, centre of mass and inertias, and the centre of mass marked.
[[nodiscard]] Drawing show_drawing(const model::Case &scene, const results::ShowResult &result,
                                   const Units &units);

/// Polar plots: readings before and after, a panel a speed (the first ones), and the weights in
/// their planes; from the model the amplitudes over speed below.
[[nodiscard]] Chart weights_chart(const model::Case &scene, const results::WeightsResult &result,
                                  const Units &units);

/// Response to a unit weight over speed, a pair of panels a plane: amplitudes (logarithmic) and
/// phases of what moves. @param result  with the influence over speed
[[nodiscard]] Chart influence_chart(const model::Case &scene, const results::WeightsResult &result,
                                    const Units &units);

} // namespace whirl::report

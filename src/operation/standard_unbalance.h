#pragma once

#include "model/rotor.h"

#include <string>
#include <vector>

namespace whirl::operation {

/// A mode of a rotor in the plane in which it moves most.
struct PlaneShape {
    double speed = 0;      ///< the critical speed, rad/s
    std::vector<double> z; ///< m, ascending, the bearings among them
    std::vector<double> w; ///< deflections there, in any measure
};

/// Imbalances that a standard asks for at once.
struct PlacedUnbalance {
    std::string name;
    std::vector<model::Imbalance> imbalances;
    std::vector<double> critical_speeds; ///< whose shapes place them, rad/s, ascending
};

/// Residual unbalance of API 617, 4 W/N oz in, W in lb, N in rpm. As 16 oz are 1 lb, that is
/// W (1/4 in rpm)/N = W (6.35 mm rpm)/N: 6350 W/N g mm, W in kg.
/// @param mass     whose weight the journals carry, kg
/// @param fastest  maximum continuous speed, rad/s
/// @returns mass times radius, kg m
[[nodiscard]] double api617_residual(double mass, double fastest);

/// Imbalances for the forced response as API 617 and API 684 place them, twice the residual ones,
/// by the shapes of modes (docs/checks.md, "Standard runs"):
///  - between the bearings in each loop of the shape a weight at its largest deflection, those of
///    neighbouring loops half a turn apart. One loop ("first bending"): W the load of both
///    journals. Two ("second bending"): W at each weight the load of the journal on its side. More,
///    for which the standard has no figure: equal shares of both loads;
///    A loop that deflects most at its bearing, as of a rigid rotor on soft bearings, has the
///    weight in the middle of its share of the span: mid-span of one loop, quarter-span of two;
///  - outside of a bearing, where the rotor deflects more there than anywhere between the bearings
///    ("overhung left", "overhung right"): at the largest deflection, W the overhung mass.
/// A loop that deflects less than a tenth of the largest one between the bearings is none. Where
/// the span deflects less than a quarter of the largest deflection of all, the mode is that of the
/// overhang alone. Weights go to a disc, bearing, probe or end of a segment that is within half a
/// percent of the shaft, where the shape is as good as the same. Modes whose weights are within 2 %
/// of the span of those of another share its run.
/// @param rotor    on two supports
/// @param fastest  maximum continuous speed, rad/s
[[nodiscard]] std::vector<PlacedUnbalance>
api617_unbalance(const model::Rotor &rotor, double fastest, const std::vector<PlaneShape> &shapes);

} // namespace whirl::operation

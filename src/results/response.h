#pragma once

#include "results/model_summary.h"

#include <string>
#include <vector>

namespace whirl::results {

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

struct ResponseResult {
    ModelSummary model;
    std::vector<double> speeds; ///< rad/s
    std::vector<ResponseNode> nodes;
    std::vector<ResponseBearing> bearings;
    std::vector<ResponseProbe> probes;
};

} // namespace whirl::results

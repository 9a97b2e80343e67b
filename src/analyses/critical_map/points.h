#pragma once

#include "assembly/discretization.h"
#include "model/rotor.h"
#include "results/formulation.h"
#include "results/whirl.h"
#include "synchronous/critical_speeds.h"

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace whirl::analyses {

inline constexpr std::array map_senses{results::Whirl::forward, results::Whirl::backward};

/// What all points of a critical speed map share.
struct MapScene {
    model::Rotor rotor; ///< without damping, all supports isotropic
    std::optional<std::size_t> varied;
    results::Form form = results::Form::planar;
    int order = 1;
    int wanted = 1; ///< critical speeds of each sense
    /// Of the softest supports, up to the highest critical speed on the stiffest.
    std::optional<synchronous::SharedShapes> shapes;

    [[nodiscard]] model::Rotor with_stiffness(double k) const;
    /// Roots kept of each sense: in rotating axes a motion is found in two directions.
    [[nodiscard]] std::size_t kept() const;
};

/// Curve of the n-th root of a sense, n from 0; a second direction of a motion that nothing
/// asymmetric takes part in has that of the first.
using CurveOf = std::map<std::pair<results::Whirl, std::size_t>, std::size_t>;

/// Places in the list of the critical speeds of one sense, ascending.
[[nodiscard]] std::vector<std::size_t> of_sense(const synchronous::SynchronousModes &list,
                                                results::Whirl whirl);

/// The lowest critical speeds of each sense, as many as the map keeps, or all.
/// @throws linalg::SolverError
[[nodiscard]] synchronous::SynchronousModes lowest_of_each(const MapScene &map,
                                                           const assembly::Discretization &d);

/// At one stiffness (N/m): speeds of map_senses in turn, kept() each, then their errors; NaN where
/// there are fewer.
[[nodiscard]] std::vector<double> point_at(const MapScene &map, double k);

} // namespace whirl::analyses

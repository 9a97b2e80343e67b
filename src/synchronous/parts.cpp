#include "synchronous/parts.h"

#include "assembly/hill_system.h"
#include "balancers/arrangement.h"
#include "modes/support_damping.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl::synchronous {

assembly::RotatingSystem held_in_rotating_axes(const assembly::Discretization &rotor,
                                               double bearing_speed) {
    return assembly::assemble_rotating(
        rotor, bearing_speed,
        balancers::balancer_elements(rotor.rotor(),
                                     balancers::arrangement_at_balance(rotor.rotor())),
        true);
}

assembly::FixedSystem turned_system(const assembly::Discretization &rotor, bool planar,
                                    double bearing_speed) {
    if (!planar)
        return assembly::assemble_fixed(rotor, bearing_speed);
    const int n = rotor.planar_size();
    assembly::PlanarSystem system = assembly::assemble_planar(rotor, bearing_speed);
    return {linalg::Matrix::sum(1, system.M, -1, system.G),
            linalg::Matrix::from_entries(n, modes::planar_support_damping(rotor, bearing_speed)),
            linalg::Matrix::from_entries(n, {}), std::move(system.K),
            linalg::Matrix::from_entries(n, {})};
}

assembly::FixedSystem steady_in_rotating_axes(const assembly::Discretization &rotor,
                                              double bearing_speed, int harmonics) {
    assembly::RotatingSystem system = held_in_rotating_axes(rotor, bearing_speed);
    if (harmonics > 0) {
        assembly::PeriodicStiffness series = assembly::periodic_stiffness(
            system, assembly::periodic_supports(rotor, bearing_speed, system.K.size()), harmonics);
        system.K = std::move(series.K);
        system.Ks = std::move(series.Ks);
        system.Kss = std::move(series.Kss);
    }
    const int n = system.K.size();
    return {linalg::Matrix::sum(-1, system.Kss, 0, system.Kss), linalg::Matrix::from_entries(n, {}),
            linalg::Matrix::from_entries(n, {}), std::move(system.K), std::move(system.Ks)};
}

Eigen::VectorXd unit_diagonal(const Eigen::VectorXd &diagonal) {
    return diagonal.unaryExpr(
        [](double d) { return d > 0 ? std::exp2(-std::round(std::log2(d) / 2)) : 1.0; });
}

std::vector<double> table_speeds(const model::Rotor &rotor) {
    std::vector<double> rows;
    for (const model::Bearing &bearing : rotor.bearings)
        if (bearing.depends_on_speed())
            rows.insert(rows.end(), bearing.speeds.begin(), bearing.speeds.end());
    std::ranges::sort(rows);
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    return rows;
}

} // namespace whirl::synchronous

#include "analyses/orbits.h"

#include <algorithm>
#include <cmath>

namespace whirl::analyses {

Stations::Stations(const assembly::Discretization &d, int per_span) {
    const auto &mesh = d.shaft_mesh();
    for (std::size_t span = 0; span < mesh.spans.size(); ++span) {
        _z.push_back(mesh.nodes[span]);
        _rows.push_back(d.deflection_at_node(static_cast<int>(span)));
        for (int i = 1; i <= per_span; ++i) {
            const double xi = static_cast<double>(i) / (per_span + 1);
            _z.push_back(mesh.spans[span].z + xi * mesh.spans[span].length);
            _rows.push_back(d.deflection_inside(static_cast<int>(span), xi));
        }
    }
    _z.push_back(mesh.nodes.back());
    _rows.push_back(d.deflection_at_node(static_cast<int>(mesh.nodes.size()) - 1));
}

Stations Stations::for_orbits(const assembly::Discretization &discretization) {
    return {discretization, discretization.shaft_mesh().spans.size() > 60 ? 0 : 3};
}

Eigen::VectorXcd Stations::deflections(const Eigen::VectorXcd &planar) const {
    Eigen::VectorXcd out(static_cast<Eigen::Index>(_rows.size()));
    for (std::size_t i = 0; i < _rows.size(); ++i) {
        std::complex<double> sum = 0;
        for (const auto &[unknown, value] : _rows[i])
            sum += value * planar(unknown);
        out(static_cast<Eigen::Index>(i)) = sum;
    }
    return out;
}

Ellipse ellipse_of(std::complex<double> x, std::complex<double> y) {
    const std::complex<double> i(0, 1);
    // x(t) + i y(t) = 1/2 (x + i y) exp(i w t) + 1/2 conj(x - i y) exp(-i w t)
    const double with = std::abs(x + i * y) / 2;
    const double against = std::abs(x - i * y) / 2;
    return {with + against, with - against};
}

OrbitSense orbit_sense(const Eigen::VectorXcd &x, const Eigen::VectorXcd &y, double spin_speed) {
    // Orbits smaller than this share of the largest say nothing; narrower ones than the second
    // share are straight lines to rounding and modelling accuracy.
    constexpr double significant = 0.01;
    constexpr double straight = 1e-6;
    double largest = 0;
    for (Eigen::Index i = 0; i < x.size(); ++i)
        largest = std::max(largest, ellipse_of(x(i), y(i)).major);
    double forward = 0;
    double backward = 0;
    double total = 0;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        const Ellipse orbit = ellipse_of(x(i), y(i));
        if (orbit.major < significant * largest)
            continue;
        const double weight = orbit.major * orbit.major;
        const double sense = spin_speed < 0 ? -orbit.minor : orbit.minor;
        total += weight;
        if (sense > straight * orbit.major)
            forward += weight;
        else if (sense < -straight * orbit.major)
            backward += weight;
    }
    if (forward + backward == 0 || total == 0)
        return {Whirl::mixed, 0.5};
    const double fraction = forward / (forward + backward);
    const Whirl whirl = backward == 0  ? Whirl::forward
                        : forward == 0 ? Whirl::backward
                                       : Whirl::mixed;
    return {whirl, fraction};
}

} // namespace whirl::analyses

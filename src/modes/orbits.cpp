#include "modes/orbits.h"

#include "balancers/balanced_position.h"
#include "elements/section.h"
#include "linalg/dense/products.h"
#include "results/whirl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace whirl::modes {

namespace {

using Complex = std::complex<double>;

/// Gauss's three points on [0, 1] with their weights: exact to degree 5 in each piece.
constexpr std::array<std::pair<double, double>, 3> gauss{{
    {0.11270166537925831, 5.0 / 18},
    {0.5, 8.0 / 18},
    {0.88729833462074169, 5.0 / 18},
}};

/// Pieces of the whole length: a mode of sixteen half waves has three pieces to each.
constexpr double pieces_of_length = 48;

/// Where the mass per length or the shape may have a kink: ends of segments, attached parts.
std::vector<double> kinks(const model::Rotor &rotor) {
    std::vector<double> out{0};
    for (const model::Segment &segment : rotor.shaft.segments)
        out.push_back(out.back() + segment.length);
    for (const model::Disc &disc : rotor.discs)
        out.push_back(disc.z);
    for (const model::Bearing &bearing : rotor.bearings)
        out.push_back(bearing.z);
    for (const model::Balancer &balancer : rotor.balancers)
        out.push_back(balancer.z);
    std::sort(out.begin(), out.end());
    return out;
}

} // namespace

Stations::Stations(const assembly::Discretization &d, int per_span) {
    const auto &mesh = d.shaft_mesh();
    for (std::size_t span = 0; span < mesh.spans.size(); ++span) {
        add(mesh.nodes[span], d.deflection_at_node(static_cast<int>(span)));
        for (int i = 1; i <= per_span; ++i) {
            const double xi = static_cast<double>(i) / (per_span + 1);
            add(mesh.spans[span].z + xi * mesh.spans[span].length,
                d.deflection_inside(static_cast<int>(span), xi));
        }
    }
    add(mesh.nodes.back(), d.deflection_at_node(static_cast<int>(mesh.nodes.size()) - 1));
}

Stations Stations::for_drawing(const assembly::Discretization &d) {
    // Stations along the shaft: a mode shape drawn with as many points is smooth.
    constexpr int wanted = 120;
    const auto spans = static_cast<int>(d.shaft_mesh().spans.size());
    return {d, std::max(0, (wanted + spans - 1) / spans - 1)};
}

void Stations::add(double z, const assembly::Combination &row) {
    _z.push_back(z);
    for (const auto &[unknown, value] : row) {
        _unknowns.push_back(unknown);
        _values.push_back(value);
    }
    _first.push_back(_unknowns.size());
}

void Stations::add(double z, const assembly::Combination &row, double mass,
                   std::vector<double> &masses) {
    add(z, row);
    masses.push_back(mass);
}

void Stations::add_shaft(const assembly::Discretization &d, std::vector<double> &masses) {
    const std::vector<mesh::Span> &spans = d.shaft_mesh().spans;
    const std::vector<double> ends = kinks(d.rotor());
    const double piece = ends.back() / pieces_of_length;
    std::size_t span = 0;
    for (std::size_t i = 1; i < ends.size(); ++i) {
        const double length = ends[i] - ends[i - 1];
        const int pieces =
            length > 0 ? std::max(1, static_cast<int>(std::ceil(length / piece))) : 0;
        for (int k = 0; k < pieces; ++k)
            for (const auto &[point, weight] : gauss) {
                const double z = ends[i - 1] + (k + point) * length / pieces;
                while (span + 1 < spans.size() && z > spans[span + 1].z)
                    ++span;
                const double xi = std::clamp((z - spans[span].z) / spans[span].length, 0.0, 1.0);
                const double rhoA = elements::beam_of(d.rotor().shaft, spans[span]).at(xi).rhoA;
                add(z, d.deflection_inside(static_cast<int>(span), xi),
                    rhoA * weight * length / pieces, masses);
            }
    }
}

Stations Stations::for_orbits(const assembly::Discretization &d) {
    Stations out;
    std::vector<double> masses;
    out.add_shaft(d, masses);
    for (const model::Disc &disc : d.rotor().discs)
        out.add(disc.z, d.deflection_at(disc.z), disc.mass, masses);
    for (const model::Balancer &balancer : d.rotor().balancers)
        out.add(balancer.z, d.deflection_at(balancer.z), balancers::mass_of(balancer), masses);
    out._masses = Eigen::Map<const Eigen::VectorXd>(masses.data(), std::ssize(masses));
    return out;
}

Eigen::VectorXcd Stations::deflections(const Eigen::VectorXcd &planar) const {
    Eigen::VectorXcd out(static_cast<Eigen::Index>(_z.size()));
    for (std::size_t i = 0; i < _z.size(); ++i) {
        Complex sum = 0;
        for (std::size_t p = _first[i]; p < _first[i + 1]; ++p)
            sum += _values[p] * planar(_unknowns[p]);
        out(static_cast<Eigen::Index>(i)) = sum;
    }
    return out;
}

std::pair<Eigen::VectorXcd, Eigen::VectorXcd>
Stations::deflections_of_both(const Eigen::VectorXcd &planes) const {
    std::pair<Eigen::VectorXcd, Eigen::VectorXcd> out(_z.size(), _z.size());
    for (std::size_t i = 0; i < _z.size(); ++i) {
        Eigen::Vector2cd sum = Eigen::Vector2cd::Zero();
        for (std::size_t p = _first[i]; p < _first[i + 1]; ++p)
            sum += _values[p] * planes.segment<2>(2 * _unknowns[p]);
        out.first(static_cast<Eigen::Index>(i)) = sum(0);
        out.second(static_cast<Eigen::Index>(i)) = sum(1);
    }
    return out;
}

Stations Stations::over(const Eigen::MatrixXd &shapes) const {
    Stations out;
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(_masses.size(), shapes.cols());
    for (std::size_t i = 0; i < _z.size(); ++i)
        for (std::size_t p = _first[i]; p < _first[i + 1]; ++p)
            rows.row(static_cast<Eigen::Index>(i)) += _values[p] * shapes.row(_unknowns[p]);
    out._weights = linalg::transposed_times(rows, Eigen::MatrixXd(_masses.asDiagonal() * rows));
    return out;
}

double Stations::deflection_energy(const Eigen::VectorXcd &planar) const {
    if (_weights.size() > 0) {
        const Eigen::VectorXcd a = planar.head(_weights.rows());
        return a.dot(_weights * a).real();
    }
    return _masses.dot(deflections(planar).cwiseAbs2());
}

Ellipse ellipse_of(std::complex<double> x, std::complex<double> y) {
    const std::complex<double> i(0, 1);
    // x(t) + i y(t) = 1/2 (x + i y) exp(i w t) + 1/2 conj(x - i y) exp(-i w t)
    const double with = std::abs(x + i * y) / 2;
    const double against = std::abs(x - i * y) / 2;
    return {with + against, with - against};
}

std::optional<double> orbit_plane(const Eigen::VectorXcd &x, const Eigen::VectorXcd &y,
                                  const Stations &stations) {
    constexpr double straight = 0.1; // across over along: what looks like a line
    double xx = 0;
    double yy = 0;
    double xy = 0;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        const double mass = stations.masses()(i);
        xx += mass * std::norm(x(i));
        yy += mass * std::norm(y(i));
        xy += mass * (x(i) * std::conj(y(i))).real();
    }
    // Mean squares of the deflections along the principal axes of [xx, xy; xy, yy].
    const double mean = (xx + yy) / 2;
    const double half = std::hypot((xx - yy) / 2, xy);
    if (!(mean - half <= straight * straight * (mean + half)) || mean == 0)
        return std::nullopt;
    constexpr double nothing = 1e-12; // rad: far above rounding
    const double angle = std::atan2(2 * xy, xx - yy) / 2;
    if (std::abs(angle) < nothing)
        return 0.0;
    // A line has no ends: from -80 to 100 degrees neither horizontal and vertical nor the diagonals
    // that cross coupling makes jump from one end to the other.
    constexpr double lowest = -4 * std::numbers::pi / 9;
    return angle > lowest ? angle : angle + std::numbers::pi;
}

OrbitSense orbit_sense(const Eigen::VectorXcd &x, const Eigen::VectorXcd &y,
                       const Stations &stations, double spin_speed) {
    // Ellipses narrower than the first share are straight lines to rounding and modelling accuracy.
    // A sense with less than the second share of the swept areas is that of places that hardly
    // move, beside the nodes of the mode.
    constexpr double straight = 1e-6;
    constexpr double significant = 0.01;
    const Complex i(0, 1);
    double positive = 0; // areas swept in the positive sense and against it, over pi
    double negative = 0;
    double size = 0;
    for (Eigen::Index k = 0; k < x.size(); ++k) {
        const double with = std::norm(x(k) + i * y(k));
        const double against = std::norm(x(k) - i * y(k));
        const double area = stations.masses()(k) * (with - against) / 4;
        (area > 0 ? positive : negative) += std::abs(area);
        // the square of the semi-major axis
        size += stations.masses()(k) * (with + against + 2 * std::sqrt(with * against)) / 4;
    }
    const double forward = spin_speed >= 0 ? positive : negative;
    const double swept = positive + negative;
    const std::optional<double> plane = orbit_plane(x, y, stations);
    if (!(swept > straight * size))
        return {results::Whirl::mixed, 0.5, plane};
    const double share = forward / swept;
    return {share >= 1 - significant ? results::Whirl::forward
            : share <= significant   ? results::Whirl::backward
                                     : results::Whirl::mixed,
            share, plane};
}

} // namespace whirl::modes

#include "modes/orbits.h"

#include "balancers/balanced_position.h"
#include "elements/section.h"
#include "linalg/dense/products.h"
#include "linalg/lanes/complex4.h"
#include "results/whirl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

namespace whirl::modes {

namespace {

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

Stations::Stations(const std::vector<Station> &stations, int unknowns)
    : _deflections(std::ssize(stations), unknowns), _masses(std::ssize(stations)) {
    std::vector<Eigen::Triplet<double>> entries;
    for (const auto &[z, deflection, mass] : stations) {
        const auto row = static_cast<int>(_z.size());
        for (const auto &[unknown, value] : deflection)
            entries.emplace_back(row, unknown, value);
        _masses(row) = mass;
        _z.push_back(z);
    }
    _deflections.setFromTriplets(entries.begin(), entries.end());
}

Stations Stations::for_drawing(const assembly::Discretization &d) {
    constexpr int wanted = 120;
    const auto &mesh = d.shaft_mesh();
    const auto spans = static_cast<int>(mesh.spans.size());
    const int parts = std::max(1, (wanted + spans - 1) / spans); // of each span
    std::vector<Station> stations;
    for (int i = 0; i < spans; ++i) {
        const mesh::Span &span = mesh.spans[static_cast<std::size_t>(i)];
        stations.push_back({mesh.nodes[static_cast<std::size_t>(i)], d.deflection_at_node(i)});
        for (int part = 1; part < parts; ++part) {
            const double xi = static_cast<double>(part) / parts;
            stations.push_back({span.z + xi * span.length, d.deflection_inside(i, xi)});
        }
    }
    stations.push_back({mesh.nodes.back(), d.deflection_at_node(spans)});
    return {stations, d.planar_size()};
}

void Stations::add_shaft(const assembly::Discretization &d, std::vector<Station> &stations) {
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
                stations.push_back({z, d.deflection_inside(static_cast<int>(span), xi),
                                    rhoA * weight * length / pieces});
            }
    }
}

Stations Stations::for_orbits(const assembly::Discretization &d) {
    std::vector<Station> stations;
    add_shaft(d, stations);
    for (const model::Disc &disc : d.rotor().discs)
        stations.push_back({disc.z, d.deflection_at(disc.z), disc.mass});
    for (const model::Balancer &balancer : d.rotor().balancers)
        stations.push_back({balancer.z, d.deflection_at(balancer.z), balancers::mass_of(balancer)});
    return {stations, d.planar_size()};
}

Eigen::VectorXcd Stations::deflections(const Eigen::VectorXcd &planar) const {
    return _deflections * planar.head(_deflections.cols());
}

std::pair<Eigen::VectorXcd, Eigen::VectorXcd>
Stations::deflections_of_both(const Eigen::VectorXcd &planes) const {
    std::vector<linalg::Real4> out(_z.size()); // real and imaginary parts of x and y at once
    const auto *in = reinterpret_cast<const double *>(planes.data());
    linalg::in_lanes([&]() __attribute__((always_inline)) {
        const int *first = _deflections.outerIndexPtr();
        for (std::size_t station = 0; station < out.size(); ++station)
            for (int p = first[station]; p < first[station + 1]; ++p) {
                linalg::Real4 four;
                std::memcpy(&four, in + 4 * _deflections.innerIndexPtr()[p], sizeof four);
                out[station] += _deflections.valuePtr()[p] * four;
            }
    });
    using Both = Eigen::Matrix<std::complex<double>, Eigen::Dynamic, 2, Eigen::RowMajor>;
    const auto *numbers = reinterpret_cast<const std::complex<double> *>(out.data());
    const Eigen::Map<const Both> both(numbers, std::ssize(out), 2);
    return {both.col(0), both.col(1)};
}

Stations Stations::over(const Eigen::MatrixXd &shapes) const {
    Stations out;
    const Eigen::MatrixXd rows = _deflections * shapes;
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

OrbitSense orbit_sense(const Eigen::VectorXcd &x, const Eigen::VectorXcd &y,
                       const Stations &stations, double spin_speed) {
    // Ellipses narrower than the first share are straight lines to rounding and modelling accuracy.
    // A sense with less than the second share of the swept areas is that of places that hardly
    // move, beside the nodes of the mode.
    constexpr double straight = 1e-6;
    constexpr double significant = 0.01;
    const auto squares = [](const auto &re, const auto &im) -> Eigen::ArrayXd {
        return re.array().square() + im.array().square();
    };
    const Eigen::ArrayXd with = squares(x.real() - y.imag(), x.imag() + y.real());    // |x + i y|^2
    const Eigen::ArrayXd against = squares(x.real() + y.imag(), x.imag() - y.real()); // |x - i y|^2
    const auto masses = stations.masses().array();
    const Eigen::ArrayXd area = masses * (with - against) / 4;
    const double positive = area.max(0).sum();
    const double negative = -area.min(0).sum();
    const double size = (masses * (with + against + 2 * (with * against).sqrt())).sum() / 4;
    const double forward = spin_speed >= 0 ? positive : negative;
    const double backward = spin_speed >= 0 ? negative : positive;
    const double swept = forward + backward;
    if (!(swept > straight * size))
        return {results::Whirl::mixed, 0.5};
    const double share = forward / swept;
    return {share >= 1 - significant ? results::Whirl::forward
            : share <= significant   ? results::Whirl::backward
                                     : results::Whirl::mixed,
            share};
}

} // namespace whirl::modes

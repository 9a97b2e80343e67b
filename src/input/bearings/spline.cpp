#include "input/bearings/coefficients.h"

#include <boost/math/interpolators/cubic_hermite.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace whirl::input {

namespace {

using model::BearingCoefficients;

constexpr std::array matrices{&BearingCoefficients::k, &BearingCoefficients::c,
                              &BearingCoefficients::m};
constexpr std::size_t most_rows = 2000;

/// Slopes at the nodes that make the cubics between them one with continuous second derivative, and
/// third derivative at the second and the last node but one (not-a-knot): so a cubic is met
/// exactly. C. de Boor, A Practical Guide to Splines, 1978, ch. IV, eq. (4) and (11).
std::vector<double> spline_slopes(const std::vector<double> &x, const std::vector<double> &y) {
    const auto n = static_cast<Eigen::Index>(x.size());
    const auto h = [&x](Eigen::Index i) {
        return x[static_cast<std::size_t>(i) + 1] - x[static_cast<std::size_t>(i)];
    };
    const auto secant = [&](Eigen::Index i) {
        return (y[static_cast<std::size_t>(i) + 1] - y[static_cast<std::size_t>(i)]) / h(i);
    };
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd b(n);
    for (Eigen::Index i = 1; i + 1 < n; ++i) { // second derivative
        A(i, i - 1) = h(i);
        A(i, i) = 2 * (h(i - 1) + h(i));
        A(i, i + 1) = h(i - 1);
        b(i) = 3 * (h(i) * secant(i - 1) + h(i - 1) * secant(i));
    }
    // Third derivative 6 (s_i + s_i+1 - 2 secant) / h^2, the same on either side.
    const auto end = [&](Eigen::Index row, Eigen::Index left) {
        const double p = 1 / (h(left) * h(left));
        const double q = 1 / (h(left + 1) * h(left + 1));
        A(row, left) = p;
        A(row, left + 1) = p - q;
        A(row, left + 2) = -q;
        b(row) = 2 * (p * secant(left) - q * secant(left + 1));
        const double size = A.row(row).cwiseAbs().maxCoeff();
        A.row(row) /= size;
        b(row) /= size;
    };
    if (n == 2)
        return std::vector<double>(2, secant(0));
    if (n == 3) { // both ends say the same: a parabola
        const double curvature = (secant(1) - secant(0)) / (h(0) + h(1));
        return {secant(0) - curvature * h(0), secant(0) + curvature * h(0),
                secant(1) + curvature * h(1)};
    }
    end(0, 0);
    end(n - 1, n - 3);
    const Eigen::VectorXd s = A.partialPivLu().solve(b);
    return {s.begin(), s.end()};
}

/// A coefficient over the speed.
struct Entry {
    CoefficientMatrix matrix;
    Eigen::Index place;
    std::vector<double> nodes, values, slopes;

    /// Largest second derivative between two nodes: at one of them.
    [[nodiscard]] double curvature(std::size_t i) const {
        const double h = nodes[i + 1] - nodes[i];
        const double secant = (values[i + 1] - values[i]) / h;
        const double left = 2 * (3 * secant - 2 * slopes[i] - slopes[i + 1]) / h;
        const double right = 2 * (2 * slopes[i + 1] + slopes[i] - 3 * secant) / h;
        return std::max(std::abs(left), std::abs(right));
    }
};

std::vector<Entry> entries_of(const model::Bearing &bearing) {
    std::vector<Entry> out;
    for (const CoefficientMatrix matrix : matrices)
        for (Eigen::Index place = 0; place < 4; ++place) {
            Entry entry{matrix, place, bearing.speeds, {}, {}};
            for (const BearingCoefficients &row : bearing.rows)
                entry.values.push_back((row.*matrix)(place));
            entry.slopes = spline_slopes(entry.nodes, entry.values);
            out.push_back(std::move(entry));
        }
    return out;
}

/// Pieces between two nodes whose chords depart little enough: h^2/8 times the second derivative.
std::size_t pieces_between(const std::vector<Entry> &entries, const model::Bearing &bearing,
                           std::size_t i, double departure) {
    const double h = bearing.speeds[i + 1] - bearing.speeds[i];
    double pieces = 1;
    for (const Entry &entry : entries) {
        double size = 0;
        for (const BearingCoefficients &row : bearing.rows)
            size = std::max(size, (row.*entry.matrix).cwiseAbs().maxCoeff());
        if (size > 0)
            pieces = std::max(pieces, h * std::sqrt(entry.curvature(i) / (8 * departure * size)));
    }
    return static_cast<std::size_t>(std::ceil(std::min(pieces, double(most_rows + 1))));
}

} // namespace

bool refine_by_spline(model::Bearing &bearing, double departure) {
    if (bearing.rows.size() < 3)
        return true;
    const std::vector<Entry> entries = entries_of(bearing);
    std::vector<double> speeds;
    for (std::size_t i = 0; i + 1 < bearing.speeds.size(); ++i) {
        const std::size_t pieces = pieces_between(entries, bearing, i, departure);
        const double h = bearing.speeds[i + 1] - bearing.speeds[i];
        for (std::size_t p = 0; p < pieces; ++p)
            speeds.push_back(bearing.speeds[i] +
                             h * static_cast<double>(p) / static_cast<double>(pieces));
        if (speeds.size() > most_rows)
            return false;
    }
    speeds.push_back(bearing.speeds.back());
    std::vector<BearingCoefficients> rows(speeds.size(), bearing.rows.front()); // tilt: constant
    for (const Entry &entry : entries) {
        const boost::math::interpolators::cubic_hermite spline(
            std::vector(entry.nodes), std::vector(entry.values), std::vector(entry.slopes));
        for (std::size_t i = 0; i < speeds.size(); ++i)
            (rows[i].*entry.matrix)(entry.place) = spline(speeds[i]);
    }
    for (std::size_t i = 0; i < speeds.size(); ++i) // at its nodes the table itself
        for (std::size_t node = 0; node < bearing.speeds.size(); ++node)
            if (speeds[i] == bearing.speeds[node])
                rows[i] = bearing.rows[node];
    bearing.speeds = std::move(speeds);
    bearing.rows = std::move(rows);
    return true;
}

} // namespace whirl::input

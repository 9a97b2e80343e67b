#include "input/bearings/spline.h"

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
constexpr double departure = 1e-5; ///< of straight lines, of the largest entry of a kind

/// Slopes at the nodes that make the cubics between them one with continuous second derivative, and
/// third derivative at the second and the last node but one (not-a-knot): so a cubic is met
/// exactly. C. de Boor, A Practical Guide to Splines, 1978, ch. IV, eq. (4) and (11).
/// @param x,y  three or more
std::vector<double> spline_slopes(const std::vector<double> &x, const std::vector<double> &y) {
    const auto n = std::ssize(x);
    const Eigen::Map<const Eigen::VectorXd> nodes(x.data(), n);
    const Eigen::Map<const Eigen::VectorXd> values(y.data(), n);
    const Eigen::VectorXd h = nodes.tail(n - 1) - nodes.head(n - 1);
    const Eigen::VectorXd secant = (values.tail(n - 1) - values.head(n - 1)).cwiseQuotient(h);
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
    double size; ///< of the largest entry of its kind
    std::vector<double> nodes, values, slopes;

    /// Second derivative at a speed between nodes i and i + 1.
    [[nodiscard]] double curvature(std::size_t i, double speed) const {
        const double h = nodes[i + 1] - nodes[i];
        const double secant = (values[i + 1] - values[i]) / h;
        const double left = 2 * (3 * secant - 2 * slopes[i] - slopes[i + 1]) / h;
        const double right = 2 * (2 * slopes[i + 1] + slopes[i] - 3 * secant) / h;
        return left + (right - left) * (speed - nodes[i]) / h;
    }
};

std::vector<Entry> entries_of(const model::Bearing &bearing) {
    std::vector<Entry> out;
    for (const CoefficientMatrix matrix : matrices) {
        double size = 0;
        for (const BearingCoefficients &row : bearing.rows)
            size = std::max(size, (row.*matrix).cwiseAbs().maxCoeff());
        for (Eigen::Index place = 0; place < 4; ++place) {
            Entry entry{matrix, place, size, bearing.speeds, {}, {}};
            for (const BearingCoefficients &row : bearing.rows)
                entry.values.push_back((row.*matrix)(place));
            entry.slopes = spline_slopes(entry.nodes, entry.values);
            out.push_back(std::move(entry));
        }
    }
    return out;
}

/// Speeds from `from` on, without `to`, between nodes i and i + 1: halved until every chord departs
/// little enough, by at most h^2/8 times the larger second derivative of its ends. Halves, so that
/// bearings with tables over the same speeds share their rows: each row is a piece to solve for.
void add_halved(const std::vector<Entry> &entries, std::size_t i, double from, double to,
                std::vector<double> &out) {
    const double square = (to - from) * (to - from);
    const bool near = std::ranges::all_of(entries, [&](const Entry &entry) {
        const double bend =
            std::max(std::abs(entry.curvature(i, from)), std::abs(entry.curvature(i, to)));
        return square * bend <= 8 * departure * entry.size;
    });
    if (near || out.size() > most_rows) {
        out.push_back(from);
        return;
    }
    const double middle = from + (to - from) / 2;
    add_halved(entries, i, from, middle, out);
    add_halved(entries, i, middle, to, out);
}

} // namespace

bool refine_by_spline(model::Bearing &bearing) {
    if (bearing.rows.size() < 3)
        return true;
    if (bearing.rows.size() > most_rows)
        return false;
    const std::vector<Entry> entries = entries_of(bearing);
    std::vector<double> speeds;
    for (std::size_t i = 0; i + 1 < bearing.speeds.size(); ++i)
        add_halved(entries, i, bearing.speeds[i], bearing.speeds[i + 1], speeds);
    if (speeds.size() > most_rows)
        return false;
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

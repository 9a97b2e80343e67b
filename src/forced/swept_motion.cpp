#include "forced/swept_motion.h"

#include "linalg/dense/products.h"
#include "synchronous/parts.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl::forced {

namespace {

using Values = linalg::RationalCurve::Values;

/// Misfit of the motions with mean coefficients: near what their rounding leaves, since sharp
/// resonances of the rotor with its bearings as they are make more of it.
constexpr double enough_of_means = 1e-11;

/// Of these matrices; smaller, by a power of two, where a few rows are much larger than the others.
Eigen::Matrix2d mean_of(const std::vector<model::BearingCoefficients> &rows,
                        Eigen::Matrix2d model::BearingCoefficients::*of) {
    Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
    double powers = 0;
    double count = 0; // of those that are not zero
    for (const model::BearingCoefficients &row : rows) {
        const double size = (row.*of).norm();
        sum += row.*of;
        powers += size > 0 ? std::log2(size) : 0;
        count += size > 0 ? 1 : 0;
    }
    if (sum.isZero(0))
        return sum;
    const Eigen::Matrix2d mean = sum / static_cast<double>(rows.size());
    return mean * std::exp2(std::min(0.0, std::round(powers / count - std::log2(mean.norm()))));
}

} // namespace

SweptMotion::Mean::Mean(const model::Rotor &rotor, int order, results::Form form,
                        const Drive &drive)
    : discretization(rotor, order), motion(discretization, form, drive, true) {}

SweptMotion::SweptMotion(const assembly::Discretization &discretization, results::Form form,
                         const std::vector<Quantity> &quantities, const Drive &drive, double from,
                         double to)
    : _discretization(discretization), _quantities(quantities), _drive(drive), _from(from), _to(to),
      _whole(discretization, form, drive, true) {
    const model::Rotor &rotor = discretization.rotor();
    if (drive.sweep.spin_rate == 0 || _whole.tabled().empty())
        return;
    _mean = std::make_unique<Mean>(with_means(rotor), discretization.order(), form, drive);
    for (const auto &entry : _whole.films(_whole.tabled(), from, from))
        _mean->acted_on.push_back(static_cast<int>(entry.row()));
    std::ranges::sort(_mean->acted_on);
    _mean->acted_on.erase(std::unique(_mean->acted_on.begin(), _mean->acted_on.end()),
                          _mean->acted_on.end());
    const auto count = std::ssize(_mean->acted_on);
    _mean->units.setZero(_whole.planes() * discretization.planar_size(), count);
    for (Eigen::Index i = 0; i < count; ++i)
        _mean->units(_mean->acted_on[static_cast<std::size_t>(i)], i) = 1;
    _mean->motions.emplace(
        std::vector{from, to}, [this](double s) { return solved_with_means(s); }, enough_of_means,
        most_solutions);
}

/// The mean of the coefficients at the rows in the range and at its ends, of the size of their
/// geometric mean where these differ by powers of ten: what a stiff support holds still says
/// nothing of how the rotor moves in a soft one. Damping is added to it, so that no resonance of
/// this rotor in its bearings is sharp.
model::Rotor SweptMotion::with_means(const model::Rotor &rotor) const {
    constexpr double added = 0.3; // of the stiffness, at the fastest speed
    model::Rotor out = rotor;
    for (model::Bearing &bearing : out.bearings) {
        if (!bearing.depends_on_speed())
            continue;
        std::vector<double> speeds{_from, _to};
        for (const double row : bearing.speeds)
            if (row > _from && row < _to)
                speeds.push_back(row);
        std::vector<model::BearingCoefficients> rows;
        for (const double speed : speeds)
            rows.push_back(bearing.at(speed));
        model::BearingCoefficients mean;
        for (const auto of : {&model::BearingCoefficients::k, &model::BearingCoefficients::c,
                              &model::BearingCoefficients::m, &model::BearingCoefficients::kt,
                              &model::BearingCoefficients::ct})
            mean.*of = mean_of(rows, of);
        const double fastest =
            std::max(std::abs(_drive.frequency_at(_from)), std::abs(_drive.frequency_at(_to)));
        if (fastest > 0)
            mean.c += added * mean.k.cwiseAbs().maxCoeff() / fastest * Eigen::Matrix2d::Identity();
        bearing.speeds.clear();
        bearing.rows = {mean};
    }
    return out;
}

std::vector<double> SweptMotion::cuts() const {
    std::vector<double> out{_from, _to};
    if (_mean)
        for (const double row : synchronous::table_speeds(_discretization.rotor()))
            if (row > _from && row < _to)
                out.push_back(row);
    std::ranges::sort(out);
    return out;
}

Values SweptMotion::values(const Stretches &stretches, double s, double rounding) const {
    Values out;
    const auto count = std::ssize(_quantities);
    out.numbers.resize(count, 2);
    out.rounding.resize(count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const Quantity &quantity = _quantities[static_cast<std::size_t>(i)];
        const Phasor stretch = _whole.in_fixed_frame(stretches.of(i));
        const Phasor seen = quantity.bearing == Quantity::deflection
                                ? quantity.seen(stretch)
                                : _whole.bearing_force(quantity.bearing, stretch, s);
        out.numbers.row(i) << seen.x, seen.y;
        out.rounding(i) = rounding * stretches.sizes(i);
        if (const double size = std::hypot(std::abs(stretch.x), std::abs(stretch.y));
            quantity.bearing != Quantity::deflection && size > 0)
            out.rounding(i) *= out.numbers.row(i).norm() / size;
    }
    return out;
}

SweptMotion::Stretches
SweptMotion::stretches(const Eigen::Ref<const Eigen::VectorXcd> &displacements) const {
    Stretches out;
    out.numbers.resize(std::ssize(_quantities), _whole.planes());
    out.sizes.setZero(out.numbers.rows());
    double largest = 0;
    for (Eigen::Index i = 0; i < out.numbers.rows(); ++i) {
        const assembly::Combination &stretch = _quantities[static_cast<std::size_t>(i)].stretch;
        const Phasor pair = _whole.as_solved(stretch, displacements);
        out.numbers(i, 0) = pair.x;
        if (out.numbers.cols() > 1)
            out.numbers(i, 1) = pair.y;
        for (const auto &[unknown, value] : stretch) {
            out.sizes(i) += std::abs(value);
            for (int k = 0; k < _whole.planes(); ++k)
                largest = std::max(largest, std::abs(displacements(_whole.planes() * unknown + k)));
        }
    }
    out.sizes *= largest; // one that is zero by symmetry has the rounding of the others
    return out;
}

std::optional<Values> SweptMotion::solved(double s) {
    if (!solves(_whole, s))
        return std::nullopt;
    return values(stretches(_whole.solution()), s, _whole.noise());
}

Eigen::VectorXd SweptMotion::rounding() const {
    const Stretches last = stretches(_whole.solution());
    Eigen::VectorXd out = Eigen::VectorXd::Constant(last.numbers.rows(), _whole.rounding());
    for (Eigen::Index i = 0; _drive.weight() && i < out.size(); ++i) {
        // What moves is what is left of the sag in axes that turn.
        const Phasor moves = _whole.in_fixed_frame(last.of(i));
        const double size = std::hypot(std::abs(moves.x), std::abs(moves.y));
        out(i) *= size > 0 ? std::max(1.0, last.numbers.row(i).norm() / size) : 1;
    }
    return out;
}

/// Rows: under the loads, then under each unit force, the stretches of all quantities and the
/// deflections that bearings with tables act on.
std::optional<Values> SweptMotion::solved_with_means(double s) {
    ForcedMotion &motion = _mean->motion;
    if (!solves(motion, s))
        return std::nullopt;
    const double noise = motion.noise();
    Eigen::MatrixXcd columns(_mean->units.rows(), 1 + _mean->units.cols());
    columns << motion.solution() / std::pow(s, power()), motion.under(_mean->units);
    const Eigen::Index count = std::ssize(_quantities);
    const Eigen::Index rows = count + std::ssize(_mean->acted_on);
    Values out;
    out.numbers.setZero(rows * columns.cols(), motion.planes());
    out.rounding.setZero(out.numbers.rows());
    for (Eigen::Index k = 0; k < columns.cols(); ++k) {
        const Stretches of = stretches(columns.col(k));
        out.numbers.middleRows(k * rows, count) = of.numbers;
        out.rounding.segment(k * rows, count) = of.sizes;
        const Eigen::VectorXcd acted_on = columns.col(k)(_mean->acted_on);
        out.numbers.col(0).segment(k * rows + count, acted_on.size()) = acted_on;
        out.rounding.segment(k * rows + count, acted_on.size())
            .setConstant(acted_on.cwiseAbs().maxCoeff());
    }
    out.rounding *= std::max(noise, motion.noise());
    return out;
}

/// What the bearings are beside their means, over the unknowns that they act on.
Eigen::MatrixXcd SweptMotion::beside_means(double s) const {
    const std::vector<int> &acted_on = _mean->acted_on;
    const auto place = [&acted_on](Eigen::Index unknown) {
        return std::ranges::lower_bound(acted_on, unknown) - acted_on.begin();
    };
    const double spin = _drive.sweep.spin_at(s);
    Eigen::MatrixXcd out = Eigen::MatrixXcd::Zero(std::ssize(acted_on), std::ssize(acted_on));
    for (const auto &entry : _whole.films(_whole.tabled(), spin, s))
        out(place(entry.row()), place(entry.col())) += entry.value();
    for (const auto &entry : _mean->motion.films(_whole.tabled(), spin, s))
        out(place(entry.row()), place(entry.col())) -= entry.value();
    return out;
}

std::optional<Values> SweptMotion::at(double s) {
    if (!_mean)
        return solved(s);
    // (P + Z) u = b with the P of the means: u = P^-1 (b + B f), f = -Z B^T u.
    const Eigen::MatrixXcd all = _mean->motions->with_slope(s).first;
    const Eigen::Index forces = std::ssize(_mean->acted_on);
    const Eigen::Index stretches = std::ssize(_quantities);
    const Eigen::Index rows = stretches + forces;
    const Eigen::MatrixXcd Z = beside_means(s);
    Eigen::MatrixXcd a(forces, 1 + forces);
    for (Eigen::Index k = 0; k <= forces; ++k)
        a.col(k) = all.col(0).segment(k * rows + stretches, forces);
    Eigen::MatrixXcd equations = linalg::times(Z, Eigen::MatrixXcd(a.rightCols(forces)));
    const double size = equations.norm();
    equations.diagonal().array() += 1;
    const Eigen::MatrixXcd inverse = Eigen::PartialPivLU<Eigen::MatrixXcd>(equations).inverse();
    const Eigen::VectorXcd f = -(inverse * (Z * a.col(0)));
    if (!f.allFinite())
        return std::nullopt;
    Eigen::MatrixXcd numbers = all.topRows(stretches);
    Eigen::VectorXd sizes = numbers.rowwise().norm();
    for (Eigen::Index k = 0; k < forces; ++k) {
        const Eigen::MatrixXcd more = f(k) * all.middleRows((k + 1) * rows, stretches);
        numbers += more;
        sizes += more.rowwise().norm();
    }
    numbers *= std::pow(s, power());
    sizes *= std::abs(std::pow(s, power()));
    return values({numbers, sizes}, s, enough_of_means * (1 + inverse.norm() * size));
}

std::vector<std::pair<double, double>> SweptMotion::unsettled() const {
    if (!_mean)
        return {};
    return _mean->motions->unsettled();
}

bool SweptMotion::take_in(const std::vector<double> &places) {
    constexpr double changed = 10 * enough_of_means; // else rounding
    return _mean && _mean->motions->take_in(places) > changed;
}

} // namespace whirl::forced

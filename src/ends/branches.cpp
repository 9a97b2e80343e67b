#include "ends/branches.h"

#include "ends/clusters.h"
#include "ends/coupling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace whirl::ends {

namespace {

using Complex = std::complex<double>;

constexpr int samples = 16; ///< of a cubic, to see two passages of zero in a step

/// From this ratio of speeds on a step is long enough for powers of the speed to show.
constexpr double long_step = 1.3;

bool is_long(double from, double to) {
    const double ratio = to / from;
    return ratio > long_step || (ratio > 0 && 1 / ratio > long_step);
}

double middle_of(double from, double to) {
    return is_long(from, to) ? std::abs(std::sqrt(from * to) - std::abs(from)) / std::abs(to - from)
                             : 0.5;
}

/// |z| without care for overflow: taken for every pair of roots.
double size_of(Complex z) { return std::sqrt(std::norm(z)); }

/// The cubic over a step from 0 with value 0: value and slopes at its end, slope at its start.
Complex cubic(double t, Complex rise, Complex d0, Complex d1) {
    return t * (d0 + t * (3.0 * rise - 2.0 * d0 - d1 + t * (d0 + d1 - 2.0 * rise)));
}

/// How far the value is from a parabola, whose rates are linear.
Complex off_parabola(const Branch &branch) {
    return branch.to->value - branch.from->value -
           branch.step * (branch.from->rate + branch.to->rate) / 2.0;
}

/// How badly one root continues another: the distance of the value from where the mean rate leads,
/// and the difference of the rates.
double misfit(const Branch &branch) {
    return size_of(off_parabola(branch)) +
           0.25 * std::abs(branch.step) * size_of(branch.to->rate - branch.from->rate);
}

/// The index of the conjugate of each root, a neighbour in the list; its own of a real root.
std::vector<int> conjugates(const Spectrum &spectrum) {
    std::vector<int> out;
    const auto count = static_cast<int>(spectrum.roots.size());
    for (int i = 0; i < count; ++i) {
        const Complex wanted = std::conj(spectrum.roots[static_cast<std::size_t>(i)].value);
        int place = i;
        for (const int other : {i, i - 1, i + 1})
            if (other >= 0 && other < count &&
                spectrum.roots[static_cast<std::size_t>(other)].value == wanted)
                place = other;
        out.push_back(place);
    }
    return out;
}

/// Takes motions that cannot be distinguished, none of which comes to the axis, in the order of
/// sign and frequency: which is which does not matter.
void add_as_one(Cluster a, Cluster b, double step, Branches &out) {
    const auto before = [](const Root *x, const Root *y) {
        return std::pair(x->sign(), x->value.imag()) < std::pair(y->sign(), y->value.imag());
    };
    std::ranges::sort(a, before);
    std::ranges::sort(b, before);
    ++out.clusters;
    for (std::size_t k = 0; k < a.size(); ++k)
        out.branches.push_back({a[k], b[k], step, out.clusters});
}

bool passes_safely(const Branch &branch) {
    const int a = branch.from->sign();
    const int b = branch.to->sign();
    if (a == 0 || b == 0)
        return true; // nothing more can be decided here
    // The part of the real part that a speed in between could disprove.
    const double bend = std::abs(off_parabola(branch).real());
    int changes = 0;
    double least = HUGE_VAL;
    double before = branch.from->value.real();
    for (int k = 1; k <= samples; ++k) {
        const double real = branch.at(static_cast<double>(k) / samples).real();
        changes += (real > 0) != (before > 0) ? 1 : 0;
        least = std::min({least, std::abs(real), std::abs(before)});
        before = real;
    }
    if (a == b)
        return changes == 0 && least > 0.5 * bend;
    return changes == 1 &&
           bend < 0.3 * std::abs(branch.to->value.real() - branch.from->value.real());
}

/// Of a cubic, to bracket an equal frequency: two of them pass at most three times.
constexpr int parts = 8;
using Course = std::array<double, parts + 1>; ///< frequencies along a branch

Course course_of(const Branch &branch) {
    Course out{};
    out.front() = branch.from->value.imag();
    for (int k = 1; k < parts; ++k)
        out[static_cast<std::size_t>(k)] = branch.at(static_cast<double>(k) / parts).imag();
    out.back() = branch.to->value.imag();
    return out;
}

/// Where the frequencies of two branches are equal, if they pass each other inside the step and
/// that speed is not an end of the step.
std::optional<double> passing(const Branch &a, const Branch &b, const Course &of_a,
                              const Course &of_b, double scale) {
    const auto gap = [&](double t) { return (a.at(t) - b.at(t)).imag(); };
    const double first = a.from->value.imag() - b.from->value.imag();
    const double last = a.to->value.imag() - b.to->value.imag();
    const double reals_from = std::abs(a.from->value.real()) + std::abs(b.from->value.real());
    const double reals_to = std::abs(a.to->value.real()) + std::abs(b.to->value.real());
    // Of the speed: the root of rounding doubled, what double roots are known to.
    constexpr double equal = 3e-8;
    constexpr double share = 0.25; // of what coupling must overcome
    if (std::abs(first) <= std::max(share * reals_from, equal * scale) ||
        std::abs(last) <= std::max(share * reals_to, equal * scale))
        return std::nullopt;
    double t0 = 0;
    double g0 = first;
    for (int k = 1; k <= parts; ++k) {
        const double t1 = static_cast<double>(k) / parts;
        const double g1 = of_a[static_cast<std::size_t>(k)] - of_b[static_cast<std::size_t>(k)];
        if ((g0 > 0) != (g1 > 0)) {
            double t = t0 + (t1 - t0) * g0 / (g0 - g1);
            for (int newton = 0; newton < 3; ++newton) {
                const double g = gap(t);
                const double slope = (g1 - g0) / (t1 - t0);
                t = std::clamp(t - g / slope, t0, t1);
            }
            return a.at(t).imag() + b.at(t).imag() >= -1e-9 * scale ? std::optional(t)
                                                                    : std::nullopt;
        }
        t0 = t1;
        g0 = g1;
    }
    return std::nullopt;
}

/// Numbers of roots at both ends of a step that belong together.
using Group = std::pair<std::vector<int>, std::vector<int>>;

/// The best partner must be better than the next by this factor.
constexpr double clearly = 0.35;

/// The least entry of a row or column, and the next larger one.
struct Best {
    Eigen::Index index = 0;
    double next = HUGE_VAL;
};
template <class Entries> Best best_of(const Entries &entries) {
    Best out;
    const double least = entries.minCoeff(&out.index);
    for (Eigen::Index k = 0; k < entries.size(); ++k)
        if (k != out.index)
            out.next = std::min(out.next, std::max(least, entries(k)));
    return out;
}

/// Groups of roots at both ends of a step that may belong to one branch: one root at either end
/// where that is clear.
class Groups {
  public:
    /// @param off  misfit of each root at the one end with each at the other
    explicit Groups(Eigen::MatrixXd off)
        : _rows(off.rows()), _group(static_cast<std::size_t>(off.rows() + off.cols())) {
        std::iota(_group.begin(), _group.end(), 0);
        take_clear_pairs(off);
        const Eigen::VectorXd of_row = off.rowwise().minCoeff() / clearly;
        const Eigen::VectorXd of_column = off.colwise().minCoeff() / clearly;
        for (Eigen::Index j = 0; j < off.cols(); ++j)
            for (Eigen::Index i = 0; i < _rows; ++i)
                if (std::isfinite(off(i, j)) &&
                    (off(i, j) <= of_row(i) || off(i, j) <= of_column(j)))
                    join(i, j);
    }

    [[nodiscard]] std::vector<Group> all() const {
        std::map<int, Group> groups;
        const auto rows = static_cast<int>(_rows);
        for (int k = 0; k < static_cast<int>(_group.size()); ++k) {
            auto &[first, second] = groups[_group[static_cast<std::size_t>(k)]];
            (k < rows ? first : second).push_back(k < rows ? k : k - rows);
        }
        std::vector<Group> out;
        for (auto &[number, group] : groups)
            out.push_back(std::move(group));
        return out;
    }

  private:
    Eigen::Index _rows;
    std::vector<int> _group; ///< of each row and of each column behind them, a number

    void join(Eigen::Index i, Eigen::Index j) {
        const int before = _group[static_cast<std::size_t>(i)];
        std::ranges::replace(_group, before, _group[static_cast<std::size_t>(_rows + j)]);
    }
    /// Pairs that are each other's best partner by far are taken out first.
    void take_clear_pairs(Eigen::MatrixXd &off) {
        std::vector<Best> of_column;
        for (Eigen::Index j = 0; j < off.cols(); ++j)
            of_column.push_back(best_of(off.col(j)));
        std::vector<std::pair<Eigen::Index, Eigen::Index>> pairs;
        for (Eigen::Index i = 0; i < _rows; ++i) {
            const Best row = best_of(off.row(i));
            const Best &column = of_column[static_cast<std::size_t>(row.index)];
            const double own = off(i, row.index);
            if (column.index == i && own <= clearly * std::min(row.next, column.next))
                pairs.emplace_back(i, row.index);
        }
        for (const auto &[i, j] : pairs) {
            join(i, j);
            off.row(i).setConstant(HUGE_VAL);
            off.col(j).setConstant(HUGE_VAL);
        }
    }
};

} // namespace

Complex Branch::at(double t) const {
    return from->value + cubic(t, to->value - from->value, step * from->rate, step * to->rate);
}

Branches followed(const Spectrum &from, const Spectrum &to) {
    const double step = to.speed - from.speed;
    const auto between = [&](int i, int j) {
        return Branch{&from.roots[static_cast<std::size_t>(i)],
                      &to.roots[static_cast<std::size_t>(j)], step};
    };
    const auto rows = static_cast<Eigen::Index>(from.roots.size());
    const auto columns = static_cast<Eigen::Index>(to.roots.size());
    Branches out;
    out.middle = middle_of(from.speed, to.speed);
    if (rows < 2 || columns < 2)
        return out;
    Eigen::MatrixXd off(rows, columns);
    const std::vector<int> conjugate_from = conjugates(from);
    const std::vector<int> conjugate_to = conjugates(to);
    for (Eigen::Index i = 0; i < rows; ++i) {
        const int same = conjugate_from[static_cast<std::size_t>(i)];
        for (Eigen::Index j = 0; j < columns; ++j)
            off(i, j) = same < i ? off(same, conjugate_to[static_cast<std::size_t>(j)])
                                 : misfit(between(static_cast<int>(i), static_cast<int>(j)));
    }
    const ClusterStep of_step{from.speed, to.speed, is_long(from.speed, to.speed)};
    for (const auto &[of_from, of_to] : Groups(std::move(off)).all()) {
        if (of_from.size() == 1 && of_to.size() == 1) {
            out.branches.push_back(between(of_from.front(), of_to.front()));
            continue;
        }
        const Cluster a = cluster(from, of_from);
        const Cluster b = cluster(to, of_to);
        if (all_alike(a, b, step))
            continue;
        if ((of_step.is_long && zero_but_for_rounding(a, b)) || off_the_axis(a, b, of_step)) {
            add_as_one(a, b, step, out);
        } else {
            out.clear = false;
        }
    }
    return out;
}

std::optional<double> where_to_refine(const Branches &all, const Spectrum &from, const Spectrum &to,
                                      double scale) {
    if (!all.clear)
        return all.middle;
    for (const Branch &branch : all.branches)
        if (branch.cluster == 0 && !passes_safely(branch))
            return all.middle;
    std::vector<Course> courses;
    for (const Branch &branch : all.branches)
        courses.push_back(course_of(branch));
    for (std::size_t i = 0; i < all.branches.size(); ++i)
        for (std::size_t k = i + 1; k < all.branches.size(); ++k) {
            const int cluster = all.branches[i].cluster;
            if (cluster != 0 && cluster == all.branches[k].cluster)
                continue;
            if (const auto t =
                    passing(all.branches[i], all.branches[k], courses[i], courses[k], scale);
                t && !weakly_coupled(all.branches[i], all.branches[k], *t, from, to))
                return t;
        }
    return std::nullopt;
}

} // namespace whirl::ends

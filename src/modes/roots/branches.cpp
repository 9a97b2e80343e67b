#include "modes/roots/branches.h"

#include "modes/roots/clusters.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace whirl::modes {

namespace {

using Complex = std::complex<double>;

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

/// How badly one root continues another: the distance of the value from where the mean rate leads,
/// and the difference of the rates.
double misfit(const Branch &branch) {
    return size_of(branch.off_parabola()) +
           0.25 * std::abs(branch.step) * size_of(branch.to->rate - branch.from->rate);
}

/// The index of the conjugate of each root, a neighbour in the list; its own of a real root.
std::vector<int> conjugates(const RootsAt &spectrum) {
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

Complex Branch::slope(double t) const {
    const Complex rise = to->value - from->value;
    const Complex d0 = step * from->rate;
    const Complex d1 = step * to->rate;
    return d0 + t * (2.0 * (3.0 * rise - 2.0 * d0 - d1) + 3.0 * t * (d0 + d1 - 2.0 * rise));
}

Complex Branch::off_parabola() const {
    return to->value - from->value - step * (from->rate + to->rate) / 2.0;
}

double Branch::zero() const {
    double low = 0;
    double high = 1;
    const bool grows = to->value.real() > 0;
    if ((from->value.real() > 0) == grows)
        return from->sign() == 0 ? 0 : 1; // at one end it is as good as zero
    for (int k = 0; k < 60; ++k) {
        const double middle = (low + high) / 2;
        ((at(middle).real() > 0) == grows ? high : low) = middle;
    }
    return (low + high) / 2;
}

Branches followed(const RootsAt &from, const RootsAt &to,
                  const std::function<bool(const Root &, const RootsAt &)> &matters) {
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
        } else if (one_root(a, b)) {
            for (std::size_t k = 0; k < a.size(); ++k)
                out.branches.push_back({a[k], b[k], step});
        } else {
            const auto counts = [&](const RootsAt &at) {
                return [&](const Root *root) { return !matters || matters(*root, at); };
            };
            out.clear = out.clear && std::ranges::none_of(a, counts(from)) &&
                        std::ranges::none_of(b, counts(to));
        }
    }
    return out;
}

} // namespace whirl::modes

#include "synchronous/followed.h"

#include "synchronous/branch.h"
#include "synchronous/general.h"
#include "synchronous/parts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace whirl::synchronous {

namespace {

using Complex = std::complex<double>;

/// Motions are followed a little beyond those that count, Im l > |Re l|.
constexpr double looked_at = 0.5;
constexpr double followed = 0.75;

/// All eigenvalues with the bearings as they are at one speed.
struct Sample {
    double speed = 0;
    std::vector<BranchPoint> points;
    bool complete = true; ///< none that could matter in the piece is missing
};

/// Speeds that agree to this are one: roots at rows of a table are found from both sides.
constexpr double one_speed = 2e-10;

bool same(const modes::WhirlMode &a, const modes::WhirlMode &b) {
    const double size = std::abs(a.eigenvalue);
    return std::abs(a.eigenvalue.imag() - b.eigenvalue.imag()) < 2 * one_speed * size &&
           std::abs(a.eigenvalue - b.eigenvalue) < 1e-8 * size &&
           std::abs(a.shape.dot(b.shape)) > 0.99 * a.shape.norm() * b.shape.norm();
}

/// Ascending, each once.
std::vector<modes::WhirlMode> tidied(std::vector<modes::WhirlMode> modes) {
    std::ranges::stable_sort(modes, {},
                             [](const modes::WhirlMode &mode) { return mode.eigenvalue.imag(); });
    std::vector<modes::WhirlMode> out;
    for (modes::WhirlMode &mode : modes)
        if (std::ranges::none_of(out, [&](const auto &other) { return same(other, mode); }))
            out.push_back(std::move(mode));
    return out;
}

/// Where Im l - s is going between two samples: the cubic in u = 0 .. 1.
struct Cubic {
    Cubic(const Sample &a, const BranchPoint &at_a, const Sample &b, const BranchPoint &at_b)
        : h(b.speed - a.speed), l0(at_a.eigenvalue), l1(at_b.eigenvalue), d0(h * at_a.slope),
          d1(h * at_b.slope), from(a.speed) {}
    double h;
    Complex l0, l1, d0, d1;
    double from;

    [[nodiscard]] Complex eigenvalue(double u) const {
        const double v = 1 - u;
        return v * v * ((1 + 2 * u) * l0 + u * d0) + u * u * ((3 - 2 * u) * l1 - v * d1);
    }
    [[nodiscard]] double above(double u) const { return eigenvalue(u).imag() - (from + u * h); }
    /// By how much values and derivatives disagree with a parabola, 1/s.
    [[nodiscard]] double misfit() const { return std::abs(l1 - l0 - (d0 + d1) / 2.0); }
};

/// Zeros of the cubic as u; none where their number is doubtful.
/// @param unseen  relative: what the ends do not know of the speeds between
std::optional<std::vector<double>> zeros_of(const Cubic &cubic, double unseen) {
    constexpr int parts = 32;
    const double doubt = 2 * cubic.misfit() + (1e-11 + unseen) * (cubic.from + cubic.h);
    std::vector<double> values;
    for (int i = 0; i <= parts; ++i)
        values.push_back(cubic.above(i / static_cast<double>(parts)));
    std::vector<double> zeros;
    for (std::size_t i = 0; i < parts; ++i) {
        const bool turns = i > 0 && (values[i] - values[i - 1]) * (values[i + 1] - values[i]) <= 0;
        if (turns && std::abs(values[i]) < doubt)
            return std::nullopt;
        if ((values[i] < 0) == (values[i + 1] < 0))
            continue;
        double a = static_cast<double>(i) / parts;
        double b = static_cast<double>(i + 1) / parts;
        for (int step = 0; step < 50; ++step) {
            const double middle = (a + b) / 2;
            ((cubic.above(middle) < 0) == (values[i] < 0) ? a : b) = middle;
        }
        zeros.push_back((a + b) / 2);
    }
    return zeros;
}

/// What the ends of a step over several rows cannot know of the speeds between, relative.
constexpr double between = 5e-3;

/// Rows from `first` on that are followed at once: up to the next one at which a table bends, or
/// twice the speed.
std::vector<double> rows_at_once(const std::vector<double> &bends, const std::vector<double> &rows,
                                 std::size_t first) {
    std::vector<double> out{rows[first], rows[first + 1]};
    for (std::size_t next = first + 2; next < rows.size(); ++next) {
        constexpr double widest = 2;
        const bool bend = std::ranges::binary_search(bends, out.back());
        if (bend || rows[next] > widest * out.front())
            break;
        out.push_back(rows[next]);
    }
    return out;
}

/// A piece of the tables, from row to row, or over several rows.
class Follower {
  public:
    Follower(const GeneralSynchronous &problem, std::vector<double> rows)
        : _problem(problem), _rows(std::move(rows)), _pieces(_rows.size() - 1),
          _first(_rows.front()), _last(_rows.back()) {}

    std::vector<modes::WhirlMode> found;
    std::vector<std::pair<double, double>> doubtful;

    /// @throws linalg::SolverError
    [[nodiscard]] Sample sample(double speed) const {
        const SynchronousModes all = _problem.lowest(speed, 0, 1.6 * _last, looked_at);
        Sample out{speed, {}, all.complete_to > _last};
        for (const modes::WhirlMode &mode : all.modes) {
            if (mode.eigenvalue.imag() < 0.4 * _first || mode.eigenvalue.imag() > 1.6 * _last)
                continue; // too far to matter, or to be the partner of one that does
            std::optional<BranchPoint> point =
                piece(place_of(speed))
                    .point(speed, mode.eigenvalue, mode.shape, 1e-7); // derivative
            // Iteration that runs to another eigenvalue has nothing to say on this one.
            if (point &&
                std::abs(point->eigenvalue - mode.eigenvalue) < 1e-5 * std::abs(mode.eigenvalue))
                out.points.push_back(std::move(*point));
            else
                out.points.push_back({mode.eigenvalue, 0, mode.shape, mode.residual, 1});
        }
        return out;
    }

    void follow(const Sample &a, const Sample &b, int depth) {
        if (resolved(a, b))
            return;
        constexpr int deepest = 12;
        const int most_samples = 100 + 4 * static_cast<int>(_rows.size());
        if (depth == deepest || ++_samples > most_samples) {
            doubtful.emplace_back(a.speed, b.speed);
            return;
        }
        const Sample middle = sample(cut(a.speed, b.speed));
        follow(a, middle, depth + 1);
        follow(middle, b, depth + 1);
    }

  private:
    const GeneralSynchronous &_problem;
    std::vector<double> _rows;
    mutable std::vector<std::optional<LinearSynchronous>> _pieces; ///< between rows, once needed
    double _first, _last;
    int _samples = 0;

    [[nodiscard]] std::size_t place_of(double speed) const {
        const auto above = std::upper_bound(_rows.begin() + 1, _rows.end() - 1, speed);
        return static_cast<std::size_t>(above - _rows.begin()) - 1;
    }
    [[nodiscard]] const LinearSynchronous &piece(std::size_t i) const {
        if (!_pieces[i])
            _pieces[i].emplace(_problem.problem(_rows[i]), _problem.problem(_rows[i + 1]), _rows[i],
                               _rows[i + 1]);
        return *_pieces[i];
    }
    /// Rows strictly between two speeds.
    [[nodiscard]] bool holds_rows(double from, double to) const {
        const auto next = std::upper_bound(_rows.begin(), _rows.end(), from);
        return next != _rows.end() && *next < to;
    }
    /// The middle of a step, or the row next to it.
    [[nodiscard]] double cut(double from, double to) const {
        const double middle = (from + to) / 2;
        if (!holds_rows(from, to))
            return middle;
        const auto above = std::lower_bound(_rows.begin() + 1, _rows.end() - 1, middle);
        return *above < to && (*above - middle < middle - *(above - 1) || *(above - 1) <= from)
                   ? *above
                   : *(above - 1);
    }
    /// Newton's steps towards the zero near a speed until they stay in one piece.
    void approach(double &speed, Complex &l, Eigen::VectorXcd &shape) const {
        constexpr int most = 4;
        for (int step = 0; step < most; ++step) {
            const std::size_t here = place_of(speed);
            const auto point = piece(here).point(speed, l, shape, 1e-7);
            if (!point)
                return;
            const double next =
                speed + (point->eigenvalue.imag() - speed) / (1 - point->slope.imag());
            if (!(next >= _first && next <= _last))
                return;
            l = point->eigenvalue + (next - speed) * point->slope;
            shape = point->shape;
            speed = next;
            if (place_of(speed) == here)
                return;
        }
    }
    /// The zero near a speed, in the piece that holds it or one of its neighbours.
    [[nodiscard]] std::optional<BranchPoint> standing(double speed, Complex l,
                                                      Eigen::VectorXcd shape) const {
        if (_pieces.size() > 1)
            approach(speed, l, shape);
        const auto here = static_cast<int>(place_of(speed));
        for (const int aside : {0, -1, 1, -2, 2})
            if (const int i = here + aside; i >= 0 && i < static_cast<int>(_pieces.size()))
                if (auto point = piece(static_cast<std::size_t>(i)).standing(speed, l, shape))
                    return point;
        return std::nullopt;
    }

    /// It could pass Im l = s in a step of this length.
    static bool matters(const BranchPoint &point, double speed, double step) {
        const Complex l = point.eigenvalue;
        return l.imag() > followed * std::abs(l.real()) &&
               std::abs(l.imag() - speed) <= 2 * step * (1 + std::abs(point.slope));
    }

    /// Index of the point of `b` that continues `point`; none where two would do.
    static std::optional<std::size_t> partner(const Sample &a, const BranchPoint &point,
                                              const Sample &b) {
        std::size_t best = b.points.size();
        double least = std::numeric_limits<double>::infinity();
        double second = least;
        for (std::size_t j = 0; j < b.points.size(); ++j) {
            const double misfit = Cubic(a, point, b, b.points[j]).misfit();
            const bool same = best < b.points.size() &&
                              std::abs(b.points[j].eigenvalue - b.points[best].eigenvalue) <
                                  1e-9 * std::abs(b.points[j].eigenvalue);
            if (misfit < least) {
                second = same ? second : least;
                least = misfit;
                best = j;
            } else if (!same) {
                second = std::min(second, misfit);
            }
        }
        const double scale = std::abs(b.speed - a.speed) * (1 + std::abs(point.slope));
        if (best == b.points.size() || 4 * least > second || least > 0.2 * scale)
            return std::nullopt;
        return best;
    }

    /// Every motion that matters has one partner each way; their zeros go to `found`.
    bool resolved(const Sample &a, const Sample &b) {
        const double step = b.speed - a.speed;
        std::map<std::size_t, std::size_t> pairs;
        for (std::size_t i = 0; i < a.points.size(); ++i)
            if (matters(a.points[i], a.speed, step)) {
                const auto j = partner(a, a.points[i], b);
                if (!j)
                    return false;
                pairs[i] = *j;
            }
        for (std::size_t j = 0; j < b.points.size(); ++j)
            if (matters(b.points[j], b.speed, step)) {
                const auto i = partner(b, b.points[j], a);
                if (!i)
                    return false;
                if (pairs.count(*i) == 0)
                    pairs[*i] = j;
            }
        std::vector<modes::WhirlMode> modes;
        if (!one_to_one(a, b, pairs))
            return false;
        for (std::size_t j = 0; j < b.points.size(); ++j)
            if (matters(b.points[j], b.speed, step) &&
                std::ranges::none_of(pairs, [j](const auto &pair) { return pair.second == j; }))
                return false;
        for (const auto &[i, j] : pairs)
            if (!add_zeros(a, i, b, j, modes))
                return false;
        found.insert(found.end(), modes.begin(), modes.end());
        return true;
    }

    /// No point is the partner of two, unless those are one double eigenvalue.
    static bool one_to_one(const Sample &a, const Sample &b,
                           std::map<std::size_t, std::size_t> &pairs) {
        std::map<std::size_t, std::size_t> taken; // j -> i
        for (auto &[i, j] : pairs) {
            const auto other = taken.find(j);
            if (other == taken.end()) {
                taken[j] = i;
                continue;
            }
            // A double eigenvalue at both ends: its second one is the partner.
            const Complex l = b.points[j].eigenvalue;
            std::optional<std::size_t> counterpart;
            for (std::size_t k = 0; k < b.points.size(); ++k)
                if (taken.count(k) == 0 &&
                    std::abs(b.points[k].eigenvalue - l) < 1e-9 * std::abs(l))
                    counterpart = k;
            const Complex here = a.points[i].eigenvalue;
            const Complex there = a.points[other->second].eigenvalue;
            if (!counterpart || std::abs(here - there) > 1e-9 * std::abs(here))
                return false;
            j = *counterpart;
            taken[j] = i;
        }
        return true;
    }

    bool add_zeros(const Sample &a, std::size_t i, const Sample &b, std::size_t j,
                   std::vector<modes::WhirlMode> &modes) const {
        const Cubic cubic(a, a.points[i], b, b.points[j]);
        auto zeros = zeros_of(cubic, holds_rows(a.speed, b.speed) ? between : 0);
        if (!zeros)
            return false;
        for (const double end : {0.0, 1.0})
            if (std::abs(cubic.above(end)) < one_speed / 2 * a.speed)
                zeros->push_back(end);
        for (const double u : *zeros) {
            const Eigen::VectorXcd &shape = (u < 0.5 ? a.points[i] : b.points[j]).shape;
            const double speed = a.speed + u * cubic.h;
            const auto point = standing(speed, cubic.eigenvalue(u), shape);
            const double slack = cubic.misfit() + 1e-9 * speed;
            if (!point || std::abs(point->eigenvalue.imag() - speed) > slack + 0.5 * cubic.h)
                return false;
            modes::WhirlMode mode;
            mode.eigenvalue = point->eigenvalue;
            mode.shape = point->shape;
            mode.residual = point->residual;
            mode.rounding = point->rounding;
            if (mode.eigenvalue.imag() > std::abs(mode.eigenvalue.real()))
                modes.push_back(std::move(mode));
        }
        return true;
    }
};

} // namespace

SynchronousModes followed_modes(const assembly::Discretization &rotor, results::Form form,
                                int wanted, double top) {
    const GeneralSynchronous problem(rotor, form);
    const std::vector<double> rows = table_speeds(rotor.rotor());
    const std::vector<double> bends = rotor.rotor().table_bends();
    SynchronousModes out;
    double row = std::max(rows.front(), 0.0);
    const SynchronousModes first = problem.lowest(row, 0, row);
    for (const modes::WhirlMode &mode : first.modes)
        if (mode.eigenvalue.imag() <= row * (1 + one_speed))
            out.modes.push_back(mode);
    if (first.complete_to < row)
        out.doubtful.emplace_back(first.complete_to, row);
    out.complete_to = row;
    const auto enough = [&] { return static_cast<int>(out.modes.size()) >= wanted && row > top; };
    std::vector<double> left{row};
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(left),
                 [row](double other) { return other > row; });
    for (std::size_t i = 0; i + 1 < left.size() && !enough();) {
        const std::vector<double> at_once = rows_at_once(bends, left, i);
        i += at_once.size() - 1;
        const double next = at_once.back();
        Follower follower(problem, at_once);
        const Sample from = follower.sample(row);
        const Sample to = follower.sample(next);
        follower.follow(from, to, 0);
        if (!from.complete || !to.complete)
            out.doubtful.emplace_back(row, next);
        out.modes.insert(out.modes.end(), follower.found.begin(), follower.found.end());
        out.doubtful.insert(out.doubtful.end(), follower.doubtful.begin(), follower.doubtful.end());
        out.complete_to = row = next;
    }
    if (!enough()) {
        const int missing = wanted - static_cast<int>(out.modes.size());
        for (int ask = std::max(missing, 1);; ask *= 2) {
            const SynchronousModes all = problem.lowest(row, ask, std::max(top, 1.01 * row));
            std::vector<modes::WhirlMode> above;
            std::copy_if(all.modes.begin(), all.modes.end(), std::back_inserter(above),
                         [&](const modes::WhirlMode &mode) {
                             return mode.eigenvalue.imag() >= row * (1 - one_speed);
                         });
            const bool more = static_cast<int>(all.modes.size()) >= ask;
            if (more && static_cast<int>(above.size()) < missing + 1)
                continue;
            out.modes.insert(out.modes.end(), above.begin(), above.end());
            out.complete_to = std::max(row, all.complete_to);
            break;
        }
    }
    out.modes = tidied(std::move(out.modes));
    return out;
}

} // namespace whirl::synchronous

#include "synchronous/followed.h"

#include "linalg/check.h"
#include "synchronous/branch.h"
#include "synchronous/parts.h"
#include "synchronous/reduced.h"

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
constexpr double least_steepness = 0.5;
constexpr double followed = 0.75;

/// All eigenvalues with the bearings as they are at one speed.
struct Sample {
    double speed = 0;
    std::vector<ReducedRoot> points;
    /// Of a conservative problem, all on the axes: W^2 = -l^2 is followed, real and smooth even
    /// where a stiffness passes zero; l is not.
    bool squares = false;
    std::vector<double> heavy; ///< |l| of motions too damped to be points
};

/// What of a motion is followed between two speeds: l, which is synchronous where Im l = s; or
/// -i l^2, where its imaginary part is s^2.
struct Followed {
    bool squares = false;
    [[nodiscard]] Complex value(const ReducedRoot &root) const {
        const Complex l = root.eigenvalue;
        return squares ? Complex(0, -1) * l * l : l;
    }
    [[nodiscard]] Complex rate(const ReducedRoot &root) const {
        return squares ? Complex(0, -2) * root.eigenvalue * root.slope : root.slope;
    }
    [[nodiscard]] double target(double speed) const { return squares ? speed * speed : speed; }
    [[nodiscard]] double target_rate(double speed) const { return squares ? 2 * speed : 1; }
};

Followed followed_between(const Sample &a, const Sample &b) { return {a.squares && b.squares}; }

/// A root of the whole rotor.
struct FoundRoot {
    modes::WhirlMode mode;
    bool downwards = true; ///< conservative: an eigenvalue of K - W^2 M falls through zero there
};

FoundRoot found_root(const BranchPoint &point) {
    FoundRoot out;
    out.mode.eigenvalue = point.eigenvalue;
    out.mode.shape = point.shape;
    out.mode.residual = point.residual;
    out.mode.rounding = point.rounding;
    out.downwards = point.downwards();
    return out;
}

/// Relative difference allowed between a root of the reduced rotor and that of the whole one: ten
/// times the usual one, far less than two motions of a rotor differ by.
constexpr double reduced_error = 1e-2;

/// Speeds that agree to this are one: roots at rows of a table are found from both sides.
constexpr double one_speed = 2e-10;

bool same(const modes::WhirlMode &a, const modes::WhirlMode &b) {
    const double size = std::abs(a.eigenvalue);
    return std::abs(a.eigenvalue.imag() - b.eigenvalue.imag()) < 2 * one_speed * size &&
           std::abs(a.eigenvalue - b.eigenvalue) < 1e-8 * size &&
           std::abs(a.shape.dot(b.shape)) > 0.99 * a.shape.norm() * b.shape.norm();
}

/// Ascending, each once; of a line that only touches there, both passages.
std::vector<FoundRoot> tidied(std::vector<FoundRoot> roots) {
    std::ranges::stable_sort(roots, {},
                             [](const FoundRoot &root) { return root.mode.eigenvalue.imag(); });
    std::vector<FoundRoot> out;
    for (FoundRoot &root : roots)
        if (std::ranges::none_of(out, [&](const FoundRoot &other) {
                return other.downwards == root.downwards && same(other.mode, root.mode);
            }))
            out.push_back(std::move(root));
    return out;
}

/// A followed motion between two samples: a cubic in u = 0 .. 1.
struct Cubic {
    Cubic(const Sample &a, const ReducedRoot &at_a, const Sample &b, const ReducedRoot &at_b)
        : what(followed_between(a, b)), h(b.speed - a.speed), l0(what.value(at_a)),
          l1(what.value(at_b)), d0(h * what.rate(at_a)), d1(h * what.rate(at_b)), from(a.speed) {}
    Followed what;
    double h;
    Complex l0, l1, d0, d1;
    double from;

    [[nodiscard]] Complex value(double u) const {
        const double v = 1 - u;
        return v * v * ((1 + 2 * u) * l0 + u * d0) + u * u * ((3 - 2 * u) * l1 - v * d1);
    }
    /// Above the synchronous value.
    [[nodiscard]] double above(double u) const {
        return value(u).imag() - what.target(from + u * h);
    }
    /// By how much values and derivatives disagree with a parabola.
    [[nodiscard]] double misfit() const { return std::abs(l1 - l0 - (d0 + d1) / 2.0); }
};

/// Zeros of the cubic as u; none where their number is doubtful.
/// @param unseen  relative: what the ends do not know of the speeds between
std::optional<std::vector<double>> zeros_of(const Cubic &cubic, double unseen) {
    // Of a cubic: three zeros at most, each bracketed unless two lie in one part.
    constexpr int parts = 32;
    const double last = cubic.from + cubic.h;
    const double doubt =
        2 * cubic.misfit() + (1e-11 + unseen) * last * cubic.what.target_rate(last);
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

/// Relative uncertainty between the ends of a step over several rows.
constexpr double between = 5e-3;

/// Rows from `first` on that are followed at once: up to the next one at which a table bends, or
/// twice the speed.
std::vector<double> rows_at_once(const std::vector<double> &bends, const std::vector<double> &rows,
                                 std::size_t first) {
    std::vector<double> out{rows[first], rows[first + 1]};
    for (std::size_t next = first + 2; next < rows.size(); ++next) {
        constexpr double widest = 2; // an octave: over more the motion is no cubic of the speed
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
    /// @param rows   of the piece
    /// @param first  number of the first of them among all
    /// @param conservative  the problem is
    Follower(const ReducedSynchronous &reduced, const WholeRoots &roots, bool conservative,
             std::vector<double> rows, std::size_t first)
        : _reduced(reduced), _roots(roots), _conservative(conservative), _rows(std::move(rows)),
          _number(first) {}

    std::vector<FoundRoot> found;
    std::vector<std::pair<double, double>> doubtful;

    /// @throws linalg::SolverError
    [[nodiscard]] Sample sample(double speed) const {
        const auto above = std::upper_bound(_rows.begin() + 1, _rows.end() - 1, speed);
        const auto piece = static_cast<std::size_t>(above - _rows.begin()) - 1;
        Sample out;
        out.speed = speed;
        out.points = _reduced.at(speed, _number + piece, 0);
        out.squares = _conservative && std::ranges::all_of(out.points, [](const ReducedRoot &root) {
                          return root.eigenvalue.real() == 0 || root.eigenvalue.imag() == 0;
                      });
        if (out.squares)
            return out;
        for (const ReducedRoot &root : out.points)
            if (root.eigenvalue.imag() <= followed * std::abs(root.eigenvalue.real()))
                out.heavy.push_back(std::abs(root.eigenvalue));
        std::erase_if(out.points, [](const ReducedRoot &root) {
            return root.eigenvalue.imag() <= least_steepness * std::abs(root.eigenvalue.real());
        });
        return out;
    }

    void follow(const Sample &a, const Sample &b, int depth) {
        if (!hides_motions(a, b, depth) && resolved(a, b))
            return;
        constexpr int deepest = 18; // where a stiffness passes zero a motion begins like a root
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
    const ReducedSynchronous &_reduced;
    const WholeRoots &_roots;
    bool _conservative;
    std::vector<double> _rows;
    std::size_t _number;
    int _samples = 0;

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

    /// A motion that is too damped to oscillate at an end of a long step may do so within it.
    static bool hides_motions(const Sample &a, const Sample &b, int depth) {
        constexpr double long_step = 0.1; // of the speed
        constexpr int deepest = 8;        // from speed zero on no step is short
        // A motion whose modulus is five times the speed does not come down to 1x in one
        // step.
        constexpr double far = 5;
        const auto heavy = [&](const Sample &end) {
            return std::ranges::any_of(end.heavy, [&](double size) {
                return size > a.speed / far && size < far * b.speed;
            });
        };
        return depth < deepest && b.speed - a.speed > long_step * b.speed && (heavy(a) || heavy(b));
    }

    /// It could become synchronous in a step of this length.
    static bool matters(const Followed &what, const ReducedRoot &point, double speed, double step) {
        const Complex l = point.eigenvalue;
        const double gap = std::abs(what.value(point).imag() - what.target(speed));
        return (what.squares || l.imag() > followed * std::abs(l.real())) &&
               gap <= 2 * step * (what.target_rate(speed + step) + std::abs(what.rate(point)));
    }

    /// Index of the point of `b` that continues `point`; none where two would do.
    static std::optional<std::size_t> partner(const Sample &a, const ReducedRoot &point,
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
        const Followed what = followed_between(a, b);
        const double scale =
            std::abs(b.speed - a.speed) *
            (what.target_rate(std::max(a.speed, b.speed)) + std::abs(what.rate(point)));
        if (best == b.points.size() || 4 * least > second || least > 0.2 * scale)
            return std::nullopt;
        return best;
    }

    /// Whether the partner of `point` is that one.
    static bool continues(const Sample &a, const ReducedRoot &point, const Sample &b,
                          const ReducedRoot &other) {
        const auto best = partner(a, point, b);
        return best && std::abs(b.points[*best].eigenvalue - other.eigenvalue) <=
                           1e-9 * std::abs(other.eigenvalue);
    }

    /// Every motion that matters has one partner each way; their zeros go to `found`.
    bool resolved(const Sample &a, const Sample &b) {
        const double step = b.speed - a.speed;
        const Followed what = followed_between(a, b);
        std::map<std::size_t, std::size_t> pairs;
        for (std::size_t i = 0; i < a.points.size(); ++i)
            if (matters(what, a.points[i], a.speed, step)) {
                const auto j = partner(a, a.points[i], b);
                if (!j || !continues(b, b.points[*j], a, a.points[i]))
                    return false;
                pairs[i] = *j;
            }
        for (std::size_t j = 0; j < b.points.size(); ++j)
            if (matters(what, b.points[j], b.speed, step)) {
                const auto i = partner(b, b.points[j], a);
                if (!i || !continues(a, a.points[*i], b, b.points[j]))
                    return false;
                if (pairs.count(*i) == 0)
                    pairs[*i] = j;
            }
        std::vector<FoundRoot> roots;
        if (!one_to_one(a, b, pairs))
            return false;
        for (std::size_t j = 0; j < b.points.size(); ++j)
            if (matters(what, b.points[j], b.speed, step) &&
                std::ranges::none_of(pairs, [j](const auto &pair) { return pair.second == j; }))
                return false;
        for (const auto &[i, j] : pairs)
            if (!add_zeros(a, i, b, j, roots))
                return false;
        found.insert(found.end(), roots.begin(), roots.end());
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
                   std::vector<FoundRoot> &roots) const {
        const Cubic cubic(a, a.points[i], b, b.points[j]);
        auto zeros = zeros_of(cubic, holds_rows(a.speed, b.speed) ? between : 0);
        if (!zeros)
            return false;
        for (const double end : {0.0, 1.0})
            if (std::abs(cubic.above(end)) < one_speed / 2 * cubic.what.target(a.speed))
                zeros->push_back(end);
        for (const double u : *zeros) {
            const Eigen::VectorXcd &shape = (u < 0.5 ? a.points[i] : b.points[j]).shape;
            const double speed = a.speed + u * cubic.h;
            const double decay = cubic.what.squares ? 0 : cubic.value(u).real();
            const auto point = _roots.near({decay, speed}, _reduced.lifted(shape));
            const double slack =
                cubic.misfit() / cubic.what.target_rate(speed) + reduced_error * speed;
            if (!point || std::abs(point->eigenvalue.imag() - speed) > slack + 0.5 * cubic.h)
                return false;
            if (point->eigenvalue.imag() > std::abs(point->eigenvalue.real()))
                roots.push_back(found_root(*point));
        }
        return true;
    }
};

/// Roots with constant coefficients, bearings as at a row: all up to `top`, and at least `wanted`.
/// @returns whether there are no more
bool add_constant(const ReducedSynchronous &reduced, const WholeRoots &roots, double speed,
                  std::size_t row, int wanted, double above, double top,
                  std::vector<FoundRoot> &found, std::vector<std::pair<double, double>> &doubtful) {
    constexpr double steepness_here = 0.9; // a little beyond those that count
    std::vector<double> taken;             // ascending
    // The order of the reduced rotor's roots may not be that of the whole one's.
    constexpr double ahead = 5 * reduced_error;
    const auto enough = [&](double frequency) {
        return std::ssize(taken) >= wanted &&
               (wanted <= 0 ||
                frequency > (1 + ahead) * taken[static_cast<std::size_t>(wanted) - 1]);
    };
    for (const ReducedRoot &root : reduced.at(speed, row, steepness_here)) {
        const Complex l = root.eigenvalue;
        if (l.imag() < above * (1 - reduced_error))
            continue;
        if (l.imag() > top * (1 + reduced_error) && enough(l.imag()))
            return false;
        const auto point = roots.near(l, reduced.lifted(root.shape));
        const bool near = point && std::abs(point->eigenvalue - l) <= reduced_error * std::abs(l);
        const bool twice = point && std::ranges::any_of(found, [&](const FoundRoot &other) {
                               return same(other.mode, found_root(*point).mode);
                           });
        // Next to a row it may be one of the piece beyond; else two that became one lack one.
        const bool beside_row = std::abs(l.imag() - speed) <= 2 * reduced_error * speed;
        if (!near || (twice && !beside_row))
            doubtful.emplace_back((1 - reduced_error) * l.imag(), (1 + reduced_error) * l.imag());
        if (!point || twice)
            continue;
        if (point->eigenvalue.imag() > std::abs(point->eigenvalue.real())) {
            found.push_back(found_root(*point));
            taken.insert(std::ranges::upper_bound(taken, point->eigenvalue.imag()),
                         point->eigenvalue.imag());
        }
    }
    return true;
}

/// Roots of a conservative problem between those found, by the negative eigenvalues of K - W^2 M of
/// the whole rotor.
class GapCount {
  public:
    /// @param whole  must outlive this
    /// @param size   of the problem
    GapCount(const WholeRoots &whole, Eigen::Index size) : _whole(whole), _size(size) {}

    std::vector<std::pair<double, double>> doubtful;

    /// Adds the roots up to `top` that are missing by the count.
    void close(std::vector<FoundRoot> &found, double top) {
        constexpr double no_room = 1e-7; // of the speed: the next root stands too near
        std::optional<int> expected;
        double from = 0;
        const auto gap = [&](double to) {
            if (to - from <= no_room * to)
                return;
            const double aside = std::max(1e-3 * (to - from), no_room / 4 * to);
            const auto first = settled(from + aside, aside, expected);
            const auto last = settled(to - aside, -aside, first);
            if (!first || !last)
                doubtful.emplace_back(from, to);
            else
                search(from + aside, *first, to - aside, *last);
            constexpr double offset = 1e-3; // of the speed: as far as counts are taken aside
            if (first && expected && *first != *expected) // not all of them are found there
                doubtful.emplace_back((1 - offset) * from, (1 + offset) * from);
            expected = last;
        };
        for (const FoundRoot &root : found) {
            const double speed = root.mode.eigenvalue.imag();
            gap(speed);
            if (expected)
                *expected += root.downwards ? 1 : -1;
            from = speed;
        }
        gap(std::max(top, 1.0001 * from));
        found.insert(found.end(), _isolated.begin(), _isolated.end());
        found = tidied(std::move(found));
    }

  private:
    const WholeRoots &_whole;
    Eigen::Index _size;
    std::vector<FoundRoot> _isolated;

    [[nodiscard]] std::optional<int> count(double speed) const {
        try {
            return _whole.negative_eigenvalues(speed);
        } catch (const linalg::SolverError &) { // a pivot was zero
            return std::nullopt;
        }
    }

    /// The count at a speed, as it is expected or with a neighbour that agrees: beside very stiff
    /// springs a pivot can be rounding.
    [[nodiscard]] std::optional<int> settled(double speed, double aside,
                                             std::optional<int> expected) const {
        std::vector<int> counts;
        for (const double part : {0.0, 0.1, 0.2, 0.3}) {
            const auto here = count(speed + part * aside);
            if (!here)
                continue;
            if (here == expected || std::ranges::count(counts, *here) > 0)
                return here;
            counts.push_back(*here);
        }
        return std::nullopt;
    }

    void search(double a, int at_a, double b, int at_b) {
        // Of the speed: roots nearer together than this are one entry, said to be doubtful.
        constexpr double isolated = 1e-6;
        if (at_a == at_b)
            return;
        const double middle = (a + b) / 2;
        if (b - a > isolated * b) {
            const auto at_middle = settled(middle, (b - a) / 10, at_a);
            if (!at_middle) {
                doubtful.emplace_back(a, b);
                return;
            }
            search(a, at_a, middle, *at_middle);
            search(middle, *at_middle, b, at_b);
            return;
        }
        std::vector<FoundRoot> here;
        const int missing = std::abs(at_b - at_a);
        for (int start = 0; start < missing; ++start) {
            const auto point = _whole.near({0, middle}, any_vector(start));
            if (point && std::abs(point->eigenvalue - Complex(0, middle)) < 2 * isolated * middle)
                here.push_back(found_root(*point));
        }
        here = tidied(std::move(here));
        if (std::ssize(here) < missing)
            doubtful.emplace_back(a, b);
        _isolated.insert(_isolated.end(), here.begin(), here.end());
    }

    /// Across no motion that one would meet.
    [[nodiscard]] Eigen::VectorXcd any_vector(int number) const {
        Eigen::VectorXcd out(_size);
        for (Eigen::Index i = 0; i < _size; ++i)
            out(i) = 1 + std::cos((1.3 + number) * static_cast<double>(i * i));
        return out;
    }
};

} // namespace

SynchronousModes followed_modes(const SynchronousProblem &problem, const WholeRoots &roots,
                                const Eigen::MatrixXd &shapes, int wanted, double top) {
    const ReducedSynchronous reduced(problem, shapes);
    const std::vector<double> &rows = problem.rows();
    const std::vector<double> bends = problem.rotor().rotor().table_bends();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    SynchronousModes out;
    std::vector<FoundRoot> found;
    double row = problem.constant() ? 0 : std::max(rows.front(), 0.0);
    if (!problem.constant() && rows.front() > 0)
        (void)add_constant(reduced, roots, row, 0, 0, 0, row, found, out.doubtful);
    const auto enough = [&] { return static_cast<int>(found.size()) >= wanted && row > top; };
    std::size_t i = 0;
    while (i + 1 < rows.size() && rows[i + 1] <= row)
        ++i;
    while (i + 1 < rows.size() && !enough()) {
        const std::vector<double> at_once = rows_at_once(bends, rows, i);
        Follower follower(reduced, roots, problem.conservative(), at_once, i);
        i += at_once.size() - 1;
        follower.follow(follower.sample(row), follower.sample(at_once.back()), 0);
        found.insert(found.end(), follower.found.begin(), follower.found.end());
        found = tidied(std::move(found)); // roots at a row are found from both sides
        out.doubtful.insert(out.doubtful.end(), follower.doubtful.begin(), follower.doubtful.end());
        row = at_once.back();
    }
    bool no_more = false;
    if (!enough()) {
        no_more =
            add_constant(reduced, roots, row, rows.size() - 1,
                         wanted - static_cast<int>(found.size()), row, top, found, out.doubtful);
        found = tidied(std::move(found));
    }
    if (problem.conservative()) {
        GapCount gaps(roots, problem.first().M.rows());
        gaps.close(found, std::max(row, top));
        out.doubtful.insert(out.doubtful.end(), gaps.doubtful.begin(), gaps.doubtful.end());
    }
    const double last = found.empty() ? 0 : found.back().mode.eigenvalue.imag();
    out.complete_to = no_more && reduced.whole() ? infinity : std::max({row, top, last});
    out.complete_to = std::min(out.complete_to, reduced.known_to());
    int negative = 0;
    for (FoundRoot &root : found) {
        out.branches.push_back(root.downwards ? ++negative : negative--);
        if (problem.conservative())
            root.mode.eigenvalue.real(0);
        out.modes.push_back(std::move(root.mode));
    }
    if (!problem.conservative())
        out.branches.clear();
    return out;
}

} // namespace whirl::synchronous

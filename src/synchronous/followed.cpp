#include "synchronous/followed.h"

#include "assembly/planes.h"
#include "linalg/check.h"
#include "modes/roots/branches.h"
#include "synchronous/branch.h"
#include "synchronous/parts.h"
#include "synchronous/reduced.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace whirl::synchronous {

namespace {

using Complex = std::complex<double>;
using assembly::i_unit;

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

/// A piece of the tables, from row to row, or over several rows. What is followed of a motion is
/// v = -i l - s: Re v = Im l - s passes zero where it is synchronous, Im v is -Re l.
class Follower {
  public:
    /// @param rows   of the piece
    /// @param first  number of the first of them among all
    Follower(const ReducedSynchronous &reduced, const WholeRoots &roots, std::vector<double> rows,
             std::size_t first)
        : _reduced(reduced), _roots(roots), _rows(std::move(rows)), _number(first) {}

    std::vector<FoundRoot> found;
    std::vector<std::pair<double, double>> doubtful;

    /// @throws linalg::SolverError
    [[nodiscard]] modes::RootsAt sample(double speed) const {
        const auto above = std::upper_bound(_rows.begin() + 1, _rows.end() - 1, speed);
        const auto piece = static_cast<std::size_t>(above - _rows.begin()) - 1;
        modes::RootsAt out = _reduced.at(speed, _number + piece);
        for (modes::Root &root : out.roots) {
            root.value = -i_unit * root.value - speed;
            root.rate = -i_unit * root.rate - 1.0;
        }
        return out;
    }

    void follow(const modes::RootsAt &a, const modes::RootsAt &b, int depth) {
        if (resolved(a, b))
            return;
        constexpr int deepest = 18; // where a stiffness passes zero a motion begins like a root
        const int most_samples = 100 + 4 * static_cast<int>(_rows.size());
        if (depth == deepest || ++_samples > most_samples) {
            doubtful.emplace_back(a.speed, b.speed);
            return;
        }
        const modes::RootsAt middle = sample(cut(a.speed, b.speed));
        follow(a, middle, depth + 1);
        follow(middle, b, depth + 1);
    }

  private:
    const ReducedSynchronous &_reduced;
    const WholeRoots &_roots;
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

    /// Distance of a motion from being synchronous and damped so little that it counts,
    /// Im l > |Re l|, with some allowance.
    static double distance(Complex v, double speed) {
        constexpr double heaviest = 1.3; // |Re l| of Im l
        return std::hypot(v.real(), std::max(std::abs(v.imag()) - heaviest * speed, 0.0));
    }

    /// Two motions that do not oscillate at an end of a step can meet in it and go on as one that
    /// does: they near one another like a root, and would meet by their rates within twice the way.
    /// @param inwards  of the step: 1 at its lower end, -1 at its upper one
    template <class Matters>
    static bool may_meet(const modes::RootsAt &end, double inwards, double step,
                         const Matters &matters) {
        constexpr double hardly = 0.1; // Im l of |Re l|: real but for gyroscopic moments
        constexpr double one = 1e-9;   // of the value: a double root
        std::vector<const modes::Root *> real;
        for (const modes::Root &root : end.roots)
            if (std::abs(root.value.real() + end.speed) <= hardly * std::abs(root.value.imag()) &&
                matters(root, end))
                real.push_back(&root);
        for (std::size_t i = 0; i < real.size(); ++i)
            for (std::size_t k = 0; k < i; ++k) {
                const Complex apart = real[i]->value - real[k]->value;
                const Complex rate = inwards * (real[i]->rate - real[k]->rate);
                if (std::abs(apart) > one * std::abs(real[i]->value) &&
                    (std::conj(apart) * rate).real() < 0 &&
                    std::abs(apart) <= 2 * step * std::abs(rate))
                    return true;
            }
        return false;
    }

    /// Every motion that could become synchronous in the step is followed through it; their
    /// passages go to `found`.
    bool resolved(const modes::RootsAt &a, const modes::RootsAt &b) {
        const double step = b.speed - a.speed;
        const auto matters = [step](const modes::Root &root, const modes::RootsAt &end) {
            return distance(root.value, end.speed) <= 2 * step * (1 + std::abs(root.rate));
        };
        if (may_meet(a, 1, step, matters) || may_meet(b, -1, step, matters))
            return false;
        const modes::Branches branches = modes::followed(a, b, matters);
        std::vector<FoundRoot> roots;
        if (!branches.clear || !std::ranges::all_of(branches.branches, [&](const auto &branch) {
                return branch.cluster != 0 || add_passage(branch, a, b, roots);
            }))
            return false;
        found.insert(found.end(), roots.begin(), roots.end());
        return true;
    }

    /// The root of the whole rotor where a motion becomes synchronous, if it does.
    /// @returns whether that is known
    bool add_passage(const modes::Branch &branch, const modes::RootsAt &a, const modes::RootsAt &b,
                     std::vector<FoundRoot> &roots) const {
        constexpr int samples = 16; // of a cubic, to see two passages in a step
        const double bend = std::abs(branch.off_parabola());
        const double unseen = holds_rows(a.speed, b.speed) ? between * b.speed : 0;
        const double rise = branch.to->value.real() - branch.from->value.real();
        const auto speed_at = [&](double t) { return a.speed + t * branch.step; };
        int passages = 0;
        bool near = false; // as far as the ends say
        bool above = branch.from->value.real() > 0;
        for (int k = 1; k <= samples; ++k) {
            const double t = static_cast<double>(k) / samples;
            const Complex v = k < samples ? branch.at(t) : branch.to->value;
            passages += (v.real() > 0) != above ? 1 : 0;
            above = v.real() > 0;
            near = near || (k < samples &&
                            distance(v, speed_at(t)) <= 4 * t * (1 - t) * (bend / 2 + unseen));
        }
        if (passages == 0)
            return !near;
        const double t = branch.zero();
        const double speed = speed_at(t);
        const Complex v = branch.at(t);
        if (distance(v, speed) > bend + unseen + std::abs(v.real())) // it is damped too much there
            return passages == 1 || !near;
        if (passages > 1 || bend + unseen > 0.3 * std::abs(rise))
            return false;
        const Eigen::VectorXcd &shape = (t < 0.5 ? branch.from : branch.to)->right;
        const auto point = _roots.near({-v.imag(), speed}, _reduced.lifted(shape));
        const double slack = bend + reduced_error * speed + branch.step / 2;
        if (!point || std::abs(point->eigenvalue.imag() - speed) > slack)
            return false;
        if (point->eigenvalue.imag() > std::abs(point->eigenvalue.real()))
            roots.push_back(found_root(*point));
        return true;
    }
};

/// Roots with constant coefficients, bearings as at a row: all up to `top`, and at least `wanted`.
/// @returns whether there are no more
bool add_constant(const ReducedSynchronous &reduced, const WholeRoots &roots, double speed,
                  std::size_t row, int wanted, double above, double top,
                  std::vector<FoundRoot> &found, std::vector<std::pair<double, double>> &doubtful) {
    constexpr double least = 0.9; // Im l of |Re l|: a little beyond those that count
    std::vector<modes::Root> all = reduced.at(speed, row).roots;
    std::erase_if(all, [](const modes::Root &root) {
        return !(root.value.imag() > least * std::abs(root.value.real()));
    });
    std::ranges::stable_sort(all, {}, [](const modes::Root &root) { return root.value.imag(); });
    std::vector<double> taken; // ascending
    // The order of the reduced rotor's roots may not be that of the whole one's.
    constexpr double ahead = 5 * reduced_error;
    const auto enough = [&](double frequency) {
        return std::ssize(taken) >= wanted &&
               (wanted <= 0 ||
                frequency > (1 + ahead) * taken[static_cast<std::size_t>(wanted) - 1]);
    };
    for (const modes::Root &root : all) {
        const Complex l = root.value;
        if (l.imag() < above * (1 - reduced_error))
            continue;
        if (l.imag() > top * (1 + reduced_error) && enough(l.imag()))
            return false;
        const Eigen::VectorXcd start = reduced.lifted(root.right);
        auto point = roots.near(l, start);
        const auto is_known = [&] {
            return point && std::ranges::any_of(found, [&](const FoundRoot &other) {
                       return same(other.mode, found_root(*point).mode);
                   });
        };
        if (is_known()) // of two that are nearly one: from what lies across the one found
            if (auto other = roots.near_across(l, start, point->shape))
                point = std::move(other);
        const bool near = point && std::abs(point->eigenvalue - l) <= reduced_error * std::abs(l);
        const bool twice = is_known();
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
        const std::vector<double> at_once = rows_at_once(problem.bends(), rows, i);
        Follower follower(reduced, roots, at_once, i);
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

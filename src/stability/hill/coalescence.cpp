#include "stability/hill/coalescence.h"

#include "linalg/dense/least_squares.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace whirl::stability {

namespace {

using Complex = std::complex<double>;
using Motions = std::vector<Motion>;

constexpr int nowhere = Continuation::nowhere;

/// Share of a state that makes it the continuation of another, and one that counts at all.
constexpr double most_of_it = 0.6;
constexpr double some_of_it = 0.1;

Eigen::MatrixXcd states(const Motions &motions) {
    Eigen::MatrixXcd out(motions.front().state.size(), std::ssize(motions));
    for (std::size_t i = 0; i < motions.size(); ++i)
        out.col(static_cast<Eigen::Index>(i)) = motions[i].state;
    return out;
}

/// Row i, column j: the share of motion i at `from` in motion j at `to`; what other motions, not
/// listed, have in it is missing from the sum over a column.
Eigen::MatrixXd shares(const Motions &from, const Motions &to) {
    const Eigen::MatrixXcd basis = states(from);
    const Eigen::MatrixXcd now = states(to);
    const Eigen::MatrixXcd coefficients = linalg::least_squares(basis, now);
    Eigen::MatrixXd out = coefficients.cwiseAbs2();
    const Eigen::MatrixXcd rest = basis * coefficients - now;
    for (Eigen::Index j = 0; j < out.cols(); ++j)
        out.col(j) *=
            std::max(0.0, 1 - rest.col(j).squaredNorm()) / std::max(out.col(j).sum(), 1e-300);
    return out;
}

double farthest(const Motions &motions) {
    double out = 0;
    for (const Motion &motion : motions)
        out = std::max(out, std::abs(motion.value));
    return out;
}

/// Motions of both speeds that are mixtures of each other.
struct Group {
    std::vector<int> from, to;
};

class Follower {
  public:
    Follower(double from, const Motions &motions_from, double to, const Motions &motions_to)
        : _from(from), _to(to), _a(motions_from), _b(motions_to),
          _share(shares(motions_from, motions_to)),
          _border(std::min(farthest(motions_from), farthest(motions_to))) {}

    Continuation follow() {
        _out.to.assign(_a.size(), nowhere);
        _origin.assign(_b.size(), nowhere);
        match();
        for (const Group &group : groups())
            judge(group);
        crossings();
        return std::move(_out);
    }

  private:
    double _from, _to;
    const Motions &_a;
    const Motions &_b;
    Eigen::MatrixXd _share;
    std::vector<int> _origin;
    double _border; ///< 1/s, least of the largest moduli at both speeds
    Continuation _out;

    [[nodiscard]] const Motion &a(int i) const { return _a[static_cast<std::size_t>(i)]; }
    [[nodiscard]] const Motion &b(int j) const { return _b[static_cast<std::size_t>(j)]; }
    [[nodiscard]] int &target(int i) { return _out.to[static_cast<std::size_t>(i)]; }
    [[nodiscard]] int &origin(int j) { return _origin[static_cast<std::size_t>(j)]; }

    void match() {
        for (int j = 0; j < std::ssize(_b); ++j) {
            Eigen::Index i = 0;
            if (_share.col(j).maxCoeff(&i) < most_of_it)
                continue;
            const auto row = static_cast<int>(i);
            if (target(row) != nowhere) { // two of one: neither is known
                origin(target(row)) = nowhere;
                _share(i, target(row)) = _share(i, j) = most_of_it / 2;
                target(row) = nowhere;
                continue;
            }
            target(row) = j;
            origin(j) = row;
        }
    }

    /// At the upper end of the computed frequencies, and too fast to matter.
    [[nodiscard]] bool comes_or_goes(const Motion &motion) const {
        return !motion.may_meet && std::abs(motion.value) > 0.95 * _border;
    }

    /// Groups of motions without a partner, connected by shares that count.
    std::vector<Group> groups() {
        std::vector<Group> out;
        std::vector<bool> used_a(_a.size(), false);
        std::vector<bool> used_b(_b.size(), false);
        const auto grow = [&](Group &group, auto &&self, int index, bool at_from) -> void {
            auto &used = at_from ? used_a : used_b;
            if (used[static_cast<std::size_t>(index)] ||
                comes_or_goes(at_from ? a(index) : b(index)))
                return;
            used[static_cast<std::size_t>(index)] = true;
            (at_from ? group.from : group.to).push_back(index);
            const auto others = static_cast<int>(at_from ? _b.size() : _a.size());
            for (int k = 0; k < others; ++k) {
                const bool free = at_from ? origin(k) == nowhere : target(k) == nowhere;
                if (free && (at_from ? _share(index, k) : _share(k, index)) > some_of_it)
                    self(group, self, k, !at_from);
            }
        };
        for (int i = 0; i < std::ssize(_a); ++i)
            if (target(i) == nowhere && !comes_or_goes(a(i)) &&
                !used_a[static_cast<std::size_t>(i)])
                grow(out.emplace_back(), grow, i, true);
        for (int j = 0; j < std::ssize(_b); ++j)
            if (origin(j) == nowhere && !comes_or_goes(b(j)) &&
                !used_b[static_cast<std::size_t>(j)])
                grow(out.emplace_back(), grow, j, false);
        return out;
    }

    /// A pair that is known as a pair is a coalescence; anything else that could grow is doubtful.
    void judge(const Group &group) {
        double growth = -HUGE_VAL;
        double inner = HUGE_VAL; // least modulus
        double noise = 0;
        bool may_meet = false;
        std::vector<Complex> values;
        const auto take = [&](const Motion &motion) {
            growth = std::max(growth, motion.value.real());
            inner = std::min(inner, std::abs(motion.value));
            noise += motion.noise;
            may_meet = may_meet || motion.may_meet;
            values.push_back(motion.value);
        };
        for (const int i : group.from)
            take(a(i));
        for (const int j : group.to)
            take(b(j));
        double spread = 0;
        for (const Complex x : values)
            for (const Complex y : values)
                spread = std::max(spread, std::abs(x - y));
        if (values.size() == 1) // how far it could go is not known
            spread = std::abs(values.front()) / 2;
        // At the upper end of the computed frequencies motions enter and leave.
        const bool border = inner > 0.9 * _border;
        // Balls near rest: rounding cannot distinguish these motions, nor what they do.
        const bool blurred = spread <= noise;
        if (!may_meet || growth < -spread || border || blurred) {
            // One that can only have become the other; another motion can still meet it.
            if (group.from.size() == 1 && group.to.size() == 1) {
                target(group.from[0]) = group.to[0];
                origin(group.to[0]) = group.from[0];
            }
            return;
        }
        if (of_one_action(group.from, group.to)) // whatever becomes of them, none grows
            return;
        if (group.from.size() == 2 && group.to.size() == 2)
            add_pair(group.from[0], group.from[1], group.to[0], group.to[1], false);
        else
            _out.doubtful = true;
    }

    /// Motions without damping of which it is known that they cannot open a band.
    [[nodiscard]] bool of_one_action(const std::vector<int> &from,
                                     const std::vector<int> &to) const {
        const int action = from.empty() ? 0 : a(from.front()).action;
        return action != 0 && !to.empty() &&
               std::ranges::all_of(from, [&](int i) { return a(i).action == action; }) &&
               std::ranges::all_of(to, [&](int j) { return b(j).action == action; });
    }

    /// Each has become a mixture of both, so that neither which is which nor whether their
    /// frequencies cross is defined.
    [[nodiscard]] bool mixed(int i, int j) const {
        // Share of the other's state from which on a motion is a mixture.
        constexpr double traces = 0.02;
        return _share(i, _out.to[static_cast<std::size_t>(j)]) > traces ||
               _share(j, _out.to[static_cast<std::size_t>(i)]) > traces;
    }

    void crossings() {
        const auto count = static_cast<int>(_a.size());
        for (int i = 0; i < count; ++i)
            for (int j = i + 1; j < count; ++j)
                if (target(i) != nowhere && target(j) != nowhere)
                    add_pair(i, j, target(i), target(j), !mixed(i, j));
    }

    void add_pair(int i, int j, int ti, int tj, bool ordered) {
        if (!(a(i).may_meet && a(j).may_meet) && !(b(ti).may_meet && b(tj).may_meet))
            return;
        if (of_one_action({i, j}, {ti, tj}) || both_die_out(i, j, ti, tj))
            return;
        const bool opposite = a(i).action * a(j).action < 0 && b(ti).action * b(tj).action < 0;
        if (opposite && a(i).action != b(ti).action) // mixed: actions identify them
            std::swap(ti, tj);
        const Complex first_to = nearest_alias(a(i).value, b(ti));
        const Complex second_to = nearest_alias(a(j).value, b(tj));
        const double repeats_from = a(i).repeats;
        const double repeats_to = b(ti).repeats;
        const double moved = ordered ? 0 : most_moved(i, j, ti, tj);
        const int reach = repeats_from > 0 && repeats_to > 0 ? 2 : 0;
        for (int k = -reach; k <= reach; ++k) {
            const Coalescence m{_from,      _to,
                                a(i).value, a(j).value + Complex(0, k * repeats_from),
                                first_to,   second_to + Complex(0, k * repeats_to),
                                ordered,    k,
                                {i, j},     {ti, tj},
                                {},         opposite ? a(i).action : 0};
            if (may_open_a_band(m) && !far_apart(m, moved))
                _out.coalescences.push_back(m);
        }
    }

    /// Next to rest, where values are those of the supports as they stand and half a turn averages
    /// them: of an end that turns, both die out faster than they could be driven from where they
    /// are, on whichever alias, and the slower the rotor turns, the nearer those are.
    [[nodiscard]] bool both_die_out(int i, int j, int ti, int tj) const {
        const bool turns_from = a(i).repeats > 0;
        if (turns_from == (b(ti).repeats > 0))
            return false;
        const Motion &first = turns_from ? a(i) : b(ti);
        const Motion &second = turns_from ? a(j) : b(tj);
        return std::max(first.value.real(), second.value.real()) <
               -alias_distance(first.value, second.value, first.repeats);
    }

    /// How far two motions can have moved in frequency, whichever became which.
    [[nodiscard]] double most_moved(int i, int j, int ti, int tj) const {
        const auto moved = [](const Motion &from, const Motion &to) {
            return std::abs(nearest_alias(from.value, to).imag() - from.value.imag());
        };
        return std::max(moved(a(i), b(ti)), moved(a(i), b(tj))) +
               std::max(moved(a(j), b(ti)), moved(a(j), b(tj)));
    }

    /// Of a pair known as a pair: aliases that are farther from each other at both ends than they
    /// could have come.
    [[nodiscard]] static bool far_apart(const Coalescence &m, double moved) {
        // Motions may come twice as far within the step as from end to end.
        constexpr double reserve = 2;
        const double before = (m.first_from - m.second_from).imag();
        const double after = (m.first_to - m.second_to).imag();
        return !m.ordered && before * after > 0 &&
               std::min(std::abs(before), std::abs(after)) > reserve * moved;
    }

    [[nodiscard]] static bool may_open_a_band(const Coalescence &m) {
        const double before = (m.first_from - m.second_from).imag();
        const double after = (m.first_to - m.second_to).imag();
        const bool crosses = (before > 0) != (after > 0) || before == 0 || after == 0;
        const double distance =
            std::abs(m.first_from - m.second_from) + std::abs(m.first_to - m.second_to);
        const bool upper =
            (m.first_from + m.second_from + m.first_to + m.second_to).imag() >= -1e-9 * distance;
        // Otherwise both die out faster than they could be driven by coalescence.
        const double growth = std::max(
            {m.first_from.real(), m.second_from.real(), m.first_to.real(), m.second_to.real()});
        return upper && growth > -distance && (crosses || !m.ordered);
    }
};

} // namespace

Continuation continued(double from, const Motions &motions_from, double to,
                       const Motions &motions_to) {
    if (motions_from.empty() || motions_to.empty()) {
        Continuation out;
        out.to.assign(motions_from.size(), nowhere);
        return out;
    }
    return Follower(from, motions_from, to, motions_to).follow();
}

} // namespace whirl::stability

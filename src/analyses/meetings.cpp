#include "analyses/meetings.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace whirl::analyses {

namespace {

using Complex = std::complex<double>;

Eigen::MatrixXcd states(const std::vector<Motion> &motions) {
    Eigen::MatrixXcd out(motions.front().state.size(), std::ssize(motions));
    for (std::size_t i = 0; i < motions.size(); ++i)
        out.col(static_cast<Eigen::Index>(i)) = motions[i].state;
    return out;
}

constexpr int nowhere = -1;

/// Continuation of each motion, and pairs that are mixed so much that it may be either way round.
struct Followed {
    std::vector<int> to;
    std::set<std::pair<int, int>> doubtful;
};

Followed follow(const Eigen::MatrixXd &likeness) {
    std::vector<std::tuple<double, int, int>> order;
    for (int i = 0; i < likeness.rows(); ++i)
        for (int j = 0; j < likeness.cols(); ++j)
            if (likeness(i, j) > 0.05)
                order.emplace_back(-likeness(i, j), i, j);
    std::sort(order.begin(), order.end());
    Followed out;
    out.to.assign(static_cast<std::size_t>(likeness.rows()), nowhere);
    std::vector<int> origin(static_cast<std::size_t>(likeness.cols()), nowhere);
    for (const auto &[negative, i, j] : order) {
        auto &to = out.to[static_cast<std::size_t>(i)];
        auto &from = origin[static_cast<std::size_t>(j)];
        if (to != nowhere || from != nowhere)
            continue;
        to = j;
        from = i;
    }
    // A column that resembles a second row nearly as much: the two rows are doubtful.
    for (const auto &[negative, i, j] : order) {
        const int own = origin[static_cast<std::size_t>(j)];
        if (own != nowhere && own != i && -negative > 0.3 * likeness(own, j) &&
            out.to[static_cast<std::size_t>(i)] != nowhere)
            out.doubtful.insert(std::minmax(own, i));
    }
    return out;
}

/// Nothing can grow: both die out faster than they could be driven by meeting.
bool too_damped(const Meeting &m) {
    const double decay = -std::max(
        {m.first_from.real(), m.second_from.real(), m.first_to.real(), m.second_to.real()});
    return decay > std::abs(m.first_from - m.second_from) + std::abs(m.first_to - m.second_to);
}

} // namespace

std::vector<Meeting> meetings(double from, const std::vector<Motion> &motions_from, double to,
                              const std::vector<Motion> &motions_to) {
    std::vector<Meeting> out;
    if (motions_from.empty() || motions_to.empty())
        return out;
    const Eigen::MatrixXcd basis = states(motions_from);
    const Eigen::MatrixXcd coefficients =
        Eigen::ColPivHouseholderQR<Eigen::MatrixXcd>(basis).solve(states(motions_to));
    const Followed followed = follow(coefficients.cwiseAbs2());
    const auto count = static_cast<int>(motions_from.size());
    for (int i = 0; i < count; ++i) {
        const int ti = followed.to[static_cast<std::size_t>(i)];
        for (int j = i + 1; j < count && ti != nowhere; ++j) {
            const int tj = followed.to[static_cast<std::size_t>(j)];
            if (tj == nowhere)
                continue;
            const auto slow = [](const std::vector<Motion> &motions, int one, int other) {
                return motions[static_cast<std::size_t>(one)].may_meet &&
                       motions[static_cast<std::size_t>(other)].may_meet;
            };
            if (!slow(motions_from, i, j) && !slow(motions_to, ti, tj))
                continue;
            const auto value = [](const std::vector<Motion> &motions, int index) {
                return motions[static_cast<std::size_t>(index)].value;
            };
            const Meeting m{from,
                            to,
                            value(motions_from, i),
                            value(motions_from, j),
                            value(motions_to, ti),
                            value(motions_to, tj)};
            const double before = (m.first_from - m.second_from).imag();
            const double after = (m.first_to - m.second_to).imag();
            const bool crosses = (before > 0) != (after > 0) || before == 0 || after == 0;
            const bool upper = (m.first_from + m.second_from + m.first_to + m.second_to).imag() >=
                               -1e-9 * (std::abs(before) + std::abs(after));
            if ((crosses || followed.doubtful.count({i, j}) > 0) && upper && !too_damped(m))
                out.push_back(m);
        }
    }
    return out;
}

} // namespace whirl::analyses

#include "ends/groups.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace whirl::ends {

namespace {

/// The best partner must be better than the next by this factor.
constexpr double clearly = 0.35;

/// Of the entries of a row or a column the place of the least, and the one after it.
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

class Groups {
  public:
    /// @param off  misfit of each root at the one end with each at the other
    explicit Groups(Eigen::MatrixXd off)
        : _rows(off.rows()), _parent(static_cast<std::size_t>(off.rows() + off.cols())) {
        std::iota(_parent.begin(), _parent.end(), Eigen::Index{0});
        take_clear_pairs(off);
        const Eigen::VectorXd of_row = off.rowwise().minCoeff() / clearly;
        const Eigen::VectorXd of_column = off.colwise().minCoeff() / clearly;
        for (Eigen::Index j = 0; j < off.cols(); ++j)
            for (Eigen::Index i = 0; i < _rows; ++i)
                if (std::isfinite(off(i, j)) &&
                    (off(i, j) <= of_row(i) || off(i, j) <= of_column(j)))
                    join(i, j);
    }

    [[nodiscard]] std::vector<Group> all() {
        std::map<Eigen::Index, Group> groups;
        for (Eigen::Index k = 0; k < std::ssize(_parent); ++k) {
            Group &group = groups[top_of(k)];
            if (k < _rows)
                group.first.push_back(static_cast<int>(k));
            else
                group.second.push_back(static_cast<int>(k - _rows));
        }
        std::vector<Group> out;
        for (auto &[top, group] : groups)
            out.push_back(std::move(group));
        return out;
    }

  private:
    Eigen::Index _rows;
    std::vector<Eigen::Index> _parent;

    static std::size_t place(Eigen::Index k) { return static_cast<std::size_t>(k); }
    void join(Eigen::Index i, Eigen::Index j) { _parent[place(top_of(i))] = top_of(_rows + j); }
    /// The best partner of each other, by far: nobody else's from then on.
    void take_clear_pairs(Eigen::MatrixXd &off) {
        std::vector<Best> of_column;
        for (Eigen::Index j = 0; j < off.cols(); ++j)
            of_column.push_back(best_of(off.col(j)));
        std::vector<std::pair<Eigen::Index, Eigen::Index>> pairs;
        for (Eigen::Index i = 0; i < _rows; ++i) {
            const Best row = best_of(off.row(i));
            const Best column = of_column[place(row.index)];
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
    Eigen::Index top_of(Eigen::Index k) {
        while (_parent[place(k)] != k)
            k = _parent[place(k)] = _parent[place(_parent[place(k)])];
        return k;
    }
};

} // namespace

std::vector<Group> groups_of(Eigen::MatrixXd off) { return Groups(std::move(off)).all(); }

} // namespace whirl::ends

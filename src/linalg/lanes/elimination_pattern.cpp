#include "linalg/lanes/elimination_pattern.h"

#include <Eigen/OrderingMethods>

#include <cstddef>

namespace whirl::linalg {

EliminationPattern::EliminationPattern(const Sparse &pattern) {
    const auto n = static_cast<int>(pattern.rows());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
    Eigen::AMDOrdering<int> ordering;
    ordering(pattern, permutation);
    const auto &order = permutation.indices();
    std::vector<int> step(static_cast<std::size_t>(n)); // at which an unknown is eliminated
    for (int k = 0; k < n; ++k) {
        _order.push_back(order(k));
        step[static_cast<std::size_t>(order(k))] = k;
    }
    _first.push_back(0);
    for (int k = 0; k < n; ++k) {
        const int column = _order[static_cast<std::size_t>(k)];
        for (int p = pattern.outerIndexPtr()[column]; p < pattern.outerIndexPtr()[column + 1];
             ++p) {
            const int row = step[static_cast<std::size_t>(pattern.innerIndexPtr()[p])];
            if (row <= k)
                _entries.push_back({row, p});
        }
        _first.push_back(static_cast<int>(_entries.size()));
    }
    analyse();
}

/// Which columns of L each row reaches, in an order that respects their dependence (T. A. Davis,
/// Algorithm 849: a concise sparse Cholesky factorization package, ACM TOMS 31, 2005).
void EliminationPattern::analyse() {
    const std::size_t n = _order.size();
    Eigen::VectorXi parent = Eigen::VectorXi::Constant(static_cast<Eigen::Index>(n), -1);
    Eigen::VectorXi flag = Eigen::VectorXi::Constant(static_cast<Eigen::Index>(n), -1);
    std::vector<int> counts(n, 0);
    std::vector<int> path(n);
    std::vector<int> reach(n); // filled from its end: later paths stand before earlier ones
    _reach_first.push_back(0);
    for (std::size_t k = 0; k < n; ++k) {
        const auto row = static_cast<int>(k);
        flag(row) = row;
        std::size_t top = n;
        for (int p = _first[k]; p < _first[k + 1]; ++p) {
            std::size_t length = 0;
            for (int i = _entries[static_cast<std::size_t>(p)].row; flag(i) != row; i = parent(i)) {
                if (parent(i) < 0)
                    parent(i) = row;
                flag(i) = row;
                path[length++] = i;
            }
            while (length > 0)
                reach[--top] = path[--length];
        }
        for (; top < n; ++top) // a row is the next one in each of its columns
            _reach.push_back({reach[top], counts[static_cast<std::size_t>(reach[top])]++});
        _reach_first.push_back(static_cast<int>(_reach.size()));
    }
    _start.push_back(0);
    for (const int count : counts)
        _start.push_back(_start.back() + count);
    _rows.resize(_reach.size());
    for (std::size_t k = 0; k < n; ++k)
        for (int r = _reach_first[k]; r < _reach_first[k + 1]; ++r) {
            auto &[column, place] = _reach[static_cast<std::size_t>(r)];
            place += _start[static_cast<std::size_t>(column)];
            _rows[static_cast<std::size_t>(place)] = static_cast<int>(k);
        }
}

} // namespace whirl::linalg

#include "linalg/lanes/elimination_pattern.h"

namespace whirl::linalg {

EliminationPattern::EliminationPattern(const SymmetricFactor &one)
    : _order(one._order), _first(one._first), _reach_first(one._reach_first), _start(one._start),
      _rows(one._rows.size()) {
    std::vector<int> next(_start.begin(), _start.end() - 1);
    for (std::size_t row = 0; row < _order.size(); ++row)
        for (int r = _reach_first[row]; r < _reach_first[row + 1]; ++r) {
            const int column = one._reach[static_cast<std::size_t>(r)];
            const int place = next[static_cast<std::size_t>(column)]++;
            _reach.push_back({column, place});
            _rows[static_cast<std::size_t>(place)] = static_cast<int>(row);
        }
}

} // namespace whirl::linalg

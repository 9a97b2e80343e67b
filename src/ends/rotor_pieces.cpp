#include "ends/rotor_pieces.h"

#include "reduction/projection.h"

#include <algorithm>
#include <iterator>

namespace whirl::ends {

RotorPieces::RotorPieces(const modes::FormMatrices &whole, const Eigen::MatrixXd *shapes,
                         const std::vector<double> &borders, const std::vector<double> &rows)
    : _whole(whole), _shapes(shapes), _M(reduced(whole.mass())), _borders(borders), _ends(borders) {
    std::ranges::copy_if(rows, std::back_inserter(_ends),
                         [&](double row) { return row > borders.front() && row < borders.back(); });
    std::ranges::sort(_ends);
    _ends.erase(std::unique(_ends.begin(), _ends.end()), _ends.end());
    _parts.resize(_ends.size() - 1);
}

const RotorPieces::Part &RotorPieces::part_at(double speed, int piece) const {
    // Of the rows inside of the piece: the part above the last one that is not above the speed.
    const auto first = std::lower_bound(_ends.begin(), _ends.end(), from(piece));
    const auto last = std::lower_bound(_ends.begin(), _ends.end(), to(piece));
    const auto k =
        static_cast<std::size_t>(std::upper_bound(first + 1, last, speed) - _ends.begin()) - 1;
    std::optional<Part> &part = _parts[k];
    if (!part) {
        const double length = _ends[k + 1] - _ends[k];
        const modes::QuadraticAt a = _whole.at(_ends[k]);
        const modes::QuadraticAt b = _whole.at(_ends[k + 1]);
        const Eigen::SparseMatrix<double> rest = b.K - a.K - length * a.above.K;
        part = {_ends[k],     reduced(a.D),       reduced(a.above.D),
                reduced(a.K), reduced(a.above.K), reduced(rest) / (length * length)};
    }
    return *part;
}

Eigen::MatrixXd RotorPieces::reduced(const Eigen::SparseMatrix<double> &A) const {
    return _shapes != nullptr ? reduction::Projection(*_shapes).of(A) : Eigen::MatrixXd(A);
}

DenseProblem RotorPieces::at(double speed, int piece) const {
    const Part &p = part_at(speed, piece);
    const double s = speed - p.from;
    return {_M, p.D + s * p.D1, p.K + s * (p.K1 + s * p.K2), p.D1, p.K1 + 2 * s * p.K2};
}

int RotorPieces::piece_of(double speed) const {
    int piece = 0;
    while (piece + 1 < pieces() && speed > to(piece))
        ++piece;
    return piece;
}

Eigen::VectorXcd RotorPieces::lifted(const Eigen::VectorXcd &reduced) const {
    return _shapes != nullptr ? reduction::Projection(*_shapes).lifted(reduced) : reduced;
}

} // namespace whirl::ends

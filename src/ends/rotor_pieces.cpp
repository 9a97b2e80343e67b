#include "ends/rotor_pieces.h"

#include "reduction/projection.h"

namespace whirl::ends {

RotorPieces::RotorPieces(const modes::FormMatrices &whole, const Eigen::MatrixXd *shapes,
                         const std::vector<double> &borders)
    : _shapes(shapes), _M(reduced(whole.mass())) {
    for (std::size_t k = 1; k < borders.size(); ++k) {
        const double from = borders[k - 1];
        const double to = borders[k];
        const double length = to - from;
        const modes::QuadraticAt a = whole.at(from);
        const modes::QuadraticAt b = whole.at(to);
        const Eigen::SparseMatrix<double> rest = b.K - a.K - length * a.above.K;
        _pieces.push_back({from, to, reduced(a.D), reduced(a.above.D), reduced(a.K),
                           reduced(a.above.K), reduced(rest) / (length * length)});
    }
}

Eigen::MatrixXd RotorPieces::reduced(const Eigen::SparseMatrix<double> &A) const {
    return _shapes != nullptr ? reduction::Projection(*_shapes).of(A) : Eigen::MatrixXd(A);
}

DenseProblem RotorPieces::at(double speed, int piece) const {
    const Piece &p = at_index(piece);
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

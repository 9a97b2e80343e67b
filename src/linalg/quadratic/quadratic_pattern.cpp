#include "linalg/quadratic/quadratic_pattern.h"

#include <cmath>

namespace whirl::linalg {

QuadraticPattern::QuadraticPattern(const Sparse &M, const Sparse &D, const Sparse &K) {
    Sparse pattern = M.cwiseAbs() + D.cwiseAbs();
    pattern = (pattern + K.cwiseAbs()).eval();
    pattern.makeCompressed();
    const auto entries_of = [&pattern](const Sparse &A) -> Eigen::VectorXd {
        const Sparse on_pattern = 0 * pattern + A; // entries that are zero stay
        return Eigen::Map<const Eigen::VectorXd>(on_pattern.valuePtr(), on_pattern.nonZeros());
    };
    _M = entries_of(M);
    _D = entries_of(D);
    _K = entries_of(K);
    _Q = pattern.cast<std::complex<double>>();
}

const QuadraticPattern::ComplexSparse &QuadraticPattern::at(std::complex<double> l) {
    const std::complex<double> square = l * l;
    std::complex<double> *values = _Q.valuePtr();
    for (Eigen::Index i = 0; i < _K.size(); ++i)
        values[i] = {square.real() * _M(i) + l.real() * _D(i) + _K(i),
                     square.imag() * _M(i) + l.imag() * _D(i)};
    return _Q;
}

double QuadraticPattern::size(const Eigen::VectorXcd &y, double l,
                              const Eigen::VectorXcd &x) const {
    const Eigen::VectorXd a = y.cwiseAbs();
    const Eigen::VectorXd b = x.cwiseAbs();
    const int *first = _Q.outerIndexPtr();
    const int *rows = _Q.innerIndexPtr();
    double out = 0;
    for (Eigen::Index column = 0; column < b.size(); ++column) {
        double sum = 0;
        for (int p = first[column]; p < first[column + 1]; ++p)
            sum += a(rows[p]) * (l * (l * std::abs(_M(p)) + std::abs(_D(p))) + std::abs(_K(p)));
        out += sum * b(column);
    }
    return out;
}

} // namespace whirl::linalg

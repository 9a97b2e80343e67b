#include "stability/rayleigh.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::stability {

namespace {

using Wide = long double; // 64 bits: products of two doubles lose nothing that matters
using Complex = std::complex<double>;
using WideComplex = std::complex<Wide>;

/// A difference of two entries below this share of them is rounding of the assembly.
constexpr double rounding_of_assembly = 16 * std::numeric_limits<double>::epsilon();

double unless_rounding(double difference, double sum) {
    return std::abs(difference) <= rounding_of_assembly * std::abs(sum) ? 0 : difference;
}

} // namespace

/// x^H A x, and what its lossy part (that of the other kind than M or D calls for) adds up from.
struct RayleighFunctional::Form {
    WideComplex value;
    Wide symmetric_size = 0; ///< sum of the moduli of the terms
    Wide skew_size = 0;
};

RayleighFunctional::Entries RayleighFunctional::split(const Sparse &A) {
    const Sparse transposed = A.transpose();
    const Sparse both = A + transposed;
    const Sparse difference = A - transposed; // the same pattern: zeros stay stored
    Entries out;
    for (Eigen::Index column = 0; column < both.outerSize(); ++column) {
        Sparse::InnerIterator b(both, column);
        Sparse::InnerIterator d(difference, column);
        for (; b && b.row() <= column; ++b, ++d) {
            const double symmetric = unless_rounding(b.value(), d.value()) / 2;
            const double skew = unless_rounding(d.value(), b.value()) / 2;
            if (symmetric != 0 || skew != 0)
                out.push_back(
                    {static_cast<int>(b.row()), static_cast<int>(column), symmetric, skew});
        }
    }
    return out;
}

RayleighFunctional::RayleighFunctional(const Sparse &M, const Sparse &D, const Sparse &K,
                                       Structure structure)
    : _M(split(M)), _D(split(D)), _K(split(K)) {
    // Sums that cancel, as of neighbouring elements at their node, leave rounding without scale.
    const auto joins_pairs = [&structure](const Entry &a) {
        return a.i / structure.block == a.j / structure.block &&
               a.i % structure.block < structure.paired && a.j % structure.block < structure.paired;
    };
    for (Entry &a : _K)
        if (joins_pairs(a) && (a.i - a.j) % 2 == 0)
            a.skew = 0;
    for (Entry &a : _M)
        if (joins_pairs(a))
            a.skew = 0;
}

RayleighFunctional::Form RayleighFunctional::form(const Entries &A, const Eigen::VectorXcd &x) {
    Form out;
    Wide re = 0;
    Wide im = 0;
    for (const Entry &a : A) {
        const WideComplex xi = x(a.i);
        const WideComplex xj = x(a.j);
        const Wide twice = a.i == a.j ? 1 : 2;
        // conj(x_i) x_j = p: symmetric entries give 2 s Re p, skew ones 2 i k Im p.
        const Wide real = xi.real() * xj.real() + xi.imag() * xj.imag();
        const Wide imag = xi.real() * xj.imag() - xi.imag() * xj.real();
        re += twice * a.symmetric * real;
        im += twice * a.skew * imag;
        out.symmetric_size += std::abs(twice * a.symmetric * real);
        out.skew_size += std::abs(twice * a.skew * imag);
    }
    out.value = {re, im};
    return out;
}

/// A x, A the part of Q(l) that is not Hermitian.
Eigen::VectorXcd RayleighFunctional::lossy_part(Complex l, const Eigen::VectorXcd &x) const {
    Eigen::VectorXcd out = Eigen::VectorXcd::Zero(x.size());
    const auto add = [&](const Entries &A, Complex factor) {
        // (f S - conj(f) S)/2 and (f N + conj(f) N)/2 of a symmetric S and a skew N.
        const Complex of_symmetric(0, factor.imag());
        const double of_skew = factor.real();
        for (const Entry &a : A) {
            out(a.i) += (of_symmetric * a.symmetric + of_skew * a.skew) * x(a.j);
            if (a.i != a.j)
                out(a.j) += (of_symmetric * a.symmetric - of_skew * a.skew) * x(a.i);
        }
    };
    add(_M, l * l);
    add(_D, l);
    add(_K, 1);
    return out;
}

RayleighFunctional::Root RayleighFunctional::root(const linalg::ComplexPair &pair,
                                                  double vector_error,
                                                  const std::vector<Admixture> &admixtures) const {
    const Form m = form(_M, pair.vector);
    const Form d = form(_D, pair.vector);
    const Form k = form(_K, pair.vector);
    WideComplex l = pair.value;
    WideComplex slope;
    bool settled = false;
    for (int step = 0; step < 12 && !settled; ++step) {
        slope = Wide(2) * m.value * l + d.value;
        const WideComplex change = -(m.value * l * l + d.value * l + k.value) / slope;
        if (!std::isfinite(std::abs(change)))
            break;
        l += change;
        settled = std::abs(change) <= Wide(1e-18) * std::abs(l);
    }
    constexpr double none = std::numeric_limits<double>::infinity();
    const Complex value(static_cast<double>(l.real()), static_cast<double>(l.imag()));
    if (!settled)
        return {pair.value, none};
    const Wide w = std::abs(l.imag());
    const Wide size = std::abs(l);
    // What Re l is the sum of, beside what conserves energy (which moves Im l, and Re l by the
    // angle that the slope has against the imaginary axis).
    const Wide lossy = size * size * m.skew_size + w * d.symmetric_size + k.skew_size +
                       2 * w * std::abs(l.real()) * m.symmetric_size +
                       std::abs(l.real()) * d.skew_size;
    const Wide angle = std::abs(slope.real()) / std::abs(slope);
    const Wide conserving = size * size * m.symmetric_size + w * d.skew_size + k.symmetric_size;
    constexpr Wide rounding = std::numeric_limits<Wide>::epsilon();
    const Eigen::VectorXcd Ax = lossy_part(value, pair.vector);
    const double own = pair.vector.cwiseAbs().dot(Ax.cwiseAbs());
    double mixed = vector_error * own;
    double squares = vector_error * vector_error;
    for (const Admixture &other : admixtures) {
        mixed += other.share * std::abs(other.vector.dot(Ax));
        squares += other.share * other.share;
    }
    const Wide error =
        2 * Wide(mixed) + Wide(squares) * own +
        (rounding + Wide(vector_error) * vector_error) * (lossy + angle * conserving);
    // Besides, rounding of entries that should be equal or opposite: a share of the modulus.
    const Wide left = error / std::abs(slope) + 8 * std::numeric_limits<double>::epsilon() * size;
    return {value, static_cast<double>(left)};
}

} // namespace whirl::stability

#include "oracles/continuum_roots.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::oracles {

namespace {

constexpr Real epsilon = std::numeric_limits<Real>::epsilon();

/// An interval of frequency with the numbers of frequencies below its ends.
struct Bracket {
    Real low, high;
    int below_low, below_high;
};

int count(const Continuum &rotor, const Question &question, Real omega) {
    int below = 0;
    (void)rotor.determinant_at(omega, question, &below);
    return below;
}

/// Value relative to the size 2^exponent, its phase taken out: real along a bracket of one root.
Real real_part(const Scaled &d, const Complex &phase, long exponent) {
    const long shift = std::clamp(d.exponent - exponent, -16000L, 16000L);
    return std::ldexp((d.value * std::conj(phase)).real(), static_cast<int>(shift));
}

/// Bisection and the secant method by turns, keeping the change of sign.
Real refined(const Continuum &rotor, const Question &question, Bracket b) {
    const Scaled first = rotor.determinant_at(b.low, question);
    const Complex phase = first.value / std::abs(first.value);
    const auto f = [&](Real omega) {
        return real_part(rotor.determinant_at(omega, question), phase, first.exponent);
    };
    Real fl = f(b.low);
    Real fh = f(b.high);
    if ((fl > 0) == (fh > 0)) // Hermitian with a turning phase, or roots closer than rounding
        return (b.low + b.high) / 2;
    int side = 0;
    for (int step = 0; step < 200 && b.high - b.low > 4 * epsilon * b.high; ++step) {
        Real x = (b.low * fh - b.high * fl) / (fh - fl); // Illinois
        if (!(x > b.low && x < b.high) || step % 8 == 7)
            x = (b.low + b.high) / 2;
        const Real fx = f(x);
        if (fx == 0)
            return x;
        if ((fx > 0) == (fl > 0)) {
            const bool stuck = x - b.low <= 4 * epsilon * x;
            b.low = x;
            fl = fx;
            if (side == 1)
                fh /= 2;
            side = 1;
            if (stuck && std::abs(fl) < std::abs(fh))
                return x;
        } else {
            const bool stuck = b.high - x <= 4 * epsilon * x;
            b.high = x;
            fh = fx;
            if (side == -1)
                fl /= 2;
            side = -1;
            if (stuck && std::abs(fh) < std::abs(fl))
                return x;
        }
    }
    return std::abs(fl) < std::abs(fh) ? b.low : b.high;
}

/// Splits until every piece holds one frequency, or several that rounding does not tell apart.
void isolate(const Continuum &rotor, const Question &question, Bracket b, int wanted,
             std::vector<Bracket> &out) {
    if (b.below_low >= std::min(b.below_high, wanted))
        return;
    const bool close = b.high - b.low < 1e-16L * b.high;
    if (b.below_high - b.below_low == 1 || close) {
        out.push_back(b);
        return;
    }
    const Real middle =
        b.low > 0 && b.high > 4 * b.low ? std::sqrt(b.low * b.high) : (b.low + b.high) / 2;
    const int below = count(rotor, question, middle);
    isolate(rotor, question, {b.low, middle, b.below_low, below}, wanted, out);
    isolate(rotor, question, {middle, b.high, below, b.below_high}, wanted, out);
}

} // namespace

std::vector<Real> frequencies(const Continuum &rotor, const Question &question, int wanted,
                              Real highest) {
    Real top = std::min(rotor.reference_frequency(), highest);
    int below = count(rotor, question, top);
    while (below < wanted && top < highest) {
        top = std::min(2 * top, highest);
        below = count(rotor, question, top);
    }
    Real bottom = top;
    int below_bottom = below;
    for (int step = 0; step < 60 && below_bottom > 0; ++step) {
        bottom /= 4;
        below_bottom = count(rotor, question, bottom);
    }
    std::vector<Bracket> brackets;
    isolate(rotor, question, {bottom, top, below_bottom, below}, wanted, brackets);
    std::vector<Real> out;
    for (const Bracket &b : brackets) {
        if (b.below_high - b.below_low > 1) {
            out.insert(out.end(), static_cast<std::size_t>(b.below_high - b.below_low),
                       (b.low + b.high) / 2);
            continue;
        }
        out.push_back(refined(rotor, question, b));
    }
    out.resize(std::min(out.size(), static_cast<std::size_t>(wanted)));
    return out;
}

std::optional<Complex> eigenvalue_near(const Continuum &rotor, const Question &question,
                                       Complex guess) {
    const Real size = std::abs(guess);
    Complex x[3] = {guess * Complex(1 - 1e-5L, 1e-6L), guess * Complex(1 + 1e-5L, -1e-6L), guess};
    Complex f[3];
    const long exponent = rotor.determinant(guess, question).exponent;
    const auto value = [&](const Complex &lambda) {
        const Scaled d = rotor.determinant(lambda, question);
        const long shift = std::clamp(d.exponent - exponent, -16000L, 16000L);
        return d.value * std::ldexp(Real(1), static_cast<int>(shift));
    };
    for (int i = 0; i < 3; ++i)
        f[i] = value(x[i]);
    Real last = size;
    for (int step = 0; step < 80; ++step) {
        if (f[2] == Complex(0))
            return x[2];
        const Complex h1 = x[1] - x[0];
        const Complex h2 = x[2] - x[1];
        if (h1 == Complex(0) || h2 == Complex(0) || h1 + h2 == Complex(0))
            return x[2];
        const Complex s1 = (f[1] - f[0]) / h1;
        const Complex s2 = (f[2] - f[1]) / h2;
        const Complex a = (s2 - s1) / (h2 + h1);
        const Complex b = a * h2 + s2;
        const Complex root = std::sqrt(b * b - Real(4) * a * f[2]);
        const Complex denominator = std::abs(b + root) > std::abs(b - root) ? b + root : b - root;
        if (denominator == Complex(0))
            return std::nullopt;
        const Complex move = -Real(2) * f[2] / denominator;
        x[0] = x[1];
        x[1] = x[2];
        x[2] += move;
        f[0] = f[1];
        f[1] = f[2];
        f[2] = value(x[2]);
        const Real moved = std::abs(move);
        // Converged steps shrink until rounding moves them about.
        if (moved < 1e-17L * size || (moved < 1e-13L * size && moved >= last))
            return x[2];
        last = moved;
    }
    return std::nullopt;
}

} // namespace whirl::oracles

#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace whirl::oracles {

/// A number with its first and second derivatives by `size` variables, so that equations of motion
/// follow from energies without being written down.
template <class Number, std::size_t size> struct Jet {
    Number value = 0;
    std::array<Number, size> first{};
    std::array<std::array<Number, size>, size> second{};

    Jet() = default;
    Jet(Number constant) : value(constant) {} // NOLINT: numbers are jets

    static Jet variable(Number value, std::size_t index) {
        Jet out(value);
        out.first[index] = 1;
        return out;
    }

    Jet &operator+=(const Jet &b) { return add(b, 1); }
    Jet &operator-=(const Jet &b) { return add(b, -1); }

    /// f(this), its value and derivatives there.
    [[nodiscard]] Jet through(Number f, Number f1, Number f2) const {
        Jet out(f);
        for (std::size_t i = 0; i < size; ++i) {
            out.first[i] = f1 * first[i];
            for (std::size_t j = 0; j < size; ++j)
                out.second[i][j] = f1 * second[i][j] + f2 * first[i] * first[j];
        }
        return out;
    }

  private:
    Jet &add(const Jet &b, Number factor) {
        value += factor * b.value;
        for (std::size_t i = 0; i < size; ++i) {
            first[i] += factor * b.first[i];
            for (std::size_t j = 0; j < size; ++j)
                second[i][j] += factor * b.second[i][j];
        }
        return *this;
    }
};

template <class N, std::size_t s> Jet<N, s> operator+(Jet<N, s> a, const Jet<N, s> &b) {
    return a += b;
}
template <class N, std::size_t s> Jet<N, s> operator-(Jet<N, s> a, const Jet<N, s> &b) {
    return a -= b;
}
template <class N, std::size_t s> Jet<N, s> operator*(const Jet<N, s> &a, const Jet<N, s> &b) {
    Jet<N, s> out(a.value * b.value);
    for (std::size_t i = 0; i < s; ++i) {
        out.first[i] = a.first[i] * b.value + a.value * b.first[i];
        for (std::size_t j = 0; j < s; ++j)
            out.second[i][j] = a.second[i][j] * b.value + a.value * b.second[i][j] +
                               a.first[i] * b.first[j] + a.first[j] * b.first[i];
    }
    return out;
}
template <class N, std::size_t s> Jet<N, s> operator*(N factor, const Jet<N, s> &b) {
    return b.through(factor * b.value, factor, 0);
}
template <class N, std::size_t s> Jet<N, s> square(const Jet<N, s> &a) { return a * a; }
template <class N, std::size_t s> Jet<N, s> sine(const Jet<N, s> &a) {
    const N f = std::sin(a.value);
    return a.through(f, std::cos(a.value), -f);
}
template <class N, std::size_t s> Jet<N, s> cosine(const Jet<N, s> &a) {
    const N f = std::cos(a.value);
    return a.through(f, -std::sin(a.value), -f);
}

} // namespace whirl::oracles

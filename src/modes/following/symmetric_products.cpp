#include "linalg/check.h"
#include "modes/following/symmetric_problem.h"

#include <algorithm>
#include <cmath>

namespace whirl::modes {

namespace {

using Complex = SymmetricProblem::Complex;

/// A row of a real matrix times a vector.
template <class Rows>
WHIRL_INLINED void row_times(const Rows &A, std::size_t r, const linalg::Vector4 &x,
                             linalg::Complex4 &sum) {
    const linalg::Complex4 *in = x.data();
    const int *columns = A.column.data();
    const double *values = A.value.data();
    const int last = A.start[r + 1];
    for (int p = A.start[r]; p < last; ++p) {
        sum.re += values[p] * in[columns[p]].re;
        sum.im += values[p] * in[columns[p]].im;
    }
}

/// @param turned  times i
template <class Rows>
WHIRL_INLINED void add_rows(const Rows &A, const linalg::Vector4 &x, bool turned,
                            linalg::Vector4 &out) {
    for (std::size_t r = 0; r < A.row.size(); ++r) {
        linalg::Complex4 sum{};
        row_times(A, r, x, sum);
        linalg::Complex4 &to = out[static_cast<std::size_t>(A.row[r])];
        to.re += turned ? -sum.im : sum.re;
        to.im += turned ? sum.re : sum.im;
    }
}

struct Factor {
    SymmetricProblem::Part part;
    linalg::Complex4 factor;
};

} // namespace

linalg::RealEnergies SymmetricProblem::energies_of(const Exponents &exponents) const {
    linalg::Real4 square{};
    for (int lane = 0; lane < linalg::lanes; ++lane) {
        const double size = std::ldexp(1.0, exponents[static_cast<std::size_t>(lane)]);
        square[lane] = size * size;
    }
    for (std::size_t entry = 0; entry < _entries.size(); ++entry) {
        const Everywhere &of = _everywhere[entry];
        _entries[entry] = {of.M * square + of.K, {}};
    }
    (void)_of_energies->factorize(_entries); // K is definite: no pivot is zero
    return linalg::RealEnergies(*_of_energies);
}

std::array<double, linalg::lanes>
SymmetricProblem::energies(const linalg::Vector4 &b,
                           const std::array<double, linalg::lanes> &sizes) const {
    Exponents exponents{};
    for (std::size_t lane = 0; lane < linalg::lanes; ++lane)
        exponents[lane] = std::ilogb(sizes[lane]);
    auto known = _energies.find(exponents);
    if (known == _energies.end())
        known = _energies.emplace(exponents, energies_of(exponents)).first;
    return known->second(b);
}

/// M x, K x and i G x, of one or both unknowns of a pair.
template <int each>
WHIRL_INLINED void SymmetricProblem::multiply_everywhere(const linalg::Vector4 &x,
                                                         Products &out) const {
    const linalg::Complex4 *in = x.data();
    const int *columns = _rows.column.data();
    const Both *entries = _rows.entry.data();
    const int *G_columns = _rows.G_column.data();
    const double *G = _rows.G.data();
    constexpr int last_of = each - 1; // q, or the same as p
    for (std::size_t r = 0; r + 1 < _rows.start.size(); ++r) {
        const std::size_t k = each * r;
        linalg::Complex4 Mp{};
        linalg::Complex4 Kp{};
        linalg::Complex4 Mq{};
        linalg::Complex4 Kq{};
        for (int e = _rows.start[r], end = _rows.start[r + 1]; e < end; ++e) {
            const linalg::Complex4 *from = in + columns[e];
            const Both of = entries[e];
            Mp.re += of.M * from->re;
            Mp.im += of.M * from->im;
            Kp.re += of.K * from->re;
            Kp.im += of.K * from->im;
            if constexpr (each == 2) {
                Mq.re += of.M * from[1].re;
                Mq.im += of.M * from[1].im;
                Kq.re += of.K * from[1].re;
                Kq.im += of.K * from[1].im;
            }
        }
        linalg::Complex4 Gp{};
        linalg::Complex4 Gq{};
        for (int e = _rows.G_start[r], end = _rows.G_start[r + 1]; e < end; ++e) {
            const linalg::Complex4 *from = in + G_columns[e];
            Gp.re += G[e] * from->re;
            Gp.im += G[e] * from->im;
            Gq.re += G[e] * from[last_of].re;
            Gq.im += G[e] * from[last_of].im;
        }
        out.M[k] = Mp;
        out.K[k] = Kp;
        out.D1[k] = {-Gp.im, Gp.re};
        if constexpr (each == 2) {
            out.M[k + 1] = Mq;
            out.K[k + 1] = Kq;
            out.D1[k + 1] = {Gq.im, -Gq.re};
        }
    }
}

void SymmetricProblem::multiply(const linalg::Vector4 &x, const linalg::Real4 &speed,
                                Products &out) const {
    const auto rows = [this](Part part) -> const Rows & {
        return _parts[static_cast<std::size_t>(part)];
    };
    for (linalg::Vector4 *y : {&out.M, &out.D, &out.K, &out.D1})
        y->resize(x.size());
    out.K1.resize(rows(circulatory).row.empty() ? 0 : x.size());
    linalg::in_lanes([&]() __attribute__((always_inline)) {
        if (_rows.pairs)
            multiply_everywhere<2>(x, out);
        else
            multiply_everywhere<1>(x, out);
        for (std::size_t k = 0; k < x.size(); ++k)
            out.D[k] = {speed * out.D1[k].re, speed * out.D1[k].im};
        add_rows(_M_across, x, false, out.M);
        add_rows(_K_across, x, false, out.K);
        add_rows(rows(stiffness_turned), x, true, out.K);
        add_rows(rows(damping), x, false, out.D);
        add_rows(rows(damping_turned), x, true, out.D);
        if (!out.K1.empty()) {
            std::fill(out.K1.begin(), out.K1.end(), linalg::Complex4{});
            add_rows(rows(circulatory), x, true, out.K1);
            for (std::size_t k = 0; k < x.size(); ++k) {
                out.K[k].re += speed * out.K1[k].re;
                out.K[k].im += speed * out.K1[k].im;
            }
        }
    });
}

SymmetricProblem::ColumnProducts SymmetricProblem::products(double speed,
                                                            const Eigen::MatrixXcd &X) const {
    ColumnProducts out{X, X, X};
    linalg::Vector4 x(static_cast<std::size_t>(X.rows()));
    Products of;
    for (Eigen::Index first = 0; first < X.cols(); first += linalg::lanes) {
        const Eigen::Index last = std::min(first + linalg::lanes, X.cols()) - 1;
        for (int lane = 0; lane < linalg::lanes; ++lane) // the last one in those that are left
            for (std::size_t k = 0; k < x.size(); ++k)
                x[k].set(lane, X(static_cast<Eigen::Index>(k), std::min(first + lane, last)));
        multiply(x, linalg::Real4{speed, speed, speed, speed}, of);
        for (int lane = 0; first + lane <= last; ++lane) {
            out.M.col(first + lane) = linalg::vector_of(of.M, lane);
            out.D.col(first + lane) = linalg::vector_of(of.D, lane);
            out.K.col(first + lane) = linalg::vector_of(of.K, lane);
        }
    }
    return out;
}

std::array<double, linalg::lanes> SymmetricProblem::absolute_forms(const linalg::Real4 &l,
                                                                   const linalg::Real4 &speed,
                                                                   const linalg::Vector4 &x) const {
    std::array<linalg::Real4, parts> form{};
    linalg::in_lanes([&]() __attribute__((always_inline)) {
        std::array<linalg::Real4, parts> sum{};
        for (std::size_t k = 0; k < x.size(); ++k) {
            const linalg::Real4 square = x[k].re * x[k].re + x[k].im * x[k].im;
            for (std::size_t part = 0; part < parts; ++part)
                sum[part] += _absolute_sums[k][part] * square;
        }
        form = sum;
    });
    const linalg::Real4 turn = speed < 0 ? -speed : speed;
    const linalg::Real4 sum =
        form[stiffness] + form[stiffness_turned] + turn * form[circulatory] +
        l * (form[damping] + form[damping_turned] + turn * form[gyroscopic] + l * form[mass]);
    return {sum[0], sum[1], sum[2], sum[3]};
}

bool SymmetricProblem::factorized(const linalg::Complex4 &l, const linalg::Real4 &speed,
                                  const linalg::Real4 &damped) const {
    linalg::in_lanes([&]() __attribute__((always_inline)) {
        linalg::Complex4 square;
        linalg::set_product(square, l, l);
        const linalg::Complex4 l_turned{-l.im, l.re};
        const linalg::Complex4 turning{l_turned.re * speed, l_turned.im * speed};
        for (std::size_t entry = 0; entry < _entries.size(); ++entry) {
            const Everywhere &of = _everywhere[entry];
            linalg::Complex4 &Q = _entries[entry];
            Q.re = of.M * square.re + of.G * turning.re + of.K;
            Q.im = of.M * square.im + of.G * turning.im;
        }
        const linalg::Real4 none{};
        const linalg::Complex4 some{l.re * damped, l.im * damped};
        for (const auto &[part, factor] :
             {Factor{damping, some}, Factor{damping_turned, {-some.im, some.re}},
              Factor{stiffness_turned, {none, damped}},
              Factor{circulatory, {none, speed * damped}}})
            for (const auto &[entry, value] : _parts[static_cast<std::size_t>(part)].triangle) {
                linalg::Complex4 &to = _entries[static_cast<std::size_t>(entry)];
                to.re += value * factor.re;
                to.im += value * factor.im;
            }
    });
    const std::array<bool, linalg::lanes> sound = _factors->factorize(_entries);
    return std::count(sound.begin(), sound.end(), true) == linalg::lanes;
}

linalg::SymmetricFactors &SymmetricProblem::factorize(linalg::Complex4 l,
                                                      const linalg::Real4 &speed,
                                                      const linalg::Real4 &damped) const {
    if (factorized(l, speed, damped))
        return *_factors;
    constexpr double beside = 1 + 1e-14;
    l.re *= beside;
    l.im *= beside;
    if (!factorized(l, speed, damped))
        throw linalg::SolverError("a pivot of the symmetric factorisation is zero");
    return *_factors;
}

} // namespace whirl::modes

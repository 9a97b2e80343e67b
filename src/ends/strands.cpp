#include "ends/strands.h"

#include <algorithm>
#include <cmath>

namespace whirl::ends {

namespace {

using Complex = std::complex<double>;

/// The best partner must be better than the next by this factor.
constexpr double clearly = 0.35;
constexpr int samples = 16;

/// What does not fit where one root would have become another: the mean of the rates does not lead
/// there, or they differ.
double misfit(const Root &a, const Root &b, double step) {
    const Complex off = b.value - a.value - step * (a.rate + b.rate) / 2.0;
    return std::abs(off) + 0.25 * std::abs(step) * std::abs(b.rate - a.rate);
}

/// All grow, or all die out, by far more than they differ, or differ by rounding: which is which
/// does not matter.
bool harmless(const std::vector<const Root *> &roots) {
    double spread = 0;
    double noise = 0;
    double least = std::abs(roots.front()->value.real());
    const int sign = roots.front()->sign();
    for (const Root *a : roots) {
        least = std::min(least, std::abs(a->value.real()));
        noise += a->noise;
        if (a->sign() != sign)
            return false;
        for (const Root *b : roots)
            spread = std::max(spread, std::abs(a->value - b->value));
    }
    return sign != 0 ? least > 2 * spread : spread <= noise;
}

/// Of the entries of a row or a column the least and the one after it.
struct Best {
    int index = 0, next = 0;
};
template <class Entries> Best best_of(const Entries &entries) {
    Best out{0, -1};
    for (int k = 1; k < entries.size(); ++k)
        if (entries(k) < entries(out.index)) {
            out.next = out.index;
            out.index = k;
        } else if (out.next < 0 || entries(k) < entries(out.next)) {
            out.next = k;
        }
    return out;
}

bool passes_safely(const Strand &strand) {
    const int a = strand.from->sign();
    const int b = strand.to->sign();
    if (a == 0 || b == 0)
        return true; // nothing more can be told here
    const double bend = strand.bend();
    int changes = 0;
    double least = HUGE_VAL;
    double before = strand.from->value.real();
    for (int k = 1; k <= samples; ++k) {
        const double real = strand.at(static_cast<double>(k) / samples).real();
        changes += (real > 0) != (before > 0) ? 1 : 0;
        least = std::min({least, std::abs(real), std::abs(before)});
        before = real;
    }
    if (a == b)
        return changes == 0 && least > 0.5 * bend;
    return changes == 1 &&
           bend < 0.3 * std::abs(strand.to->value.real() - strand.from->value.real());
}

/// Where the frequencies of two strands are equal, if they pass each other inside the step and this
/// place has not been looked at.
std::optional<double> passing(const Strand &a, const Strand &b, double scale) {
    const auto gap = [&](double t) { return (a.at(t) - b.at(t)).imag(); };
    const double first = a.from->value.imag() - b.from->value.imag();
    const double last = a.to->value.imag() - b.to->value.imag();
    const double reals_from = std::abs(a.from->value.real()) + std::abs(b.from->value.real());
    const double reals_to = std::abs(a.to->value.real()) + std::abs(b.to->value.real());
    constexpr double equal = 3e-8;
    constexpr double share = 0.25; // of what coupling must overcome
    if (std::abs(first) <= std::max(share * reals_from, equal * scale) ||
        std::abs(last) <= std::max(share * reals_to, equal * scale))
        return std::nullopt;
    double t0 = 0;
    double g0 = first;
    for (int k = 1; k <= 8; ++k) {
        const double t1 = k / 8.0;
        const double g1 = k == 8 ? last : gap(t1);
        if ((g0 > 0) != (g1 > 0)) {
            double t = t0 + (t1 - t0) * g0 / (g0 - g1);
            for (int newton = 0; newton < 3; ++newton) {
                const double g = gap(t);
                const double slope = (g1 - g0) / (t1 - t0);
                t = std::clamp(t - g / slope, t0, t1);
            }
            return a.at(t).imag() + b.at(t).imag() >= -1e-9 * scale ? std::optional(t)
                                                                    : std::nullopt;
        }
        t0 = t1;
        g0 = g1;
    }
    return std::nullopt;
}

} // namespace

Complex Strand::at(double t) const {
    const Complex d0 = step * from->rate;
    const Complex d1 = step * to->rate;
    const Complex rise = to->value - from->value;
    return from->value + t * (d0 + t * (3.0 * rise - 2.0 * d0 - d1 + t * (d0 + d1 - 2.0 * rise)));
}

double Strand::bend() const {
    return std::abs((to->value - from->value - step * (from->rate + to->rate) / 2.0).real());
}

Strands followed(const Spectrum &from, const Spectrum &to) {
    const double step = to.speed - from.speed;
    const auto rows = static_cast<Eigen::Index>(from.roots.size());
    const auto columns = static_cast<Eigen::Index>(to.roots.size());
    Strands out;
    if (rows < 2 || columns < 2)
        return out;
    Eigen::MatrixXd off(rows, columns);
    for (Eigen::Index i = 0; i < rows; ++i)
        for (Eigen::Index j = 0; j < columns; ++j)
            off(i, j) = misfit(from.roots[static_cast<std::size_t>(i)],
                               to.roots[static_cast<std::size_t>(j)], step);
    const auto a = [&](int i) { return &from.roots[static_cast<std::size_t>(i)]; };
    const auto b = [&](int j) { return &to.roots[static_cast<std::size_t>(j)]; };
    std::vector<Best> of_column;
    for (Eigen::Index j = 0; j < columns; ++j)
        of_column.push_back(best_of(off.col(j)));
    for (int i = 0; i < rows; ++i) {
        const Best row = best_of(off.row(i));
        const Best column = of_column[static_cast<std::size_t>(row.index)];
        const double own = off(i, row.index);
        const bool known = column.index == i && own <= clearly * off(i, row.next) &&
                           own <= clearly * off(column.next, row.index);
        if (known)
            out.strands.push_back({a(i), b(row.index), step});
        else if (!harmless({a(i), b(row.index), b(row.next), a(column.index)}))
            out.clear = false;
    }
    return out;
}

std::optional<double> look_at(const Strands &all, double scale) {
    if (!all.clear)
        return 0.5;
    for (const Strand &strand : all.strands)
        if (!passes_safely(strand))
            return 0.5;
    for (std::size_t i = 0; i < all.strands.size(); ++i)
        for (std::size_t k = i + 1; k < all.strands.size(); ++k)
            if (const auto t = passing(all.strands[i], all.strands[k], scale))
                return t;
    return std::nullopt;
}

} // namespace whirl::ends

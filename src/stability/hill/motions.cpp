#include "stability/hill/motions.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::stability {

std::complex<double> nearest_alias(std::complex<double> other, const Motion &motion) {
    if (motion.repeats == 0)
        return motion.value;
    const double off = motion.value.imag() - other.imag();
    return {motion.value.real(), other.imag() + std::remainder(off, motion.repeats)};
}

double alias_distance(std::complex<double> a, std::complex<double> b, double repeats) {
    const std::complex<double> off = a - b;
    return std::abs(std::complex<double>(
        off.real(), repeats != 0 ? std::remainder(off.imag(), repeats) : off.imag()));
}

const Motion &fastest_growing(const std::vector<Motion> &motions) {
    return *std::ranges::max_element(motions, {},
                                     [](const Motion &motion) { return motion.value.real(); });
}

double growth_of(const std::vector<Motion> &motions) {
    double growth = -std::numeric_limits<double>::infinity();
    for (const Motion &motion : motions) { // a blurred zero must not hide one that grows
        growth = std::max(growth, motion.neutral() ? 0 : motion.value.real());
    }
    return growth;
}

} // namespace whirl::stability

#include "ends/spectrum.h"

#include <algorithm>
#include <cmath>

namespace whirl::ends {

int Spectrum::growing() const {
    return static_cast<int>(
        std::ranges::count_if(roots, [](const Root &r) { return r.sign() > 0; }));
}

const Root &Spectrum::nearest(std::complex<double> value) const {
    return *std::ranges::min_element(roots, {},
                                     [&](const Root &a) { return std::abs(a.value - value); });
}

} // namespace whirl::ends

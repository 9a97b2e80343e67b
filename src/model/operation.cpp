#include "model/operation.h"

#include <array>
#include <cstddef>

namespace whirl::model {

std::string reading_name(Reading reading) {
    static constexpr std::array names{"peak", "peak to peak", "rms"};
    return names.at(static_cast<std::size_t>(reading));
}

std::string zone_name(Zone zone) {
    static constexpr std::array names{"A/B", "B/C", "C/D"};
    return names.at(static_cast<std::size_t>(zone));
}

std::string fit_name(BearingFit fit) {
    static constexpr std::array names{"as given", "min", "max"};
    return names.at(static_cast<std::size_t>(fit));
}

} // namespace whirl::model

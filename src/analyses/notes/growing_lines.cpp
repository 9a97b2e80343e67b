#include "analyses/notes/growing_lines.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace whirl::analyses {

void note_growing(results::CampbellResult &result) {
    std::vector<std::string> lines;
    for (const results::CampbellMode &mode : result.modes) {
        std::vector<double> at;
        for (std::size_t k = 0; k < mode.real.size(); ++k) {
            constexpr double always = 1e-9; // of the frequency: rounding
            if (!mode.real[k] || !mode.frequency[k])
                continue;
            const double noise = (always + 10 * mode.residual[k].value_or(0)) *
                                 std::max(*mode.frequency[k], std::abs(result.speeds[k]));
            if (*mode.real[k] > noise)
                at.push_back(result.speeds[k]);
        }
        if (!at.empty())
            lines.push_back(
                fmt::format("{} ({:.6g} to {:.6g} rad/s)", mode.label, at.front(), at.back()));
    }
    constexpr std::size_t listed = 4;
    if (lines.empty())
        return;
    const std::size_t more = lines.size() - std::min(listed, lines.size());
    lines.resize(std::min(listed, lines.size()));
    result.model.notes.push_back(fmt::format(
        "unstable: motion grows (negative damping) at speeds of {}{}; `stability` finds where it "
        "begins",
        fmt::join(lines, ", "), more > 0 ? fmt::format(" and {} more modes", more) : ""));
}

} // namespace whirl::analyses

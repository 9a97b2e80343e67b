#include "analyses/notes/gaps.h"

#include <fmt/format.h>

#include <algorithm>

namespace whirl::analyses {

void note_gaps(results::ModelSummary &model, const std::vector<tracking::Gap> &gaps,
               const std::string &what) {
    constexpr std::size_t few = 3;
    if (gaps.size() <= few) {
        for (const tracking::Gap &gap : gaps)
            model.notes.push_back(
                fmt::format("between {:.6g} and {:.6g} rad/s {} (frequency near {:.6g} rad/s)",
                            gap.from, gap.to, what, gap.frequency));
        return;
    }
    tracking::Gap all = gaps.front();
    double highest = all.frequency;
    for (const tracking::Gap &gap : gaps) {
        all.from = std::min(all.from, gap.from);
        all.to = std::max(all.to, gap.to);
        all.frequency = std::min(all.frequency, gap.frequency);
        highest = std::max(highest, gap.frequency);
    }
    model.notes.push_back(fmt::format(
        "in {} short stretches between {:.6g} and {:.6g} rad/s {} (frequencies from {:.6g} to "
        "{:.6g} rad/s)",
        gaps.size(), all.from, all.to, what, all.frequency, highest));
}

} // namespace whirl::analyses

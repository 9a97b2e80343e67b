#include "cli/messages.h"

#include "process/signals.h"
#include "report/common/text_width.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <system_error>

namespace whirl::cli {

bool first_process() {
    // The launchers tell each process its number by an environment variable.
    for (const char *name :
         {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK", "MV2_COMM_WORLD_RANK", "SLURM_PROCID"})
        if (const char *rank = std::getenv(name))
            return std::string_view(rank) == "0";
    return true;
}

void complain(std::string_view message) {
    if (first_process())
        complain_here(message);
}

void complain_here(std::string_view message) {
    const bool ended = !message.empty() && message.back() == '\n';
    // One write for the whole message, so that it stays in one piece; if standard error is
    // closed there is nobody to tell.
    const std::string whole = report::printable(message, true) + (ended ? "" : "\n");
    (void)std::fwrite(whole.data(), 1, whole.size(), stderr);
}

void say(std::string_view text) {
    if (!first_process())
        return;
    const std::string whole = report::printable(text, true);
    if (std::fwrite(whole.data(), 1, whole.size(), stdout) != whole.size() ||
        std::fflush(stdout) != 0)
        throw std::system_error(errno, std::generic_category(), "cannot write to standard output");
    process::results_written();
}

} // namespace whirl::cli

#include "report/common/html.h"

namespace whirl::report {

#ifdef WHIRL_PLOTLY_FILE

// The assembler copies the file into read-only data; a megabyte as a string literal would take the
// compiler minutes.
asm(".pushsection .rodata\n"
    ".global whirl_plotly_begin\n"
    ".global whirl_plotly_end\n"
    "whirl_plotly_begin:\n"
    ".incbin \"" WHIRL_PLOTLY_FILE "\"\n"
    "whirl_plotly_end:\n"
    ".byte 0\n"
    ".popsection\n");

extern "C" {
extern const char whirl_plotly_begin[];
extern const char whirl_plotly_end[];
}

std::string_view plotly_bundle() {
    return {whirl_plotly_begin, static_cast<std::size_t>(whirl_plotly_end - whirl_plotly_begin)};
}

#else

std::string_view plotly_bundle() { return {}; }

#endif

} // namespace whirl::report

#pragma once

namespace whirl::process {

/// Has the heap begin with 64 MB in pages of 2 MB, where the system has them: a run of a second
/// touches tens of megabytes, and a tenth of its time would go into 4 kB pages that are cleared one
/// by one. Only what is touched takes memory. Without an effect elsewhere than on Linux.
void use_huge_pages();

/// Bytes that a program may take here: of the machine, or what a container or a limit of the shell
/// leaves of it. Infinite where that is not known.
[[nodiscard]] double memory_of_machine();

} // namespace whirl::process

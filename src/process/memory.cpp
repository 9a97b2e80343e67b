#include "process/memory.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>

#ifdef __linux__
#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace whirl::process {

void use_huge_pages() {
#if defined(__GLIBC__) && defined(MADV_HUGEPAGE)
    constexpr int megabyte = 1 << 20;
    constexpr int size = 64 * megabyte;
    // Blocks are taken from the heap up to the size that the library would arrive at by and by.
    mallopt(M_MMAP_THRESHOLD, 32 * megabyte);
    mallopt(M_TRIM_THRESHOLD, 4 * size);
    mallopt(M_TOP_PAD, size);
    char *begin = static_cast<char *>(sbrk(0)); // at a page: the library sees to it
    void *volatile block = std::malloc(megabyte);
    std::free(block); // it was more than there was: the heap has grown by it and the pad
    const char *end = static_cast<const char *>(sbrk(0));
    mallopt(M_TOP_PAD, megabyte);
    if (end > begin)
        madvise(begin, static_cast<std::size_t>(end - begin), MADV_HUGEPAGE);
#endif
}

double memory_of_machine() {
    double least = std::numeric_limits<double>::infinity();
#ifdef __linux__
    const long pages = sysconf(_SC_PHYS_PAGES);
    const long page = sysconf(_SC_PAGE_SIZE);
    if (pages > 0 && page > 0)
        least = static_cast<double>(pages) * static_cast<double>(page);
    for (const int of : {RLIMIT_AS, RLIMIT_DATA}) {
        rlimit limit{};
        if (getrlimit(of, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
            least = std::min(least, static_cast<double>(limit.rlim_cur));
    }
    // Of a container; "max" where it has none.
    for (const char *name :
         {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
        double limit = 0;
        if (std::ifstream(name) >> limit && limit > 0)
            least = std::min(least, limit);
    }
#endif
    return least;
}

} // namespace whirl::process

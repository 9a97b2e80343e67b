#include "process/memory.h"

#include <cstdlib>

#ifdef __linux__
#include <malloc.h>
#include <sys/mman.h>
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

} // namespace whirl::process

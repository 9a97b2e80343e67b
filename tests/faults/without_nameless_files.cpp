// Loaded before all other libraries (LD_PRELOAD) it is a file system that knows no files without
// names, as NFS: opening one fails, all else is as it is.

#include <cerrno>
#include <cstdarg>

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace {

int open_named(int folder, const char *path, int flags, va_list rest) {
    if ((flags & O_TMPFILE) == O_TMPFILE) {
        errno = EOPNOTSUPP;
        return -1;
    }
    const unsigned mode = (flags & O_CREAT) != 0 ? va_arg(rest, unsigned) : 0U;
    return static_cast<int>(syscall(SYS_openat, folder, path, flags, mode));
}

} // namespace

// Both names of one function.
extern "C" int openat(int folder, const char *path, int flags, ...) {
    va_list rest;
    va_start(rest, flags);
    const int descriptor = open_named(folder, path, flags, rest);
    va_end(rest);
    return descriptor;
}

extern "C" int openat64(int folder, const char *path, int flags, ...) {
    va_list rest;
    va_start(rest, flags);
    const int descriptor = open_named(folder, path, flags, rest);
    va_end(rest);
    return descriptor;
}

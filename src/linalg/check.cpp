#include "linalg/check.h"

#include <fmt/format.h>
#include <petscsys.h>

#include <new>
#include <string_view>

namespace whirl::linalg {

void check(int code, const char *file, int line) {
    if (code == 0)
        return;
    if (code == PETSC_ERR_MEM)
        throw std::bad_alloc(); // no other solver would fare better
    std::string_view name = file;
    name = name.substr(name.find_last_of('/') + 1);
    throw SolverError(
        fmt::format("a linear algebra step failed (code {} at {}:{})", code, name, line));
}

} // namespace whirl::linalg

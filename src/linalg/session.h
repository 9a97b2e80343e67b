#pragma once

namespace whirl::linalg {

/// Starts MPI, PETSc and SLEPc and ends them; one lives in main (or in a test program).
/// No option of PETSc's or SLEPc's is read from anywhere (petscrc files, PETSC_OPTIONS), and its
/// error printing is off: errors arrive as exceptions.
class Session {
  public:
    /// @throws std::bad_alloc where there is not the memory to start with
    Session();
    ~Session();
    Session(const Session &) = delete;
    Session &operator=(const Session &) = delete;
    Session(Session &&) = delete;
    Session &operator=(Session &&) = delete;
};

} // namespace whirl::linalg

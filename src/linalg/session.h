#pragma once

namespace whirl::linalg {

/// Starts MPI, PETSc and SLEPc and ends them; one lives in main (or in a test program).
/// PETSc's own option database and its error printing are off: errors arrive as exceptions.
class Session {
  public:
    Session();
    ~Session();
    Session(const Session &) = delete;
    Session &operator=(const Session &) = delete;
    Session(Session &&) = delete;
    Session &operator=(Session &&) = delete;
};

} // namespace whirl::linalg

#include "linalg/session.h"

#include "linalg/check.h"

#include <slepcsys.h>

#include <petscblaslapack.h> // needs what that brings

#ifdef __linux__
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#endif

#include <cstdlib>
#include <filesystem>
#include <new>
#include <string_view>
#include <system_error>

namespace whirl::linalg {

namespace {

/// Of no use where nothing is said over networks: which devices the machine has (14 ms of the start
/// of a process, 31 of two), and what else hwloc loads at run time (4 ms).
void leave_out_devices() {
    setenv("HWLOC_COMPONENTS", "-linuxio,-pci,-opencl,-gl", 0);
    setenv("HWLOC_PLUGINS_PATH", "/nonexistent", 0);
}

/// Processes of Open MPI's launcher that share one machine's memory need none of its networks:
/// the start falls from 0.22 s to 0.02 s. The user's own settings win.
void prepare_one_machine() {
    const char *all = std::getenv("OMPI_COMM_WORLD_SIZE");
    const char *here = std::getenv("OMPI_COMM_WORLD_LOCAL_SIZE");
    if (all == nullptr || here == nullptr || std::string_view(all) != here)
        return;
    setenv("OMPI_MCA_pml", "ob1", 0);
    leave_out_devices();
}

/// What a process tells its launcher at the end are small messages, and each waits for the system
/// to acknowledge the one before (40 ms) where connections gather such.
void send_at_once() {
#ifdef __linux__
    std::error_code none;
    for (const auto &entry : std::filesystem::directory_iterator("/proc/self/fd", none)) {
        const int yes = 1; // no connection, or one of another kind: it stays as it is
        (void)setsockopt(std::atoi(entry.path().filename().c_str()), IPPROTO_TCP, TCP_NODELAY, &yes,
                         sizeof yes);
    }
#endif
}

bool under_launcher() {
    for (const char *name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "SLURM_PROCID"})
        if (std::getenv(name) != nullptr)
            return true;
    return false;
}

/// A single process needs no run-time daemon and no network: Open MPI's start falls from 0.45 s
/// to 0.08 s. The user's own settings win.
void prepare_single_process() {
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
    setenv("OMPI_MCA_pml", "ob1", 0);
    setenv("OMPI_MCA_btl", "self", 0);
    leave_out_devices();
    // Of Open MPI's components those that one process takes in the end; looking at the others and
    // leaving them takes 2 ms.
    setenv("OMPI_MCA_coll", "self,basic,libnbc", 0);
    setenv("OMPI_MCA_osc", "sm", 0);
    setenv("OMPI_MCA_op", "^avx", 0);
    setenv("OMPI_MCA_state", "app", 0);
    setenv("OMPI_MCA_errmgr", "default_app", 0);
    setenv("OMPI_MCA_shmem", "mmap", 0);
    // Isolated processes would all use one session directory, and remove it under one another.
    setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
}

/// PETSc reads these whatever it is told, and whoever set them meant another program: they can
/// overwrite files, write to standard output, start a debugger.
void leave_out_options() {
    unsetenv("PETSC_OPTIONS");
    unsetenv("PETSC_OPTIONS_YAML");
}

/// OpenBLAS takes one buffer, of 128 MB on x86-64, when it is called first, keeps it, and up to
/// 0.3.29 asks for it again for ever where there is not so much (its issue 5289). So it is asked
/// here, after a look whether there is.
/// @throws std::bad_alloc
void claim_blas_buffer() {
    constexpr std::size_t size = 129U << 20U; // with what it adds to align it
    void *volatile buffer = std::malloc(size);
    if (buffer == nullptr)
        throw std::bad_alloc();
    std::free(buffer);
    // Products of small matrices do without it, solutions do not.
    const PetscBLASInt one = 1;
    const PetscScalar A = 1;
    PetscScalar x = 1;
    BLAStrsm_("L", "L", "N", "N", &one, &one, &A, &A, &one, &x, &one);
}

PetscErrorCode silent_handler(MPI_Comm, int, const char *, const char *, PetscErrorCode code,
                              PetscErrorType, const char *, void *) {
    return code;
}

} // namespace

Session::Session() {
    claim_blas_buffer();
    leave_out_options();
    if (under_launcher())
        prepare_one_machine();
    else
        prepare_single_process();
    static int argc = 3;
    static char name[] = "whirl";
    static char no_signals[] = "-no_signal_handler";
    static char no_files[] = "-skip_petscrc";
    static char *list[] = {name, no_signals, no_files, nullptr};
    static char **argv = list;
    argc = 3; // Initialize changes it
    check(SlepcInitialize(&argc, &argv, nullptr, nullptr));
    check(PetscPushErrorHandler(silent_handler, nullptr));
    if (under_launcher())
        send_at_once();
}

Session::~Session() {
    PetscPopErrorHandler();
    SlepcFinalize();
}

} // namespace whirl::linalg

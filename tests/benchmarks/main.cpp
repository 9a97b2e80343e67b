// main of the benchmarks: PETSc and SLEPc run around all of them.

#include "linalg/session.h"

#include <benchmark/benchmark.h>

int main(int argc, char **argv) {
    const whirl::linalg::Session session;
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv))
        return 2;
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}

// main of test programs that use PETSc and SLEPc.

#include "process/session.h"

#include <gtest/gtest.h>

int main(int argc, char **argv) {
    testing::InitGoogleTest(&argc, argv);
    const whirl::process::Session session;
    return RUN_ALL_TESTS();
}

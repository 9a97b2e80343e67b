// main of test programs that use PETSc and SLEPc.

#include "linalg/session.h"

#include <gtest/gtest.h>

int main(int argc, char **argv) {
    testing::InitGoogleTest(&argc, argv);
    const whirl::linalg::Session session;
    return RUN_ALL_TESTS();
}

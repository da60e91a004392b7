// SPDX-License-Identifier: Apache-2.0
// The tests import foreign files, whose readers are this program started again.
#include <gtest/gtest.h>

#include "cases/foreign_files.h"

int main(int argc, char** argv) {
    theatron::sandbox::run_as_child(argc, argv, theatron::cases::foreign_readers);
    ::testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: Apache-2.0
// The tests open recordings; their reader processes are this program, started again.
#include <gtest/gtest.h>

#include "capture/mkv_reader.h"

int main(int argc, char** argv) {
    theatron::sandbox::run_as_child(argc, argv, theatron::capture::foreign_readers);
    ::testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}

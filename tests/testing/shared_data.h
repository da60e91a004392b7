// SPDX-License-Identifier: Apache-2.0
// Real camera sequences for tests, where this checkout has them beside it. A
// test that needs them skips with a message where they are missing.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace theatron::testing {

// The folder of recorded sequences: $THEATRON_DATA or ../shared/data.
inline std::filesystem::path shared_data() {
    const char* set = std::getenv("THEATRON_DATA");
    return set ? set : "../shared/data";
}

}  // namespace theatron::testing

#define THEATRON_REQUIRE_DATA(relative)                                               \
    if (!std::filesystem::exists(theatron::testing::shared_data() / (relative)))      \
    GTEST_SKIP() << "no " << (theatron::testing::shared_data() / (relative)).string() \
                 << ": set THEATRON_DATA to a folder with recorded sequences"

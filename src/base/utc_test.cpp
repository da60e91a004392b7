// SPDX-License-Identifier: Apache-2.0
#include "base/utc.h"

#include <gtest/gtest.h>

namespace theatron {
namespace {

TEST(Utc, IsWrittenAsRfc3339) {
    using namespace std::chrono;
    EXPECT_EQ(utc_text(sys_days(2026y / 2 / 28) + 23h + 59min + 59s + 999'999us),
              "2026-02-28T23:59:59.999Z");
    EXPECT_EQ(utc_text(sys_days(1969y / 12 / 31) + 1ms), "1969-12-31T00:00:00.001Z");
    EXPECT_EQ(utc_text(UtcTime{}), "") << "not known";
}

}  // namespace
}  // namespace theatron

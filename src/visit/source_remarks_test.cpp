// SPDX-License-Identifier: Apache-2.0
#include "visit/source_remarks.h"

#include <gtest/gtest.h>

namespace theatron::visit {
namespace {

using wire::CameraCondition;
using Lines = std::vector<std::string>;

constexpr TimePoint at(int ms) {
    return from_us(std::int64_t(ms) * 1000);
}

TEST(SourceRemarks, SayWhyASourceStandsStillAndThatItGoesOn) {
    SourceRemarks remarks;
    const auto take = [&](CameraCondition condition, const char* problem, int ms) {
        return remarks.take({{"lamp", CameraCondition::live, ""}, {"scope", condition, problem}},
                            at(ms));
    };
    const char* gone = "The window 'scope' is closed.";
    EXPECT_EQ(take(CameraCondition::live, "", 0), Lines{});
    EXPECT_EQ(take(CameraCondition::stale, "It sends no pictures.", 100), Lines{});
    EXPECT_EQ(take(CameraCondition::stale, gone, 1100),
              Lines{"\"scope\" stands still and is tried again by itself. The window 'scope' is "
                    "closed."});
    EXPECT_EQ(take(CameraCondition::stale, gone, 9000), Lines{});
    EXPECT_EQ(take(CameraCondition::live, "", 9100), Lines{"\"scope\" goes on."});
    EXPECT_EQ(take(CameraCondition::live, "", 9200), Lines{});
    EXPECT_EQ(take(CameraCondition::ended, "", 12'000), Lines{});
    EXPECT_EQ(take(CameraCondition::ended, "", 13'000),
              Lines{"\"scope\" has ended; the others see its last picture."});
}

TEST(SourceRemarks, AShortPauseAndReasonsThatAlternateAreNoFlood) {
    SourceRemarks remarks;
    const auto take = [&](CameraCondition condition, const char* problem, int ms) {
        return remarks.take({{"scope", condition, problem}}, at(ms)).size();
    };
    EXPECT_EQ(take(CameraCondition::stale, "", 0), 0u);
    EXPECT_EQ(take(CameraCondition::live, "", 900), 0u);
    EXPECT_EQ(take(CameraCondition::stale, "", 1000), 0u);
    EXPECT_EQ(take(CameraCondition::stale, "", 1900), 0u);
    EXPECT_EQ(take(CameraCondition::stale, "It sends no pictures.", 2000), 1u);
    EXPECT_EQ(take(CameraCondition::stale, "It does not answer.", 2100), 1u);
    EXPECT_EQ(take(CameraCondition::stale, "It sends no pictures.", 2200), 0u);
}

}  // namespace
}  // namespace theatron::visit

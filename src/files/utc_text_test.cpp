// SPDX-License-Identifier: Apache-2.0
#include "files/utc_text.h"

#include <gtest/gtest.h>

namespace theatron::files {
namespace {

TEST(UtcText, IsTheSameTimeInBothDirections) {
    EXPECT_EQ(utc_text(0), "1970-01-01T00:00:00Z");
    EXPECT_EQ(utc_text(1'795'378'500), "2026-11-22T20:15:00Z");
    EXPECT_EQ(utc_text(1'709'251'199), "2024-02-29T23:59:59Z");
    for (const UtcSeconds time : {0l, 1'795'378'500l, 1'709'251'199l, 253'402'300'799l})
        EXPECT_EQ(parse_utc(utc_text(time)), time);
    EXPECT_EQ(utc_text(-1), "");
    EXPECT_EQ(utc_text(253'402'300'800), "");
}

TEST(UtcText, OfAnotherSpellingOrOfNoDayIsNone) {
    for (const char* text : {"", "-", "2026-11-22", "2026-11-22T20:15:00", "2026-02-30T00:00:00Z",
                             "2026-11-22T24:00:00Z", "2026-11-22T20:15:00Zx", "2026-1-2T0:0:0Z",
                             "2026-11-22T20:15:00+01:00", "2026-13-01T00:00:00Z"})
        EXPECT_FALSE(parse_utc(text)) << text;
}

}  // namespace
}  // namespace theatron::files

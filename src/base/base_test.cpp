// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "base/bytes.h"
#include "base/error.h"
#include "base/float_bytes.h"
#include "base/newest_slot.h"
#include "base/options.h"
#include "base/statistics.h"
#include "base/time_between.h"
#include "base/trimmed.h"

namespace theatron {
namespace {

TEST(Trimmed, TakesBlanksAtBothEndsOnly) {
    EXPECT_EQ(trimmed(" \t a b\r"), "a b");
    EXPECT_EQ(trimmed(" \t\r"), "");
    EXPECT_EQ(trimmed(""), "");
    EXPECT_EQ(trimmed("\na "), "\na");
    EXPECT_EQ(trimmed("--a-", "-"), "a");
}

TEST(Bytes, AreLittleEndian) {
    Bytes bytes;
    ByteWriter(bytes).put(std::uint32_t(0x01020304));
    EXPECT_EQ(bytes, (Bytes{std::byte{4}, std::byte{3}, std::byte{2}, std::byte{1}}));
    EXPECT_EQ(load_le<std::int16_t>(Bytes{std::byte{0xfe}, std::byte{0xff}}.data()), -2);
}

TEST(Bytes, FloatsAreTheirBits) {
    Bytes bytes;
    ByteWriter out(bytes);
    put_f32(out, -2.5f);
    EXPECT_EQ(bytes, (Bytes{std::byte(0), std::byte(0), std::byte(0x20), std::byte(0xc0)}));
    ByteReader whole(bytes);
    EXPECT_EQ(get_f32(whole), -2.5f);
    ByteReader cut(ByteView(bytes).first(3));
    EXPECT_EQ(get_f32(cut), 0);
    EXPECT_FALSE(cut.ok());
}

TEST(Bytes, ReaderFailsPastTheEndAndStaysFailed) {
    Bytes bytes(3);
    ByteReader in(bytes);
    EXPECT_EQ(in.get<std::uint32_t>(), 0u);
    EXPECT_FALSE(in.ok());
    EXPECT_EQ(in.get<std::uint8_t>(), 0);
    EXPECT_FALSE(in.ok());
}

TEST(TimeBetween, IsExactOrCutWhereItWouldOverflow) {
    const TimePoint lowest = TimePoint::min(), highest = TimePoint::max();
    EXPECT_EQ(time_between(from_us(5), from_us(12)), 7us);
    EXPECT_EQ(time_between(highest, highest - 3us), -3us);
    EXPECT_EQ(time_between(lowest, highest), most_time_between);
    EXPECT_EQ(time_between(highest, lowest), -most_time_between);
}

TEST(Options, SplitsKindValueAndKeys) {
    Options o = Options::parse("folder:a/b,c/d=e,fps=15,loop=1");
    EXPECT_EQ(o.kind(), "folder");
    EXPECT_EQ(o.value(), "a/b,c/d=e");
    EXPECT_EQ(o.take_number("fps", 30, 1, 240), 15);
    EXPECT_TRUE(o.take_flag("loop"));
    EXPECT_EQ(o.problem(), "");
}

TEST(Options, KeysNeedNoValueBefore) {
    Options o = Options::parse("zstd:delta=1");
    EXPECT_EQ(o.value(), "");
    EXPECT_EQ(o.take_int("delta", 0, 0, 1), 1);
}

TEST(Options, NamesWhatIsWrong) {
    const auto problem_with = [](std::string_view text) {
        Options o = Options::parse(text);
        o.take_int("n", 1, 0, 9);
        return o.problem();
    };
    EXPECT_EQ(problem_with("a:n=5"), "");
    for (const char* text :
         {":x", "a:b,n=1,n=2", "a:n=1,c", "a:n=banana", "a:n=10", "a:n=nan", "a:n=", "a:n=1.5"})
        EXPECT_NE(problem_with(text), "") << text;
    EXPECT_EQ(problem_with("a:n=1,bogus=1"), "In 'a:n=1,bogus=1', the key 'bogus' is unknown.");
    EXPECT_THROW(Options::parse("a:x=1").require_no_problem(), Error);
}

TEST(NewestSlot, KeepsOnlyTheNewest) {
    NewestSlot<int> slot;
    EXPECT_FALSE(slot.put(1));
    EXPECT_TRUE(slot.put(2));
    EXPECT_EQ(slot.take(std::chrono::milliseconds(0)), 2);
    EXPECT_EQ(slot.take(std::chrono::milliseconds(0)), std::nullopt);
}

TEST(NewestSlot, WithRoomForMoreDropsTheOldest) {
    NewestSlot<int> slot(2);
    EXPECT_FALSE(slot.put(1));
    EXPECT_FALSE(slot.put(2));
    EXPECT_TRUE(slot.put(3));
    EXPECT_EQ(slot.take(std::chrono::milliseconds(0)), 2);
    EXPECT_EQ(slot.take(std::chrono::milliseconds(0)), 3);
    EXPECT_EQ(slot.take(std::chrono::milliseconds(0)), std::nullopt);
}

TEST(Statistics, PercentilesOfAWindow) {
    SampleWindow window(4);
    for (const double v : {9.0, 1.0, 2.0, 3.0, 4.0})
        window.add(v);
    EXPECT_EQ(window.percentile(0), 1);
    EXPECT_EQ(window.percentile(1), 4);
    EXPECT_EQ(median({3, 1, 2}), 2);
    EXPECT_EQ(median({}), 0);
}

}  // namespace
}  // namespace theatron

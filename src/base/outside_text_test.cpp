// SPDX-License-Identifier: Apache-2.0
#include "base/outside_text.h"

#include <gtest/gtest.h>

namespace theatron {
namespace {

constexpr std::size_t plenty = 1000;
const std::string replaced = "\xef\xbf\xbd";

TEST(CleanText, LeavesOrdinaryTextOfAnyLanguageAsItIs) {
    for (const char* text :
         {"", "Dr. A", "Überwachungsplatz der Anästhesie", "手術室", "غرفة", "\xf0\x9f\xa9\xba",
          "\xf4\x8f\xbf\xbf", "\xed\x9f\xbf", "\xee\x80\x80"})
        EXPECT_EQ(clean_text(text, plenty), text);
}

TEST(CleanText, CutsBetweenCharactersNeverInsideOne) {
    EXPECT_EQ(clean_text("Ärzte", 3), "Ärz");
    EXPECT_EQ(clean_text("üüüü", 2), "üü");
    EXPECT_EQ(clean_text("\xf0\x9f\xa9\xba\xf0\x9f\xa9\xba", 1), "\xf0\x9f\xa9\xba");
    EXPECT_EQ(clean_text("abc", 0), "");
}

TEST(CleanText, ReplacesWhatIsNoUtf8) {
    EXPECT_EQ(clean_text("a\xff\xfe z", plenty), "a" + replaced + replaced + " z");
    EXPECT_EQ(clean_text("\x80", plenty), replaced);
    EXPECT_EQ(clean_text("\xc3", plenty), replaced) << "ends inside a character";
    EXPECT_EQ(clean_text("\xf0\x9f\xa9", plenty), replaced) << "ends inside a character";
    EXPECT_EQ(clean_text("\xf0\x9f\xa9|", plenty), replaced + "|");
    EXPECT_EQ(clean_text("\xc0\xaf", plenty), replaced + replaced) << "a long spelling of '/'";
    EXPECT_EQ(clean_text("\xe0\x80\xaf", plenty), replaced + replaced + replaced);
    EXPECT_EQ(clean_text("\xed\xa0\x80", plenty), replaced + replaced + replaced) << "a surrogate";
    EXPECT_EQ(clean_text("\xf4\x90\x80\x80", plenty), replaced + replaced + replaced + replaced)
        << "beyond the last character";
}

TEST(CleanText, LeavesNothingThatSteersATerminalOrTurnsTheText) {
    EXPECT_EQ(clean_text("a\x1b]0;owned\x07z", plenty), "a ]0;owned z");
    EXPECT_EQ(clean_text("a\r\n\tz\x7f", plenty), "a   z ");
    EXPECT_EQ(clean_text("a\xc2\x9b"
                         "31mz",
                         plenty),
              "a 31mz")
        << "U+009B begins an escape, too";
    EXPECT_EQ(clean_text("a\xc2\x85z\xe2\x80\xa8", plenty), "a z ") << "other ends of lines";
    // NOLINTNEXTLINE(misc-misleading-bidirectional): it is what the test is about
    EXPECT_EQ(clean_text("a\xe2\x80\xaez\xe2\x81\xa6\xef\xbb\xbf\xd8\x9c", plenty), "az");
    EXPECT_EQ(clean_text(std::string_view("a\0z", 3), plenty), "a z");
}

TEST(CleanText, CleaningAgainChangesNothing) {
    std::string every;
    for (int i = 0; i < 4096; ++i)
        every += char(i * 37 ^ i >> 3);
    const std::string once = clean_text(every, plenty);
    EXPECT_EQ(clean_text(once, plenty), once);
}

}  // namespace
}  // namespace theatron

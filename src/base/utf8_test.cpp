// SPDX-License-Identifier: Apache-2.0
#include "base/utf8.h"

#include <gtest/gtest.h>

#include "base/basic_letters.h"

namespace theatron {
namespace {

TEST(Utf8, ACharacterHasItsCodeAndItsBytes) {
    const auto is = [](std::string_view text, char32_t code, std::size_t bytes) {
        const Utf8Character first = first_character(text);
        return first.code == code && first.bytes == bytes && first.valid;
    };
    EXPECT_TRUE(is("ab", U'a', 1));
    EXPECT_TRUE(is("ß.", 0xdf, 2));
    EXPECT_TRUE(is("山", 0x5c71, 3));
    EXPECT_TRUE(is("\U0001fa7a", 0x1fa7a, 4));
}

TEST(Utf8, BytesThatAreNoCharacterAreOneTogetherAsFarAsTheyCouldBegin) {
    const auto bytes = [](std::string_view text) {
        const Utf8Character first = first_character(text);
        EXPECT_FALSE(first.valid);
        EXPECT_EQ(first.code, char32_t(0xfffd));
        return first.bytes;
    };
    EXPECT_EQ(bytes("\xff"), 1u);
    EXPECT_EQ(bytes("\x80x"), 1u);
    EXPECT_EQ(bytes("\xc3"), 1u) << "cut off";
    EXPECT_EQ(bytes("\xf0\x9f\xa9"), 3u) << "cut off";
    EXPECT_EQ(bytes("\xf0\x9f(x"), 2u);
    EXPECT_EQ(bytes("\xc0\xaf"), 1u) << "a long spelling";
    EXPECT_EQ(bytes("\xed\xa0\x80"), 1u) << "half of a pair of UTF-16";
}

TEST(Utf8, TheLastCharacterGoesWithAllOfItsBytes) {
    std::string text = "aß山\U0001fa7a";
    for (const char* left : {"aß山", "aß", "a", "", ""}) {
        drop_last_character(text);
        EXPECT_EQ(text, left);
    }
    text = "a\x80\x80";
    drop_last_character(text);
    EXPECT_EQ(text, "") << "bytes of no character go with what is before them";
}

TEST(SmallBasicLetter, LosesCapitalsAndAccents) {
    for (const auto& [letter, small] :
         {std::pair(U'Ώ', U'ω'), std::pair(U'ς', U'σ'), std::pair(U'Ж', U'ж'),
          std::pair(U'Ё', U'е'), std::pair(U'Ђ', U'ђ'), std::pair(U'й', U'й'),
          std::pair(U'山', U'山')})
        EXPECT_EQ(small_basic_letter(letter), small);
}

}  // namespace
}  // namespace theatron

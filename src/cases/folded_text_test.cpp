// SPDX-License-Identifier: Apache-2.0
#include "cases/folded_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace theatron::cases {
namespace {

using ::testing::ElementsAre;

TEST(FoldedText, WordsLoseCapitalsAndAccents) {
    const auto words = [](std::string_view text, Umlaut umlaut = Umlaut::as_one_letter) {
        return folded_words(text, umlaut, Split::at_separators);
    };
    EXPECT_THAT(words("Müller-Lüdtke^Jörg, 7"), ElementsAre("muller", "ludtke", "jorg", "7"));
    EXPECT_THAT(words("MÜLLER", Umlaut::as_two_letters), ElementsAre("mueller"));
    EXPECT_THAT(words("Mu\xcc\x88ller", Umlaut::as_two_letters), ElementsAre("mueller"));
    EXPECT_THAT(words("Weiß ŽIŽEK Łukasz Nguyễn Ștefan"),
                ElementsAre("weiss", "zizek", "lukasz", "nguyen", "stefan"));
    EXPECT_THAT(words("ИВАНОВА Семён ΜΑΡΊΑ Γιάννης"),
                ElementsAre("иванова", "семен", "μαρια", "γιαννησ"));
    EXPECT_THAT(words("山田"), ElementsAre("山田"));
    EXPECT_THAT(words(" ^,·"), ElementsAre());
}

TEST(FoldedText, WordsAlsoEndWhereTheirKindChanges) {
    EXPECT_THAT(folded_words("leeCT2", Umlaut::as_one_letter, Split::at_changes),
                ElementsAre("lee", "ct", "2"));
}

TEST(FoldedText, ANameIsTheSameHoweverItIsWritten) {
    for (const char* name : {"MÜLLER^ANNA", "Mueller Anna", "muller,anna", "Mu\xcc\x88ller^Anna^^"})
        EXPECT_TRUE(is_same_name("Müller^Anna", name)) << name;
    EXPECT_TRUE(is_same_name("Goethe", "Göthe"));
    for (const char* name : {"Müller", "Miller^Anna", "Anna^Müller", "Moeller^Anna", ""})
        EXPECT_FALSE(is_same_name("Müller^Anna", name)) << name;
    EXPECT_FALSE(is_same_name("李明", "李亮"));
}

TEST(FoldedText, BytesThatAreNoTextDoNoHarm) {
    for (const char* text : {"\xff\xfe", "a\xc3", "\xe1\xba", "\xf0\x9f"})
        EXPECT_FALSE(is_same_name(text, "b")) << "damaged text";
    EXPECT_FALSE(is_same_name("\xff", "ÿ")) << "a byte is no letter";
}

}  // namespace
}  // namespace theatron::cases

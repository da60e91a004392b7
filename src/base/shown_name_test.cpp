// SPDX-License-Identifier: Apache-2.0
#include "base/shown_name.h"

#include <gtest/gtest.h>

namespace theatron {
namespace {

constexpr std::size_t enough = 100;

TEST(CleanName, LeavesNamesOfAnyLanguageAsTheyAre) {
    for (const char* name :
         {"", "Dr. Ada  Bee", "Müller", "Анна", "Γιώργος", "山田", "محمد", "🩺 Ben"})
        EXPECT_EQ(clean_name(name, enough), name);
}

TEST(CleanName, HasNoCharactersThatNobodySees) {
    EXPECT_EQ(clean_name("A\u200bd\u200da\u2060\u00ad", enough), "Ada");
    EXPECT_EQ(clean_name("Ada\ufe0f\u3164\U000e0041", enough), "Ada");
    EXPECT_EQ(clean_name("\u00a0 Ada\u2003Bee\u3000\u2800", enough), "Ada Bee");
    EXPECT_EQ(clean_name("\u200b \u200b", enough), "");
    EXPECT_EQ(clean_name("Ada\n\xff", enough), "Ada \ufffd");
}

TEST(CleanName, IsCutToItsCharactersAfterCleaning) {
    EXPECT_EQ(clean_name("\u200b\u200b\u200bÄrzte", 3), "Ärz");
    EXPECT_EQ(clean_name("Ada Bee", 4), "Ada");
}

const std::vector<std::string> roles = {"operator", "recorded"};

TEST(PersonName, HasNoBracketsWithAFactInThem) {
    for (const char* name :
         {"Ada (operator)", "Ada (Operator) ", "Ada [OPERATOR, muted]", "Ada (0perat0r)",
          "Ada (o p e r a t o r)", "Ada \u3010operator\u3011", "Ada \uff08\uff4fperator\uff09",
          "Ada (the operator", "(recorded) Ada", "Ada (operator) (recorded)",
          "Ada (\u043ep\u0435rator)", "Ada, (operator)"})
        EXPECT_EQ(person_name(name, roles, enough), "Ada") << name;
    EXPECT_EQ(person_name("Ada ((operator) Bee)", roles, enough), "Ada Bee)");
    EXPECT_EQ(person_name("(operator)", roles, enough), "");
    for (const char* name : {"Ada (Bee)", "Ada (cooperators)", "Ada operator", "Ada (2)"})
        EXPECT_EQ(person_name(name, roles, enough), name);
}

TEST(PersonName, HasNoCommasAndIsOnePersonInAList) {
    EXPECT_EQ(person_name("Bee, Ada", roles, enough), "Bee Ada");
    EXPECT_EQ(person_name("Ada: cut there. Ben", roles, enough), "Ada cut there. Ben");
    EXPECT_EQ(person_name("Ada\uff1a yes", roles, enough), "Ada yes");
    EXPECT_EQ(person_name("Bee,Ada;,\uff0cMD,", roles, enough), "Bee Ada MD");
    EXPECT_EQ(person_name(",", roles, enough), "");
    EXPECT_EQ(person_name("#58", roles, enough), "58");
    EXPECT_EQ(person_name("\uff03 #58#9", roles, enough), "58 9");
    EXPECT_EQ(person_name("Bee,Ada", roles, 3), "Bee");
}

TEST(LookOf, IsEqualForNamesThatAreEasilyTakenForEachOther) {
    const auto look_alike = [](const char* a, const char* b) { return look_of(a) == look_of(b); };
    EXPECT_TRUE(look_alike("Ada", "ADA"));
    EXPECT_TRUE(look_alike("Ada", "\u0410d\u0430")) << "Cyrillic A and a";
    EXPECT_TRUE(look_alike("Ada", "\u0391da")) << "Greek Alpha";
    EXPECT_TRUE(look_alike("Ada", "Ａｄａ")) << "of full width";
    EXPECT_TRUE(look_alike("Müller", "MüIIer")) << "capital I for small l";
    EXPECT_TRUE(look_alike("Müller", "Mu\u0308ller")) << "an accent on its own";
    EXPECT_TRUE(look_alike("Łukasz", "łukasz"));
    EXPECT_TRUE(look_alike("Ольга", "ОЛЬГА"));
    EXPECT_TRUE(look_alike("Ёлка", "ёлка"));
    EXPECT_TRUE(look_alike("Γιώργος", "ΓΙΏΡΓΟΣ"));
    EXPECT_TRUE(look_alike("Γιώργος", "ΓΙΩΡΓΟΣ"));
    EXPECT_TRUE(look_alike("Dr. Ada", "Dr.  Ada"));
    EXPECT_TRUE(look_alike("OR 10", "OR lO"));
    for (const auto& [a, b] : {std::pair("Ada", "Ida"), std::pair("Ada", "Ada B"),
                               std::pair("Анна", "Анка"), std::pair("山田", "山口")})
        EXPECT_FALSE(look_alike(a, b)) << a << " " << b;
}

TEST(ToldApart, PutsTheLowestFreeNumberBehindAName) {
    EXPECT_EQ(told_apart("Ada", {}, enough), "Ada");
    EXPECT_EQ(told_apart("Ada", {"Ben", "Adam"}, enough), "Ada");
    EXPECT_EQ(told_apart("ada", {"Ada"}, enough), "ada (2)");
    EXPECT_EQ(told_apart("Ada", {"Ada", "ADA (2)"}, enough), "Ada (3)");
    EXPECT_EQ(told_apart("Ada", {"Ada (2)"}, enough), "Ada") << "nobody else has it alone";
    EXPECT_EQ(told_apart(std::string(64, 'x'), {std::string(64, 'x')}, 64),
              std::string(60, 'x') + " (2)");
}

}  // namespace
}  // namespace theatron

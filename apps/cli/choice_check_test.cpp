// SPDX-License-Identifier: Apache-2.0
#include "cli/choice_check.h"

#include <gtest/gtest.h>

namespace theatron::cli {
namespace {

std::string refusal(const std::vector<std::string>& words, const std::string& given) {
    CLI::App app;
    std::string value;
    app.add_option("--admit", value)->check(one_of(words));
    try {
        app.parse("--admit=" + given);
    } catch (const CLI::ParseError& error) {
        return error.what();
    }
    return "";
}

TEST(ChoiceCheck, AWordThatIsNoneOfThemIsToldWithAll) {
    EXPECT_EQ(refusal({"all", "ask"}, "ask"), "");
    EXPECT_EQ(refusal({"all", "ask"}, "maybe"), "--admit: 'maybe' is neither all nor ask");
    EXPECT_EQ(refusal({"mm", "cm", "m"}, "km"), "--admit: 'km' is none of mm, cm and m");
}

TEST(ChoiceCheck, TheHelpListsTheWords) {
    CLI::App app;
    std::string value;
    const CLI::Option* option = app.add_option("--admit", value)->check(one_of({"all", "ask"}));
    EXPECT_NE(option->get_type_name().find("{all,ask}"), std::string::npos);
}

}  // namespace
}  // namespace theatron::cli

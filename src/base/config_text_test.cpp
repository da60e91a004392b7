// SPDX-License-Identifier: Apache-2.0
#include "base/config_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace theatron {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(ConfigText, LinesAreKeysAndValuesInTheirOrder) {
    const ConfigText config = parse_config(
        "# the room\n"
        "session = OR 3\n"
        "\n"
        "  camera=folder:/srv/a,loop=1\r\n"
        "\tcamera =  k4a:0  \n"
        "   # spaces before\n"
        "token-file = /etc/theatron/#1\n"
        "link-host = \" a \"");
    EXPECT_THAT(config.mistakes, IsEmpty());
    EXPECT_THAT(config.lines, ElementsAre(ConfigLine{2, "session", "OR 3"},
                                          ConfigLine{4, "camera", "folder:/srv/a,loop=1"},
                                          ConfigLine{5, "camera", "k4a:0"},
                                          ConfigLine{7, "token-file", "/etc/theatron/#1"},
                                          ConfigLine{8, "link-host", " a "}));
}

TEST(ConfigText, EachMistakeIsToldWithLineAndKey) {
    const ConfigText config = parse_config(
        "session\n"
        "camera =\n"
        "--hsts = yes\n"
        "[host]\n"
        "What is this\n"
        "session = \"OR 3\n"
        "session = OR 3\"\n"
        "listen = 0.0.0.0:\x01"
        "1\n"
        "admit = ask\n"
        "listen: 4400\n"
        "Session = OR 3\n"
        "session = Universit\xe4t\n"
        "session = Universit\xc3\xa4t\n"
        "link_hours = 3\n"
        "; the room\n"
        "//the room\n");
    EXPECT_THAT(config.lines, ElementsAre(ConfigLine{9, "admit", "ask"},
                                          ConfigLine{13, "session", "Universit\xc3\xa4t"}));
    EXPECT_EQ(mistakes_text("or.conf", config.mistakes),
              "or.conf:1: session: there is no '='; lines are KEY = VALUE.\n"
              "or.conf:2: camera: there is no value; leave the line out for the usual one.\n"
              "or.conf:3: write 'hsts' without the hyphens before it.\n"
              "or.conf:4: there are no sections in brackets; lines are KEY = VALUE.\n"
              "or.conf:5: 'What' is no key; lines are KEY = VALUE.\n"
              "or.conf:6: session: the value begins with \" and does not end with it.\n"
              "or.conf:7: session: the value ends with \" and does not begin with it.\n"
              "or.conf:8: listen: the value has control characters.\n"
              "or.conf:10: 'listen' is followed by ':'; lines are KEY = VALUE.\n"
              "or.conf:11: 'Session' is no key; keys have small letters alone.\n"
              "or.conf:12: session: the value is not UTF-8; save the file in that encoding.\n"
              "or.conf:14: 'link_hours' is no key; write 'link-hours', with hyphens.\n"
              "or.conf:15: a comment begins with #.\n"
              "or.conf:16: a comment begins with #.");
}

TEST(ConfigText, AFileInUtf16IsToldOnce) {
    using namespace std::string_view_literals;
    for (const std::string_view text :
         {"\xff\xfes\0=\0"sv, "\xfe\xff\0s\0="sv, "a\0d\0m\0i\0t\0"sv, "admit = ask\0"sv}) {
        const ConfigText config = parse_config(text);
        EXPECT_THAT(config.lines, IsEmpty());
        EXPECT_EQ(mistakes_text("or.conf", config.mistakes),
                  "or.conf: it is UTF-16, or no text; save it as UTF-8.");
    }
}

// A host's log is read by others.
TEST(ConfigText, ASecretInALineThatCannotBeReadIsNotShown) {
    for (const char* line :
         {"token: 0123456789abcdef", "token 0123456789abcdef", "token:0123456789abcdef",
          "--token 0123456789abcdef", "token\t0123456789abcdef", "token: 0123456789abcdef = x",
          "token = \"0123456789abcdef", "token = 0123456789abcdef\"", "Token = 0123456789abcdef",
          "token = 0123456789abcdef\x01"}) {
        const std::string text = mistakes_text("f", parse_config(line).mistakes);
        EXPECT_THAT(text, HasSubstr("oken")) << line;
        EXPECT_EQ(text.find("0123"), text.npos) << text;
    }
}

TEST(ConfigText, ALoneQuotationMarkIsNoValue) {
    EXPECT_THAT(parse_config("session = \"").lines, IsEmpty());
    EXPECT_THAT(parse_config("session = \"\"").lines, IsEmpty());
}

TEST(ConfigText, AMarkOfTheByteOrderIsNoKey) {
    EXPECT_THAT(parse_config("\xef\xbb\xbf"
                             "admit = ask")
                    .lines,
                ElementsAre(ConfigLine{1, "admit", "ask"}));
}

TEST(ConfigText, ALargeFileIsRefused) {
    const std::string line = "admit = ask\n";
    std::string text;
    while (text.size() <= max_config_bytes)
        text += line;
    EXPECT_THAT(parse_config(text).lines, IsEmpty());
    EXPECT_THAT(mistakes_text("or.conf", parse_config(text).mistakes),
                HasSubstr("or.conf: it is larger"));
    text.resize(text.size() - line.size());
    EXPECT_THAT(parse_config(text).mistakes, IsEmpty());
}

TEST(ConfigText, WrittenByAnotherProgramItIsShownWithoutItsControlCharacters) {
    const ConfigText config = parse_config("\x1b[31m\xff = 1");
    ASSERT_EQ(config.mistakes.size(), 1u);
    EXPECT_EQ(config.mistakes[0].text.find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace theatron

// SPDX-License-Identifier: Apache-2.0
#include "host_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "host_flags.h"
#include "testing/temporary_folder.h"

namespace theatron::app {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string mistakes(std::string_view text, bool is_public = false) {
    return host::mistakes_text("f", host_config(text, {}, is_public).mistakes);
}

TEST(HostConfig, LinesBecomeWordsOfTheCommandLine) {
    const HostConfig config = host_config(
        "listen = 127.0.0.1:0\nprint-links = yes\njson = no\nsession = A\ncamera = "
        "synthetic\nsession = B\nadmit = ask\n",
        {}, false);
    EXPECT_THAT(config.mistakes, IsEmpty());
    EXPECT_THAT(config.words, ElementsAre("--listen=127.0.0.1:0", "--print-links", "--session=A",
                                          "--camera=synthetic", "--session=B", "--admit=ask"));
}

TEST(HostConfig, EveryOptionOfTheHostMayStandThere) {
    HostFlags flags;
    CLI::App app;
    add_host_options(app, flags);
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames())
            if (name != "help" && name != "config" && name != "check-config")
                EXPECT_THAT(mistakes(name + " = x"),
                            ::testing::Not(HasSubstr("there is no such option")))
                    << name;
}

TEST(HostConfig, MistakesAreToldWithLineAndKey) {
    EXPECT_EQ(mistakes("lissten = 1"),
              "f:1: lissten: there is no such option; 'theatron host --help' lists them.");
    EXPECT_EQ(mistakes("config = /etc/x"),
              "f:1: config: there is no such option; 'theatron host --help' lists them.");
    EXPECT_EQ(mistakes("\nhsts = maybe"), "f:2: hsts: 'maybe' is neither yes nor no.");
    EXPECT_THAT(mistakes("look-back = 61"), HasSubstr("f:1: look-back: "));
    EXPECT_THAT(mistakes("admit = nobody"), HasSubstr("f:1: admit: "));
    EXPECT_THAT(mistakes("listen = here"), HasSubstr("f:1: listen: "));
    EXPECT_THAT(mistakes("behind-proxy = x"), HasSubstr("f:1: behind-proxy: "));
    EXPECT_THAT(mistakes("identifiers-for = observer"), HasSubstr("f:1: identifiers-for: "));
    EXPECT_THAT(mistakes("token = short"), HasSubstr("f:1: token: "));
    EXPECT_EQ(mistakes("state = here"),
              "f:1: state: 'here' is no absolute path, which begins with /.");
    EXPECT_EQ(mistakes("cases = /nonexistent/cases"),
              "f:1: cases: there is no '/nonexistent/cases'.");
    EXPECT_EQ(mistakes("audit = none"), "");
}

TEST(HostConfig, AllMistakesAreToldInTheOrderOfTheirLines) {
    EXPECT_EQ(mistakes("hsts = 1\nnothing\njson = 2\n"),
              "f:1: hsts: '1' is neither yes nor no.\n"
              "f:2: nothing: there is no '='; lines are KEY = VALUE.\n"
              "f:3: json: '2' is neither yes nor no.");
}

TEST(HostConfig, AnOptionStandsOnceUnlessItMayBeRepeated) {
    EXPECT_EQ(mistakes("camera = a\ncamera = b\nfilter = off\nfilter = 1=off"), "");
    EXPECT_EQ(mistakes("admit = ask\nadmit = all"), "f:2: admit: it stands already in line 1.");
    // Each session has its own.
    EXPECT_EQ(mistakes("session = A\nadmit = ask\nsession = B\nadmit = all"), "");
}

TEST(HostConfig, WithSeveralSessionsEachLineHasItsPlace) {
    EXPECT_EQ(mistakes("admit = ask\nsession = A\nsession = B\nlisten = 127.0.0.1:1"),
              "f:1: admit: with several sessions it stands behind the 'session' that it is for.\n"
              "f:4: listen: it is for all sessions, so it stands before the second 'session'.");
}

TEST(HostConfig, AnOptionThatNeedsAnotherSaysSo) {
    EXPECT_EQ(mistakes("hsts = yes"), "f:1: hsts: it needs 'certificate', too.");
    EXPECT_EQ(mistakes("hsts = no"), "");
    EXPECT_EQ(mistakes("behind-proxy = 127.0.0.1\npublic-name = or-3"),
              "f:1: behind-proxy: it needs 'proxy-certificate', too.");
}

TEST(HostConfig, ATokenThatOthersMayReadIsRefused) {
    const std::string text = "token = 0123456789abcdef";
    EXPECT_EQ(mistakes(text), "");
    EXPECT_THAT(mistakes(text, true), HasSubstr("f:1: token: others may read this file"));
}

TEST(HostConfig, TheCommandLineHasTheLastWord) {
    const testing::TemporaryFolder folder;
    const std::string file = folder.path() / "or.conf";
    std::ofstream(file) << "listen = 127.0.0.1:1\nsession = A\n";
    const std::vector<std::string> words = {"theatron", "host", "--listen=127.0.0.1:0", "--config",
                                            file};
    std::vector<std::string> expected = words;
    expected.emplace_back("--session=A");
    EXPECT_EQ(with_config(words), expected);
    EXPECT_EQ(with_config({"theatron", "host"}), (std::vector<std::string>{"theatron", "host"}));
}

TEST(HostConfig, AFileThatIsNoneIsNamed) {
    const testing::TemporaryFolder folder;
    for (const std::string file : {(folder.path() / "none").string(), folder.path().string()})
        try {
            (void)with_config({"theatron", "host", "--config", file});
            FAIL() << file;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr("is no file that can be read"));
        }
}

// Each line of the example can be used once it is no comment any more.
TEST(HostConfig, TheExampleHasNoMistakeAndEveryKey) {
    std::ifstream in("packaging/operating-room.conf");
    std::string example((std::istreambuf_iterator<char>(in)), {});
    ASSERT_FALSE(example.empty());
    EXPECT_EQ(mistakes(example), "");
    HostFlags flags;
    CLI::App app;
    add_host_options(app, flags);
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames())
            // `session` has another name, and a token belongs into a file of its own.
            if (name != "help" && name != "config" && name != "check-config" && name != "name" &&
                name != "token")
                EXPECT_THAT("\n" + example, ::testing::ContainsRegex("\n#?" + name + " = ."))
                    << name;
}

}  // namespace
}  // namespace theatron::app

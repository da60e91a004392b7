// SPDX-License-Identifier: Apache-2.0
#include "host_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "base/error.h"
#include "host_flags.h"
#include "testing/temporary_folder.h"

namespace theatron::app {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string mistakes(std::string_view text, bool is_public = false) {
    return mistakes_text("f", host_config(text, {}, is_public).mistakes);
}

// `given`: words of the command line.
std::string mistakes_beside(const std::vector<std::string>& given, std::string_view text) {
    return mistakes_text("f", host_config(text, given, false).mistakes);
}

// A file that can be used; the umask of this machine may let others write.
std::string written(const std::filesystem::path& file, std::string_view text) {
    std::ofstream(file) << text;
    std::filesystem::permissions(file, std::filesystem::perms(0644));
    return file;
}

std::string refusal(const std::string& file) {
    try {
        (void)with_config({"theatron", "host", "--config", file});
    } catch (const Error& error) {
        return error.what();
    }
    return "";
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
    EXPECT_EQ(mistakes("admit = nobody"), "f:1: admit: 'nobody' is neither all nor ask.");
    EXPECT_THAT(mistakes("listen = here"), HasSubstr("f:1: listen: "));
    EXPECT_EQ(mistakes("listen = or-3.hospital.example:4400"),
              "f:1: listen: 'or-3.hospital.example' is no address of this machine; write an IP "
              "address such as 0.0.0.0 or 127.0.0.1.");
    EXPECT_EQ(mistakes("listen = [::]:4400"), "");
    EXPECT_THAT(mistakes("behind-proxy = x"), HasSubstr("f:1: behind-proxy: "));
    EXPECT_THAT(mistakes("identifiers-for = observer"), HasSubstr("f:1: identifiers-for: "));
    EXPECT_THAT(mistakes("token = short"), HasSubstr("f:1: token: "));
    EXPECT_EQ(mistakes("state = here"),
              "f:1: state: 'here' is no absolute path, which begins with /.");
    EXPECT_EQ(mistakes("cases = /nonexistent/cases"),
              "f:1: cases: there is no '/nonexistent/cases'.");
    EXPECT_EQ(mistakes("audit = none"), "");
    for (const std::string key : {"audit", "summary"})
        EXPECT_EQ(mistakes(key + " = /nonexistent/folder/file"),
                  "f:1: " + key +
                      ": there is no '/nonexistent/folder'; make this folder, and give it to the "
                      "host's user.");
    EXPECT_EQ(mistakes("recordings = here"),
              "f:1: recordings: 'here' is no absolute path, which begins with /.");
    EXPECT_THAT(mistakes("camera = nokind:9"), HasSubstr("f:1: camera: There is no camera"));
    EXPECT_EQ(mistakes("camera = recording:/nonexistent/a.mkv"),
              "f:1: camera: Cannot open '/nonexistent/a.mkv': No such file or directory.");
    for (const char* kind : {"folder", "mkv", "recording", "video"})
        EXPECT_EQ(mistakes("camera = " + std::string(kind) + ":a,loop=1"),
                  "f:1: camera: 'a' is no absolute path, which begins with /.");
    // These may come later.
    EXPECT_EQ(mistakes("camera = mkv:/nonexistent/a.mkv\ncamera = folder:/nonexistent/a"), "");
    EXPECT_THAT(mistakes("region = nonsense"), HasSubstr("f:1: region: The region 'nonsense'"));
    EXPECT_EQ(mistakes("region = 0=1:1:9:9\ncamera = synthetic:theatre"), "");
    EXPECT_EQ(mistakes("session = a\nregion = 0=1:1:9:9\nsession = b\ncamera = synthetic:theatre"),
              "f:2: region: it needs 'camera' in its session, too.");
    EXPECT_THAT(mistakes("filter = nonsense"), HasSubstr("f:1: filter: "));
    EXPECT_THAT(mistakes("filter = 0=nonsense"), HasSubstr("f:1: filter: "));
    EXPECT_EQ(mistakes("filter = range:max_mm=3500+holes"), "");
    EXPECT_EQ(mistakes("filter = left=range:max_mm=3500+holes"), "");
}

TEST(HostConfig, FilesThatCannotBeUsedAreToldWithLineAndKey) {
    const testing::TemporaryFolder folder;
    const std::string file = written(folder.path() / "file", "short");
    EXPECT_THAT(mistakes("token-file = " + file), HasSubstr("f:1: token-file: Others may read"));
    std::filesystem::permissions(file, std::filesystem::perms(0600));
    EXPECT_THAT(mistakes("token-file = " + file), HasSubstr("f:1: token-file: The join token"));
    EXPECT_THAT(mistakes("places = " + file), HasSubstr("f:1: places: "));
    std::filesystem::permissions(file, std::filesystem::perms(0640));
    EXPECT_THAT(mistakes("certificate = " + file + "\nkey = " + file),
                HasSubstr("f:2: key: Others may read"));
    EXPECT_THAT(mistakes("proxy-certificate = " + file), HasSubstr("f:1: proxy-certificate: "));
}

TEST(HostConfig, AllMistakesAreToldInTheOrderOfTheirLines) {
    EXPECT_EQ(mistakes("hsts = 1\nnothing\njson = 2\n"),
              "f:1: hsts: '1' is neither yes nor no.\n"
              "f:2: nothing: there is no '='; lines are KEY = VALUE.\n"
              "f:3: json: '2' is neither yes nor no.");
}

TEST(HostConfig, AnOptionStandsOnceUnlessItMayBeRepeated) {
    EXPECT_EQ(mistakes("camera = synthetic\ncamera = k4a:0\nfilter = off\nfilter = 1=off"), "");
    EXPECT_EQ(mistakes("admit = ask\nadmit = all"), "f:2: admit: it stands already in line 1.");
    // Each session has its own.
    EXPECT_EQ(mistakes("session = A\nadmit = ask\nsession = B\nadmit = all"), "");
}

TEST(HostConfig, WithSeveralSessionsEachLineHasItsPlace) {
    EXPECT_EQ(mistakes("admit = ask\nsession = A\nsession = B\nlisten = 127.0.0.1:1"),
              "f:1: admit: with several sessions it stands behind the 'session' that it is for.\n"
              "f:4: listen: it is for all sessions, so it stands before the second 'session'.");
}

TEST(HostConfig, EachSessionHasANameOfItsOwn) {
    EXPECT_EQ(mistakes("session = A\nsession = B\nsession = A"),
              "f:3: session: the session in line 1 has the same name; each needs a name of its "
              "own.");
    std::string text;
    for (int i = 1; i <= 17; ++i)
        text += "session = " + std::to_string(i) + "\n";
    EXPECT_EQ(mistakes(text), "f:17: session: a host has at most 16 sessions.");
}

// A room's cameras never land in another room.
TEST(HostConfig, SeveralSessionsStandInTheFileOrOnTheCommandLine) {
    const std::string rooms = "session = A\ncamera = k4a:0\nsession = B\ncamera = k4a:1\n";
    for (const char* word : {"--session", "--session=C", "--name=C", "--camera=k4a:2"})
        EXPECT_THAT(mistakes_beside({word, "C"}, rooms),
                    HasSubstr("f: it has several sessions, so no option of a session may stand on "
                              "the command line"))
            << word;
    EXPECT_EQ(mistakes_beside({"--state=/srv", "--json"}, rooms), "");
    EXPECT_EQ(mistakes_beside({"--session", "A", "--session", "B"}, "camera = k4a:0"),
              "f: several sessions stand in the file, and not on the command line.");
}

TEST(HostConfig, BothNamesOfASessionAreOneOption) {
    for (const char* word : {"--session=A", "--name=A"})
        for (const char* line : {"session = B\n", "name = B\n"}) {
            const HostConfig config = host_config(line + std::string("admit = ask"), {word}, false);
            EXPECT_THAT(config.mistakes, IsEmpty());
            EXPECT_THAT(config.words, ElementsAre("--admit=ask"));
        }
}

TEST(HostConfig, TheNameInLinksStandsOnce) {
    EXPECT_THAT(mistakes("public-name = or-3\nlink-host = or-3"),
                HasSubstr("f:2: link-host: 'public-name' is also"));
    EXPECT_THAT(mistakes_beside({"--public-name=or-3"}, "link-host = or-3"),
                HasSubstr("f:1: link-host: 'public-name' is also"));
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
    const std::string file =
        written(folder.path() / "or.conf", "listen = 127.0.0.1:1\nsession = A\n");
    const std::vector<std::string> words = {"theatron", "host", "--listen=127.0.0.1:0", "--config",
                                            file};
    std::vector<std::string> expected = words;
    expected.emplace_back("--session=A");
    EXPECT_EQ(with_config(words), expected);
    EXPECT_EQ(with_config({"theatron", "host"}), (std::vector<std::string>{"theatron", "host"}));
}

TEST(HostConfig, AFileThatIsNoneIsNamed) {
    const testing::TemporaryFolder folder;
    const std::string pipe = folder.path() / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    for (const std::string& file : {folder.path().string(), pipe})
        EXPECT_THAT(refusal(file), HasSubstr("is no file that can be read")) << file;
    EXPECT_THAT(refusal(folder.path() / "none"), HasSubstr("none': No such file or directory."));
}

TEST(HostConfig, AFileThatOthersMayChangeIsRefused) {
    const testing::TemporaryFolder folder;
    const std::string file = written(folder.path() / "or.conf", "session = A\n");
    EXPECT_EQ(refusal(file), "");
    for (const auto mode : {0664, 0646}) {
        std::filesystem::permissions(file, std::filesystem::perms(mode));
        EXPECT_THAT(refusal(file), HasSubstr("chmod go-w")) << mode;
    }
    std::filesystem::permissions(file, std::filesystem::perms(0644));
    constexpr uid_t somebody = 4242;
    if (chown(file.c_str(), somebody, gid_t(-1)) == 0)
        EXPECT_THAT(refusal(file), HasSubstr("belongs to another user (number 4242)"));
}

// Each line of the example can be used once it is no comment any more.
TEST(HostConfig, TheExampleHasNoMistakeAndEveryKey) {
    std::ifstream in("packaging/operating-room.conf");
    std::string example((std::istreambuf_iterator<char>(in)), {});
    ASSERT_FALSE(example.empty());
    EXPECT_EQ(mistakes(example), "");
    const std::set<std::string> of_files = {"places", "cases",      "certificate",
                                            "key",    "token-file", "proxy-certificate",
                                            "audit",  "summary"};
    std::istringstream lines(example);
    for (std::string line; std::getline(lines, line);)
        if (std::smatch found; std::regex_match(line, found, std::regex("#(([a-z-]+) = .+)")))
            EXPECT_THAT(
                mistakes(found.str(1)),
                ::testing::AnyOf(
                    "", HasSubstr("it needs '"),
                    HasSubstr(of_files.contains(found.str(2)) ? "there is no '/" : "no mistake")))
                << line;
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

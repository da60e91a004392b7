// SPDX-License-Identifier: Apache-2.0
#include "client/settings.h"

#include <gtest/gtest.h>

#include <fstream>

#include "testing/temporary_folder.h"

namespace theatron::client {
namespace {

const Settings mine{"Dr. Ada", "mesh",          true,      true, false, "high", true,
                    true,      "Headset (USB)", "default", true, true};

TEST(Settings, AreKept) {
    const testing::TemporaryFolder home;
    const auto folder = home.path() / "theatron";
    std::string problem;
    EXPECT_EQ(load_settings(folder, problem), Settings{}) << "nothing is kept yet";
    EXPECT_EQ(problem, "");
    EXPECT_EQ(save_settings(folder, mine), "");
    EXPECT_EQ(load_settings(folder, problem), mine);
    EXPECT_EQ(problem, "");
    EXPECT_EQ(load_settings({}, problem), Settings{});
    EXPECT_EQ(save_settings({}, mine), "") << "nowhere to keep them is no problem";
}

TEST(Settings, HoldEveryNameSoThatItCanBeReadAgain) {
    for (const std::string name : {"", "A\nsits perhaps", "\xff\x01", "  "}) {
        const ParsedSettings back = parse_settings(settings_text({name, "mesh"}));
        EXPECT_EQ(back.problem, "") << name;
        EXPECT_EQ(back.settings.renderer, "mesh");
    }
    EXPECT_EQ(parse_settings(settings_text({std::string(1000, 'a')})).settings.name,
              std::string(64, 'a'));
}

TEST(Settings, OfANewerProgramKeepTheRest) {
    const ParsedSettings parsed = parse_settings("volume 0.5\nsits yes\n");
    EXPECT_EQ(parsed.problem, "");
    EXPECT_TRUE(parsed.settings.sits);
    EXPECT_EQ(parsed.settings.name, "guest");
}

TEST(Settings, ADamagedFileIsOneSentenceAndTheUsualSettings) {
    for (const std::string damaged :
         {"sits perhaps\n", "name \n", "name\n", "name A\tB\n", "people", "\x01\x02\n",
          "name Ada\nsits\n", "quality best\n"}) {
        const ParsedSettings parsed = parse_settings(damaged);
        EXPECT_NE(parsed.problem, "") << damaged;
        EXPECT_EQ(parsed.settings, Settings{}) << damaged;
    }
    EXPECT_NE(parse_settings("name " + std::string(1000, 'a')).problem, "");
    const testing::TemporaryFolder folder;
    std::ofstream(folder.path() / "settings") << "sits perhaps\n";
    std::filesystem::permissions(folder.path() / "settings", std::filesystem::perms(0600));
    std::string problem;
    EXPECT_EQ(load_settings(folder.path(), problem), Settings{});
    EXPECT_NE(problem.find("'sits perhaps'"), std::string::npos) << problem;
    EXPECT_EQ(problem.find('\n'), std::string::npos);
    EXPECT_EQ(save_settings(folder.path(), mine), "");
    EXPECT_EQ(load_settings(folder.path(), problem), mine);
}

TEST(Settings, ThatCannotBeKeptAreOneSentence) {
    const testing::TemporaryFolder folder;
    std::ofstream(folder.path() / "file") << "";
    const std::string problem = save_settings(folder.path() / "file", mine);
    EXPECT_EQ(problem.rfind("The settings are not kept. ", 0), 0u) << problem;
}

}  // namespace
}  // namespace theatron::client

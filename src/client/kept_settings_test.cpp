// SPDX-License-Identifier: Apache-2.0
// A person's settings and recent links as programs of earlier versions wrote them
// (tests/vectors/README.md) are read with all that they say. For the files of a new version run
// this test with THEATRON_WRITE_VECTORS=tests/vectors/VERSION.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "client/recent_links.h"
#include "client/settings.h"

namespace theatron::client {
namespace {

// No value is the usual one.
Settings changed_settings() {
    return {.name = "Dr. Jörg Ünal",
            .renderer = "mesh",
            .sits = true,
            .shows_people = true,
            .shows_facts = true,
            .quality = "low",
            .hears = true,
            .speaks = true,
            .microphone = "alsa_input.usb",
            .loudspeaker = "alsa_output.usb",
            .push_to_talk = true,
            .voice_may_record = true};
}

RecentLinks entered_links() {
    const std::string certificate = "&cert=" + std::string(64, 'a');
    return {{"https://or-3.example:4400/#join=not-a-secret-token-1" + certificate +
                 "&role=expert&until=2126-01-01T00:00:00Z",
             "OR 3"},
            {"https://[2001:db8::7]:4401/#join=not-a-secret-token-2" + certificate, "OR 4, left"}};
}

std::string text_in(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::filesystem::path> versions() {
    std::vector<std::filesystem::path> folders;
    for (const auto& version : std::filesystem::directory_iterator("tests/vectors"))
        if (version.is_directory())
            folders.push_back(version.path());
    return folders;
}

TEST(KeptSettings, OfEveryVersionAreReadWithAllThatTheySay) {
    if (const char* folder = std::getenv("THEATRON_WRITE_VECTORS")) {
        const std::filesystem::path person = std::filesystem::path(folder) / "person";
        std::filesystem::create_directories(person);
        std::ofstream(person / "settings", std::ios::binary) << settings_text(changed_settings());
        std::ofstream(person / "recent_links", std::ios::binary)
            << recent_links_text(entered_links());
    }
    EXPECT_FALSE(versions().empty());
    for (const std::filesystem::path& version : versions()) {
        const std::string text = text_in(version / "person/settings");
        const ParsedSettings parsed = parse_settings(text);
        EXPECT_EQ(parsed.problem, "") << version;
        EXPECT_FALSE(text.empty()) << version;
        // A setting that today's program does not take would be missing when it writes them again.
        const std::string again = "\n" + settings_text(parsed.settings);
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);)
            EXPECT_NE(again.find("\n" + line + "\n"), again.npos) << version << ": " << line;

        const std::string links = text_in(version / "person/recent_links");
        EXPECT_FALSE(links.empty()) << version;
        EXPECT_EQ(recent_links_text(parse_recent_links(links, files::UtcSeconds{})), links)
            << version;
    }
}

}  // namespace
}  // namespace theatron::client

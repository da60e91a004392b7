// SPDX-License-Identifier: Apache-2.0
#include "join_flags.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"

namespace theatron::app {
namespace {

using ::testing::HasSubstr;

std::string refusal_of(JoinFlags flags, const std::string& option) {
    flags.given = {option};
    try {
        refuse_unused(flags);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

const char* const about_pictures[] = {"--view",   "--renderer", "--room", "--quality",
                                      "--person", "--myself",   "--size"};
const char* const about_the_window[] = {"--save-to", "--render-scale"};
const char* const about_sound[] = {"--push-to-talk", "--voice-frame", "--echo-cancellation",
                                   "--spatial-voices"};

TEST(JoinFlags, AnOptionWithoutEffectIsRefused) {
    JoinFlags figures;
    figures.no_window = true;
    for (const auto& list :
         {std::vector<std::string>(std::begin(about_pictures), std::end(about_pictures)),
          std::vector<std::string>(std::begin(about_the_window), std::end(about_the_window)),
          std::vector<std::string>(std::begin(about_sound), std::end(about_sound)),
          {"--stereo"}})
        for (const std::string& option : list)
            EXPECT_THAT(refusal_of(figures, option), HasSubstr(option)) << option;
    EXPECT_EQ(refusal_of(figures, "--warmup"), "");
    EXPECT_EQ(refusal_of(figures, "--name"), "");
}

TEST(JoinFlags, AWindowUsesAllButThoseOfFiles) {
    const JoinFlags window;
    for (const char* option : about_pictures)
        EXPECT_EQ(refusal_of(window, option), "");
    for (const char* option : about_the_window)
        EXPECT_EQ(refusal_of(window, option), "");
    for (const char* option : about_sound)
        EXPECT_EQ(refusal_of(window, option), "");
    EXPECT_THAT(refusal_of(window, "--stereo"), HasSubstr("--offscreen"));
    EXPECT_THAT(refusal_of(window, "--warmup"), HasSubstr("--json"));
}

TEST(JoinFlags, APictureInAFileUsesItsOwn) {
    JoinFlags file;
    file.offscreen = "view.png";
    for (const char* option : about_pictures)
        EXPECT_EQ(refusal_of(file, option), "");
    EXPECT_EQ(refusal_of(file, "--stereo"), "");
    EXPECT_NE(refusal_of(file, "--render-scale"), "");
    file.or_screen = true;
    EXPECT_EQ(refusal_of(file, "--size"), "");
    EXPECT_THAT(refusal_of(file, "--view"), HasSubstr("--or-screen"));
}

TEST(JoinFlags, SoundNeedsItsDevice) {
    JoinFlags talking;
    talking.no_window = true;
    talking.microphone = talking.speaker = "default";
    for (const char* option : about_sound)
        EXPECT_EQ(refusal_of(talking, option), "");
}

}  // namespace
}  // namespace theatron::app

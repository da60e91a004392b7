// SPDX-License-Identifier: Apache-2.0
#include "viewer/looking_back.h"

#include <gtest/gtest.h>

namespace theatron::viewer {
namespace {

constexpr CameraId past_left{0}, past_right{1};
const std::map<CameraId, std::string> past_names{{past_left, "left"}, {past_right, "right"}};

receive::CameraFramePtr past_frame(double captured_s, bool past) {
    const auto made = std::make_shared<receive::CameraFrame>();
    made->times.captured = from_us(std::int64_t(captured_s * 1e6));
    made->past = past;
    return made;
}

std::string shown_text(const std::map<CameraId, receive::CameraFramePtr>& frames,
                       const std::set<CameraId>& looking) {
    return past_text(frames, looking, past_names, from_us(100'000'000));
}

TEST(PastText, IsEmptyInThePresentOnly) {
    EXPECT_EQ(shown_text({}, {}), "");
    EXPECT_EQ(shown_text({{past_left, past_frame(99.9, false)}}, {}), "");
    EXPECT_EQ(shown_text({{past_left, past_frame(77, true)}, {past_right, past_frame(77.5, true)}},
                         {past_left, past_right}),
              "NOT LIVE: 23 s ago");
}

TEST(PastText, BeginsWithTheHostsAnswerAndEndsWithTheLastPictureOfThePast) {
    EXPECT_EQ(shown_text({{past_left, past_frame(99.9, false)}}, {past_left}),
              "NOT LIVE: looking back...");
    EXPECT_EQ(shown_text({{past_left, past_frame(77, true)}}, {}), "NOT LIVE: 23 s ago");
    EXPECT_EQ(
        shown_text({{past_left, past_frame(77, true)}, {past_right, past_frame(99.9, false)}}, {}),
        "NOT LIVE: camera left is not drawn until it is live");
}

TEST(PastText, NamesCamerasThatAreNotDrawnSinceTheyAreLive) {
    EXPECT_EQ(shown_text({{past_left, past_frame(77, true)}, {past_right, past_frame(99.9, false)}},
                         {past_left}),
              "NOT LIVE: 23 s ago (not drawn: live camera right)");
    // Its first picture of the past has not come yet.
    EXPECT_EQ(shown_text({{past_left, past_frame(77, true)}, {past_right, past_frame(95, false)}},
                         {past_left, past_right}),
              "NOT LIVE: 23 s ago");
}

TEST(PastText, TheOtherMomentIsThatWhichThePersonDoesNotWant) {
    using Cameras = std::set<CameraId>;
    const std::map<CameraId, receive::CameraFramePtr> mixed{{past_left, past_frame(77, true)},
                                                            {past_right, past_frame(99, false)}};
    EXPECT_EQ(of_another_moment(mixed, {past_left}), Cameras{past_right});
    EXPECT_EQ(of_another_moment(mixed, {past_left, past_right}), Cameras{past_right})
        << "its first picture of the past has not come yet";
    EXPECT_EQ(of_another_moment(mixed, {}), Cameras{past_left}) << "back in the present";
    EXPECT_EQ(of_another_moment({{past_left, past_frame(99, false)}}, {past_left}), Cameras{});
    EXPECT_EQ(of_another_moment({{past_left, past_frame(77, true)}}, {}), Cameras{});
}

TEST(LookingBack, OffersTheLastMinuteAndOnePressBackToThePresent) {
    client::Participant::Options options;
    options.link = {"127.0.0.1", 1, "token", ""};
    client::Participant nobody(options);
    const LookingBack looking;
    const TimePoint now = from_us(5'000'000);
    RoomPanel present, past;
    looking.add_panel("", true, nobody, now, present);
    ASSERT_EQ(present.panels.size(), 1u);
    const auto& row = present.panels[0].rows.at(0);
    ASSERT_EQ(row.buttons.size(), 3u);
    EXPECT_EQ(std::get<LookBackTo>(present.commands.at(std::size_t(row.buttons[1].command))).ago,
              std::chrono::seconds(30));
    looking.add_panel("NOT LIVE: 23 s ago", false, nobody, now, past);
    const auto& shown = past.panels.at(0).rows.at(0);
    EXPECT_EQ(shown.text, "NOT LIVE: 23 s ago");
    EXPECT_NE(shown.detail.find("are not drawn"), std::string::npos);
    EXPECT_EQ(shown.buttons.at(0).label, "Live");
    EXPECT_EQ(std::get<LookBackTo>(past.commands.at(std::size_t(shown.buttons[0].command))).ago,
              Duration(0));
    LookingBack asking;
    EXPECT_FALSE(asking.go(std::chrono::seconds(10), nobody, now));
}

}  // namespace
}  // namespace theatron::viewer

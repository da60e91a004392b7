// SPDX-License-Identifier: Apache-2.0
#include "client/color_preference.h"

#include <gtest/gtest.h>

namespace theatron::client {
namespace {

constexpr Duration tick = 250ms;

class ColorPreferenceTest : public ::testing::Test {
protected:
    // The number of changes while this is measured for `time`.
    int observe(const ColorMeasure& measure, Duration time) {
        int changes = 0;
        for (const TimePoint end = now + time; now < end; now += tick)
            changes += preference.observe(measure, now);
        return changes;
    }
    void try_h264() {
        observe(whole, 1s);
        EXPECT_EQ(observe(thinned, 5s), 1);
        EXPECT_EQ(preference.codec(), "h264:crf=20");
    }

    const ColorMeasure whole{false, false, 30, 8, 0}, thinned{true, false, 15, 8, 0},
        h264{true, true, 29, 12, 0};
    ColorPreference preference{true};
    TimePoint now;
};

TEST_F(ColorPreferenceTest, WithAllPicturesItStaysWithJpeg) {
    EXPECT_EQ(preference.codec(), "jpeg:quality=85");
    EXPECT_EQ(observe(whole, 60s), 0);
    // For a moment the link is worse.
    EXPECT_EQ(observe(thinned, 1s), 0);
    EXPECT_EQ(observe(whole, 1s), 0);
    EXPECT_EQ(observe(thinned, 1s), 0);
    EXPECT_EQ(preference.codec(), "jpeg:quality=85");
}

TEST_F(ColorPreferenceTest, SaysOnlyWhatItHasMeasured) {
    EXPECT_EQ(preference.reason(), "JPEG: nothing is measured yet");
    observe({}, 1s);  // no picture has come
    EXPECT_EQ(preference.reason(), "JPEG: nothing is measured yet");
    observe(thinned, 1s);
    EXPECT_EQ(preference.reason(),
              "JPEG: only 15 pictures a second come; H.264 is tried if that lasts");
    observe(whole, 1s);
    EXPECT_EQ(preference.reason(), "JPEG: all pictures come in time");
    EXPECT_EQ(preference.codec(), "jpeg:quality=85");
}

TEST_F(ColorPreferenceTest, APageThatStoodStillMeasuresAnew) {
    observe(whole, 2s);
    // Another tab was in front; then the host needs some seconds to send everything again.
    now += 15s;
    EXPECT_EQ(observe(thinned, 3s), 0);
    EXPECT_EQ(observe(whole, 30s), 0);
    EXPECT_EQ(preference.reason(), "JPEG: all pictures come in time");

    try_h264();
    observe(h264, 3s);
    now += 15s;
    ColorMeasure one = h264;
    one.pictures_per_second = 1;
    EXPECT_EQ(observe(one, 4s), 0);
    EXPECT_EQ(observe(h264, 5s), 0);
    EXPECT_EQ(preference.reason(), "H.264: 29 pictures a second, 15 as JPEG");
}

TEST_F(ColorPreferenceTest, KeepsH264ThatGivesMorePictures) {
    try_h264();
    EXPECT_EQ(observe(h264, 600s), 0);
    EXPECT_EQ(preference.reason(), "H.264: 29 pictures a second, 15 as JPEG");
}

TEST_F(ColorPreferenceTest, EndsATryThatGivesFewerPicturesAndWaitsLongerEachTime) {
    try_h264();
    ColorMeasure worse = h264;
    worse.pictures_per_second = 9;
    EXPECT_EQ(observe(worse, ColorPreference::trial + 1s), 1);
    EXPECT_EQ(preference.codec(), "jpeg:quality=85");
    EXPECT_EQ(
        preference.reason(),
        "JPEG: 9 pictures a second came as H.264, 15 before; H.264 is tried again after 30 s");
    EXPECT_EQ(observe(thinned, 27s), 0);
    EXPECT_EQ(observe(thinned, 3s), 1);
    EXPECT_EQ(observe(worse, ColorPreference::trial + 1s), 1);
    EXPECT_EQ(observe(thinned, 50s), 0);
    EXPECT_EQ(observe(thinned, 10s), 1);
}

TEST_F(ColorPreferenceTest, EndsWhenTheDecoderIsTooSlow) {
    try_h264();
    observe(h264, 20s);
    ColorMeasure slow = h264;
    slow.decode_ms = 400;
    EXPECT_EQ(observe(slow, 1s), 0);
    EXPECT_EQ(observe(h264, 1s), 0);
    EXPECT_EQ(observe(slow, 5s), 1);
    EXPECT_EQ(preference.codec(), "jpeg:quality=85");
}

TEST_F(ColorPreferenceTest, EndsWhenTheDecoderFailsAgainAndAgain) {
    try_h264();
    ColorMeasure failing = h264;
    observe(failing, 1s);
    for (std::size_t i = 1; i < DecoderFailures::most; ++i) {
        failing.lost += 8;
        EXPECT_EQ(observe(failing, 1s), 0) << i;
    }
    // A measurement begins anew.
    failing.lost = 0;
    EXPECT_EQ(observe(failing, 1s), 0);
    ++failing.lost;
    EXPECT_EQ(observe(failing, 1s), 1);
    EXPECT_EQ(preference.codec(), "jpeg:quality=85");
}

TEST_F(ColorPreferenceTest, OneFailureThatLosesManyPicturesIsOne) {
    try_h264();
    ColorMeasure failing = h264;
    for (int i = 0; i < 20; ++i) {
        failing.lost += 8;
        EXPECT_EQ(observe(failing, DecoderFailures::window / 2 + 1s), 0) << i;
    }
}

TEST_F(ColorPreferenceTest, IsNotJudgedWhileTheHostSendsJpeg) {
    try_h264();
    EXPECT_EQ(observe(thinned, 600s), 0);
    EXPECT_EQ(preference.codec(), "h264:crf=20");
    EXPECT_EQ(observe(h264, 3s), 0);
}

TEST(ColorPreference, WithoutADecoderItIsJpeg) {
    ColorPreference preference(false);
    TimePoint now;
    for (int i = 0; i < 100; ++i, now += tick)
        EXPECT_FALSE(preference.observe({true, false, 4, 8, 0}, now));
    EXPECT_EQ(preference.codec(), "jpeg:quality=85");
    EXPECT_EQ(preference.reason(), "JPEG: this browser does not decode H.264");
}

}  // namespace
}  // namespace theatron::client

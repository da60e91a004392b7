// SPDX-License-Identifier: Apache-2.0
#include "sound/device_watch.h"

#include <gtest/gtest.h>

#include <vector>

namespace theatron::sound {
namespace {

using Answer = std::function<void(DeviceList)>;

TEST(DeviceWatch, AsksAgainOnlyWhenTheSystemHasAnswered) {
    std::vector<Answer> asked;
    DeviceWatch watch([&](Answer answer) { asked.push_back(std::move(answer)); }, 2s);
    const TimePoint begin(1s);
    EXPECT_TRUE(watch.devices_at(begin).microphones.empty());
    EXPECT_TRUE(watch.devices_at(begin + 10s).microphones.empty());
    EXPECT_EQ(asked.size(), 1u);
    asked[0]({{"Headset"}, {}, ""});
    EXPECT_EQ(watch.devices_at(begin + 11s).microphones.size(), 1u);
    EXPECT_EQ(asked.size(), 2u);
    asked[1]({{}, {}, ""});
    EXPECT_TRUE(watch.devices_at(begin + 12s).microphones.empty());
    EXPECT_EQ(asked.size(), 2u) << "an interval has not passed";
    (void)watch.devices_at(begin + 13s);
    EXPECT_EQ(asked.size(), 3u);
}

TEST(DeviceWatch, AnAnswerMayComeAfterItsEnd) {
    std::vector<Answer> asked;
    DeviceWatch([&](Answer answer) {
        asked.push_back(std::move(answer));
    }).devices_at(TimePoint(1s));
    ASSERT_EQ(asked.size(), 1u);
    asked[0]({{"Headset"}, {}, ""});
}

}  // namespace
}  // namespace theatron::sound

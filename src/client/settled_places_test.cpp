// SPDX-License-Identifier: Apache-2.0
#include "client/settled_places.h"

#include <gtest/gtest.h>

namespace theatron::client {
namespace {

constexpr CameraId camera{3};
constexpr TimePoint begin = from_us(5'000'000);

Bytes place(int number) {
    return Bytes(4, std::byte(number));
}

TEST(SettledPlaces, AnotherRegistrationHoldsAtOnce) {
    SettledPlaces places;
    EXPECT_EQ(places.settled(camera, place(1), {}, begin), place(1));
    EXPECT_EQ(places.settled(camera, place(2), {}, begin), place(2));
    EXPECT_FALSE(places.is_settling());
}

TEST(SettledPlaces, ANudgedCameraIsRecordedWhereItComesToRest) {
    SettledPlaces places;
    (void)places.settled(camera, place(1), {}, begin);
    for (int i = 2; i < 8; ++i)
        EXPECT_EQ(places.settled(camera, place(i), place(i), begin + 100ms * i), place(1));
    EXPECT_TRUE(places.is_settling());
    const TimePoint rest = begin + 700ms + SettledPlaces::stays;
    EXPECT_EQ(places.settled(camera, place(7), place(7), rest), place(7));
    EXPECT_FALSE(places.is_settling());
    // Taken back, it is a nudge as well.
    EXPECT_EQ(places.settled(camera, place(1), {}, rest + 1s), place(7));
}

TEST(SettledPlaces, OneThatIsNudgedOnAndOnIsRecordedMeanwhile) {
    SettledPlaces places;
    (void)places.settled(camera, place(1), {}, begin);
    int recorded = 1;
    for (int i = 0; i < 120; ++i)
        recorded = std::to_integer<int>(
            places.settled(camera, place(i % 2 + 2), place(9), begin + 100ms * i)[0]);
    EXPECT_NE(recorded, 1);
}

TEST(SettledPlaces, CamerasThatAreGoneAreForgotten) {
    SettledPlaces places;
    (void)places.settled(camera, place(1), {}, begin);
    (void)places.settled(camera, place(2), place(2), begin);
    places.keep_only([](CameraId) { return false; });
    EXPECT_FALSE(places.is_settling());
    EXPECT_EQ(places.settled(camera, place(3), place(3), begin), place(3));
}

}  // namespace
}  // namespace theatron::client

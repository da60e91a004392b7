// SPDX-License-Identifier: Apache-2.0
#include "client/settled_places.h"

#include <gtest/gtest.h>

namespace theatron::client {
namespace {

constexpr CameraId nudged{3};
constexpr TimePoint first_look = from_us(5'000'000);

Bytes place(int number) {
    return Bytes(4, std::byte(number));
}

TEST(SettledPlaces, AnotherRegistrationHoldsAtOnce) {
    SettledPlaces places;
    EXPECT_EQ(places.settled(nudged, place(1), {}, first_look), place(1));
    EXPECT_EQ(places.settled(nudged, place(2), {}, first_look), place(2));
    EXPECT_FALSE(places.is_settling());
}

TEST(SettledPlaces, ANudgedCameraIsRecordedWhereItComesToRest) {
    SettledPlaces places;
    (void)places.settled(nudged, place(1), {}, first_look);
    for (int i = 2; i < 8; ++i)
        EXPECT_EQ(places.settled(nudged, place(i), place(i), first_look + 100ms * i), place(1));
    EXPECT_TRUE(places.is_settling());
    const TimePoint rest = first_look + 700ms + SettledPlaces::stays;
    EXPECT_EQ(places.settled(nudged, place(7), place(7), rest), place(7));
    EXPECT_FALSE(places.is_settling());
    // Taken back, it is a nudge as well.
    EXPECT_EQ(places.settled(nudged, place(1), {}, rest + 1s), place(7));
}

TEST(SettledPlaces, OneThatIsNudgedOnAndOnIsRecordedMeanwhile) {
    SettledPlaces places;
    (void)places.settled(nudged, place(1), {}, first_look);
    int recorded = 1;
    for (int i = 0; i < 120; ++i)
        recorded = std::to_integer<int>(
            places.settled(nudged, place(i % 2 + 2), place(9), first_look + 100ms * i)[0]);
    EXPECT_NE(recorded, 1);
}

TEST(SettledPlaces, CamerasThatAreGoneAreForgotten) {
    SettledPlaces places;
    (void)places.settled(nudged, place(1), {}, first_look);
    (void)places.settled(nudged, place(2), place(2), first_look);
    places.keep_only([](CameraId) { return false; });
    EXPECT_FALSE(places.is_settling());
    EXPECT_EQ(places.settled(nudged, place(3), place(3), first_look), place(3));
}

}  // namespace
}  // namespace theatron::client

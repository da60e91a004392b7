// SPDX-License-Identifier: Apache-2.0
#include "viewer/room_past.h"

#include <gtest/gtest.h>

namespace theatron::viewer {
namespace {

using session::ObjectId;
using session::ObjectKind;
using session::RoomObjects;

constexpr ObjectId kept_brick{1}, kept_mark{2}, kept_person{3};

session::RoomObject object_at(double x, ObjectKind kind = ObjectKind::brick) {
    session::RoomObject object;
    object.kind = kind;
    object.room_from_object.translation = {x, 0, 0};
    return object;
}

TimePoint second(double seconds) {
    return from_us(std::int64_t(seconds * 1e6));
}

TEST(RoomPast, HasEachObjectAsItWasThen) {
    RoomPast past;
    past.note({{kept_brick, object_at(1)}}, second(100));
    past.note({{kept_brick, object_at(2)}, {kept_mark, object_at(0, ObjectKind::mark)}},
              second(110));
    past.note({{kept_mark, object_at(0, ObjectKind::mark)}}, second(120));
    EXPECT_EQ(past.at(second(105)), (RoomObjects{{kept_brick, object_at(1)}}))
        << "the mark came later";
    EXPECT_EQ(past.at(second(115)).at(kept_brick), object_at(2));
    EXPECT_EQ(past.at(second(115)).size(), 2u);
    EXPECT_EQ(past.at(second(125)).count(kept_brick), 0u) << "removed since";
}

TEST(RoomPast, KnowsNothingOfBeforeOneCame) {
    RoomPast past;
    EXPECT_FALSE(past.knows(second(100)));
    past.note({{kept_brick, object_at(1)}}, second(100));
    EXPECT_FALSE(past.knows(second(99)));
    EXPECT_EQ(past.at(second(99)), RoomObjects{});
    EXPECT_TRUE(past.knows(second(100)));
}

TEST(RoomPast, LeavesPeopleOut) {
    RoomPast past;
    past.note({{kept_person, object_at(1, ObjectKind::person)}}, second(100));
    EXPECT_EQ(past.at(second(101)), RoomObjects{});
}

TEST(RoomPast, FollowsAMovingObjectInStepsAndEndsWhereItIs) {
    RoomPast past;
    for (int i = 0; i <= 100; ++i)
        past.note({{kept_brick, object_at(i)}}, second(100 + 0.01 * i));
    for (const double at : {100.0, 100.35, 100.7})
        EXPECT_NEAR(past.at(second(at)).at(kept_brick).room_from_object.translation.x,
                    100 * (at - 100), 11);
    EXPECT_EQ(past.at(second(101.1)).at(kept_brick), object_at(100));
}

TEST(RoomPast, ForgetsWhatNobodyCanLookBackAt) {
    RoomPast past;
    past.note({{kept_brick, object_at(1)}}, second(100));
    past.note({{kept_brick, object_at(2)}}, second(110));
    past.note({}, second(120));
    past.note({}, second(181));
    EXPECT_EQ(past.at(second(105)), RoomObjects{}) << "too long ago";
    EXPECT_EQ(past.at(second(115)).at(kept_brick), object_at(2));
    past.note({}, second(191));
    EXPECT_EQ(past.at(second(115)), RoomObjects{});
}

TEST(RoomPast, BeginsAnewWithAnotherSession) {
    RoomPast past;
    past.note({{kept_brick, object_at(1)}}, second(100));
    past.note({}, second(5));
    EXPECT_FALSE(past.knows(second(4)));
    EXPECT_EQ(past.at(second(100)), RoomObjects{});
}

}  // namespace
}  // namespace theatron::viewer

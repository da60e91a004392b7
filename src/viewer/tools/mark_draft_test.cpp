// SPDX-License-Identifier: Apache-2.0
#include "viewer/tools/mark_draft.h"

#include <gtest/gtest.h>

namespace theatron::viewer {
namespace {

using session::MarkedSurface;
using session::MarkKind;

MarkedPlace on_cloud(double x_m) {
    MarkedPlace place{
        MarkedSurface::cloud, {}, {}, {{x_m, 0, 0}, {0, 1, 0}}, room::MeasuredPoint{}};
    place.measured->in_camera = {x_m, 0, 1};
    place.measured->deviation_m = 0.001;
    return place;
}

MarkedPlace on_part(std::uint32_t part, double x_m) {
    return {MarkedSurface::organ,
            session::ObjectId{part},
            session::ObjectId{50},
            {{x_m, 0, 0}, {0, 1, 0}},
            std::nullopt};
}

TEST(MarkDraft, AStrokeFollowsThePointerWhileTheButtonIsDown) {
    MarkDraft draft(MarkKind::stroke);
    EXPECT_FALSE(draft.is_open());
    ASSERT_TRUE(draft.press(on_cloud(0)));
    for (int i = 1; i <= 5; ++i)
        draft.move_to(on_cloud(0.01 * i));
    draft.move_to(on_cloud(0.0504));   // no step
    draft.move_to(on_part(51, 0.06));  // another surface
    const auto mark = draft.release();
    ASSERT_TRUE(mark);
    EXPECT_EQ(mark->kind, MarkKind::stroke);
    EXPECT_EQ(mark->points.size(), 7u);  // the first one twice
    EXPECT_EQ(mark->points.back().position.x, 0.05);
    EXPECT_FALSE(draft.is_open());
    EXPECT_FALSE(draft.take_advice());
}

TEST(MarkDraft, AClickOfTheStrokeDrawsNothingAndSaysHowToDraw) {
    MarkDraft draft(MarkKind::stroke);
    draft.press(on_cloud(0));
    EXPECT_FALSE(draft.release());
    EXPECT_FALSE(draft.is_open());
    EXPECT_EQ(draft.take_advice(), Phrase::draw_by_dragging);
    EXPECT_FALSE(draft.take_advice()) << "once";
}

TEST(MarkDraft, AClickIsAPin) {
    MarkDraft draft(MarkKind::pin);
    draft.press(on_part(51, 0));
    const auto pin = draft.release();
    ASSERT_TRUE(pin);
    EXPECT_EQ(pin->points.size(), 1u);
    EXPECT_EQ(pin->object, 51u);
    EXPECT_EQ(pin->number, 1);
}

TEST(MarkDraft, TheEndsOfADistanceAreTwoPressesOrOneDrag) {
    for (const bool by_clicks : {false, true}) {
        SCOPED_TRACE(by_clicks);
        MarkDraft draft(MarkKind::distance);
        draft.press(on_cloud(0));
        if (by_clicks) {
            EXPECT_FALSE(draft.release());
            EXPECT_EQ(draft.take_advice(), Phrase::press_at_other_end);
            EXPECT_TRUE(draft.is_open());
            EXPECT_FALSE(draft.is_pressed());
            draft.move_to(on_cloud(0.05));  // the preview
            EXPECT_EQ(draft.mark().points[1].position.x, 0.05);
            ASSERT_TRUE(draft.press(on_cloud(0.2)));
        } else {
            draft.move_to(on_cloud(0.2));
        }
        const auto mark = draft.release();
        ASSERT_TRUE(mark);
        EXPECT_EQ(mark->points[0].position.x, 0);
        EXPECT_EQ(mark->points[1].position.x, 0.2);
        EXPECT_GT(mark->deviation_m, 0);
        EXPECT_FALSE(draft.is_open());
    }
}

TEST(MarkDraft, ASecondPressAtTheSamePlaceWaitsOnForTheOtherEnd) {
    MarkDraft draft(MarkKind::arrow);
    for (int i = 0; i < 3; ++i) {
        draft.press(on_cloud(0));
        EXPECT_FALSE(draft.release());
    }
    draft.press(on_cloud(0.1));
    EXPECT_TRUE(draft.release());
}

TEST(MarkDraft, APressOnNothingDropsWhatWasBegun) {
    MarkDraft draft(MarkKind::distance);
    draft.press(on_cloud(0));
    (void)draft.release();
    EXPECT_FALSE(draft.press(std::nullopt));
    EXPECT_FALSE(draft.is_open());
    EXPECT_FALSE(draft.release());
}

TEST(MarkDraft, ADistanceBetweenTwoPartsIsOfTheOrganAndAStrokeStaysOnOne) {
    MarkDraft distance(MarkKind::distance);
    distance.press(on_part(51, 0));
    distance.move_to(on_part(52, 0.1));
    EXPECT_EQ(distance.mark().object, 50u);
    distance.move_to(on_part(51, 0.1));
    EXPECT_EQ(distance.release()->object, 51u);
    MarkDraft stroke(MarkKind::stroke);
    stroke.press(on_part(51, 0));
    stroke.move_to(on_part(52, 0.1));
    EXPECT_EQ(stroke.mark().points.size(), 2u);
}

}  // namespace
}  // namespace theatron::viewer

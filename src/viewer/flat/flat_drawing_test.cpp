// SPDX-License-Identifier: Apache-2.0
#include "viewer/flat/flat_drawing.h"

#include <gtest/gtest.h>

#include "room/people.h"
#include "room/srgb.h"

namespace theatron::viewer {
namespace {

using session::MarkedSurface;
using session::MarkKind;

// Seen from z 2 along -z, 60 degrees wide: at z 0 a metre is 0.433 of the picture's width.
class FlatDrawingTest : public ::testing::Test {
protected:
    FlatDrawingTest() {
        calibration.color = pinhole({320, 240}, 60);
        calibration.room_from_camera = look_at({0, 1.5, 2}, {0, 1.5, 0}, {0, 1, 0});
    }
    session::Mark mark(MarkKind kind, std::vector<Vec3> places) const {
        session::Mark made;
        made.kind = kind;
        made.color = 2;
        made.initials = "AL";
        for (const Vec3 place : places)
            made.points.push_back({place, {0, 0, 1}});
        return made;
    }
    FlatPicture picture() const { return {CameraId{1}, calibration, {}}; }
    FlatDrawing drawn(const session::Mark& one) const {
        FlatDrawing drawing;
        add_mark(one, picture(), drawing);
        return drawing;
    }

    Calibration calibration;
};

TEST_F(FlatDrawingTest, AStrokeIsALineWithItsAuthor) {
    const FlatDrawing drawing =
        drawn(mark(MarkKind::stroke, {{0, 1.5, 0}, {0.1, 1.5, 0}, {0.1, 1.6, 0}}));
    ASSERT_EQ(drawing.lines.size(), 1u);
    const FlatLine& line = drawing.lines[0];
    ASSERT_EQ(line.pieces.size(), 2u);
    EXPECT_NEAR(line.pieces[0].from.x, 0.5, 1e-9);
    EXPECT_NEAR(line.pieces[0].to.x, 0.5 + 0.1 * 0.433, 1e-3);
    EXPECT_LT(line.pieces[1].to.y, 0.5) << "up in the room is up in the picture";
    EXPECT_EQ(line.color, room::srgb_of(room::color_of(ParticipantId{2})));
    ASSERT_EQ(drawing.labels.size(), 1u);
    EXPECT_EQ(drawing.labels[0].utf8, "AL");
    EXPECT_EQ(drawing.labels[0].rank, render::LabelRank::author);
}

TEST_F(FlatDrawingTest, ADistanceTellsItsLengthAlsoWhereItsMiddleIsOutside) {
    const FlatDrawing inside = drawn(mark(MarkKind::distance, {{0, 1.5, 0}, {0.1, 1.5, 0}}));
    ASSERT_EQ(inside.labels.size(), 1u);
    EXPECT_EQ(inside.labels[0].utf8, "100.0 mm AL");
    EXPECT_EQ(inside.labels[0].brief, "100 mm");
    EXPECT_NEAR(inside.labels[0].place.x, 0.5 + 0.05 * 0.433, 1e-3);
    EXPECT_EQ(inside.lines[0].pieces.size(), 3u);
    // The right end is far outside.
    const FlatDrawing partly = drawn(mark(MarkKind::distance, {{1, 1.5, 0}, {5, 1.5, 0}}));
    ASSERT_EQ(partly.labels.size(), 1u);
    EXPECT_NEAR(partly.labels[0].place.x, 0.5 + 0.433, 1e-3);
}

TEST_F(FlatDrawingTest, OrgansAndWhatIsOutsideAreNotDrawn) {
    session::Mark on_organ = mark(MarkKind::pin, {{0, 1.5, 0}});
    EXPECT_EQ(drawn(on_organ).lines.size(), 1u);
    on_organ.surface = MarkedSurface::organ;
    EXPECT_TRUE(drawn(on_organ).lines.empty());
    const FlatDrawing behind = drawn(mark(MarkKind::arrow, {{0, 1.5, 3}, {0.1, 1.5, 3}}));
    EXPECT_TRUE(behind.lines.empty());
    EXPECT_TRUE(behind.labels.empty());
}

TEST_F(FlatDrawingTest, APointerIsADotWithAName) {
    FlatDrawing drawing;
    add_pointer(ParticipantId{4}, "Eva", {0, 1.5, 0}, picture(), drawing);
    add_pointer(ParticipantId{5}, "", {0, 1.4, 0}, picture(), drawing);
    ASSERT_EQ(drawing.lines.size(), 2u);
    EXPECT_EQ(drawing.lines[0].pieces[0].from, drawing.lines[0].pieces[0].to);
    ASSERT_EQ(drawing.labels.size(), 1u);
    EXPECT_EQ(drawing.labels[0].utf8, "Eva");
}

}  // namespace
}  // namespace theatron::viewer

// SPDX-License-Identifier: Apache-2.0
#include "room/mark_shape.h"

#include <gtest/gtest.h>

#include <cmath>

#include "session/mark_testing.h"

namespace theatron::room {
namespace {

using render::LinePiece;
using session::between;
using session::examples;
using session::Mark;
using session::MarkKind;
using session::pin;
using session::stroke;

TEST(MarkShape, AStrokeIsOneLineWithoutGaps) {
    const std::vector<LinePiece> line = mark_line(stroke(200));
    ASSERT_EQ(line.size(), 199u);
    for (std::size_t i = 1; i < line.size(); ++i)
        EXPECT_EQ(line[i].from, line[i - 1].to) << i;
}

TEST(MarkShape, EveryPieceHasALeastWidthAndOnlyTheTipOfAnArrowIsSharp) {
    for (const Mark& mark : examples())
        for (const LinePiece& piece : mark_line(mark)) {
            EXPECT_GE(piece.from_half_widths, 1) << to_text(mark.kind);
            const bool is_tip = mark.kind == MarkKind::arrow && piece.to == mark.points[1].position;
            EXPECT_GE(piece.to_half_widths, is_tip ? 0 : 1) << to_text(mark.kind);
        }
}

TEST(MarkShape, PointsAtOnePlaceStillHaveALine) {
    for (const MarkKind kind : {MarkKind::stroke, MarkKind::arrow, MarkKind::distance}) {
        const std::vector<LinePiece> line = mark_line(between(kind, {1, 1, 1}, {1, 1, 1}));
        ASSERT_FALSE(line.empty());
        for (const LinePiece& piece : line)
            EXPECT_TRUE(std::isfinite(length(piece.from) + length(piece.to))) << to_text(kind);
    }
}

TEST(MarkShape, ADistanceIsNamedInItsMiddleOrWhereElseItIsSeen) {
    const auto places = label_places(between(MarkKind::distance, {0, 0, 0}, {0.2, 0, 0}));
    EXPECT_EQ(places.at(0), (Vec3{0.1, 0, 0}));
    EXPECT_EQ(places.size(), 5u);
}

TEST(MarkShape, LabelsSayNumberLengthAndAuthor) {
    EXPECT_EQ(label_of(pin()), "12 AB");
    EXPECT_EQ(label_of(between(MarkKind::arrow, {}, {1, 0, 0})), "AB");
    Mark distance = between(MarkKind::distance, {}, {0.0123, 0, 0});
    EXPECT_EQ(label_of(distance), "12.3 mm AB");
    distance.initials.clear();
    EXPECT_EQ(label_of(distance), "12.3 mm");
    distance.initials = "AB";
    distance.deviation_m = 0.0015f;
    EXPECT_EQ(label_of(distance), "12.3 mm \u00b1 3.0 mm AB");
    EXPECT_EQ(short_label_of(distance), "12 \u00b1 3 mm");
    distance.deviation_m = 0.0002f;
    EXPECT_EQ(short_label_of(distance), "12 \u00b1 1 mm");
    distance.deviation_m = 0;
    EXPECT_EQ(short_label_of(distance), "12 mm");
    EXPECT_EQ(short_label_of(pin()), "12 AB");
}

}  // namespace
}  // namespace theatron::room

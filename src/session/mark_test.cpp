// SPDX-License-Identifier: Apache-2.0
#include "session/mark.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>

#include "session/mark_testing.h"

namespace theatron::session {
namespace {

TEST(Mark, ComesBackFromItsBytes) {
    for (const Mark& mark : examples()) {
        const Bytes bytes = encode_mark(mark);
        EXPECT_LE(bytes.size(), 4096u);
        EXPECT_EQ(decode_mark(bytes), mark);
    }
}

// The test vector of docs/formats/mark.md.
TEST(Mark, HasTheDocumentedBytes) {
    Mark mark = pin();
    mark.surface = MarkedSurface::slice;
    mark.object = 0x01020304;
    mark.color = 5;
    mark.points[0].position = {1, -0.5, 2};
    const unsigned char documented[] = {3,    3, 4,    3,    2,    1, 5, 12,   0,    0,    0,   0,
                                        0,    2, 0x41, 0x42, 1,    0, 0, 0x80, 0x3f, 0,    0,   0,
                                        0xbf, 0, 0,    0,    0x40, 0, 0, 0,    0,    0xff, 0x7f};
    const ByteView bytes = std::as_bytes(std::span(documented));
    EXPECT_TRUE(std::ranges::equal(encode_mark(mark), bytes));
    EXPECT_EQ(decode_mark(bytes), mark);
}

TEST(Mark, BytesThatAreTooShortOrTooLongAreNone) {
    for (const Mark& mark : examples()) {
        Bytes bytes = encode_mark(mark);
        for (std::size_t size = 0; size < bytes.size(); ++size)
            ASSERT_FALSE(decode_mark(ByteView(bytes).first(size))) << size;
        bytes.push_back({});
        EXPECT_FALSE(decode_mark(bytes));
    }
}

TEST(Mark, ContradictionsAreRefused) {
    const auto refused = [](const Mark& valid, auto change) {
        ASSERT_TRUE(decode_mark(encode_mark(valid)));
        Mark mark = valid;
        change(mark);
        EXPECT_FALSE(decode_mark(encode_mark(mark)));
    };
    refused(stroke(3), [](Mark& m) { m.points.resize(1); });
    refused(stroke(3), [](Mark& m) { m.points.resize(most_mark_points + 1, m.points[0]); });
    refused(stroke(3), [](Mark& m) { m.kind = MarkKind(9); });
    refused(stroke(3), [](Mark& m) { m.kind = MarkKind::arrow; });
    refused(stroke(3), [](Mark& m) { m.surface = MarkedSurface(0); });
    refused(stroke(3), [](Mark& m) { m.object = 0; });
    refused(stroke(3), [](Mark& m) { m.number = 1; });
    refused(stroke(3), [](Mark& m) { m.deviation_m = 0.1f; });
    refused(stroke(3), [](Mark& m) { m.initials = std::string(most_initials_bytes + 1, 'A'); });
    refused(stroke(3), [](Mark& m) { m.points[1].normal = {0, 0.5, 0}; });
    refused(stroke(3), [](Mark& m) { m.points[1].position.x = 1001; });
    refused(stroke(3),
            [](Mark& m) { m.points[1].position.x = std::numeric_limits<double>::quiet_NaN(); });
    refused(pin(), [](Mark& m) { m.number = 0; });
    refused(pin(), [](Mark& m) { m.object = 4; });
}

TEST(Mark, InitialsAreThoseOfTheFirstAndTheLastWord) {
    EXPECT_EQ(initials_of("Ada Lovelace"), "AL");
    EXPECT_EQ(initials_of("  Ada   King of Lovelace "), "AL");
    EXPECT_EQ(initials_of("Ada"), "A");
    EXPECT_EQ(initials_of("\u00d6zlem K\u00f6se"), "\u00d6K");
    EXPECT_EQ(initials_of(" "), "?");
    EXPECT_EQ(initials_of("Dr. Eva Stone"), "ES");
    EXPECT_EQ(initials_of("Prof. Dr. med. Ada Lovelace"), "AL");
    EXPECT_EQ(initials_of(" Dr Eva  Stone"), "ES");
    EXPECT_EQ(initials_of("J.R. Stone"), "JS");
    EXPECT_EQ(initials_of("Dr. Stone"), "S");
    EXPECT_EQ(initials_of("Dr. "), "D") << "nothing else is known";
    // Cut in the middle of a character.
    EXPECT_EQ(initials_of("\xc3"), "\xc3");
    EXPECT_TRUE(may_be_initials_of("Dr. Eva Stone", "ES"));
    EXPECT_TRUE(may_be_initials_of("Dr. Eva Stone", "DS")) << "a program of version 0.1.0";
    EXPECT_FALSE(may_be_initials_of("Dr. Eva Stone", "E"));
}

std::vector<MarkPoint> circle(std::size_t count, double radius) {
    std::vector<MarkPoint> line;
    for (std::size_t i = 0; i < count; ++i) {
        const double angle = 6 * double(i) / double(count - 1);
        line.push_back({{radius * std::cos(angle), radius * std::sin(angle), 0}, {0, 0, 1}});
    }
    return line;
}

double farthest_left_out(const std::vector<MarkPoint>& line, const std::vector<MarkPoint>& kept) {
    double worst = 0;
    for (const MarkPoint& point : line) {
        double nearest = 1e9;
        for (std::size_t i = 1; i < kept.size(); ++i) {
            const Vec3 a = kept[i - 1].position, step = kept[i].position - a;
            const double t = std::clamp(dot(point.position - a, step) / dot(step, step), 0.0, 1.0);
            nearest = std::min(nearest, length(point.position - a - step * t));
        }
        worst = std::max(worst, nearest);
    }
    return worst;
}

TEST(Mark, ASimplifiedLineStaysWithinTheTolerance) {
    const std::vector<MarkPoint> line = circle(2000, 0.1);
    const std::vector<MarkPoint> kept = simplified(line, 0.0005, most_mark_points);
    EXPECT_LT(kept.size(), 60u);
    EXPECT_GT(kept.size(), 10u);
    EXPECT_EQ(kept.front(), line.front());
    EXPECT_EQ(kept.back(), line.back());
    EXPECT_LE(farthest_left_out(line, kept), 0.0005);
}

TEST(Mark, ALineThatIsTooLongLosesDetailAndNotItsEnd) {
    const std::vector<MarkPoint> line = circle(2000, 0.1);
    const std::vector<MarkPoint> kept = simplified(line, 0, 12);
    EXPECT_LE(kept.size(), 12u);
    EXPECT_EQ(kept.back(), line.back());
    EXPECT_LT(farthest_left_out(line, kept), 0.02);
    const std::vector<MarkPoint> two = circle(2, 0.1);
    EXPECT_EQ(simplified(two, 0.1, 2), two);
}

TEST(Mark, AScribbleOfMorePointsThanFitStaysAScribble) {
    std::vector<MarkPoint> zigzag;
    for (int i = 0; i < 5000; ++i)
        zigzag.push_back({{i * 0.001, i % 2 * 0.05, 0}, {0, 0, 1}});
    const std::vector<MarkPoint> kept = simplified(zigzag, 0.0005, most_mark_points);
    EXPECT_EQ(kept.size(), most_mark_points);
    const auto high = std::count_if(kept.begin(), kept.end(),
                                    [](const MarkPoint& p) { return p.position.y > 0; });
    EXPECT_GT(high, 50);
    EXPECT_GT(std::ssize(kept) - high, 50);
}

}  // namespace
}  // namespace theatron::session

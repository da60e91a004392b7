// SPDX-License-Identifier: Apache-2.0
#include "pace/drawing_rest.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace theatron::pace {
namespace {

// A processor that decodes `wanted` frames a second and draws with the rest of its time.
struct Machine {
    double decoding_ms = 4;       // of the processor, for each frame
    Duration drawing = 90ms;      // of a picture, without anything else to do
    double carried_per_s = 1000;  // frames that the link brings
    double wanted_per_s = 60;
    bool has_card = false;  // which draws; then the processor works 1 ms for a picture
};

struct Viewer {
    explicit Viewer(const Machine& of, bool begins_resting = false)
        : machine(of), rest(begins_resting) {}

    // Decoding gets half of the time at worst: the scheduler is fair, and drawing takes all else.
    void watch(Duration length) {
        pictures = 0;
        frames = lost = 0;
        begun = now;
        std::size_t step = rest.step();
        for (const TimePoint end = now + length; now < end; now += 100ms) {
            const Duration drawn = draw_for(100ms);
            const double free_ms = 100 - to_ms(drawn) / 2;
            // A few frames wait while a picture is drawn; others are left out.
            constexpr double most_waiting = 8;
            const double came = std::min(machine.wanted_per_s, machine.carried_per_s) / 10;
            const double decoded = std::min(waiting + came, free_ms / machine.decoding_ms);
            waiting += came - decoded;
            const double left_out =
                std::max(waiting - most_waiting, 0.0) + machine.wanted_per_s / 10 - came;
            waiting = std::min(waiting, most_waiting);
            frames += decoded;
            lost += left_out;
            rest.observe({left_out > 0, 10 * decoded, 30 + 100 * waiting / came}, now + 100ms);
            changes += rest.step() != step;
            step = rest.step();
        }
        seconds = to_seconds(length);
    }
    double pictures_per_s() const { return pictures / seconds; }
    double lost_per_s() const { return lost / seconds; }

    Machine machine;
    DrawingRest rest;
    TimePoint now{1s}, begun, busy_until;
    int pictures = 0, changes = 0;
    double waiting = 0, frames = 0, lost = 0, seconds = 0;

private:
    // The time of the processor for drawing, of this time.
    Duration draw_for(Duration length) {
        Duration drawn{};
        const Duration processor = machine.has_card ? Duration(1ms) : machine.drawing;
        for (TimePoint at = now; at < now + length; at += 1ms) {
            if (at >= busy_until && !rest.rests_until_later(at)) {
                // As many as a display shows at most.
                busy_until = at + std::max(processor, Duration(16ms));
                drawing_until = at + processor;
                rest.add(at, processor);
                ++pictures;
            }
            if (at < drawing_until)
                drawn += 1ms;
        }
        return drawn;
    }

    TimePoint drawing_until;
};

constexpr Duration minute = 60s;
// Drawing leaves time for 25 of 60 frames.
const Machine overloaded{20, 90ms, 1000, 38, false};

TEST(DrawingRest, EachPictureIsDrawnWhereTheProcessorDoesBoth) {
    Viewer viewer({4, 90ms, 1000, 10, false});
    viewer.watch(minute);
    EXPECT_EQ(viewer.rest.step(), 0u);
    EXPECT_GE(viewer.pictures_per_s(), 10);
    EXPECT_EQ(viewer.changes, 0);
}

TEST(DrawingRest, FewerPicturesBringTheFramesBack) {
    Viewer viewer(overloaded);
    viewer.watch(1s);
    EXPECT_GT(viewer.lost_per_s(), 1);
    viewer.watch(1s);
    viewer.watch(2s);
    EXPECT_EQ(viewer.lost_per_s(), 0);
    EXPECT_GE(viewer.pictures_per_s(), DrawingRest::fewest_per_second - 0.5);
}

TEST(DrawingRest, RestAloneLeavesTwoPicturesASecond) {
    for (const Duration drawing : {20ms, 60ms, 120ms, 240ms}) {
        Viewer viewer({25, drawing, 1000, 39, false}, true);
        viewer.watch(2s);
        EXPECT_GE(viewer.pictures_per_s(), DrawingRest::fewest_per_second - 0.5);
    }
    Viewer slow({25, 600ms, 1000, 39, false}, true);
    slow.watch(5s);
    EXPECT_GE(slow.pictures_per_s(), 1.6);
}

TEST(DrawingRest, MorePicturesThatAreTooManyAreTriedEverLessOften) {
    Viewer viewer(overloaded);
    viewer.watch(minute);
    const int first = viewer.changes;
    viewer.watch(minute);
    viewer.watch(10 * minute);
    viewer.changes = 0;
    viewer.watch(10 * minute);
    EXPECT_GE(first, 2);
    EXPECT_LE(viewer.changes, 12);
    EXPECT_LE(viewer.lost_per_s(), 0.2);
}

TEST(DrawingRest, OlderFramesEndATryBeforeAnyIsLost) {
    DrawingRest rest(true);
    TimePoint now{1s};
    const auto receive = [&](double age_ms, Duration length) {
        for (const TimePoint end = now + length; now < end; now += 100ms) {
            rest.add(now, 90ms);
            rest.observe({false, 30, age_ms}, now + 100ms);
        }
    };
    receive(35, DrawingRest::first_patience + 200ms);
    EXPECT_EQ(rest.step(), 1u);
    receive(60, 1s);
    EXPECT_EQ(rest.step(), 1u);
    receive(100, 100ms);
    EXPECT_EQ(rest.step(), 2u);
}

TEST(DrawingRest, ItComesBackWhenThereIsTimeAgain) {
    Viewer viewer(overloaded);
    viewer.watch(5s);
    EXPECT_GT(viewer.rest.step(), 0u);
    viewer.machine.decoding_ms = 4;
    viewer.watch(minute);
    EXPECT_EQ(viewer.rest.step(), 0u);
    viewer.changes = 0;
    viewer.watch(10 * minute);
    EXPECT_EQ(viewer.changes, 0);
}

TEST(DrawingRest, OnANarrowLinkDrawingGetsItsTimeBack) {
    Machine link;
    link.carried_per_s = 20;
    Viewer viewer(link);
    viewer.watch(10s);
    viewer.watch(20s);
    EXPECT_EQ(viewer.rest.step(), 0u);
    viewer.watch(10 * minute);
    viewer.changes = 0;
    viewer.watch(10 * minute);
    EXPECT_LE(viewer.changes, 6);
    EXPECT_GE(viewer.pictures_per_s(), 10);
}

TEST(DrawingRest, AGraphicsCardNeverRests) {
    Machine link;
    link.has_card = true;
    link.carried_per_s = 20;
    Viewer viewer(link);
    viewer.watch(minute);
    EXPECT_EQ(viewer.changes, 0);
    EXPECT_GE(viewer.pictures_per_s(), 55);
}

TEST(DrawingRest, AProcessorBeginsWithFewPicturesAndDrawsMoreWhereThereIsTime) {
    Viewer viewer({4, 40ms, 1000, 10, false}, true);
    viewer.watch(2s);
    EXPECT_LE(viewer.pictures_per_s(), 7);
    viewer.watch(8s);
    EXPECT_EQ(viewer.rest.step(), 0u);

    Viewer busy(overloaded, true);
    busy.watch(2s);
    EXPECT_EQ(busy.lost_per_s(), 0);
}

}  // namespace
}  // namespace theatron::pace

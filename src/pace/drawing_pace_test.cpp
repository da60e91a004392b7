// SPDX-License-Identifier: Apache-2.0
#include "pace/drawing_pace.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <string>

namespace theatron::pace {
namespace {

// The time that a machine needs for a picture in this mode.
using Machine = std::function<Duration(const DrawingWay&)>;

// A viewer in front of a machine, whose cameras give 30 pictures a second.
struct Viewer {
    explicit Viewer(std::vector<DrawingWay> ways) : pace(std::move(ways)) {}

    const DrawingWay& watch(const Machine& machine, Duration length) {
        for (const TimePoint end = now + length; now < end;) {
            const DrawingWay way = pace.way();
            const Duration drawing = machine(way);
            now += std::max(drawing, Duration(33ms));
            pace.add(now, drawing);
            changes += pace.way() != way;
            used.insert(pace.way().renderer);
        }
        return pace.way();
    }

    DrawingPace pace;
    TimePoint now{};
    int changes = 0;
    std::set<std::string> used;
};

Duration times(Duration of, double factor) {
    return Duration(std::int64_t(double(of.count()) * factor));
}

// The time grows with the work as on a driver that computes all on the processor.
Machine machine(Duration points, Duration pixels) {
    return [=](const DrawingWay& way) {
        const double work = way.renderer == "blend" ? 2 : way.renderer == "mesh" ? 1 : 0.9;
        return times(points, work / (way.depth_step * way.depth_step)) +
               times(pixels, way.scale * way.scale);
    };
}

constexpr Duration minute = 60s;

TEST(DrawingPace, AFastMachineDrawsTheBestPicture) {
    Viewer viewer(automatic_ways(2, 0));
    const DrawingWay best{"blend", 1, 1};
    EXPECT_EQ(viewer.watch(machine(4ms, 5ms), minute), best);
    EXPECT_EQ(viewer.watch(machine(14ms, 11ms), minute), best);
    EXPECT_EQ(viewer.changes, 0);
}

TEST(DrawingPace, AHeadsetsDisplayNeedsEachPictureInTime) {
    const PaceLimits limits = limits_of_display(90);
    DrawingPace pace(automatic_ways(1, 0), 0, limits);
    const DrawingWay best = pace.way();
    TimePoint now{};
    const auto draw = [&](Duration time, int pictures) {
        for (int i = 0; i < pictures; ++i)
            pace.add(now += time, time);
    };
    draw(10ms, 100);
    EXPECT_EQ(pace.way(), best);  // a ninetieth of a second is 11.1 ms
    draw(14ms, 12);
    EXPECT_FALSE(pace.way() == best);
    EXPECT_EQ(DrawingPace(automatic_ways(1, 0)).way(), best);
}

TEST(DrawingPace, OneCameraIsDrawnAsAMesh) {
    for (const DrawingWay& way : automatic_ways(1, 0))
        EXPECT_EQ(way.renderer, "mesh");
}

TEST(DrawingPace, ASlowerMachineGetsTheNextBestThatKeepsUp) {
    const auto best_for = [](const Machine& machine) {
        return Viewer(automatic_ways(2, 0)).watch(machine, minute);
    };
    EXPECT_EQ(best_for(machine(25ms, 10ms)), (DrawingWay{"blend", 2, 1}));
    EXPECT_EQ(best_for(machine(100ms, 10ms)), (DrawingWay{"mesh", 2, 1}));
    EXPECT_EQ(best_for(machine(200ms, 10ms)), (DrawingWay{"mesh", 3, 1}));
    EXPECT_EQ(best_for(machine(60ms, 90ms)), (DrawingWay{"mesh", 3, 0.5}));
    // A graphics card on which points cost nothing and blending is slow.
    EXPECT_EQ(best_for([](const DrawingWay& way) { return way.renderer == "blend" ? 60ms : 20ms; }),
              (DrawingWay{"mesh", 1, 1}));
}

TEST(DrawingPace, AVerySlowMachineIsHelpedSoon) {
    Viewer viewer(automatic_ways(2, 0));
    EXPECT_EQ(viewer.watch(machine(200ms, 20ms), 5s).renderer, "mesh");
}

TEST(DrawingPace, AChosenRendererStays) {
    for (const char* renderer : {"splat", "disc", "mesh", "blend"}) {
        Viewer viewer(ways_of(renderer, 0));
        const DrawingWay way = viewer.watch(machine(20ms, 200ms), minute);
        EXPECT_EQ(way.renderer, renderer);
        EXPECT_EQ(way.depth_step, 1);
        EXPECT_LT(way.scale, 1);
        EXPECT_EQ(viewer.used, std::set<std::string>{renderer});
    }
}

TEST(DrawingPace, AChosenScaleStays) {
    for (const auto& ways : {automatic_ways(2, 0.6), ways_of("blend", 0.6)}) {
        Viewer viewer(ways);
        EXPECT_EQ(viewer.watch(machine(300ms, 300ms), minute).scale, 0.6);
    }
}

TEST(DrawingPace, WhatDoesNotHelpIsNotDone) {
    Viewer pixels_are_free(ways_of("splat", 0)), nothing_helps(automatic_ways(2, 0));
    EXPECT_EQ(pixels_are_free.watch(machine(100ms, 5ms), minute), (DrawingWay{"splat", 1, 1}));
    EXPECT_EQ(nothing_helps.watch([](const DrawingWay&) { return Duration(90ms); }, minute),
              (DrawingWay{"blend", 1, 1}));
}

TEST(DrawingPace, TheBestPictureComesBackWhenThereIsTimeAgain) {
    Viewer viewer(automatic_ways(2, 0));
    EXPECT_NE(viewer.watch(machine(150ms, 60ms), minute).renderer, "blend");
    EXPECT_EQ(viewer.watch(machine(8ms, 5ms), minute), (DrawingWay{"blend", 1, 1}));
}

TEST(DrawingPace, DoesNotSwingToAndFro) {
    for (const Duration points : {12ms, 16ms, 20ms, 30ms, 38ms, 45ms, 80ms, 160ms, 400ms})
        for (const Duration pixels : {2ms, 10ms, 25ms, 60ms}) {
            Viewer viewer(automatic_ways(2, 0));
            viewer.watch(machine(points, pixels), 30s);
            viewer.changes = 0;
            viewer.watch(machine(points, pixels), 10 * minute);
            EXPECT_EQ(viewer.changes, 0) << points.count() << " " << pixels.count();
        }
}

// A GPU whose queue fills only while the viewer moves: at rest it seems fast.
TEST(DrawingPace, WhatFailsAgainAndAgainIsTriedEverLessOften) {
    Viewer viewer(automatic_ways(2, 0));
    const Machine moving = [](const DrawingWay& way) {
        return way.renderer == "blend" ? 60ms : 20ms;
    };
    const Machine resting = [](const DrawingWay&) { return 4ms; };
    const auto changes_in_ten_minutes = [&] {
        const int before = viewer.changes;
        for (int i = 0; i < 100; ++i) {
            viewer.watch(moving, 3s);
            viewer.watch(resting, 3s);
        }
        return viewer.changes - before;
    };
    EXPECT_LE(changes_in_ten_minutes(), 30);
    EXPECT_LE(changes_in_ten_minutes(), 8);
}

TEST(DrawingPace, WithoutAGraphicsCardItBeginsSimplyAndGoesUpWhereThereIsTime) {
    const auto ways = automatic_ways(2, 0);
    Viewer viewer(ways);
    viewer.pace = DrawingPace(ways, begin_without_gpu(ways));
    EXPECT_EQ(viewer.pace.way(), (DrawingWay{"mesh", 1, 1}));
    viewer.watch([](const DrawingWay&) { return Duration(5ms); }, 20s);
    EXPECT_EQ(viewer.pace.way(), ways.front());

    viewer.pace = DrawingPace(ways, begin_without_gpu(ways));
    viewer.used.clear();
    viewer.watch(
        [](const DrawingWay& way) { return way.scale < 1 ? Duration(20ms) : Duration(80ms); }, 20s);
    EXPECT_EQ(viewer.used, std::set<std::string>{"mesh"});
    EXPECT_EQ(begin_without_gpu(ways_of("blend", 0)), 0u);
}

TEST(DrawingPace, AHeadsetBeginsSimplyOrAsTheWindowWasMeasuredToCarry) {
    const auto ways = automatic_ways(2, 0);
    EXPECT_EQ(ways[begin_with_headset(ways, ways.front())], (DrawingWay{"mesh", 1, 1}));
    EXPECT_EQ(ways[begin_with_headset(ways, ways.back())], ways.back());
    EXPECT_EQ(begin_with_headset(ways, {"disc", 1, 1}), begin_without_gpu(ways));
    EXPECT_EQ(begin_with_headset(ways_of("blend", 0), {"mesh", 1, 1}), 0u);
}

TEST(DrawingPace, OneSlowPictureChangesNothing) {
    Viewer viewer(automatic_ways(2, 0));
    int i = 0;
    viewer.watch([&](const DrawingWay&) { return ++i % 8 == 0 ? Duration(2s) : Duration(10ms); },
                 minute);
    EXPECT_EQ(viewer.changes, 0);
}

}  // namespace
}  // namespace theatron::pace

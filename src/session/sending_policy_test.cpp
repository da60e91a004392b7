// SPDX-License-Identifier: Apache-2.0
#include "session/sending_policy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "session/ladder.h"

namespace theatron::session {
namespace {

constexpr double mbit = 125'000;

// A camera of 40 Mbit/s: depth by layers, then colour ever coarser.
std::vector<StepNeed> camera(double scale = 1) {
    std::vector<StepNeed> needs;
    for (const double megabits : {40.0, 22.0, 12.0, 9.5, 8.8, 8.0}) {
        const double frames = megabits == 40 ? 30 : megabits == 22 ? 15 : 7.5;
        needs.push_back({megabits * mbit * scale, megabits * mbit * scale / frames});
    }
    return needs;
}

// A link as the policy sees it: frames are late when more is sent than it
// carries, by as much as waits in front of it.
class Link {
public:
    explicit Link(unsigned seed = 1) : random_(seed) {}

    double carries = 100 * mbit;
    Duration delay = std::chrono::milliseconds(30);
    Duration jitter{};

    LinkMeasure measure(const StepNeed& need) {
        waiting_ += (need.bytes_per_second - carries) * 0.1;
        waiting_ = std::max(waiting_, 0.0);
        LinkMeasure m;
        // The newest wins: it takes the place of the one that waits.
        if (waiting_ > need.bytes_at_once) {
            waiting_ = std::fmod(waiting_, need.bytes_at_once);
            m.dropped = 1;
        }
        m.bytes_per_second = carries;
        m.round_trip = 2 * delay;
        m.delay = delay + seconds_to_duration((waiting_ + need.bytes_at_once) / carries);
        if (jitter > Duration(0))
            m.delay += Duration(std::int64_t(random_() % std::uint64_t(jitter.count())));
        return m;
    }

private:
    double waiting_ = 0;
    std::mt19937 random_;
};

struct Trial {
    Link link;
    SendingPolicy policy;
    SendingGoal goal{std::chrono::milliseconds(130), 0};
    std::vector<StepNeed> needs = camera();
    TimePoint now = from_us(1'000'000);
    int changes = 0, worst = 0;

    void run(double seconds) {
        changes = 0;
        worst = policy.step();
        for (int i = 0; i < int(seconds * 10); ++i) {
            const LinkMeasure m = link.measure(needs[std::size_t(policy.step())]);
            changes += policy.update(m, needs, goal, now);
            worst = std::max(worst, policy.step());
            now += std::chrono::milliseconds(100);
        }
    }
};

TEST(SendingPolicy, LeavesAFastLinkAlone) {
    Trial r;
    r.run(60);
    EXPECT_EQ(r.changes, 0);
    EXPECT_EQ(r.policy.step(), 0);
}

TEST(SendingPolicy, GoesDownWithinASecondToWhatTheLinkCarries) {
    Trial r;
    r.run(5);
    r.link.carries = 10 * mbit;
    r.run(1);
    EXPECT_LE(r.needs[std::size_t(r.policy.step())].bytes_per_second, 10 * mbit);
    EXPECT_EQ(r.policy.reason(), SendingReason::late);
}

TEST(SendingPolicy, ComesBackWhenTheLinkDoes) {
    Trial r;
    r.link.carries = 10 * mbit;
    r.run(10);
    ASSERT_GT(r.worst, 2);
    r.link.carries = 100 * mbit;
    r.run(6);
    EXPECT_EQ(r.policy.step(), 0);
    r.run(60);
    EXPECT_EQ(r.changes, 0);
}

// A sender by BBR was offered little, and needs half a second to find that the link carries more.
TEST(SendingPolicy, ALinkThatLosesPacketsHasTimeToFindAHigherRate) {
    for (const bool loses : {true, false}) {
        SCOPED_TRACE(loses);
        Trial r;
        r.link.carries = 10 * mbit;
        r.run(5);
        ASSERT_GT(r.policy.step(), 0);
        int searches = 0;  // tenths of a second
        for (int i = 0; i < 200; ++i, r.now += 100ms) {
            const int before = r.policy.step();
            const bool searching = searches-- > 0;
            LinkMeasure m;
            m.bytes_per_second = 1.3 * r.needs[std::size_t(before)].bytes_per_second;
            m.round_trip = 40ms;
            m.delay = searching ? 200ms : 70ms;
            m.dropped = searching;
            m.loses_packets = loses;
            r.policy.update(m, r.needs, r.goal, r.now);
            if (r.policy.step() < before)
                searches = 5;
        }
        EXPECT_EQ(r.policy.step() == 0, loses);
    }
}

TEST(SendingPolicy, DoesNotSwingOnASlowLink) {
    for (const double megabits : {9.0, 10.0, 14.0, 20.0, 30.0, 39.0}) {
        SCOPED_TRACE(megabits);
        Trial r;
        r.link.carries = megabits * mbit;
        r.run(10);
        r.run(120);
        EXPECT_LE(r.changes, 10);
        r.run(120);
        EXPECT_LE(r.changes, 6);
    }
}

TEST(SendingPolicy, DoesNotSwingOnANoisyLink) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(seed);
        Trial r;
        r.link = Link(seed);
        r.link.jitter = std::chrono::milliseconds(60);
        r.link.carries = 15 * mbit;
        r.run(10);
        r.run(120);
        EXPECT_LE(r.changes, 14);
    }
}

TEST(SendingPolicy, OneLateFrameIsAnAccident) {
    Trial r;
    r.run(2);
    LinkMeasure late = r.link.measure(r.needs[0]);
    late.delay = std::chrono::milliseconds(400);
    EXPECT_FALSE(r.policy.update(late, r.needs, r.goal, r.now));
    r.run(2);
    EXPECT_EQ(r.policy.step(), 0);
}

TEST(SendingPolicy, APageThatLoadsIsNoSlowLink) {
    Trial r;
    r.run(0.3);
    LinkMeasure pause = r.link.measure(r.needs[0]);
    pause.takes_nothing = true;
    for (int i = 1; i <= 5; ++i) {
        pause.delay = i * std::chrono::milliseconds(100);
        r.policy.update(pause, r.needs, r.goal, r.now += std::chrono::milliseconds(100));
    }
    EXPECT_EQ(r.policy.step(), 0);
    r.run(3);
    EXPECT_EQ(r.policy.step(), 0);
    // Later the same pause is the link's.
    for (int i = 1; i <= 5; ++i) {
        pause.delay = i * std::chrono::milliseconds(100);
        r.policy.update(pause, r.needs, r.goal, r.now += std::chrono::milliseconds(100));
    }
    EXPECT_GT(r.policy.step(), 0);
}

TEST(SendingPolicy, ASlowLinkIsSeenWithinASecondOfTheBeginning) {
    Trial r;
    r.link.carries = 10 * mbit;
    r.run(1.2);
    EXPECT_LE(r.needs[std::size_t(r.policy.step())].bytes_per_second, 10 * mbit);
}

TEST(SendingPolicy, TrialsThatFailBecomeRare) {
    // The link is believed to carry more than it does, so that only trying tells.
    Trial r;
    std::vector<TimePoint> trials;
    for (int i = 0; i < 3000; ++i) {
        LinkMeasure m;
        m.round_trip = std::chrono::milliseconds(60);
        m.delay = std::chrono::milliseconds(r.policy.step() >= 2 ? 80 : 300);
        if (r.policy.update(m, r.needs, r.goal, r.now) && r.policy.reason() == SendingReason::trial)
            trials.push_back(r.now);
        r.now += std::chrono::milliseconds(100);
    }
    ASSERT_GE(trials.size(), 3u);
    EXPECT_LE(trials.size(), 12u);
    EXPECT_GE(trials.back() - trials[trials.size() - 2], std::chrono::seconds(30));
}

TEST(SendingPolicy, AReceiverWithNewTimeIsTriedSoon) {
    Trial r;
    const auto run = [&](int tenths, bool is_busy) {
        for (int i = 0; i < tenths; ++i) {
            LinkMeasure m;
            m.round_trip = std::chrono::milliseconds(60);
            m.delay = std::chrono::milliseconds(is_busy && r.policy.step() < 2 ? 300 : 80);
            r.policy.update(m, r.needs, r.goal, r.now);
            r.now += std::chrono::milliseconds(100);
        }
    };
    run(3000, true);
    Trial before = r;
    run(40, false);
    EXPECT_GT(r.policy.step(), 0);
    r = before;
    r.policy.forget_failures();
    run(40, false);
    EXPECT_EQ(r.policy.step(), 0);
}

TEST(SendingPolicy, StaysBelowACeilingWithoutSwinging) {
    Trial r;
    r.goal.max_bytes_per_second = 15 * mbit;
    r.run(1);
    EXPECT_EQ(r.policy.step(), 2);
    EXPECT_EQ(r.policy.reason(), SendingReason::ceiling);
    // The encoded rate varies with the content of the picture.
    std::mt19937 random(3);
    int changes = 0;
    for (int i = 0; i < 600; ++i) {
        r.needs = camera(0.9 + 0.2 * double(random() % 1000) / 1000);
        r.run(0.1);
        changes += r.changes;
        EXPECT_LE(r.needs[std::size_t(r.policy.step())].bytes_per_second, 15 * mbit);
    }
    EXPECT_EQ(changes, 0);
    r.goal.max_bytes_per_second = 0;
    r.run(5);
    EXPECT_EQ(r.policy.step(), 0);
}

TEST(SendingPolicy, AGoalThatCannotBeReachedDoesNotRuinThePicture) {
    Trial r;
    r.link.delay = std::chrono::milliseconds(400);
    r.run(30);
    EXPECT_EQ(r.policy.step(), 0);
}

TEST(SendingPolicy, WithoutAGoalNothingIsLeftOut) {
    Trial r;
    r.goal.latency = Duration(0);
    r.link.carries = 5 * mbit;
    r.run(30);
    EXPECT_EQ(r.policy.step(), 0);
}

TEST(SendingPolicy, AShorterLadderIsEnteredAtItsEnd) {
    Trial r;
    r.link.carries = 5 * mbit;
    r.run(10);
    ASSERT_EQ(r.policy.step(), 5);
    r.policy.limit(3);
    EXPECT_EQ(r.policy.step(), 2);
}

TEST(Ladder, FramesThenColourThenLossOutsideTheRegion) {
    CodecSteps codecs;
    codecs.layered = [](const std::string& depth) {
        return CodecSteps::Layered{depth + ":layers", false, true};
    };
    codecs.coarser = [](const std::string& color) {
        return std::vector<CodecSteps::Coarser>{{color + "-", 0.5}, {color + "--", 0.25}};
    };
    codecs.lossy_outside_region = [](const std::string& depth) { return depth + ",loss"; };

    const auto ladder = make_ladder("d", "c", codecs, true);
    std::string steps;
    for (const LadderStep& s : ladder)
        steps += std::to_string(s.highest_layer) + " " + s.depth_codec + " " + s.color_codec + "; ";
    EXPECT_EQ(steps,
              "2 d c; 1 d:layers c; 0 d:layers c; 0 d:layers c-; 0 d:layers c--; "
              "0 d:layers,loss c--; ");
    EXPECT_TRUE(ladder.back().lossy_outside_region);

    const auto without_region = make_ladder("d", "c", codecs, false);
    EXPECT_EQ(without_region.size(), ladder.size() - 1);
    for (const LadderStep& s : without_region)
        EXPECT_FALSE(s.lossy_outside_region);
}

}  // namespace
}  // namespace theatron::session

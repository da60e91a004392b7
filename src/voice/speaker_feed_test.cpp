// SPDX-License-Identifier: Apache-2.0
#include "voice/speaker_feed.h"

#include <gtest/gtest.h>

#include <future>
#include <thread>

#include "testing/counted_allocations.h"

namespace theatron::voice {
namespace {

constexpr std::size_t block = 480;
constexpr Duration period = 10ms;

// A loudspeaker and a rendering thread in given time. The sound is the numbers 1, 2, 3 and so on,
// so that each sample tells its place.
class Machine {
public:
    explicit Machine(int channels = 1) : feed(channels), channels_(std::size_t(channels)) {}

    // The device takes this number of samples of each channel. The rendering thread does what it
    // has planned this much later than planned, and sees a call of the device only when it has
    // nothing planned that is due. Returns the samples that are heard.
    std::vector<float> call(TimePoint at, std::size_t samples, Duration delay = {}) {
        work_until(at, delay);
        now_ = at;
        std::vector<float> out(samples * channels_, -1.0f);
        feed.play(out, at);
        if (planned_ > at)
            planned_ = feed.fill([this] { return now_; }, render_);
        return out;
    }

    void work_until(TimePoint end, Duration delay = {}) {
        while (planned_ != TimePoint::max() && planned_ + delay <= end) {
            now_ = planned_ + delay;
            planned_ = feed.fill([this] { return now_; }, render_);
        }
    }

    bool waits_for_the_device() const { return planned_ == TimePoint::max(); }

    SpeakerFeed feed;
    float rendered = 0;  // the newest sample
    TimePoint rendered_at, heard;

private:
    const std::size_t channels_;
    TimePoint now_, planned_ = TimePoint::max();
    const SpeakerFeed::Render render_ = [this](std::span<float> out, TimePoint at) {
        rendered_at = now_;
        heard = at;
        for (float& v : out)
            v = ++rendered;
    };
};

// The samples but silence, which must be complete and in order behind `before`.
float expect_next(const std::vector<float>& out, float before) {
    for (const float v : out)
        if (v != 0) {
            EXPECT_EQ(v, ++before);
        }
    return before;
}

TEST(SpeakerFeed, ABlockIsRenderedJustBeforeItIsAskedFor) {
    Machine machine;
    EXPECT_EQ(machine.call(from_us(0), block), std::vector<float>(block, 0.0f));
    float heard = 0;
    for (int i = 1; i <= 1000; ++i) {
        const TimePoint at = from_us(0) + i * period;
        const auto out = machine.call(at, block);
        ASSERT_EQ(out.front(), heard + 1) << "block " << i;
        heard = expect_next(out, heard);
        ASSERT_EQ(machine.rendered, heard) << "nothing is rendered early";
        ASSERT_EQ(machine.rendered_at, at - SpeakerFeed::least_lead);
        ASSERT_EQ(machine.heard, at);
    }
    EXPECT_EQ(machine.feed.missing(), 0u);
    EXPECT_EQ(machine.feed.lead(), SpeakerFeed::least_lead);
}

TEST(SpeakerFeed, ALateRenderingIsHeardAsSilenceAndCoveredFromThenOn) {
    Machine machine;
    float heard = 0;
    for (int i = 0; i < 100; ++i)
        heard = expect_next(machine.call(from_us(0) + i * period, block), heard);
    // One rendering comes 6 ms after its time: the device finds nothing.
    const auto silent = machine.call(from_us(0) + 100 * period, block, 6ms);
    EXPECT_EQ(silent, std::vector<float>(block, 0.0f));
    EXPECT_EQ(machine.feed.missing(), block);
    machine.work_until(from_us(0) + 101 * period - 4ms, 6ms);
    EXPECT_EQ(machine.feed.lead(), 6ms + SpeakerFeed::lead_margin);
    // The same delay costs nothing any more, and nothing is left out.
    for (int i = 101; i < 300; ++i) {
        const auto out = machine.call(from_us(0) + i * period, block, 6ms);
        ASSERT_EQ(out.front(), heard + 1) << "block " << i;
        heard = expect_next(out, heard);
    }
    EXPECT_EQ(machine.feed.missing(), block);
    // The jitter buffer is told that it is earlier.
    EXPECT_EQ(machine.heard, from_us(0) + 299 * period - 5ms);
    // Without delays the lead gets short again.
    for (int i = 300; i < 300 + int(SpeakerFeed::remembered_delays) + 1; ++i)
        heard = expect_next(machine.call(from_us(0) + i * period, block), heard);
    EXPECT_EQ(machine.feed.lead(), SpeakerFeed::least_lead);
    EXPECT_EQ(machine.feed.missing(), block);
}

TEST(SpeakerFeed, TheLeadIsBounded) {
    Machine machine;
    for (int i = 0; i < 20; ++i)
        (void)machine.call(from_us(0) + i * period, block, 300ms);
    machine.work_until(from_us(1'000'000), 300ms);
    EXPECT_EQ(machine.feed.lead(), SpeakerFeed::most_lead);
}

TEST(SpeakerFeed, DevicesMayAskForAnyNumberOfSamples) {
    for (const std::vector<std::size_t>& sizes : std::vector<std::vector<std::size_t>>{
             {441}, {512}, {1024}, {441, 939}, {100, 2000}, {SpeakerFeed::largest_block}}) {
        for (const int channels : {1, 2}) {
            Machine machine(channels);
            double at_us = 0;
            float heard = 0;
            std::uint64_t missing = 0;
            for (int i = 0; i < 400; ++i) {
                const std::size_t size = sizes[std::size_t(i) % sizes.size()];
                const auto out = machine.call(from_us(std::int64_t(at_us)), size);
                ASSERT_EQ(out.size(), size * std::size_t(channels));
                heard = expect_next(out, heard);
                if (i == 2)  // by now each size is known
                    missing = machine.feed.missing();
                at_us += double(size) / 0.048;
            }
            EXPECT_EQ(machine.feed.missing(), missing) << sizes.front() << ' ' << channels;
        }
    }
}

TEST(SpeakerFeed, ADeviceMayTakeSeveralBlocksAtOnce) {
    Machine machine;
    float heard = 0;
    std::uint64_t missing = 0;
    for (int i = 0; i < 200; ++i)
        for (int k = 0; k < 3; ++k) {
            const TimePoint at = from_us(i * 30'000 + k * 50);
            heard = expect_next(machine.call(at, block), heard);
            if (i == 1)
                missing = machine.feed.missing();
        }
    EXPECT_EQ(machine.feed.missing(), missing);
    EXPECT_LE(missing, 2 * block);
}

TEST(SpeakerFeed, AnUnevenDeviceIsServedFromItsEarliestCalls) {
    Machine machine;
    float heard = 0;
    for (int i = 0; i < 2000; ++i) {
        const Duration late = 1ms * (i * 7 % 8);  // up to 7 ms
        heard = expect_next(machine.call(from_us(0) + i * period + late, block), heard);
    }
    EXPECT_EQ(machine.feed.missing(), 0u);
}

TEST(SpeakerFeed, MoreThanFitsIsSilent) {
    Machine machine;
    const std::size_t size = SpeakerFeed::largest_block * (SpeakerFeed::most_blocks + 1);
    for (int i = 0; i < 10; ++i)
        EXPECT_EQ(machine.call(from_us(i * 400'000), size).back(), 0.0f);
    EXPECT_EQ(machine.call(from_us(4'000'000), 0).size(), 0u);
}

TEST(SpeakerFeed, ADeviceThatStopsFindsTheNextSamplesWhenItComesBack) {
    Machine machine;
    float heard = 0;
    for (int i = 0; i < 100; ++i)
        heard = expect_next(machine.call(from_us(0) + i * period, block), heard);
    machine.work_until(from_us(10'000'000));
    EXPECT_TRUE(machine.waits_for_the_device());
    const float old = machine.rendered - heard;
    EXPECT_LE(old, float(SpeakerFeed::most_blocks * block));
    for (int i = 0; i < 100; ++i) {
        const TimePoint at = from_us(20'000'000) + i * period;
        const auto out = machine.call(at, block);
        ASSERT_EQ(out.front(), heard + 1);
        heard = expect_next(out, heard);
    }
    EXPECT_EQ(machine.feed.missing(), 0u);
    EXPECT_EQ(machine.rendered_at, from_us(20'000'000) + 99 * period - SpeakerFeed::least_lead);
}

TEST(SpeakerFeed, TheDeviceWaitsForNoRenderingAndAllocatesNothing) {
    SpeakerFeed feed(2);
    std::vector<float> out(2 * block);
    feed.play(out, from_us(0));
    std::promise<void> begun, released;
    // Rendering holds all that fill() may hold.
    std::thread rendering([&] {
        (void)feed.fill([] { return from_us(9'000); },
                        [&](std::span<float>, TimePoint) {
                            begun.set_value();
                            released.get_future().wait();
                        });
    });
    begun.get_future().wait();
    testing::allocations = 0;
    testing::counting = true;
    for (int i = 1; i < 200; ++i)
        feed.play(out, from_us(i * 10'000));
    testing::counting = false;
    released.set_value();
    rendering.join();
    EXPECT_EQ(testing::allocations.load(), 0u);  // of sanitizers' builds always
    // Far more calls than are remembered, and the next rendering follows the newest ones all the
    // same.
    float rendered = 0;
    const SpeakerFeed::Render render = [&](std::span<float> samples, TimePoint) {
        for (float& v : samples)
            v = ++rendered;
    };
    (void)feed.fill([] { return from_us(1'990'000); }, render);
    feed.play(out, from_us(2'000'000));
    (void)feed.fill([] { return from_us(2'000'000); }, render);
    (void)feed.fill([] { return from_us(2'009'000); }, render);
    feed.play(out, from_us(2'010'000));
    EXPECT_NE(out.front(), 0.0f);
}

}  // namespace
}  // namespace theatron::voice

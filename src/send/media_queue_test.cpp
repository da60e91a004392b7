// SPDX-License-Identifier: Apache-2.0
#include "send/media_queue.h"

#include <gtest/gtest.h>

namespace theatron::send {
namespace {

EncodedMedia frame(int stream, FrameNumber number, bool key, int setting = 1) {
    EncodedMedia media;
    media.header.stream = StreamId(stream);
    media.header.setting = SettingId(setting);
    media.header.frame = number;
    media.header.key = key;
    return media;
}

std::vector<FrameNumber> numbers(const MediaQueue::Taken& taken) {
    std::vector<FrameNumber> result;
    for (const auto& media : taken.media)
        result.push_back(media.header.frame);
    return result;
}

TEST(MediaQueue, HandsOverInOrderAndTellsOnce) {
    MediaQueue queue;
    EXPECT_TRUE(queue.put(frame(0, 1, true)));
    EXPECT_FALSE(queue.put(frame(0, 2, false)));
    const auto taken = queue.take();
    EXPECT_EQ(numbers(taken), (std::vector<FrameNumber>{1, 2}));
    EXPECT_TRUE(taken.dropped.empty());
    EXPECT_TRUE(taken.broken.empty());
    EXPECT_TRUE(queue.put(frame(0, 3, false)));
}

TEST(MediaQueue, StaysBoundedWhileNobodyTakesAndGoesOnWithAKeyFrame) {
    MediaQueue queue;
    for (FrameNumber n = 0; n < 1000; ++n)
        (void)queue.put(frame(0, n, n == 0));
    auto taken = queue.take();
    EXPECT_TRUE(taken.media.empty());
    EXPECT_EQ(taken.dropped[StreamId{0}], 1000u);
    ASSERT_EQ(taken.broken.size(), 1u);
    EXPECT_EQ(taken.broken[0].first, StreamId{0});

    (void)queue.put(frame(0, 1000, false));
    (void)queue.put(frame(0, 1001, true));
    (void)queue.put(frame(0, 1002, false));
    taken = queue.take();
    EXPECT_EQ(numbers(taken), (std::vector<FrameNumber>{1001, 1002}));
    EXPECT_EQ(taken.dropped[StreamId{0}], 1u);
    EXPECT_TRUE(taken.broken.empty());
}

TEST(MediaQueue, KeepsSecondsWhileSomebodyRecords) {
    MediaQueue queue;
    queue.keep_everything(true);
    for (FrameNumber n = 0; n < MediaQueue::max_kept; ++n)
        (void)queue.put(frame(0, n, n == 0));
    auto taken = queue.take();
    EXPECT_EQ(taken.media.size(), MediaQueue::max_kept);
    EXPECT_TRUE(taken.dropped.empty());

    for (FrameNumber n = 0; n <= MediaQueue::max_kept; ++n)
        (void)queue.put(frame(0, n, n == 0));
    EXPECT_EQ(queue.take().dropped[StreamId{0}], MediaQueue::max_kept + 1);

    queue.keep_everything(false);
    for (FrameNumber n = 0; n <= MediaQueue::max_waiting; ++n)
        (void)queue.put(frame(0, n, true));
    EXPECT_EQ(queue.take().dropped[StreamId{0}], MediaQueue::max_waiting);
}

TEST(MediaQueue, KeepsNoMoreBytesThanItSaysAlsoForARecorder) {
    MediaQueue queue;
    queue.keep_everything(true);
    const auto put = [&](int stream) {
        EncodedMedia media = frame(stream, 1, true);
        media.message = std::make_shared<Bytes>(MediaQueue::max_kept_bytes / 4);
        (void)queue.put(std::move(media));
    };
    for (int stream = 0; stream < 4; ++stream)
        put(stream);
    put(0);  // its own waiting frame goes, not another stream's
    const auto taken = queue.take();
    EXPECT_EQ(taken.media.size(), 4u);
    EXPECT_EQ(taken.dropped.at(StreamId{0}), 1u);
    EXPECT_EQ(taken.dropped.size(), 1u);
}

TEST(MediaQueue, OneStreamDoesNotCostAnotherItsFrames) {
    MediaQueue queue;
    (void)queue.put(frame(0, 1, true));
    for (FrameNumber n = 0; n < 100; ++n)
        (void)queue.put(frame(1, n, true));
    const auto taken = queue.take();
    ASSERT_FALSE(taken.media.empty());
    EXPECT_EQ(taken.media.front().header.stream, StreamId{0});
    EXPECT_LE(taken.media.size(), 1 + MediaQueue::max_waiting);
    EXPECT_EQ(taken.media.back().header.frame, 99u);
}

}  // namespace
}  // namespace theatron::send

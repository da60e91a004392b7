// SPDX-License-Identifier: Apache-2.0
#include "client/decoder_messages.h"

#include <gtest/gtest.h>

namespace theatron::client {
namespace {

TEST(DecoderMessages, AFrameArrivesWithItsTimesAndImages) {
    const Bytes depth(12, std::byte(7)), color(18, std::byte(9));
    WorkerFrame sent;
    sent.generation = 3;
    sent.camera = CameraId(2);
    sent.number = 41;
    sent.moment = TimePoint(Duration(5));
    sent.times.captured = TimePoint(Duration(-6));
    sent.times.decoded = TimePoint(Duration(7));
    sent.depth_size = sent.color_size = {3, 2};
    sent.depth = depth;
    sent.color = color;
    const Bytes bytes = encode(FromWorker(sent));
    const auto decoded = decode_from_worker(bytes);
    ASSERT_TRUE(decoded);
    const auto& frame = std::get<WorkerFrame>(*decoded);
    EXPECT_EQ(frame.generation, 3u);
    EXPECT_EQ(frame.camera, CameraId(2));
    EXPECT_EQ(frame.number, 41u);
    EXPECT_EQ(frame.moment, sent.moment);
    EXPECT_EQ(frame.times.captured, sent.times.captured);
    EXPECT_EQ(frame.times.decoded, sent.times.decoded);
    EXPECT_EQ(frame.color_size, sent.color_size);
    EXPECT_EQ(Bytes(frame.depth.begin(), frame.depth.end()), depth);
    EXPECT_EQ(Bytes(frame.color.begin(), frame.color.end()), color);
    EXPECT_FALSE(frame.same_color);
}

TEST(DecoderMessages, CamerasSettingsAndFiguresArrive) {
    wire::Camera camera;
    camera.id = CameraId(4);
    camera.name = "left";
    camera.depth_stream = StreamId(8);
    camera.color_stream = StreamId(9);
    const auto cameras = decode_to_worker(encode(ToWorker(WorkerCameras{9, true, {camera}})));
    ASSERT_TRUE(cameras);
    EXPECT_TRUE(std::get<WorkerCameras>(*cameras).anew);
    ASSERT_EQ(std::get<WorkerCameras>(*cameras).cameras.size(), 1u);
    EXPECT_EQ(std::get<WorkerCameras>(*cameras).cameras[0].name, "left");

    const wire::StreamSetting setting{StreamId(8), SettingId(3), "strata"};
    const auto settings = decode_to_worker(encode(ToWorker(WorkerSettings{{setting}})));
    ASSERT_TRUE(settings);
    EXPECT_EQ(std::get<WorkerSettings>(*settings).settings, std::vector{setting});

    receive::StreamFigures figures;
    figures.stream = StreamId(8);
    figures.codec = "strata";
    figures.frames = 70;
    figures.exact = receive::Exactness::everywhere;
    figures.age_p50_ms = 12.5;
    figures.decode_ms = 3.5;
    figures.decoder_failures = 4;
    figures.awaited_ms = 900;
    figures.has_come = true;
    const auto told = decode_from_worker(encode(FromWorker(WorkerFigures{2, {figures}})));
    ASSERT_TRUE(told);
    const auto& first = std::get<WorkerFigures>(*told).figures.at(0);
    EXPECT_EQ(first.codec, "strata");
    EXPECT_EQ(first.frames, 70u);
    EXPECT_EQ(first.exact, receive::Exactness::everywhere);
    EXPECT_EQ(first.age_p50_ms, 12.5);
    EXPECT_EQ(first.decode_ms, 3.5);
    EXPECT_EQ(first.decoder_failures, 4u);
    EXPECT_EQ(first.awaited_ms, 900);
    EXPECT_EQ(first.has_come, true);
}

TEST(DecoderMessages, EveryShorterMessageIsRefused) {
    const Bytes message(5, std::byte(1));
    const Bytes bytes = encode(ToWorker(WorkerMedia{1, Duration(2), message}));
    ASSERT_TRUE(decode_to_worker(bytes));
    for (std::size_t size = 0; size < bytes.size(); ++size)
        EXPECT_FALSE(decode_to_worker(ByteView(bytes).first(size))) << size;
    EXPECT_FALSE(decode_to_worker(Bytes{std::byte(77)}));
}

}  // namespace
}  // namespace theatron::client

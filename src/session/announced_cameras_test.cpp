// SPDX-License-Identifier: Apache-2.0
#include "session/announced_cameras.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/calibration.h"
#include "session/viewer_session.h"

namespace theatron::session {
namespace {

Calibration calibration(Size depth, Size color) {
    Calibration c;
    c.depth.size = depth;
    c.depth.fx = c.depth.fy = c.color.fx = c.color.fy = 500;
    c.color.size = color;
    return c;
}

wire::Camera camera(int number, Size depth = {64, 48}, Size color = {128, 96}) {
    wire::Camera c;
    c.id = CameraId(number);
    c.name = "camera " + std::to_string(number);
    c.depth_stream = depth_stream(c.id);
    c.color_stream = color_stream(c.id);
    c.has_color = true;
    c.frames_per_second = 30;
    c.calibration = encode_calibration(calibration(depth, color));
    return c;
}

std::size_t accepted(const std::vector<wire::Camera>& cameras) {
    const AnnouncedCameras judged = judge_cameras(cameras);
    EXPECT_EQ(judged.accepted.size() + judged.left_out.size(), cameras.size());
    return judged.accepted.size();
}

TEST(AnnouncedCameras, OrdinaryOnesAreAccepted) {
    EXPECT_EQ(accepted({camera(0), camera(1), camera(62)}), 3u);
    wire::Camera without_color = camera(3, {640, 576}, {0, 0});
    without_color.has_color = false;
    EXPECT_EQ(accepted({without_color}), 1u);
}

TEST(AnnouncedCameras, NumbersAreInRangeAndDiffer) {
    EXPECT_EQ(accepted({camera(max_camera_number)}), 1u);
    EXPECT_EQ(accepted({camera(max_camera_number + 1)}), 0u);
    std::vector<wire::Camera> many;
    for (int i = 0; i <= int(wire::max_cameras); ++i)
        many.push_back(camera(1000 + i));
    EXPECT_EQ(accepted(many), wire::max_cameras);
    EXPECT_EQ(accepted({camera(5), camera(5)}), 1u);
    EXPECT_EQ(judge_cameras({camera(5), camera(5)}).left_out.front(),
              (wire::Text{wire::TextCode::camera_number_taken, {"camera 5"}}));
}

TEST(AnnouncedCameras, StreamsAreTheirOwn) {
    wire::Camera thief = camera(1);
    thief.depth_stream = depth_stream(CameraId{0});
    EXPECT_EQ(accepted({camera(0), thief}), 1u);
    thief = camera(1);
    thief.color_stream = thief.depth_stream;
    EXPECT_EQ(accepted({thief}), 0u);
}

TEST(AnnouncedCameras, RatesAndCalibrationsMakeSense) {
    for (const double rate : {-1.0, 1e9, std::nan(""), double(INFINITY)}) {
        wire::Camera odd = camera(0);
        odd.frames_per_second = rate;
        EXPECT_EQ(accepted({odd}), 0u) << rate;
    }
    Calibration flat = *decode_calibration(camera(0).calibration);
    flat.depth = {};
    wire::Camera without_depth = camera(0);
    without_depth.calibration = encode_calibration(flat);
    EXPECT_EQ(judge_cameras({without_depth, camera(1)}).left_out,
              (std::vector{wire::Text{wire::TextCode::camera_without_depth, {"camera 0"}}}));
    wire::Camera uncalibrated = camera(0);
    uncalibrated.calibration.pop_back();
    EXPECT_EQ(accepted({uncalibrated}), 0u);
}

TEST(AnnouncedCameras, PixelsAreLimitedForOneAndForAllTogether) {
    EXPECT_EQ(accepted({camera(0, {2048, 2048})}), 1u);
    EXPECT_EQ(accepted({camera(0, {2048, 2049})}), 0u);
    EXPECT_EQ(accepted({camera(0, {8192, 8192})}), 0u);
    EXPECT_EQ(accepted({camera(0, {64, 48}, {4096, 3072})}), 1u);
    EXPECT_EQ(accepted({camera(0, {64, 48}, {8192, 8192})}), 0u);
    std::vector<wire::Camera> many;
    for (int i = 0; i < int(wire::max_cameras); ++i)
        many.push_back(camera(i, {2048, 2048}, {4096, 3072}));
    EXPECT_EQ(accepted(many), max_total_depth_pixels / max_depth_pixels);
    for (auto& c : many)
        c = camera(int(c.id), {64, 48}, {4096, 3072});
    EXPECT_EQ(accepted(many), max_total_color_pixels / max_color_pixels);
}

TEST(AnnouncedCameras, ShapesMayDifferAsTheyLike) {
    EXPECT_EQ(accepted({camera(0, {8192, 512}), camera(1, {512, 8192})}), 2u);
    EXPECT_EQ(accepted({camera(0, {64, 48}, {8192, 1024}), camera(1, {64, 48}, {1024, 8192})}), 2u);
    EXPECT_EQ(accepted({camera(0, {640, 576}, {3840, 2160}), camera(1, {512, 512}, {2160, 3840})}),
              2u);
}

TEST(ViewerSession, KnowsOnlyTheCamerasThatItAccepted) {
    ViewerSession viewer({});
    wire::Welcome welcome{wire::protocol_max, {}, "host", {camera(0), camera(0), camera(4)}};
    ASSERT_EQ(viewer.on_control(wire::encode(welcome)), ViewerSession::Change::welcomed);
    EXPECT_EQ(viewer.cameras().size(), 2u);
    EXPECT_EQ(viewer.left_out().size(), 1u);

    for (int id = 0; id < 4000; ++id)
        (void)viewer.on_control(wire::encode(wire::ToParticipant(wire::CameraState{
            CameraId(id), wire::CameraCondition::failed, wire::as_written("gone"), ""})));
    EXPECT_EQ(viewer.camera_states().size(), 2u);
    EXPECT_EQ(viewer.camera_states().at(CameraId{4}).problem, wire::as_written("gone"));
}

TEST(ViewerSession, CamerasThatComeAndLeaveChangeNoOther) {
    ViewerSession viewer({});
    (void)viewer.on_control(wire::encode(wire::CamerasAdded{{camera(7)}}));
    EXPECT_TRUE(viewer.cameras().empty()) << "it has not joined";
    (void)viewer.on_control(
        wire::encode(wire::Welcome{wire::protocol_max, {}, "host", {camera(0), camera(1)}}));
    (void)viewer.on_control(wire::encode(wire::Settings{
        {{StreamId{0}, SettingId{1}, "raw"}, {StreamId{2}, SettingId{2}, "rvl"}}, {}}));
    EXPECT_EQ(viewer.on_control(wire::encode(wire::CamerasAdded{{camera(900), camera(1)}})),
              ViewerSession::Change::cameras);
    ASSERT_EQ(viewer.cameras().size(), 3u);
    EXPECT_EQ(viewer.left_out().size(), 1u) << "one has a number that is taken";
    (void)viewer.on_control(
        wire::encode(wire::Settings{{{depth_stream(CameraId{900}), SettingId{3}, "lz4"},
                                     {depth_stream(CameraId{33}), SettingId{4}, "lz4"}},
                                    {}}));
    EXPECT_EQ(viewer.settings().size(), 3u) << "nothing is kept of a camera that is not there";
    wire::Camera foreign = camera(901);
    foreign.session = wire::SessionId{1};
    (void)viewer.on_control(wire::encode(wire::CamerasAdded{{foreign}}));
    EXPECT_EQ(viewer.cameras().size(), 3u) << "it is of another session";
    EXPECT_EQ(viewer.on_control(wire::encode(wire::CamerasRemoved{{CameraId{0}}})),
              ViewerSession::Change::cameras);
    ASSERT_EQ(viewer.cameras().size(), 2u);
    EXPECT_EQ(viewer.cameras()[0].id, CameraId{1});
    ASSERT_EQ(viewer.settings().size(), 2u);
    EXPECT_EQ(viewer.settings()[0].codec, "rvl") << "as it was";
}

TEST(ViewerSession, KeepsNoStateOfCamerasBeforeTheyAreAnnounced) {
    ViewerSession viewer({});
    const wire::ToParticipant state = wire::CameraState{CameraId{0}, {}, {}, ""};
    EXPECT_EQ(viewer.on_control(wire::encode(state)), ViewerSession::Change::nothing);
    EXPECT_TRUE(viewer.camera_states().empty());
}

}  // namespace
}  // namespace theatron::session

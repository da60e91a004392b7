// SPDX-License-Identifier: Apache-2.0
#include "bench_clouds.h"

#include <numbers>

#include "base/error.h"

namespace theatron::bench {

void upload(render::CloudSet& clouds, int id, const RenderBenchCamera& camera) {
    if (clouds.upload(CameraId(id), camera.depth.view(), camera.color.view()) != Status::ok)
        throw Error("A camera's images do not have the size of its calibration.");
}

FurnishedRoom::FurnishedRoom(render::SceneQuality quality, const render::CameraView& view)
    : view_(view), people_(2) {
    frame_.quality = quality;
    room_.set_cameras({});
    const Pose turned{rotation_about({1, 0, 0}, std::numbers::pi), {}};
    for (int i = 0; i < 2; ++i) {
        Pose head = view.room_from_eye * turned;
        head.translation = view.room_from_eye * Vec3{i ? 0.5 : -0.5, 0.1, 1.4};
        people_[std::size_t(i)].id = ParticipantId{std::uint32_t(i + 1)};
        people_[std::size_t(i)].head = head;
        head.translation = view.room_from_eye * Vec3{i ? 0.2 : -0.2, 0.3, 1.2};
        people_[std::size_t(i)].right_hand = head;
    }
}

void FurnishedRoom::forget() {
    room_ = {};
    room_.set_cameras({});
}

const render::SceneFrame& FurnishedRoom::fill() {
    frame_.objects.clear();
    frame_.texts.clear();
    room_.build(frame_.quality);
    room_.add_to(frame_, view_);
    avatars_.add_to(frame_, people_, view_);
    return frame_;
}

}  // namespace theatron::bench

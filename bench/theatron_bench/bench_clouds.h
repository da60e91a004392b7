// SPDX-License-Identifier: Apache-2.0
// Shared by the benchmarks that draw: one camera's images, a clock around the GPU, and the
// furnished room with two people. Needs the GL context current.
#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "geometry/calibration.h"
#include "image/image.h"
#include "render/cloud_set.h"
#include "render/gl.h"
#include "render/scene_frame.h"
#include "room/people.h"
#include "room/virtual_room.h"

namespace theatron::bench {

// The input of one camera: calibration and pictures.
struct RenderBenchCamera {
    Calibration calibration;
    DepthImage depth;
    ColorImage color;
};

// The time until the GPU has finished `work`, in milliseconds.
template <class Work>
double gpu_ms(const Work& work) {
    glFinish();
    const auto start = std::chrono::steady_clock::now();
    work();
    glFinish();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
        .count();
}

// Throws Error if the images do not have the size of the calibration.
void upload(render::CloudSet& clouds, int id, const RenderBenchCamera& camera);

// The virtual operating room with all its furniture, as if no camera saw any of it, and two people
// who face the eye of `view`.
class FurnishedRoom {
public:
    FurnishedRoom(render::SceneQuality quality, const render::CameraView& view);

    // The room is made again by the next fill().
    void forget();
    // The room and its people for the next picture; the first call makes the room.
    const render::SceneFrame& fill();

private:
    render::CameraView view_;
    room::VirtualRoom room_;
    room::People avatars_;
    std::vector<room::RoomPerson> people_;
    render::SceneFrame frame_;
};

}  // namespace theatron::bench

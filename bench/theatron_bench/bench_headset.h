// SPDX-License-Identifier: Apache-2.0
// The time of a headset's picture: two eyes, the furnished room, people and live clouds.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "bench_clouds.h"
#include "render/offscreen_context_native.h"
#include "render/render_target.h"
#include "render/room_picture.h"

namespace theatron::bench {

// The sizes of HTC's Vive Pro Eye, the headset of Fischer et al.: pixels of an eye's panel, and
// about the vertical field of view.
inline constexpr Size vive_pro_eye{1440, 1600};
inline constexpr double vive_pro_eye_degrees = 98;

struct HeadsetTiming {
    int pictures = 15;   // at most; at least one
    double seconds = 4;  // after this time no further one is begun
    bool operator==(const HeadsetTiming&) const = default;
};

// Draws offscreen, with a GL context of its own, which stays current.
class HeadsetBench {
public:
    // All images have the sizes of their calibrations. The eyes are at the first camera and look at
    // the nearest surface before it. Throws Error if there is no GL.
    HeadsetBench(std::vector<RenderBenchCamera> cameras, Size eye);

    std::string renderer_name() const { return context_.renderer_name(); }

    // The median time of a picture of both eyes that shows the first `count` cameras, whose images
    // are all uploaded for each picture: wall clock around glFinish. Before the first picture of
    // its kind a small one, which compiles programs, is drawn and not counted, and the cloud is
    // checked: without a GPU a large one takes as long as those that count. Throws Error for an
    // unknown renderer, an empty cloud, and errors of the driver.
    double picture_ms(int count, const std::string& renderer, render::SceneQuality quality,
                      const HeadsetTiming& timing);

private:
    FurnishedRoom& room(render::SceneQuality quality);
    render::CloudSet& clouds(int count);
    void draw(int count, const std::string& renderer, render::SceneQuality quality,
              const render::RenderTarget& left, const render::RenderTarget& right);
    void check_cloud(int count, const std::string& renderer);

    render::OffscreenContext context_;  // longer than the objects below
    std::vector<RenderBenchCamera> cameras_;
    render::CameraView middle_;
    render::RenderTarget left_, right_, small_left_, small_right_;
    std::shared_ptr<render::CloudPrograms> programs_;
    std::map<int, render::CloudSet> clouds_;  // by the number of cameras
    std::map<render::SceneQuality, FurnishedRoom> rooms_;
    std::set<std::tuple<int, std::string, render::SceneQuality>> drawn_;  // kinds of picture
    render::ScenePasses passes_;
};

}  // namespace theatron::bench

// SPDX-License-Identifier: Apache-2.0
#include "render/room_picture.h"

#include "render/render_target.h"

namespace theatron::render {
namespace {

constexpr Rgb background{32, 34, 38};

}  // namespace

void draw(const RoomPicture& picture, ScenePasses* passes) {
    for (const DrawnClouds& clouds : picture.clouds)
        check_renderer_name(clouds.renderer);
    if (picture.scene && !picture.eyes.empty())
        passes->prepare(*picture.scene, picture.eyes[0].view, picture.eyes[0].target.size);
    for (const EyePicture& eye : picture.eyes) {
        if (picture.scene)
            passes->draw_opaque(*picture.scene, eye.view, eye.target);
        for (const DrawnClouds& clouds : picture.clouds)
            clouds.set->draw(eye.view, eye.target, clouds.renderer);
        if (picture.scene)
            passes->draw_translucent(*picture.scene, eye.view, eye.target);
    }
}

std::array<CameraView, 2> stereo_pair(const CameraView& middle, double eye_distance_m) {
    std::array<CameraView, 2> eyes{middle, middle};
    eyes[0].room_from_eye.translation = middle.room_from_eye * Vec3{-eye_distance_m / 2, 0, 0};
    eyes[1].room_from_eye.translation = middle.room_from_eye * Vec3{eye_distance_m / 2, 0, 0};
    return eyes;
}

Picture draw_and_read(const SceneFrame* scene, const std::vector<DrawnClouds>& clouds,
                      const std::vector<CameraView>& eyes, Size size, ScenePasses* passes) {
    const RenderTarget target({size.width * int(eyes.size()), size.height});
    target.clear(background);
    RoomPicture picture{scene, clouds, {}};
    for (const CameraView& view : eyes)
        picture.eyes.push_back(
            {view, {target.target().framebuffer, size.width * int(picture.eyes.size()), 0, size}});
    draw(picture, passes);
    return target.read();
}

}  // namespace theatron::render

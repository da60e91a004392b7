// SPDX-License-Identifier: Apache-2.0
// The screens that participants share: their pictures in the room, each with its name and age.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/participant_figures.h"
#include "geometry/screen.h"
#include "render/scene_frame.h"

namespace theatron::viewer {

struct ScreenCaption {
    std::string text;
    bool is_trouble = false;  // the picture stands still, is old, or has not come
    bool operator==(const ScreenCaption&) const = default;
};

// The caption of a screen whose newest picture has this age; nullopt: none has come. Pure.
ScreenCaption screen_caption(const std::string& name, const wire::CameraState& state,
                             std::optional<double> age_ms);

// Use from one thread, with the same GL context current.
class SharedScreens {
public:
    // Adds the screen or changes it. Precondition: is_screen(calibration).
    void set_camera(CameraId camera, const std::string& name, const Calibration& calibration);
    void remove_camera(CameraId camera) { screens_.erase(camera); }
    bool empty() const { return screens_.empty(); }
    bool has(CameraId camera) const { return screens_.count(camera) > 0; }

    void take(const receive::CameraFrame& frame);
    // Writes the captions at session time `now`. True if one of them has changed.
    bool note(const std::vector<client::CameraFigures>& cameras, TimePoint now);

    // The appended objects are valid until the next call of another function.
    void add_to(render::SceneFrame& frame);

private:
    struct Screen {
        std::string name;
        Calibration calibration;
        ScreenCaption caption;
        std::shared_ptr<const ColorImage> color;
        TimePoint captured;   // of `color`
        bool is_new = false;  // `color` is not in the texture
        std::optional<render::SceneTexture> texture;
        std::optional<render::SceneMesh> panel, housing;
    };
    std::map<CameraId, Screen> screens_;
};

}  // namespace theatron::viewer

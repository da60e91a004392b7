// SPDX-License-Identifier: Apache-2.0
// The screens that participants share: their pictures in the room, each with its name and age.
//
// A screen stands where its object of the room is (session/shared_screen.h), or, at a host that has
// no such objects, where its camera's calibration says.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/participant_figures.h"
#include "geometry/screen.h"
#include "render/scene_frame.h"
#include "session/shared_screen.h"

namespace theatron::viewer {

struct ScreenCaption {
    std::string text;
    bool is_trouble = false;  // the picture stands still, is old, or has not come
    bool operator==(const ScreenCaption&) const = default;
};

// The caption of a screen whose newest picture has this age; nullopt: none has come. `is_past`: the
// person looks back, and the picture is of then. Pure.
ScreenCaption screen_caption(const std::string& name, const wire::CameraState& state,
                             std::optional<double> age_ms, bool is_past = false);

// Use from one thread, with the same GL context current.
class SharedScreens {
public:
    // Adds the screen or changes it. Precondition: is_screen(calibration).
    void set_camera(CameraId camera, const std::string& name, const Calibration& calibration);
    void remove_camera(CameraId camera) { screens_.erase(camera); }
    // Moves the screens to where their objects are. The host sends `self` no pictures of its own
    // screens: an empty screen stands for each of them. True if the picture changes.
    bool follow(const session::RoomObjects& objects, ParticipantId self);
    bool empty() const { return screens_.empty() && own_.empty(); }
    bool has(CameraId camera) const { return screens_.count(camera) > 0; }

    void take(const receive::CameraFrame& frame);
    // Writes the captions at session time `now`. True if one of them has changed.
    bool note(const std::vector<client::CameraFigures>& cameras, TimePoint now);

    // The appended objects are valid until the next call of another function.
    void add_to(render::SceneFrame& frame);

private:
    // The object of a screen.
    struct Object {
        session::ObjectId id{};
        ScreenPlace place;
        bool pinned = false;
        ParticipantId holder{};
        bool operator==(const Object&) const = default;
    };
    struct Screen {
        std::string name;
        Calibration calibration;
        std::optional<Object> object;
        ScreenCaption caption;
        std::shared_ptr<const ColorImage> color;
        TimePoint captured;  // of `color`
        bool is_past = false;
        bool is_faint = false;  // it stands still and is not marked otherwise, as noted last
        bool is_new = false;    // `color` is not in the texture
        std::optional<render::SceneTexture> texture;
        // One metre wide.
        std::optional<render::SceneMesh> panel, housing;
    };
    static void add(Screen& screen, render::SceneFrame& frame);

    std::map<CameraId, Screen> screens_;
    std::map<CameraId, Screen> own_;
};

}  // namespace theatron::viewer

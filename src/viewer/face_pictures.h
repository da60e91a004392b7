// SPDX-License-Identifier: Apache-2.0
// The pictures of participants' faces (wire::CameraKind::face) for the heads of their avatars. One
// that stands still fades away, so that nobody talks to a frozen picture.
#pragma once

#include <map>
#include <memory>
#include <optional>

#include "geometry/calibration.h"
#include "receive/receiver.h"
#include "render/scene_frame.h"
#include "room/people.h"

namespace theatron::viewer {

// A picture of this age is opaque, fades, and is not drawn any more. Pure; from 1 to 0.
inline constexpr double fresh_face_ms = 1500, gone_face_ms = 3000;
double face_opacity(double age_ms);

// Use from one thread, with the same GL context current.
class FacePictures {
public:
    // Adds the picture or changes it. Precondition: is_screen(calibration).
    void set_camera(ParticipantId person, CameraId camera, const Calibration& calibration);
    void remove_camera(CameraId camera) { faces_.erase(camera); }
    bool has(CameraId camera) const { return faces_.count(camera) > 0; }

    // `now` is session time.
    void take(const receive::CameraFrame& frame, TimePoint now);
    // Ages the pictures. True if one of them looks another way than before.
    bool note(TimePoint now);

    // Those that can be seen; valid until the next call of another function.
    std::map<ParticipantId, room::FacePicture> pictures();

private:
    struct Face {
        ParticipantId person{};
        Size size;
        std::shared_ptr<const ColorImage> color;
        TimePoint captured, taken;  // of `color`
        double opacity = 0;
        std::string age;
        bool is_new = false;  // `color` is not in the texture
        std::optional<render::SceneTexture> texture;
    };
    std::map<CameraId, Face> faces_;
};

}  // namespace theatron::viewer

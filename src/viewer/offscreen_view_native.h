// SPDX-License-Identifier: Apache-2.0
// A participant's view, drawn offscreen: the newest frames of all cameras.
#pragma once

#include <optional>
#include <string>

#include "render/offscreen_context_native.h"
#include "viewer/live_scene.h"
#include "viewer/view_choice.h"

namespace theatron::viewer {

// Use from one thread.
class OffscreenView {
public:
    explicit OffscreenView(RoomChoice room = {}, std::vector<SeenPerson> people = {})
        : scene_(room, std::move(people)) {
        scene_.set_cover_shown(true);
    }

    // Takes over new cameras and frames; true if they change the picture. Throws as LiveScene does.
    bool take(client::Participant& participant) {
        const bool is_new = !scene_.take(participant).empty();
        return scene_.take_meeting(participant) || is_new;
    }
    // Frames wait for those of other cameras: take() must be called again soon.
    bool waits() const { return scene_.same_moment().waits(); }
    // Needs can_draw(view); throws Error if the view is impossible. In a meeting without cameras it
    // is that of the place where this participant begins.
    render::CameraView view(const ViewChoice& view, Size size) const;

    // A camera has sent a picture, or the host has no camera. View and picture need more:
    bool has_picture() const { return scene_.has_picture() || meets_without_cameras(); }
    // The same, and the camera of this view has sent one, or never will: then view() throws.
    bool can_draw(const ViewChoice& view) const {
        return has_picture() && (scene_.newest().contains(view.camera) ||
                                 !scene_.calibrations().contains(view.camera));
    }
    // The frame of a camera that the next picture shows; null before its first one.
    receive::CameraFramePtr newest(CameraId camera) const {
        const auto frame = scene_.newest().find(camera);
        return frame == scene_.newest().end() ? nullptr : frame->second;
    }
    // See LiveScene.
    std::vector<std::string> unseen_people() const { return scene_.unseen_people(); }
    bool fade(const client::Participant& participant, TimePoint now) {
        return scene_.fade(participant, now);
    }
    std::optional<Duration> still() const { return scene_.still(); }
    std::size_t cameras() const { return scene_.calibrations().size(); }

    struct Wish {
        ViewChoice view;
        Size size;
        std::string renderer;
        // If given, the picture is twice as wide: the left and the right eye's views side by side.
        std::optional<double> eye_distance_m;
        // If given, the eye is here, looking along +z, with the lens of `view`.
        std::optional<Pose> room_from_eye;
    };
    // Both throw Error if that camera has sent nothing, or if the driver reported an error.
    ColorImage picture(const Wish& wish) { return render(wish, true).color; }
    DepthImage distances(const Wish& wish) { return render(wish, false).depth_mm; }  // of clouds

private:
    bool meets_without_cameras() const {
        return scene_.is_without_cameras() && scene_.meeting().room().self != ParticipantId{};
    }
    render::Picture render(const Wish& wish, bool with_room);

    render::OffscreenContext context_;
    LiveScene scene_;
};

}  // namespace theatron::viewer

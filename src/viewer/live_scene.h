// SPDX-License-Identifier: Apache-2.0
// The clouds of all cameras of a session, kept up to date, and the room around them.
#pragma once

#include <map>
#include <memory>
#include <optional>

#include "client/participant.h"
#include "render/room_picture.h"
#include "room/pointers.h"
#include "room/virtual_room.h"
#include "viewer/cloud_pick.h"
#include "viewer/head_text.h"
#include "viewer/meeting.h"
#include "viewer/person_clouds.h"

namespace theatron::viewer {

// The virtual room around the clouds: drawn or not, and in which quality.
struct RoomChoice {
    bool shown = true;
    std::optional<render::SceneQuality> quality;  // none: render::usual_quality()
};

// Use from one thread, with the same GL context current.
class LiveScene {
public:
    // With its number, which camera it is.
    using Origin = std::pair<wire::SessionId, std::string>;

    explicit LiveScene(RoomChoice choice, std::vector<SeenPerson> people = {})
        : choice_(choice), people_(std::move(people)) {}

    // Takes over new cameras and frames. Returns the cameras with a new picture. A camera that
    // joins or leaves changes no other camera's picture; beyond render::max_cameras none is added.
    // Throws Error if a person's place names a camera that the host never had.
    std::vector<CameraId> take(client::Participant& participant);

    // Takes over people and shared objects that have changed. True if the picture changes.
    bool take_meeting(const client::Participant& participant);
    Meeting& meeting() { return meeting_; }
    const Meeting& meeting() const { return meeting_; }

    // See render::CloudSet. Uploads the newest frames again, so that the clouds stay.
    void set_depth_step(int step);

    // Fades stale cameras out to a low presence, and others back in. True while the picture
    // changes by that.
    bool fade(const client::Participant& participant, TimePoint now);

    // The cameras of the room, without those that see their publisher.
    bool has_picture() const { return !newest_.empty(); }
    // The host has told its cameras, and there are none of the room.
    bool is_without_cameras() const { return generation_ > 0 && calibrations_.empty(); }
    const std::optional<room::FreeSpace>& free_space() const { return room_.free_space(); }
    const std::map<CameraId, Calibration>& calibrations() const { return calibrations_; }
    // The newest pictures of these, for cloud_pick.h; valid until take().
    std::vector<CloudCamera> cloud() const;
    // A ray of this person, as the others see it; from the next picture on.
    void set_own_pointer(std::optional<room::Pointer> pointer) {
        own_pointer_ = std::move(pointer);
    }
    // The last frame of each of these that sent one.
    const std::map<CameraId, receive::CameraFramePtr>& newest() const { return newest_; }

    // Draws clouds and room into a cleared target. Throws Error if the driver cannot do it.
    void draw(const render::CameraView& view, const render::DrawTarget& target,
              const std::string& renderer);
    // The pictures of these eyes beside each other, read back.
    render::Picture render(const std::vector<render::CameraView>& eyes, Size size,
                           const std::string& renderer, bool with_room);

private:
    void take_cameras(const std::vector<client::Participant::Camera>& cameras);
    Status upload(const receive::CameraFrame& frame);
    std::vector<render::DrawnClouds> clouds(const std::string& renderer);
    void cut_people(const std::vector<client::Participant::Camera>& cameras);
    void update_room(const std::vector<client::Participant::Camera>& cameras);
    void add_pointers(const render::CameraView& view);
    // Everything in the picture except the clouds; null if nothing.
    const render::SceneFrame* scene_for(const render::CameraView& view);

    RoomChoice choice_;
    std::vector<SeenPerson> people_;
    render::CloudSet clouds_;  // of the room's cameras
    PersonClouds person_clouds_;
    room::VirtualRoom room_;
    Meeting meeting_;
    std::optional<room::Pointer> own_pointer_;
    std::unique_ptr<room::Pointers> pointers_;     // made for the first one
    render::SceneFrame frame_;                     // of the picture that is drawn
    std::unique_ptr<render::ScenePasses> passes_;  // made when there is a room
    std::uint64_t generation_ = 0;
    std::map<CameraId, double> presence_;
    TimePoint faded_at_, judged_at_;
    std::map<CameraId, bool> live_;  // as judged last
    std::map<CameraId, Calibration> calibrations_;
    std::map<CameraId, Origin> origins_;  // also of cameras that see their publisher
    std::map<CameraId, receive::CameraFramePtr> newest_;
};

}  // namespace theatron::viewer

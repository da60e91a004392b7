// SPDX-License-Identifier: Apache-2.0
// The clouds of all cameras of a session, kept up to date, and the room around them.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "client/participant.h"
#include "geometry/ply.h"
#include "render/room_picture.h"
#include "room/pointers.h"
#include "room/virtual_room.h"
#include "viewer/cloud_pick.h"
#include "viewer/face_pictures.h"
#include "viewer/head_text.h"
#include "viewer/meeting.h"
#include "viewer/panels/plate.h"
#include "viewer/person_clouds.h"
#include "viewer/same_moment.h"
#include "viewer/shared_screens.h"

namespace theatron::viewer {

// The virtual room around the clouds: drawn or not, and in which quality.
struct RoomChoice {
    bool shown = true;
    std::optional<render::SceneQuality> quality;  // none: render::usual_quality()
    bool has_texts = true;                        // names and labels in the room
    bool in_steps = false;  // nothing but clouds is drawn until prepare() has made it
};

// Use from one thread, with the same GL context current.
class LiveScene {
public:
    // Session and name; with the camera's number it identifies a camera.
    using Origin = std::pair<wire::SessionId, std::string>;

    explicit LiveScene(RoomChoice choice, std::vector<SeenPerson> people = {})
        : choice_(choice), people_(std::move(people)) {
        meeting_.set_screens(screens_);
    }
    // The meeting refers to the screens.
    LiveScene(const LiveScene&) = delete;
    LiveScene& operator=(const LiveScene&) = delete;

    // Takes over new cameras and frames. Returns the cameras with a new picture. A camera that
    // joins or leaves changes no other camera's picture; beyond render::max_set_cameras none is
    // added. Throws Error if a person's place names a camera that the host never had.
    std::vector<CameraId> take(client::Participant& participant);

    // Takes over people and shared objects that have changed. True if the picture changes.
    bool take_meeting(const client::Participant& participant);
    Meeting& meeting() { return meeting_; }
    const Meeting& meeting() const { return meeting_; }

    // A sentence for each person of the options of whom the newest picture of their camera shows
    // nothing (head_text.h).
    std::vector<std::string> unseen_people() const;

    // See render::CloudSet. Uploads the newest frames again, so that the clouds stay.
    void set_depth_step(int step);

    // Shows or hides the age of what is seen beside each camera and person of the room. Warnings
    // that something is not live are always shown.
    void set_ages_shown(bool shown);

    // See render::CloudSet; from the next picture on.
    void set_point_size(double factor) { point_size_ = factor; }

    // The points of the room's cameras that are drawn, in their newest pictures, in the room. Takes
    // some tenths of a second.
    std::vector<ColoredPoint> points() const;

    // Fades stale cameras out to a low presence, and others back in, and tells the ages of screens.
    // True while the picture changes by that.
    bool fade(const client::Participant& participant, TimePoint now);

    // The cameras of the room, without screens, faces and those that see their publisher.
    bool has_picture() const { return !newest_.empty(); }
    // The host has told its cameras, and there are none of the room.
    bool is_without_cameras() const { return generation_ > 0 && calibrations_.empty(); }
    const std::optional<room::FreeSpace>& free_space() const { return room_.free_space(); }
    const std::map<CameraId, Calibration>& calibrations() const { return calibrations_; }
    // The newest pictures of those that are drawn, for cloud_pick.h; valid until take(). None with
    // the real room around.
    std::vector<CloudCamera> cloud() const;
    // The distance of the measured surface that a ray meets, in metres; none where the clouds are
    // not drawn.
    std::optional<double> pick_surface(const render::PickRay& ray) const;
    // This person's own rays; from the next picture on.
    void set_own_pointers(std::vector<room::Pointer> pointers) {
        own_pointers_ = std::move(pointers);
    }
    // The menu and the panels of a person with a headset, until the next call.
    void set_plates(std::vector<const Plate*> plates) { plates_ = std::move(plates); }
    // A line below the middle of the view, for a person with a headset; may be empty.
    void set_headset_text(std::string text) { headset_text_ = std::move(text); }
    // A plate before the eyes says so while all cameras stand still (still_cover.h), or not: with a
    // headset and in pictures of a file, where no overlay is.
    void set_cover_shown(bool shown) { shows_cover_ = shown; }
    // As all_still() of still_cover.h, judged last by fade().
    std::optional<Duration> still() const { return still_; }
    // The place of the operating table, while a person shows where the real one is.
    void set_table_outline(bool shown) { shows_table_ = shown; }
    // The rays of all people who point, with the surfaces that they meet in the newest pictures.
    // The sizes of what is drawn depend on the view, the rays do not. Empty where no room is shown.
    const std::vector<room::Pointer>& pointers(const render::CameraView& view);
    // The last frame of each of these that sent one, also of those that are not drawn since their
    // picture is of another moment than the others' (looking_back.h).
    const std::map<CameraId, receive::CameraFramePtr>& newest() const { return newest_; }
    bool is_drawn(CameraId camera) const { return !left_out_.contains(camera); }
    // The moment of the oldest picture of the past that is drawn, in session time; nullopt: the
    // present is drawn.
    std::optional<TimePoint> past_moment() const;
    // The room's cameras are shown together by moment; for figures.
    const SameMoment& same_moment() const { return same_moment_; }
    // The camera is live and its newest frame is of the present, as judged last.
    bool shows_present(CameraId camera) const;

    // True once after a take() that made cameras, which takes as long as a picture.
    bool take_made_cameras() { return std::exchange(made_cameras_, false); }

    // A step of the work on the room, of some milliseconds; true if the picture changes by it. Only
    // needed with RoomChoice::in_steps. A step that asks the driver something waits a while for an
    // idle GPU.
    bool prepare(bool gpu_is_idle);

    // Draws clouds and room into a cleared target. Throws Error if the driver cannot do it.
    void draw(const render::CameraView& view, const render::DrawTarget& target,
              const std::string& renderer);
    // The same for several eyes of a head: the scene is made once, texts face `head`, a view in
    // their middle.
    void draw(const render::CameraView& head, std::vector<render::EyePicture> eyes,
              const std::string& renderer);
    // With a real room around the person: the virtual one and the clouds of the room's cameras are
    // left out, people, their clouds, organs and pointers stay.
    void set_real_room(bool real) { real_room_ = real; }
    bool has_real_room() const { return real_room_; }
    // The pictures of these eyes beside each other, read back.
    render::Picture render(const std::vector<render::CameraView>& eyes, Size size,
                           const std::string& renderer, bool with_room);

private:
    void take_cameras(const std::vector<client::Participant::Camera>& cameras);
    bool follow_screens();
    void note_screens(const client::Participant& participant);
    Status upload(const receive::CameraFrame& frame);
    std::vector<render::DrawnClouds> clouds(const std::string& renderer);
    void cut_people(const std::vector<client::Participant::Camera>& cameras);
    void update_room(const std::vector<client::Participant::Camera>& cameras);
    void add_pointers();
    void add_table_outline();
    void add_headset_text(const render::CameraView& view);
    void add_cover(const render::CameraView& view);
    void add_ages(const render::CameraView& view);
    bool note_ages(const client::Participant& participant);
    void leave_out_other_moments(const client::Participant& participant);
    double presence_of(CameraId camera) const;
    void make_passes();
    // Everything in the picture except the clouds; null if nothing.
    const render::SceneFrame* scene_for(const render::CameraView& view);

    RoomChoice choice_;
    bool real_room_ = false;
    std::vector<SeenPerson> people_;
    std::map<CameraId, std::size_t> person_at_;  // index in people_
    render::CloudSet clouds_;                    // of the room's cameras
    PersonClouds person_clouds_;
    SharedScreens screens_;
    FacePictures faces_;
    TimePoint screens_noted_at_;
    bool made_cameras_ = false;
    bool captions_changed_ = false;  // or faces, since the last fade()
    double point_size_ = 1;
    room::VirtualRoom room_;
    Meeting meeting_;
    std::vector<room::Pointer> own_pointers_;
    std::vector<const Plate*> plates_;
    std::string headset_text_;
    bool shows_cover_ = false;
    std::optional<Duration> still_;             // as judged last
    std::string cover_;                         // of still_; empty: none
    std::unique_ptr<render::SceneMesh> plate_;  // made for the first cover
    bool shows_table_ = false;
    std::unique_ptr<render::SceneMesh> table_;        // made for the first outline
    std::unique_ptr<room::Pointers> drawn_pointers_;  // made for the first one
    std::vector<room::Pointer> pointers_;             // of frame_
    render::SceneFrame frame_;                        // of the picture that is drawn
    std::unique_ptr<render::ScenePasses> passes_;     // made when there is a room
    std::uint64_t generation_ = 0;
    std::unique_ptr<render::BegunScenePrograms> begun_programs_;  // of prepare()
    int busy_steps_ = 0;  // in which they waited for the GPU
    std::map<CameraId, double> presence_;
    std::set<CameraId> left_out_;  // not drawn: of another moment than the others
    TimePoint faded_at_, judged_at_;
    std::map<CameraId, bool> live_;  // as judged last
    bool shows_ages_ = false;
    std::map<CameraId, std::string> ages_;  // as judged last
    std::map<CameraId, Calibration> calibrations_;
    std::map<CameraId, Origin> origins_;  // also of cameras that see their publisher
    SameMoment same_moment_;
    std::map<CameraId, receive::CameraFramePtr> newest_;
};

}  // namespace theatron::viewer

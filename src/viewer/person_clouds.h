// SPDX-License-Identifier: Apache-2.0
// Point-cloud avatars: the clouds of cameras that see their own publisher, cut to this person and
// drawn at the person's pose in the room.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "geometry/ray_table.h"
#include "receive/receiver.h"
#include "render/room_picture.h"
#include "room/people.h"

namespace theatron::viewer {

// The person's frame (wire::CameraKind::person) in the room, from the pose of the head (y up, -z
// forward): the same place, upright.
Pose room_from_person(const Pose& room_from_head);

// Use from one thread, with the same GL context current.
class PersonClouds {
public:
    // `calibration` is in the person's frame. Adds the camera or changes it; a person's cameras
    // beyond render::max_set_cameras are left out.
    void set_camera(ParticipantId person, CameraId camera, const Calibration& calibration);
    void remove_camera(CameraId camera);
    bool has(CameraId camera) const { return person_of(camera) != nullptr; }
    // A camera that delivers no pictures shows nothing; the person gets a face instead.
    void set_live(CameraId camera, bool is_live);

    // As in render::CloudSet; size_mismatch for unknown cameras.
    Status upload(const receive::CameraFramePtr& frame);
    void set_depth_step(int step);

    // Moves the clouds to these people's heads. The clouds of people without a pose are not drawn.
    // Where an own head is drawn, the cloud has none, nor a headset.
    void place(const std::vector<room::RoomPerson>& people);
    // The colours of the skin of people whose own head is drawn, where it is seen.
    std::map<ParticipantId, Vec3> skins() const;
    // The people whose cameras have sent a picture and are live.
    std::set<ParticipantId> seen() const;

    // Appends the placed clouds. "blend" is used for people with several cameras only.
    void add_to(std::vector<render::DrawnClouds>& clouds, const std::string& renderer);

private:
    struct Camera {
        Calibration person_from_camera;
        receive::CameraFramePtr newest;
        bool is_live = true;
        Image<Ray> rays;    // made when the skin's colour is wanted
        TimePoint skin_of;  // the picture in which it was looked for
    };
    struct Person {
        render::CloudSet clouds;
        std::map<CameraId, Camera> cameras;
        std::optional<Pose> room_from_head;
        bool has_own_head = false;
        std::optional<Vec3> skin;
    };
    static void note_skin(Person& person, Camera& camera);
    static bool is_seen(const Person& person);
    Person* person_of(CameraId camera) const;

    std::shared_ptr<render::CloudPrograms> programs_;  // of all sets
    std::map<ParticipantId, std::unique_ptr<Person>> people_;
    int depth_step_ = 1;
};

}  // namespace theatron::viewer

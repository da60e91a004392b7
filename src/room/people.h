// SPDX-License-Identifier: Apache-2.0
// Avatars: a name, hands, and for people without a depth camera a floating head with a face, drawn
// or that of their webcam. The face shows the direction in which a person looks, a hand's finger
// where it points.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/ids.h"
#include "render/camera_view.h"
#include "render/scene_frame.h"

namespace theatron::room {

// The picture of a person's own face, in place of the drawn one.
struct FacePicture {
    const render::SceneTexture* texture = nullptr;
    double opacity = 1;  // below 1: it is old, and the drawn face shows through
    std::string age;     // of an old one, for people; else empty
};

// Poses as in wire/person_pose.h: y up, -z forward, metres.
struct RoomPerson {
    ParticipantId id{};
    std::string name;
    std::optional<Pose> head, left_hand, right_hand;
    bool is_stale = false;  // its poses are old: it is drawn half transparent
    std::string age;        // of what is seen of it, above the name; empty: not shown
    // It is seen as a point cloud, in place of the head with a face.
    bool has_cloud = false;
    std::optional<FacePicture> face;
    bool calls = false;   // asks the others to come
    bool points = false;  // with the right hand
};

// The colour of everything that belongs to a participant: avatar, pointer, ownership. Neighbouring
// numbers have different colours, also for colour-blind eyes (Okabe and Ito, 2008). Linear.
Vec3 color_of(ParticipantId id);

// Needs the GL context current in which it was made.
class People {
public:
    People();

    // Appends all people except those whose head surrounds the eye. Names face the eye.
    void add_to(render::SceneFrame& frame, const std::vector<RoomPerson>& people,
                const render::CameraView& view) const;

private:
    void add_face(render::SceneFrame& frame, const RoomPerson& person, double opacity) const;

    render::SceneMesh skin_, nose_, eyes_, pupils_, hand_, picture_, rim_;
};

}  // namespace theatron::room

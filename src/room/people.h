// SPDX-License-Identifier: Apache-2.0
// Avatars of people, by what is known of them, and their names. A person with a headset is a bust
// with gloved hands, one whose expression is known is a bust with a face, one with a webcam is its
// picture, and anybody else is a plate with initials that faces the eye, and below it a cone that
// points where the person looks.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/ids.h"
#include "face/channels.h"
#include "render/camera_view.h"
#include "render/scene_frame.h"
#include "room/face_shape.h"
#include "room/figure_meshes.h"
#include "room/own_head.h"

namespace theatron::room {

// The picture of a person's own face, in place of the bust or the plate.
struct FacePicture {
    const render::SceneTexture* texture = nullptr;
    double opacity = 1;  // below 1: it is old, and the bust or the plate shows through
    std::string age;     // of an old one, for people; else empty
};

// Poses as in wire/person_pose.h: y up, -z forward, metres.
struct RoomPerson {
    ParticipantId id{};
    std::string name;
    std::optional<Pose> head, left_hand, right_hand;
    bool is_stale = false;  // its poses are old: it is drawn half transparent
    std::string age;        // of what is seen of it, above the name; empty: not shown
    bool has_headset = false;
    // It is seen as a point cloud, in place of its bust, picture or plate. An own head is drawn
    // into the cloud, without light of the room, as the cloud is.
    bool has_cloud = false;
    std::optional<FacePicture> face;
    // The channels of its face, if it sends its expression.
    std::optional<face::Channels> expression;
    // The same as emotions, and the head that shows them; null: the usual one.
    ShownFace shown_face;
    std::shared_ptr<const OwnHead> own_head;
    Vec3 skin_gain{1, 1, 1};  // of the own head's colours, in a cloud
    bool calls = false;       // asks the others to come
    bool points = false;      // with the right hand
};

// The colour of everything that belongs to a participant: avatar, pointer, ownership. Neighbouring
// numbers have different colours, also for colour-blind eyes (Okabe and Ito, 2008). Linear.
Vec3 color_of(ParticipantId id);

// One or two letters that stand for a name: those of its first and last word, titles such as "Dr."
// left out. Basic letters are capitals.
std::string initials_of(const std::string& name);

// Needs the GL context current in which it was made.
class People {
public:
    People();

    // Appends all people except those whose head surrounds the eye. Names face the eye.
    void add_to(render::SceneFrame& frame, const std::vector<RoomPerson>& people,
                const render::CameraView& view);

private:
    struct Bust {
        render::SceneMesh head, back, cap, mask, eyes, neck, gown, collar;
    };
    struct Face {
        face::Channels shown;
        render::SceneMesh skin, whites, dark, lips, mouth;
    };
    struct Own {
        std::shared_ptr<const OwnHead> head;
        ShownFace shown;
        OwnHead::Shares shares{};
        std::array<std::optional<render::SceneMesh>, face::part_count> parts;
        std::optional<render::SceneMesh> back;  // of a face alone
        std::optional<render::SceneTexture> skin;
    };
    struct Hand {
        render::SceneMesh glove, cuff;
    };
    static Hand make_hand(Side side, bool points);
    void add_hands(render::SceneFrame& frame, const RoomPerson& person, double opacity) const;
    void add_bust(render::SceneFrame& frame, const RoomPerson& person, double opacity);
    void add_face(render::SceneFrame& frame, const RoomPerson& person, double opacity);
    const Face& face_of(const RoomPerson& person);
    void add_own_head(render::SceneFrame& frame, const RoomPerson& person, double opacity);
    const Own& own_of(const RoomPerson& person);
    void add_plate(render::SceneFrame& frame, const RoomPerson& person, double opacity,
                   Vec3 eye) const;
    void add_picture(render::SceneFrame& frame, const RoomPerson& person, double opacity) const;

    Bust bust_;
    std::unique_ptr<FaceShape> shape_;  // made for the first face
    std::map<ParticipantId, Face> drawn_faces_;
    std::map<ParticipantId, Own> own_heads_;
    ColorImage blended_;
    Hand left_, right_, pointing_;
    render::SceneMesh plate_, plate_rim_, cone_, picture_, rim_;
};

}  // namespace theatron::room

// SPDX-License-Identifier: Apache-2.0
// The objects of the case that is open in a room: the organ as a whole, its parts, and a screen
// for its images (docs/formats/room.md).
//
// The organ and the screen have poses in the room; the pose of a part is relative to the organ. In
// the organ's frame x points to the patient's left, y to the head, z to the front; the origin is
// the middle of the case, and a scale of 1 is life size.
//
// Pure functions; decoders are safe for untrusted input and give nullopt for anything else.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/content_hash.h"
#include "session/room_object.h"

namespace theatron::session {

// ObjectKind::organ.
struct CaseOrgan {
    ContentHash of_case;
    std::uint8_t explosion = 0;  // 0: parts in their places; 255: as far apart as they are drawn
    bool cut = false;            // away in front of the slice that the screen shows
    bool operator==(const CaseOrgan&) const = default;
};
// ObjectKind::organ, too.
struct CasePart {
    ContentHash of_case;
    std::uint16_t part = 0;  // its number in the case
    bool shown = true;
    std::uint8_t opacity = 255;
    bool operator==(const CasePart&) const = default;
};
// ObjectKind::screen.
struct CaseScreen {
    static constexpr std::uint8_t orientations = 3;
    ContentHash of_case;
    std::uint8_t series = 0;
    std::uint8_t orientation = 0;     // medical::Orientation
    double position_mm = 0;           // of the slice: z (axial), y (coronal) or x (sagittal)
    double center = 40, width = 400;  // of the window, in measured values
    // The number of a picture of the case, which is shown instead of the slice; none: the slice.
    std::optional<std::uint16_t> picture = {};
    // The participant that alone changes the screen, beside operators; 0: everybody may.
    ParticipantId presenter{};
    bool operator==(const CaseScreen&) const = default;
};
// ObjectKind::organ, too: the name that the case had when it was opened. Everybody sees it, so it
// is never that of the patient. Rooms of version 0.1.0 have none, and its programs leave it out.
struct CaseName {
    static constexpr std::size_t max_characters = 64;
    ContentHash of_case;
    std::string name;
    bool operator==(const CaseName&) const = default;
};
using CaseObject = std::variant<CaseOrgan, CasePart, CaseScreen, CaseName>;

Bytes encode_case_object(const CaseObject& object);
std::optional<CaseObject> decode_case_object(ObjectKind kind, ByteView properties);
template <class T>
std::optional<T> decode_as(ObjectKind kind, ByteView properties) {
    const auto object = decode_case_object(kind, properties);
    const T* found = object ? std::get_if<T>(&*object) : nullptr;
    return found ? std::optional(*found) : std::nullopt;
}

// True if somebody may change the properties from `before` to `after`: the object stays the same
// organ, part or screen of the same case. The name stays as it is.
bool may_become(ObjectKind kind, ByteView before, ByteView after);

// True if a participant may change a screen so: everybody where nobody presents, else the presenter
// and those who `manage`. Nobody makes somebody else the presenter.
bool may_change(ParticipantId by, bool manages, const CaseScreen& before, const CaseScreen& after);

// The open case: the objects of the one of this session, or else of a replayed one.
struct CaseInRoom {
    struct Part {
        ObjectId id{};
        CasePart facts;
        RoomObject object;
    };
    struct Screen {
        ObjectId id{};
        CaseScreen facts;
        RoomObject object;
    };
    ObjectId organ_id{};
    CaseOrgan organ;
    RoomObject organ_object;
    std::vector<Part> parts;
    std::optional<Screen> screen;
    std::string name;  // see CaseName; empty: the room has none

    const Part* find(ObjectId id) const;
};
std::optional<CaseInRoom> case_in_room(const RoomObjects& objects);

// A place in the room with the number of metres that are a metre of the object.
struct ScaledPose {
    Pose pose;
    double scale = 1;

    Vec3 operator*(Vec3 p) const { return pose * (p * scale); }
};
// Where a part with this pose, relative to the organ, is; and the opposite.
ScaledPose part_in_room(const RoomObject& organ, const Pose& organ_from_part);
Pose part_in_organ(const RoomObject& organ, const Pose& room_from_part);

// The facts that the host has of a case that it offers.
struct CaseFacts {
    static constexpr std::size_t max_parts = 256;
    static constexpr std::size_t max_series = 16;
    static constexpr std::size_t max_pictures = 64;
    ContentHash id;
    std::string name;
    std::uint64_t bytes = 0;              // of all its content
    std::vector<std::uint8_t> opacities;  // of its parts
    std::optional<CaseScreen> screen;  // what it shows at first; none without images and pictures
    bool operator==(const CaseFacts&) const = default;
};

// All objects of a case, opened at `place` with life size, the organ first.
std::vector<RoomObject> case_objects(const CaseFacts& facts, const Pose& place);

}  // namespace theatron::session

// SPDX-License-Identifier: Apache-2.0
// A shared screen as an object of the room, kind ObjectKind::screen (docs/formats/room.md): the
// place, the width and the facts of a camera that is a screen (geometry/screen.h).
//
// The frame of the object is that of ScreenPlace: x right, y down, z away from the reader, the
// origin in the middle. The scale of the object is the width of the picture in metres. The creator
// is the participant who shares it.
//
// Pure functions; the decoder is safe for untrusted input and gives nullopt for anything else.
#pragma once

#include <optional>
#include <string>

#include "geometry/screen.h"
#include "session/room_object.h"

namespace theatron::session {

struct SharedScreen {
    static constexpr int max_side = 8192;  // of the picture, in pixels

    // The camera that shows it; none: its source is away, and nothing is seen of the screen. A
    // source that comes back is known by the names of its publisher and of its camera.
    std::optional<CameraId> camera;
    bool pinned = false;  // nobody can hold it
    Size picture;         // in pixels
    std::string publisher, name;
    bool operator==(const SharedScreen&) const = default;
};

// Names are cut to wire::max_name characters.
Bytes encode_shared_screen(const SharedScreen& screen);
std::optional<SharedScreen> decode_shared_screen(ObjectKind kind, ByteView properties);
// The screen of this number. Nullopt: there is none, or it is another object.
std::optional<SharedScreen> shared_screen_of(const RoomObjects& objects, ObjectId id);
// True for any screen of this kind, also one that cannot be decoded. Screens of a case are none.
bool is_shared_screen(const RoomObject& object);

// A shared screen that nobody can hold.
bool is_pinned(const RoomObject& object);

constexpr bool is_screen_width(double width_m) {
    return width_m >= least_screen_width_m && width_m <= largest_screen_width_m;
}
double clamped_screen_width(double width_m);

// Where the screen is, in metres of the room.
ScreenPlace place_of(const RoomObject& object, const SharedScreen& screen);

// The screen of this camera. Objects of a replayed recording show the camera of their name, if no
// other object shows it.
std::optional<ObjectId> find_screen(const RoomObjects& objects, CameraId camera,
                                    const std::string& name);

}  // namespace theatron::session

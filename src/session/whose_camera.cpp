// SPDX-License-Identifier: Apache-2.0
#include "session/whose_camera.h"

#include "session/room_bytes.h"

namespace theatron::session {

std::string whose_camera(const std::string& camera, ParticipantId publisher,
                         const std::string& publisher_name) {
    if (publisher == ParticipantId{})
        return camera;
    return (publisher_name.empty() ? "#" + std::to_string(std::uint32_t(publisher))
                                   : publisher_name) +
           ": " + camera;
}

std::string whose_camera(const wire::Camera& camera, const RoomObjects& room) {
    if (camera.publisher == ParticipantId{})
        return camera.name;
    std::string name;
    for (const auto& [id, object] : room)
        if (object.kind == ObjectKind::person && object.creator == camera.publisher &&
            !is_recorded(id))
            if (const auto facts = decode_person(object.properties))
                name = facts->name;
    return whose_camera(camera.name, camera.publisher, name);
}

}  // namespace theatron::session

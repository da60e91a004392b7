// SPDX-License-Identifier: Apache-2.0
#include "export/room_of_recording.h"

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "base/error.h"
#include "export/mark_json.h"
#include "export/screen_json.h"
#include "files/json_text.h"
#include "session/room_bytes.h"
#include "session/room_text.h"

namespace theatron::exporting {
namespace {

using Json = nlohmann::json;
using Recording = std::shared_ptr<const record::RecordingFile>;

// Calls `visit` with the time of each moment at which the room changes.
template <class Visit>
void for_each_moment(capture::RecordedRoom& room, Visit visit) {
    while (const auto time = room.next())
        if (room.go_to(*time))
            visit(*time);
}

Json describe(const std::optional<wire::PartPose>& part) {
    return part ? Json{{"position", part->position}, {"rotation", part->rotation}} : Json();
}

Json describe(session::ObjectId id, const session::RoomObject& object) {
    const auto& [q, p] = object.room_from_object;
    Json json{{"id", std::uint32_t(id)},
              {"kind", session::text_of(object.kind)},
              {"creator", std::uint32_t(object.creator)},
              {"held_by", std::uint32_t(object.grip.holder)},
              {"position", {p.x, p.y, p.z}},
              {"rotation", {q.w, q.x, q.y, q.z}},
              {"scale", object.scale}};
    if (object.kind == session::ObjectKind::mark)
        if (const std::optional<session::Mark> mark = session::decode_mark(object.properties))
            json["mark"] = mark_json(*mark);
    if (const auto screen = session::decode_shared_screen(object.kind, object.properties))
        json["screen"] = screen_json(*screen);
    return json;
}

Json describe(const session::RoomObject& person, const session::PoseBodies& poses) {
    const auto facts = session::decode_person(person.properties);
    Json json{{"id", std::uint32_t(person.creator)}, {"name", facts ? facts->name : ""}};
    const auto body = poses.find(person.creator);
    if (body == poses.end())
        return json;
    const auto pose = wire::decode_person_pose(body->second);
    if (!pose)
        return json;
    json["head"] = describe(pose->head);
    json["left_hand"] = describe(pose->left_hand);
    json["right_hand"] = describe(pose->right_hand);
    return json;
}

}  // namespace

RoomSummary summarize_room(const Recording& recording) {
    capture::RecordedRoom room(recording);
    std::map<session::ObjectId, std::string> people;
    std::set<session::ObjectId> objects;
    for_each_moment(room, [&](Duration) {
        for (const auto& [id, object] : room.objects()) {
            if (object.kind != session::ObjectKind::person)
                objects.insert(id);
            else if (const auto [person, is_new] = people.try_emplace(id); is_new)
                if (const auto facts = session::decode_person(object.properties))
                    person->second = facts->name;
        }
    });
    RoomSummary summary{{}, objects.size(), room.figures()};
    for (const auto& [id, name] : people)
        summary.people.push_back(name);
    return summary;
}

std::string room_line(const capture::RecordedRoom& room, Duration time) {
    Json people = Json::array(), objects = Json::array();
    for (const auto& [id, object] : room.objects())
        if (object.kind == session::ObjectKind::person)
            people.push_back(describe(object, room.poses()));
        else
            objects.push_back(describe(id, object));
    return files::json_text({{"seconds", to_seconds(time)},
                             {"hash", session::hash_text(room.objects())},
                             {"people", people},
                             {"objects", objects}});
}

std::size_t export_room(const Recording& recording, const std::filesystem::path& file,
                        capture::RecordedRoom::Figures& figures) {
    std::ofstream out(file);
    capture::RecordedRoom room(recording);
    std::size_t lines = 0;
    for_each_moment(room, [&](Duration time) {
        out << room_line(room, time) << "\n";
        ++lines;
    });
    out.close();
    if (!out)
        throw Error("Cannot write '" + file.string() + "'.");
    figures = room.figures();
    return lines;
}

}  // namespace theatron::exporting

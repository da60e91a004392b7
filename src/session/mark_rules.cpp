// SPDX-License-Identifier: Apache-2.0
#include "session/mark_rules.h"

#include <algorithm>
#include <set>

#include "session/mark.h"
#include "session/shared_screen.h"

namespace theatron::session {
namespace {

bool is_there(const RoomObjects& objects, const Mark& mark) {
    if (mark.surface == MarkedSurface::cloud)
        return true;
    const auto found = objects.find(ObjectId(mark.object));
    return found != objects.end() &&
           found->second.kind ==
               (mark.surface == MarkedSurface::organ ? ObjectKind::organ : ObjectKind::screen) &&
           !is_shared_screen(found->second);
}

bool has_room_for(const RoomObjects& objects, ParticipantId author, std::size_t bytes) {
    std::size_t marks = 0, marks_of_one = 0, all_bytes = bytes, bytes_of_one = bytes;
    for (const auto& [id, object] : objects) {
        if (object.kind != ObjectKind::mark)
            continue;
        ++marks;
        all_bytes += object.properties.size();
        if (object.creator != author)
            continue;
        ++marks_of_one;
        bytes_of_one += object.properties.size();
    }
    return marks < max_marks && marks_of_one < max_marks_of_one && all_bytes <= max_mark_bytes &&
           bytes_of_one <= max_mark_bytes_of_one;
}

std::uint16_t next_pin(const RoomObjects& objects) {
    std::set<std::uint16_t> taken;
    for (const auto& [id, object] : objects)
        if (object.kind == ObjectKind::mark)
            if (const auto mark = decode_mark(object.properties))
                taken.insert(mark->number);
    std::uint16_t number = 1;
    while (taken.contains(number))
        ++number;
    return number;
}

}  // namespace

Refusal judge_new_mark(const RoomObjects& objects, ParticipantId author, std::string_view name,
                       request::Create& request) {
    auto mark = decode_mark(request.properties);
    if (!mark || request.room_from_object != Pose{} || request.scale != 1)
        return Refusal::malformed;
    if (mark->color != color_number(author) || !may_be_initials_of(name, mark->initials))
        return Refusal::of_another;
    if (!is_there(objects, *mark))
        return Refusal::no_such_object;
    if (!has_room_for(objects, author, request.properties.size()))
        return Refusal::too_many;
    if (mark->kind == MarkKind::pin) {
        mark->number = next_pin(objects);
        request.properties = encode_mark(*mark);
    }
    return Refusal::none;
}

std::vector<ObjectId> marks_of(const RoomObjects& objects, ParticipantId author, bool of_all) {
    std::vector<ObjectId> marks;
    for (const auto& [id, object] : objects)
        if (object.kind == ObjectKind::mark && (of_all || object.creator == author))
            marks.push_back(id);
    return marks;
}

std::vector<ObjectId> marks_without_surface(const RoomObjects& objects) {
    std::vector<ObjectId> marks;
    for (const auto& [id, object] : objects)
        if (object.kind == ObjectKind::mark)
            if (const auto mark = decode_mark(object.properties); mark && !is_there(objects, *mark))
                marks.push_back(id);
    return marks;
}

}  // namespace theatron::session

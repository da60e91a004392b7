// SPDX-License-Identifier: Apache-2.0
#include "viewer/tools/mark_actions.h"

#include <utility>

#include "session/mark_rules.h"
#include "session/room_bytes.h"

namespace theatron::viewer {
namespace {

namespace request = session::request;

// Below the width of a mark's line.
constexpr double tolerance_m = 0.0002;

// The author's colour and initials in `mark`. False without a room.
bool sign(const client::Participant::Room& room, session::Mark& mark) {
    for (const auto& [id, object] : room.objects)
        if (object.kind == session::ObjectKind::person && object.creator == room.self) {
            const auto facts = session::decode_person(object.properties);
            mark.color = session::color_number(room.self);
            mark.initials = session::initials_of(facts ? facts->name : "");
            return true;
        }
    return false;
}

}  // namespace

std::optional<session::Mark> preview_of(const client::Participant::Room& room, session::Mark mark) {
    if (!sign(room, mark))
        return std::nullopt;
    if (mark.kind == session::MarkKind::stroke)
        mark.points = session::simplified(mark.points, tolerance_m, session::most_mark_points);
    return mark;
}

bool make_mark(client::Participant& participant, session::Mark mark) {
    if (mark.kind == session::MarkKind::pin)
        mark.number = 1;
    auto made = preview_of(participant.room(), std::move(mark));
    return made && participant.ask_room(request::Create{
                       session::ObjectKind::mark, {}, 1, session::encode_mark(*made)}) != 0;
}

bool undo_mark(client::Participant& participant) {
    const auto room = participant.room();
    const auto own = session::marks_of(room.objects, room.self, false);
    // Numbers of objects grow with time.
    return !own.empty() && participant.ask_room(request::Remove{own.back()}) != 0;
}

bool clear_marks(client::Participant& participant, bool of_all) {
    const auto room = participant.room();
    return !session::marks_of(room.objects, room.self, of_all).empty() &&
           participant.ask_room(request::ClearMarks{of_all}) != 0;
}

}  // namespace theatron::viewer

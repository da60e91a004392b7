// SPDX-License-Identifier: Apache-2.0
#include "viewer/room_panel.h"

#include "session/room_bytes.h"

namespace theatron::viewer {
namespace {

// "observer, records, holds 2 objects".
std::string doing(const client::Participant::Room& room, ParticipantId id) {
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
    int held = 0;
    for (const auto& [number, object] : room.objects) {
        if (object.kind != session::ObjectKind::person) {
            held += object.grip.holder == id;
            continue;
        }
        const auto facts = session::decode_person(object.properties);
        if (object.creator == id && facts && facts->records)
            add("records");
    }
    if (held > 0)
        add(held == 1 ? "holds an object" : "holds " + std::to_string(held) + " objects");
    return text;
}

}  // namespace

RoomPanel room_panel(const client::Participant::Room& room,
                     const std::vector<room::RoomPerson>& people, const std::vector<Place>& places,
                     std::optional<ParticipantId> followed) {
    RoomPanel panel;
    const auto button = [&](const char* label, RoomCommand command) {
        panel.commands.push_back(std::move(command));
        return xr::PanelButton{label, int(panel.commands.size()) - 1};
    };
    xr::Panel who{"People", {}};
    for (const room::RoomPerson& person : people) {
        xr::PanelRow row{person.name, doing(room, person.id), {}};
        if (!person.head)
            row.detail += row.detail.empty() ? "not in the room" : ", not in the room";
        else if (person.is_stale)
            row.detail += row.detail.empty() ? "view is old" : ", view is old";
        if (followed == person.id)
            row.detail +=
                row.detail.empty() ? "you see through their eyes" : ", you see through their eyes";
        if (person.head) {
            row.buttons.push_back(button("Go to", GoToPerson{person.id}));
            row.buttons.push_back(button("See through", LookThrough{person.id}));
        }
        who.rows.push_back(std::move(row));
    }
    if (who.rows.empty())
        who.rows.push_back({"Nobody else is here", "", {}});
    panel.panels.push_back(std::move(who));
    if (places.empty())
        return panel;
    xr::Panel where{"Places", {}};
    for (const Place& place : places)
        where.rows.push_back({place.name, "", {button("Go", GoToPlace{place})}});
    panel.panels.push_back(std::move(where));
    return panel;
}

}  // namespace theatron::viewer

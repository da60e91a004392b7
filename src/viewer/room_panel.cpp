// SPDX-License-Identifier: Apache-2.0
#include "viewer/room_panel.h"

#include "base/shown_name.h"
#include "session/room_bytes.h"

namespace theatron::viewer {
namespace {

constexpr std::size_t shortened_name = 24;  // characters of a name on a button

void add(std::string& text, const std::string& part) {
    text += (text.empty() ? "" : ", ") + part;
}

std::optional<session::PersonFacts> facts_of(const client::Participant::Room& room,
                                             ParticipantId id) {
    for (const auto& [number, object] : room.objects)
        if (object.kind == session::ObjectKind::person && object.creator == id)
            if (const auto facts = session::decode_person(object.properties))
                return *facts;
    return std::nullopt;
}

// "observer, muted, records, holds 2 objects"; never empty for a person whose role is known, so
// that rows keep their height when somebody begins to speak.
std::string doing(const RoomPanelFacts& facts, const room::RoomPerson& person) {
    std::string text;
    if (const auto known = facts_of(facts.room, person.id)) {
        add(text, wire::text_of(known->role));
        if (known->muted)
            add(text, "muted");
        if (known->records)
            add(text, "records");
        if (known->voice_recorded)
            add(text, "voice may be recorded");
    }
    if (const auto level = facts.speaking.find(person.id); level != facts.speaking.end())
        add(text, "speaks " + meter_text(level->second));
    int held = 0;
    for (const auto& [number, object] : facts.room.objects)
        held += object.kind != session::ObjectKind::person && object.grip.holder == person.id;
    if (held > 0)
        add(text, held == 1 ? "holds an object" : "holds " + std::to_string(held) + " objects");
    if (!person.head)
        add(text, "not in the room");
    else if (!person.age.empty())
        add(text, person.age);
    else if (person.is_stale)
        add(text, "view is old");
    if (person.calls)
        add(text, "asks all to come");
    if (facts.followed == person.id)
        add(text, "you see through their eyes");
    return text;
}

}  // namespace

RoomPanel room_panel(const RoomPanelFacts& facts) {
    RoomPanel panel;
    const auto button = [&](std::string label, RoomCommand command) {
        panel.commands.push_back(std::move(command));
        return xr::PanelButton{std::move(label), int(panel.commands.size()) - 1};
    };
    using Action = wire::ManageAction;
    xr::Panel who{"People", {}};
    for (const room::RoomPerson& person : facts.people) {
        xr::PanelRow row{person.name, doing(facts, person), {}};
        if (person.head) {
            row.buttons.push_back(button("Go to", GoToPerson{person.id}));
            row.buttons.push_back(button("See through", LookThrough{person.id}));
        }
        who.rows.push_back(std::move(row));
        const auto known = facts_of(facts.room, person.id);
        if (!facts.is_operator || !known || session::is_recorded(person.id))
            continue;
        const bool observes = known->role == wire::Role::observer;
        who.rows.push_back({"",
                            "",
                            {known->muted ? button("Unmute", Decide{Action::unmute, person.id, {}})
                                          : button("Mute", Decide{Action::mute, person.id, {}}),
                             button(observes ? "Make expert" : "Make observer",
                                    Decide{Action::set_role, person.id,
                                           observes ? wire::Role::expert : wire::Role::observer}),
                             button(facts.asked_removal == person.id
                                        ? "Really remove " + clean_name(person.name, shortened_name)
                                        : "Remove",
                                    Decide{Action::remove, person.id, {}})}});
    }
    if (!who.rows.empty() && facts.may_call)
        who.rows.push_back({"",
                            "",
                            {facts.is_calling ? button("Stop calling", Call{false})
                                              : button("Call all to me", Call{true})}});
    if (who.rows.empty())
        who.rows.push_back({"Nobody else is here", "", {}});
    if (facts.own_face == OwnFace::off)
        who.rows.push_back({"", "", {button("Show my face", ShowFace{true})}});
    else if (facts.own_face != OwnFace::none)
        who.rows.push_back({"", "You are seen", {button("Hide my face", ShowFace{false})}});
    panel.panels.push_back(std::move(who));
    if (!facts.places.empty()) {
        xr::Panel where{"Places", {}};
        for (const Place& place : facts.places)
            where.rows.push_back({place.name, "", {button("Go", GoToPlace{place})}});
        panel.panels.push_back(std::move(where));
    }
    // Below the others: they stay in their places when somebody knocks.
    if (facts.is_operator && !facts.visitors.empty()) {
        xr::Panel door{"At the door", {}};
        for (const wire::Visitor& visitor : facts.visitors)
            door.rows.push_back(
                {visitor.name,
                 wire::text_of(visitor.role),
                 {button("Let in", Decide{Action::admit, visitor.participant, {}}),
                  button("Refuse", Decide{Action::turn_away, visitor.participant, {}})}});
        panel.panels.push_back(std::move(door));
    }
    return panel;
}

RoomPanel call_panel(const std::vector<room::RoomPerson>& callers) {
    RoomPanel panel;
    if (callers.empty())
        return panel;
    xr::Panel offer{"Calls you (J: go there)", {}};
    for (const room::RoomPerson& person : callers) {
        const int first = int(panel.commands.size());
        panel.commands.push_back(AnswerCall{person.id, true});
        panel.commands.push_back(AnswerCall{person.id, false});
        offer.rows.push_back({person.name, "", {{"Go there", first}, {"Stay here", first + 1}}});
    }
    panel.panels.push_back(std::move(offer));
    return panel;
}

RoomPanel joined(RoomPanel upper, const RoomPanel& lower) {
    const int before = int(upper.commands.size());
    for (xr::Panel panel : lower.panels) {
        for (xr::PanelRow& row : panel.rows)
            for (xr::PanelButton& button : row.buttons)
                button.command += before;
        upper.panels.push_back(std::move(panel));
    }
    upper.commands.insert(upper.commands.end(), lower.commands.begin(), lower.commands.end());
    return upper;
}

}  // namespace theatron::viewer

// SPDX-License-Identifier: Apache-2.0
#include "viewer/room_panel.h"

#include "base/shown_name.h"
#include "session/room_bytes.h"
#include "wire/clear_objects.h"
#include "wire/sentence.h"

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
        add(text, wire::spoken(known->role));
        if (known->hand_raised)
            add(text, say(Phrase::hand_is_up));
        if (known->muted)
            add(text, say(Phrase::muted));
        if (known->records)
            add(text, say(Phrase::records));
        if (known->voice_recorded)
            add(text, say(Phrase::voice_may_be_recorded));
    }
    if (const auto level = facts.speaking.find(person.id); level != facts.speaking.end())
        add(text, say(Phrase::speaks, meter_text(level->second)));
    int held = 0;
    for (const auto& [number, object] : facts.room.objects)
        held += object.kind != session::ObjectKind::person && object.grip.holder == person.id;
    if (held > 0)
        add(text, say(held == 1 ? Phrase::holds_one : Phrase::holds_many, std::to_string(held)));
    if (!person.head)
        add(text, say(Phrase::not_in_room));
    else if (!person.age.empty())
        add(text, person.age);
    else if (person.is_stale)
        add(text, say(Phrase::view_is_old));
    if (person.calls)
        add(text, say(Phrase::asks_all));
    if (facts.followed == person.id)
        add(text, say(Phrase::you_see_through));
    return text;
}

}  // namespace

void add_places_panel(const std::vector<Place>& places, RoomPanel& panel) {
    window::Panel where{say(Phrase::places), {}};
    for (const Place& place : places)
        where.rows.push_back({place.name, "", {panel.button(say(Phrase::go), GoToPlace{place})}});
    panel.panels.push_back(std::move(where));
}

RoomPanel room_panel(const RoomPanelFacts& facts) {
    RoomPanel panel;
    const auto button = [&](Phrase label, RoomCommand command) {
        return panel.button(say(label), std::move(command));
    };
    using Action = wire::ManageAction;
    const auto removing = [&](Phrase label, Phrase again, Action action,
                              const room::RoomPerson& person) {
        const Decide decision{action, person.id, {}};
        return panel.button(facts.asked == decision
                                ? say(again, clean_name(person.name, shortened_name))
                                : say(label),
                            decision);
    };
    window::Panel who{say(Phrase::people), {}};
    for (const room::RoomPerson& person : facts.people) {
        window::PanelRow row{person.name, doing(facts, person), {}};
        if (person.head && facts.may_go)
            row.buttons.push_back(button(Phrase::go_to, GoToPerson{person.id}));
        if (person.head && facts.may_look_through)
            row.buttons.push_back(button(Phrase::see_through, LookThrough{person.id}));
        who.rows.push_back(std::move(row));
        const auto known = facts_of(facts.room, person.id);
        if (!facts.is_operator || !known || session::is_recorded(person.id))
            continue;
        if (known->hand_raised)
            who.rows.push_back(
                {"",
                 "",
                 {button(Phrase::lower_hand_of, Decide{Action::lower_hand, person.id, {}})}});
        const bool observes = known->role == wire::Role::observer;
        who.rows.push_back(
            {"",
             "",
             {known->muted ? button(Phrase::unmute, Decide{Action::unmute, person.id, {}})
                           : button(Phrase::mute, Decide{Action::mute, person.id, {}}),
              button(observes ? Phrase::make_expert : Phrase::make_observer,
                     Decide{Action::set_role, person.id,
                            observes ? wire::Role::expert : wire::Role::observer}),
              removing(Phrase::clear_made, Phrase::really_clear, wire::clear_objects, person),
              removing(Phrase::remove, Phrase::really_remove, Action::remove, person)}});
    }
    if (!who.rows.empty() && facts.may_call)
        who.rows.push_back({"",
                            "",
                            {facts.is_calling ? button(Phrase::stop_calling, Call{false})
                                              : button(Phrase::call_all, Call{true})}});
    if (who.rows.empty())
        who.rows.push_back({say(Phrase::nobody_here), "", {}});
    if (facts.hand_raised)
        who.rows.push_back({"",
                            *facts.hand_raised ? say(Phrase::your_hand_is_up) : "",
                            {*facts.hand_raised ? button(Phrase::lower_hand, RaiseHand{false})
                                                : button(Phrase::raise_hand, RaiseHand{true})}});
    if (facts.own_face == OwnFace::off)
        who.rows.push_back({"", "", {button(Phrase::show_face, ShowFace{true})}});
    else if (facts.own_face != OwnFace::none)
        who.rows.push_back(
            {"", say(Phrase::you_are_seen), {button(Phrase::hide_face, ShowFace{false})}});
    panel.panels.push_back(std::move(who));
    if (!facts.places.empty())
        add_places_panel(facts.places, panel);
    // Below the others: they stay in their places when somebody knocks.
    if (facts.is_operator && !facts.visitors.empty()) {
        window::Panel door{say(Phrase::at_the_door), {}};
        for (const wire::Visitor& visitor : facts.visitors)
            door.rows.push_back(
                {visitor.name,
                 wire::spoken(visitor),
                 {button(Phrase::let_in, Decide{Action::admit, visitor.participant, {}}),
                  button(Phrase::refuse, Decide{Action::turn_away, visitor.participant, {}})}});
        panel.panels.push_back(std::move(door));
    }
    return panel;
}

RoomPanel call_panel(const std::vector<room::RoomPerson>& callers) {
    RoomPanel panel;
    if (callers.empty())
        return panel;
    window::Panel offer{say(Phrase::calls_you), {}};
    for (const room::RoomPerson& person : callers) {
        offer.rows.push_back(
            {person.name,
             "",
             {panel.button(say(Phrase::go_there), AnswerCall{person.id, true}),
              panel.button(say(Phrase::stay_here), AnswerCall{person.id, false})}});
    }
    panel.panels.push_back(std::move(offer));
    return panel;
}

RoomPanel joined(RoomPanel upper, const RoomPanel& lower) {
    const int before = int(upper.commands.size());
    for (window::Panel panel : lower.panels) {
        for (window::PanelRow& row : panel.rows)
            for (window::PanelButton& button : row.buttons)
                button.command += before;
        upper.panels.push_back(std::move(panel));
    }
    upper.commands.insert(upper.commands.end(), lower.commands.begin(), lower.commands.end());
    return upper;
}

}  // namespace theatron::viewer

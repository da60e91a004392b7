// SPDX-License-Identifier: Apache-2.0
#include "people_lines.h"

#include <algorithm>
#include <charconv>
#include <sstream>

#include "base/error.h"
#include "base/log.h"
#include "base/trimmed.h"
#include "session/room_bytes.h"
#include "wire/clear_objects.h"
#include "wire/manage_text.h"

namespace theatron::app {
namespace {

using wire::ManageAction;

constexpr struct {
    const char* word;
    ManageAction action;
} commands[] = {{"admit", ManageAction::admit},        {"refuse", ManageAction::turn_away},
                {"mute", ManageAction::mute},          {"unmute", ManageAction::unmute},
                {"role", ManageAction::set_role},      {"remove", ManageAction::remove},
                {"revoke", ManageAction::revoke_link}, {"clear", wire::clear_objects},
                {"lower", ManageAction::lower_hand}};

ParticipantId find_person(const std::string& who, const std::vector<SomePerson>& people,
                          bool waits) {
    std::vector<const SomePerson*> found;
    const auto number_of = [](const SomePerson& person) {
        return "#" + std::to_string(std::uint32_t(person.id));
    };
    const auto add = [&](std::string& list, const SomePerson& person) {
        list += (list.empty() ? "" : ", ") + number_of(person) + " " + person.name +
                (person.records ? " (records)" : "");
    };
    std::string present;
    for (const SomePerson& person : people) {
        if (who == number_of(person))
            return person.id;
        if (person.name == who)
            found.push_back(&person);
        add(present, person);
    }
    // The same name inside and at the door is no doubt.
    if (found.size() > 1)
        std::erase_if(found, [&](const SomePerson* person) { return person->waits != waits; });
    // Nor are the windows of one person who asks for the same.
    const auto is_the_same = [&](const SomePerson* person) {
        return !person->person.empty() && person->person == found.front()->person &&
               person->records == found.front()->records;
    };
    if (found.size() > 1 && !std::ranges::all_of(found, is_the_same)) {
        std::string matching;
        for (const SomePerson* person : found)
            add(matching, *person);
        throw Error("There is more than one '" + who + "'; say the number, one of " + matching +
                    ".");
    }
    if (found.empty())
        throw Error("There is no '" + who + "' here; " +
                    (present.empty() ? "nobody is." : "there are " + present + "."));
    return found.front()->id;
}

// Objects stay when their author has left. "earlier": of people before the host was started.
std::optional<ParticipantId> number_of_author(const std::string& who) {
    if (who == "earlier")
        return ParticipantId{};
    std::uint32_t number = 0;
    const char* const end = who.data() + who.size();
    if (who.size() < 2 || who[0] != '#')
        return std::nullopt;
    const auto [at, problem] = std::from_chars(who.data() + 1, end, number);
    if (problem != std::errc() || at != end || number == 0)
        return std::nullopt;
    return ParticipantId(number);
}

// Removing a person leaves what it has made.
void offer_to_clear(const PersonDecision& decision) {
    if (decision.action == ManageAction::remove)
        log::say("What that person has made in the room stays; 'clear #" +
                 std::to_string(std::uint32_t(decision.person)) + "' removes it, too.");
}

template <class Carry>
bool obey(const std::string& line, const std::vector<SomePerson>& people, const Carry& carry_out) {
    try {
        const auto decision = parse_people_line(line, people);
        if (decision) {
            carry_out(*decision);
            offer_to_clear(*decision);
        }
        return decision.has_value();
    } catch (const Error& error) {
        log::say(error.what());
        return true;
    }
}

}  // namespace

const char* people_help() {
    return "'admit NAME', 'refuse NAME', 'mute NAME', 'unmute NAME', 'lower NAME' (a raised "
           "hand),\n"
           "'role NAME ROLE', 'remove NAME', 'revoke NAME' (the link by which that person came), "
           "'clear NAME' (what\n"
           "that person has made in the room; 'clear #7' also of somebody who has left, 'clear\n"
           "earlier' of people before the host was started), 'end session'";
}

std::optional<PersonDecision> parse_people_line(const std::string& line,
                                                const std::vector<SomePerson>& people) {
    if (trimmed(line) == "end session")
        return PersonDecision{ManageAction::end_session, {}, {}};
    std::istringstream words(line);
    std::string word, who;
    words >> word;
    std::getline(words, who);
    who = trimmed(who);
    const auto command =
        std::ranges::find_if(commands, [&](const auto& c) { return c.word == word; });
    // A lone "remove" is the held object's.
    if (command == std::end(commands) || (command->action == ManageAction::remove && who.empty()))
        return std::nullopt;
    PersonDecision decision{command->action, {}, {}};
    if (decision.action == ManageAction::set_role) {
        const auto space = who.find_last_of(' ');
        const auto role = wire::parse_role(space == std::string::npos ? "" : who.substr(space + 1));
        if (!role)
            throw Error("Say 'role NAME ROLE' with operator, expert, observer or publisher.");
        decision.role = *role;
        who = trimmed(who.substr(0, space));
    }
    if (who.empty())
        throw Error("Say '" + word + " NAME'.");
    if (decision.action == wire::clear_objects)
        if (const auto number = number_of_author(who)) {
            decision.person = *number;
            return decision;
        }
    const bool at_the_door =
        decision.action == ManageAction::admit || decision.action == ManageAction::turn_away;
    decision.person = find_person(who, people, at_the_door);
    return decision;
}

bool obey_people_line(client::Participant& participant, const std::string& line) {
    std::vector<SomePerson> people;
    for (const wire::Visitor& visitor : participant.visitors())
        people.push_back(
            {visitor.participant, visitor.name, true, visitor.person, visitor.records});
    for (const auto& [id, object] : participant.room().objects)
        if (object.kind == session::ObjectKind::person && !session::is_recorded(id))
            if (const auto facts = session::decode_person(object.properties))
                people.push_back({object.creator, facts->name, false, {}, facts->records});
    return obey(line, people, [&](const PersonDecision& decision) {
        // It would take the decision for a damaged message.
        if (decision.action == ManageAction::lower_hand && !participant.has_chat())
            throw Error("This host knows no raised hands.");
        if (participant.manage(decision.action, decision.person, decision.role) == 0)
            throw Error("You have not joined yet.");
    });
}

bool obey_people_line(host::Host& host, const std::string& line) {
    const host::HostFigures figures = host.figures();
    std::vector<SomePerson> people;
    for (const wire::Visitor& visitor : figures.visitors)
        people.push_back(
            {visitor.participant, visitor.name, true, visitor.person, visitor.records});
    for (const auto& participant : figures.participants)
        people.push_back({participant.id, participant.name, false, {}, false});
    return obey(line, people, [&](const PersonDecision& decision) {
        host.manage(decision.action, decision.person, decision.role);
    });
}

void print_managed(client::Participant& participant) {
    while (const auto answer = participant.take_managed())
        if (answer->refusal != wire::ManageRefusal::none)
            log::say(wire::text_of(answer->refusal));
}

}  // namespace theatron::app

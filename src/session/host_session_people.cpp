// SPDX-License-Identifier: Apache-2.0
// Decisions of operators on participants, and what roles allow.
#include <algorithm>
#include <utility>

#include "session/audit_action.h"
#include "session/host_session.h"
#include "session/request_kinds.h"
#include "wire/clear_objects.h"

namespace theatron::session {
namespace {

using wire::ManageAction;
using wire::ManageRefusal;
using wire::TextCode;
using What = AuditEvent::What;

constexpr ParticipantId the_host{};

// True for decisions that hold for a person, on all its connections and when it comes again.
bool is_on_person(ManageAction action) {
    return action == ManageAction::mute || action == ManageAction::unmute ||
           action == ManageAction::set_role || action == ManageAction::remove ||
           action == ManageAction::lower_hand;
}

// The refusal of an offer of cameras that needs this right.
TextCode refusal_of(Right right) {
    if (right == Right::be_seen)
        return TextCode::face_forbidden;
    return right == Right::show_screen ? TextCode::screen_forbidden
                                       : TextCode::link_without_cameras;
}

}  // namespace

bool HostSession::allow(ParticipantId id, Right right) {
    Participant* participant = admission_.find(id);
    if (!participant || !participant->takes_part())
        return false;
    const bool allowed = participant->may(right);
    if (!allowed)
        ++participant->denied;
    return allowed;
}

void HostSession::deny(ParticipantId id, const wire::ToHost& message) {
    ++admission_.find(id)->denied;
    if (const auto* offer = std::get_if<wire::Publish>(&message))
        send(id, wire::Published{{}, {refusal_of(needed_right(*offer))}});
    else if (const auto* request = std::get_if<wire::RoomRequest>(&message))
        room_.refuse(id, *request, Refusal::role);
    else if (const auto* decision = std::get_if<wire::Manage>(&message))
        send(id, wire::Managed{decision->number, ManageRefusal::role});
    else if (const auto* adjusting = std::get_if<wire::AdjustCamera>(&message))
        send(id, wire::Managed{adjusting->number, ManageRefusal::adjusting_role});
    else if (const auto* play = std::get_if<wire::Play>(&message))
        send(id, wire::Managed{play->number, ManageRefusal::playing_role});
    else if (const std::uint32_t number = decision_number(message); number != 0)
        send(id, wire::Managed{number, ManageRefusal::role});
}

void HostSession::carry_out(ParticipantId id, const wire::Manage& decision, TimePoint now) {
    const std::string name = admission_.find(id)->name;
    const ManageRefusal refusal = manage(decision, id, name, now);
    // Perhaps the decision has ended the sender's own connection.
    if (const Participant* sender = admission_.find(id); sender && sender->takes_part())
        send(id, wire::Managed{decision.number, refusal});
}

ManageRefusal HostSession::manage(const wire::Manage& decision, TimePoint now,
                                  const std::string& by) {
    return manage(decision, the_host, by, now);
}

ManageRefusal HostSession::manage(const wire::Manage& decision, ParticipantId by,
                                  const std::string& by_name, TimePoint now) {
    if (decision.action == ManageAction::end_session) {
        actions_.push_back(action::Audit{event_of_session(What::ended, by_name)});
        end(TextCode::ended_by_operator);
        return ManageRefusal::none;
    }
    const ParticipantId id = decision.participant;
    if (decision.action == wire::clear_objects)
        return clear_objects(id, by_name);
    Participant* found = admission_.find(id);
    if (!found || (!found->takes_part() && !found->waits()))
        return ManageRefusal::no_such_participant;
    if (id == by)
        return ManageRefusal::yourself;
    Participant& person = *found;
    // A relay is nobody, and can only be sent away.
    if (person.of_link == Role::relay && decision.action != ManageAction::remove &&
        decision.action != ManageAction::revoke_link)
        return ManageRefusal::no_such_participant;
    // A stranger may have got hold of the operator's id. So a decision on another connection of
    // one's own holds for that one alone, and does not shut out the operator at its next join.
    const Participant* decider = admission_.find(by);
    const bool is_of_own_id = decider && is_on_person(decision.action) && !person.person.empty() &&
                              person.person == decider->person;
    const std::vector<ParticipantId> concerned =
        is_of_own_id ? std::vector{id} : connections_of(id);
    const bool for_visitors =
        decision.action == ManageAction::admit || decision.action == ManageAction::turn_away;
    if (for_visitors && !person.waits())
        return ManageRefusal::not_waiting;
    if (!for_visitors && person.waits() && decision.action != ManageAction::remove &&
        decision.action != ManageAction::revoke_link)
        return ManageRefusal::still_waiting;

    switch (decision.action) {
        case ManageAction::admit: {
            membership_.admit(person.person, person.records, now);
            for (const ParticipantId own : connections_of(id)) {
                Participant& here = *admission_.find(own);
                // To record is a question of its own.
                if (!here.waits() || (own != id && here.records && !person.records))
                    continue;
                here.admitted = now;
                audit(What::admitted, own, by_name);
                const wire::Join hello = std::move(*here.asked);
                enter(own, hello);
            }
            tell_operators();
            break;
        }
        case ManageAction::turn_away:
            audit(What::turned_away, id, by_name);
            refuse(id, {TextCode::not_let_in});
            break;
        case ManageAction::mute:
        case ManageAction::unmute:
            for (const ParticipantId own : concerned) {
                Participant& here = *admission_.find(own);
                here.muted = decision.action == ManageAction::mute;
                if (!is_of_own_id)
                    membership_.set_muted(here.person, here.muted);
                audit(here.muted ? What::muted : What::unmuted, own, by_name);
                // A visitor gets nothing of the session, and is told on entering.
                if (!here.waits())
                    tell_standing(own);
            }
            break;
        case ManageAction::set_role: {
            // By a link of another role somebody has another task, such as to publish.
            const Role of_link = person.of_link;
            for (const ParticipantId own : concerned) {
                const Participant& here = *admission_.find(own);
                if (here.of_link != of_link || here.waits())
                    continue;
                if (!is_of_own_id)
                    membership_.set_role(here.person, of_link, decision.role);
                set_role(own, decision.role);
                audit(What::role_changed, own, by_name);
            }
            break;
        }
        case ManageAction::remove:
            for (const ParticipantId own : concerned) {
                const Participant& here = *admission_.find(own);
                if (!is_of_own_id)
                    membership_.remove(here.person, here.token);
                else if (here.token != decider->token)
                    membership_.remove_by(here.person, here.token);
                audit(What::removed, own, by_name);
                refuse(own, {TextCode::removed_by_operator});
            }
            break;
        case ManageAction::revoke_link:
            // It would remove the operator, too, perhaps the last one.
            if (const Participant* own = admission_.find(by); own && own->link == person.link)
                return ManageRefusal::yourself;
            revoke_link(std::string(person.link), by_name);
            break;
        case ManageAction::lower_hand:
            for (const ParticipantId own : concerned) {
                Participant& here = *admission_.find(own);
                if (std::exchange(here.hand_raised, false))
                    room_.set_person(own, facts_of(here));
            }
            break;
        case ManageAction::end_session:
            break;
    }
    return ManageRefusal::none;
}

// Also of somebody who has left, whose objects have stayed.
ManageRefusal HostSession::clear_objects(ParticipantId id, const std::string& by) {
    const Participant* person = admission_.find(id);
    const std::size_t count = room_.clear_of(id);
    if (count == 0 && !person)
        return ManageRefusal::no_such_participant;
    const std::string detail = std::to_string(count) + (count == 1 ? " object" : " objects");
    if (person)
        audit(What::cleared, id, by, detail);
    else
        actions_.push_back(action::Audit{{What::cleared, id, "", {}, {}, "", by, detail}});
    return ManageRefusal::none;
}

std::vector<ParticipantId> HostSession::connections_of(ParticipantId id) {
    std::vector<ParticipantId> own{id};
    const Bytes& person = admission_.find(id)->person;
    for (const auto& [other, there] : admission_.participants())
        if (other != id && !person.empty() && there.person == person &&
            (there.takes_part() || there.waits()))
            own.push_back(other);
    return own;
}

void HostSession::begin_again(const std::string& by) {
    has_ended_ = false;
    membership_.forget_all();
    admission_.forget_those_who_left();
    room_.clear();
    cases_.tell_changes();
    look_back_.clear();
    chat_.clear();
    actions_.push_back(action::Audit{event_of_session(What::began, by, config_.name)});
}

void HostSession::set_role(ParticipantId id, Role role) {
    Participant& person = *admission_.find(id);
    const bool could_publish = person.may(Right::publish);
    const bool could_manage = person.may(Right::manage);
    person.role = role;
    actions_.push_back(action::ChangeRights{id});
    faces_.follow_rights(id);
    if (could_manage && !person.may(Right::manage)) {
        end_leading(id);
        // A program that is nobody in the room watches it for as long as it may manage.
        if (person.has(wire::Feature::sends_only)) {
            room_.leave(id);
            std::erase(person.features, wire::Feature::room);
        }
    }
    if (person.records && !person.may(Right::record))
        return refuse(id, {TextCode::observer_records});
    if (!person.may(Right::publish)) {
        std::erase(person.features, wire::Feature::publish);
        std::vector<CameraId> forbidden = streams_.cameras().of(id);
        std::erase_if(forbidden, [&](CameraId camera) {
            return person.may(needed_right(streams_.cameras().find(camera)->offered_as()));
        });
        shared_.remove(id, forbidden, Removal::decided);
    } else if (person.asks_to_publish && !could_publish) {
        person.features.push_back(wire::Feature::publish);
    }
    // The features of Welcome are others.
    if (could_publish != person.may(Right::publish))
        resynchronise(id);
    else
        tell_standing(id);
    cases_.tell_changes();
    if (could_manage != person.may(Right::manage))
        tell_operators();
}

void HostSession::set_tokens(std::vector<Admission::Token> tokens,
                             const std::map<std::string, std::string>& makers) {
    const auto lacks = [](const std::vector<Admission::Token>& all, const Admission::Token& one) {
        return std::none_of(all.begin(), all.end(),
                            [&](const auto& t) { return t.secret == one.secret; });
    };
    for (const Admission::Token& old : admission_.tokens())
        if (lacks(tokens, old))
            audit_link(What::link_revoked, old.role, old.link, at_the_host);
    for (const Admission::Token& made : tokens)
        if (lacks(admission_.tokens(), made)) {
            const auto maker = makers.find(made.link);
            audit_link(What::link_made, made.role, made.link,
                       maker == makers.end() ? at_the_host : maker->second);
        }
    admission_.set_tokens(std::move(tokens));
    remove_without_link(at_the_host);
}

void HostSession::revoke_link(const std::string& link, const std::string& by) {
    for (const Admission::Token& token : admission_.tokens())
        if (token.link == link)
            audit_link(What::link_revoked, token.role, link, by);
    actions_.push_back(action::RevokeLink{link});
    admission_.revoke(link);
    remove_without_link(by);
}

void HostSession::remove_without_link(const std::string& by) {
    for (auto& [id, participant] : admission_.participants())
        if ((participant.takes_part() || participant.waits()) && !admission_.knows(participant)) {
            audit(What::link_revoked, id, by);
            refuse(id, {TextCode::link_revoked});
        }
}

PersonFacts HostSession::facts_of(const Participant& person) {
    return {person.role,  person.records,        person.name,
            person.muted, person.voice_recorded, person.hand_raised};
}

// To the participant, and to all as a fact about its person in the room.
void HostSession::tell_standing(ParticipantId id) {
    const Participant& person = *admission_.find(id);
    send(id, wire::Standing{person.role, person.muted});
    room_.set_person(id, facts_of(person));
}

// Another program may have got hold of the id of an operator who is here.
void HostSession::tell_of_own_id(ParticipantId newcomer) {
    const Participant& came = *admission_.find(newcomer);
    for (const auto& [id, there] : admission_.participants())
        if (id != newcomer && there.may(Right::manage) && !came.person.empty() &&
            there.person == came.person)
            send(id, wire::Settings{
                         {},
                         wire::as_written("A further program has joined with your own id, as " +
                                          came.name + " (number " +
                                          std::to_string(std::uint32_t(newcomer)) +
                                          "). If it is none of yours, mute or remove it.")});
}

std::vector<wire::Visitor> HostSession::visitors() const {
    std::vector<wire::Visitor> visitors;
    for (const auto& [id, participant] : admission_.participants())
        if (participant.waits())
            visitors.push_back({id, participant.name, shown_person(participant.person),
                                participant.role, participant.records});
    return visitors;
}

void HostSession::tell_operators() {
    const wire::Visitors now{visitors()};
    for (const auto& [id, participant] : admission_.participants())
        if (participant.may(Right::manage))
            send(id, now);
}

void HostSession::audit_link(What what, Role role, const std::string& link, const std::string& by) {
    actions_.push_back(action::Audit{{what, {}, "", {}, role, link, by, ""}});
}

void HostSession::audit(What what, ParticipantId id, std::string by, std::string detail) {
    actions_.push_back(audit_of(what, id, *admission_.find(id), std::move(by), std::move(detail)));
}

}  // namespace theatron::session

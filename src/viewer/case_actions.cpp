// SPDX-License-Identifier: Apache-2.0
#include "viewer/case_actions.h"

#include <algorithm>
#include <cmath>

namespace theatron::viewer {
namespace {

namespace request = session::request;
using session::CaseInRoom;
using session::ObjectKind;

std::optional<CaseInRoom> open_in(const client::Participant& participant) {
    return session::case_in_room(participant.room().objects);
}

bool change(client::Participant& participant, session::ObjectId object,
            const session::CaseObject& properties) {
    return participant.ask_room(
               request::SetProperties{object, session::encode_case_object(properties)}) != 0;
}

// Moves an object that nobody holds.
bool place(client::Participant& participant, session::ObjectId id,
           const session::RoomObject& object, const Pose& pose, double scale) {
    if (object.grip.holder != ParticipantId{})
        return false;
    const std::uint32_t grip = participant.ask_room(request::Grab{id});
    return grip != 0 && participant.ask_room(request::Release{id, grip, pose, scale}) != 0;
}

const CaseInRoom::Part* find(const std::optional<CaseInRoom>& open, std::size_t part) {
    if (open)
        for (const CaseInRoom::Part& one : open->parts)
            if (one.facts.part == part)
                return &one;
    return nullptr;
}

std::uint8_t to_byte(double share) {
    return std::uint8_t(std::lround(std::clamp(share, 0.0, 1.0) * 255));
}

}  // namespace

bool open_case(client::Participant& participant, const ContentHash& offered, Vec3 middle,
               Vec3 eye) {
    // The organ's front is z.
    const double angle = std::atan2(eye.x - middle.x, eye.z - middle.z);
    return participant.ask_room(
               request::Create{ObjectKind::organ, Pose{rotation_about({0, 1, 0}, angle), middle}, 1,
                               session::encode_case_object(session::CaseOrgan{offered})}) != 0;
}

bool close_case(client::Participant& participant) {
    const auto open = open_in(participant);
    return open && participant.ask_room(request::Remove{open->organ_id}) != 0;
}

bool show_part(client::Participant& participant, std::size_t part, bool shown) {
    const auto open = open_in(participant);
    const CaseInRoom::Part* found = find(open, part);
    if (!found)
        return false;
    session::CasePart facts = found->facts;
    facts.shown = shown;
    return change(participant, found->id, facts);
}

bool set_opacity(client::Participant& participant, std::size_t part, double opacity) {
    const auto open = open_in(participant);
    const CaseInRoom::Part* found = find(open, part);
    if (!found)
        return false;
    session::CasePart facts = found->facts;
    facts.opacity = to_byte(opacity);
    return change(participant, found->id, facts);
}

bool explode(client::Participant& participant, double share) {
    const auto open = open_in(participant);
    if (!open)
        return false;
    session::CaseOrgan organ = open->organ;
    organ.explosion = to_byte(share);
    return change(participant, open->organ_id, organ);
}

bool put_together(client::Participant& participant) {
    const auto open = open_in(participant);
    if (!open)
        return false;
    if (open->organ.explosion != 0)
        explode(participant, 0);
    for (const CaseInRoom::Part& part : open->parts) {
        if (part.object.room_from_object != Pose{})
            place(participant, part.id, part.object, {}, 1);
        if (!part.facts.shown)
            show_part(participant, part.facts.part, true);
    }
    return true;
}

bool set_scale(client::Participant& participant, double scale) {
    const auto open = open_in(participant);
    return open && place(participant, open->organ_id, open->organ_object,
                         open->organ_object.room_from_object, scale);
}

bool cut_at_slice(client::Participant& participant, bool cut) {
    const auto open = open_in(participant);
    if (!open || !open->screen)
        return false;
    session::CaseOrgan organ = open->organ;
    organ.cut = cut;
    return change(participant, open->organ_id, organ);
}

bool set_screen(client::Participant& participant, const session::CaseScreen& screen) {
    const auto open = open_in(participant);
    return open && open->screen && change(participant, open->screen->id, screen);
}

bool present(client::Participant& participant, bool presents) {
    const auto open = open_in(participant);
    if (!open || !open->screen)
        return false;
    session::CaseScreen screen = open->screen->facts;
    screen.presenter = presents ? participant.room().self : ParticipantId{};
    return set_screen(participant, screen);
}

}  // namespace theatron::viewer

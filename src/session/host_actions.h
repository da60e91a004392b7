// SPDX-License-Identifier: Apache-2.0
// The actions that a HostSession requests from the host that runs it.
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "base/content_hash.h"
#include "base/ids.h"
#include "session/audit_event.h"
#include "session/key_requests.h"
#include "wire/control.h"
#include "wire/envelope.h"

namespace theatron::session {

namespace action {

// Send `message` to `participant`.
struct Send {
    ParticipantId participant{};
    wire::ToParticipant message;
};
// Close the connection after all queued messages; `why` is for the log.
struct Close {
    ParticipantId participant{};
    std::string why;
};
// End the connection at once; `why` is for the log.
struct Drop {
    ParticipantId participant{};
    std::string why;
};
// Send `message` and close the connection: the session is over.
struct End {
    ParticipantId participant{};
    wire::Goodbye message;
};
// Take media from the participant from now on, at most `max_message` bytes in one message.
struct TakeMedia {
    ParticipantId participant{};
    std::size_t max_message = 0;
};
// The participant has joined; for the log.
struct Joined {
    ParticipantId participant{};
    std::string name;
    Bytes person;  // as in wire::Join
};
// Have a key frame of one of the host's own cameras encoded.
struct RequestKey {
    KeyRequests::Key key;
};
// Encode this camera of the host exactly in HostSession's depth_settings() and color_settings().
struct ChangeSettings {
    CameraId camera{};
};
// The participant records: send all of its frames in order, however late.
struct KeepEverything {
    ParticipantId participant{};
};
// Send at most `bytes_per_second`; 0: no ceiling.
struct SetCeiling {
    ParticipantId participant{};
    std::uint64_t bytes_per_second = 0;
};
// Everything to the participant and from it is `by` later than it comes.
struct Delay {
    ParticipantId participant{};
    Duration by{};
};
// The participant has other rights: take back from the others what it may not send any more.
struct ChangeRights {
    ParticipantId participant{};
};
// The participant gets more or less, `to`; for the log.
struct Stepped {
    ParticipantId participant{};
    std::string to;
};
// The participant draws with another renderer; for the log.
struct Drawing {
    ParticipantId participant{};
    std::string renderer;
};
// For the audit log.
struct Audit {
    AuditEvent event;
};
// Send the participant `count` bytes of this content from `offset` on, behind everything else.
struct SendContent {
    ParticipantId participant{};
    ContentHash content;
    std::uint64_t offset = 0;
    std::uint32_t count = 0;
};
// Send the participant this state.
struct SendState {
    ParticipantId participant{};
    wire::StateKey key;
    Bytes body;
};
// A camera was adjusted; the session's description of it says how.
struct Adjusted {
    CameraId camera{};
    bool states_place = false;  // not a region of its picture: an operator says where it is
};
// Play the recording of the host's cameras so; then call HostSession::set_playback().
struct Play {
    wire::PlayAction action{};
    Duration position{};
    std::string by;
};
// Make this link invalid for good.
struct RevokeLink {
    std::string link;
};

}  // namespace action

using Action =
    std::variant<action::Send, action::Close, action::Drop, action::End, action::Joined,
                 action::TakeMedia, action::RequestKey, action::ChangeSettings,
                 action::KeepEverything, action::SetCeiling, action::ChangeRights, action::Stepped,
                 action::Drawing, action::Audit, action::RevokeLink, action::SendContent,
                 action::Adjusted, action::Play, action::Delay, action::SendState>;

}  // namespace theatron::session

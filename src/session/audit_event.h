// SPDX-License-Identifier: Apache-2.0
// Events of the people of a session, for its audit log (docs/formats/audit.md).
#pragma once

#include <string>
#include <utility>

#include "base/bytes.h"
#include "base/ids.h"
#include "wire/role.h"

namespace theatron::session {

// Stands for the person at the host's machine, as the one who decided.
inline constexpr const char* at_the_host = "host";

struct AuditEvent {
    enum class What : std::uint8_t {
        began,  // the session
        ended,
        waits,  // asks to be admitted
        admitted,
        turned_away,
        joined,
        left,
        removed,
        muted,
        unmuted,
        role_changed,  // to `role`
        refused,       // at joining; `detail` says why
        link_made,     // in `role`; its participant is 0
        link_revoked,  // its participant is 0; one more for each who came by it: its connection
                       // ends
        shared,        // a camera, named by `detail`
        unshared,
        voice_agreed,      // to the recording of its voice
        voice_not_agreed,  // no longer
        adjusted,          // a camera; `detail` says how
        deleted,           // the session, with its links and its room
        created,           // a further session, named by `detail`
        end_asked,         // of the session that `detail` names, for good
        recording_begun,   // by the host itself; `detail` names the file
        recording_ended,   // by the host itself; `detail` names the file, and how it ended
        cleared,           // what somebody made in the room; `detail` says how many objects
    };
    What what{};
    ParticipantId participant{};  // 0: none; the host itself
    std::string name;
    Bytes person;  // as in wire::Join
    wire::Role role{};
    std::string link;    // by which it came, or that was made or revoked; empty: it knew none
    std::string by;      // the name of the operator who decided, or at_the_host
    std::string detail;  // a camera's name; "records" of one who joined to record
};

// One that concerns no participant.
inline AuditEvent event_of_session(AuditEvent::What what, std::string by = "",
                                   std::string detail = "") {
    return {what, {}, "", {}, {}, "", std::move(by), std::move(detail)};
}

constexpr const char* text_of(AuditEvent::What what) {
    constexpr const char* texts[] = {
        "began",     "ended",        "waits",   "admitted",  "turned_away",     "joined",
        "left",      "removed",      "muted",   "unmuted",   "role_changed",    "refused",
        "link_made", "link_revoked", "shared",  "unshared",  "voice_agreed",    "voice_not_agreed",
        "adjusted",  "deleted",      "created", "end_asked", "recording_begun", "recording_ended",
        "cleared"};
    return texts[std::size_t(what)];
}

}  // namespace theatron::session

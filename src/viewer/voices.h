// SPDX-License-Identifier: Apache-2.0
// Voices in a session as a window shows them: who speaks, and how one's own microphone stands.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "base/ids.h"
#include "window/overlay_content.h"
#include "wire/control.h"

namespace theatron::viewer {

enum class Microphone {
    none,     // the person only listens: nothing to show
    missing,  // the device that was asked for is not there, or denied
    closed,
    waits,  // push to talk, and the key is not held
    open,
};

struct Voices {
    std::map<ParticipantId, int> speaking;  // the others who speak now, with their levels in dBFS
    std::optional<Microphone> microphone;   // nothing: the window has none to show
    int own_level_db = -127;                // of an open microphone
    // The person agrees that others record the voice; nothing: the host does not ask.
    std::optional<bool> may_record;

    bool operator==(const Voices&) const = default;
};

// A level meter of five characters, always of the same width: "|||..".
std::string meter_text(int level_db);

// Says in a session that is recorded whether the person's voice is, too.
std::optional<window::Fact> recorded_voice_fact(const Voices& voices);

// The state of the person's own microphone, and what to do if nobody hears the person.
std::optional<window::Fact> microphone_fact(const Voices& voices, const wire::Standing& standing);

}  // namespace theatron::viewer

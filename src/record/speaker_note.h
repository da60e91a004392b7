// SPDX-License-Identifier: Apache-2.0
// The line beside blocks of a voice that names its speaker: the participant's number, a space, and
// the name.
#pragma once

#include <charconv>
#include <optional>
#include <string>

#include "record/recorded_voice.h"

namespace theatron::record {

inline std::string speaker_note(const RecordedVoice& voice) {
    return std::to_string(std::uint32_t(voice.person)) + " " + voice.name;
}

inline std::string name_in(const std::string& note) {
    const auto space = note.find(' ');
    return space == std::string::npos ? "" : note.substr(space + 1);
}

// Nobody for a line of another form. Safe for any text.
inline std::optional<RecordedVoice> parse_speaker_note(const std::string& note) {
    std::uint32_t number = 0;
    const char* const end = note.data() + note.size();
    const auto [at, problem] = std::from_chars(note.data(), end, number);
    if (problem != std::errc() || at == end || *at != ' ' || number == 0)
        return std::nullopt;
    return RecordedVoice{ParticipantId(number), std::string(at + 1, end)};
}

}  // namespace theatron::record

// SPDX-License-Identifier: Apache-2.0
#include "viewer/voices.h"

#include <algorithm>

#include "phrases/phrase.h"

namespace theatron::viewer {
namespace {

constexpr int meter_marks = 5;
// The first mark is at a level that counts as speech, and each further one a step above it.
constexpr int first_mark_db = -50, mark_step_db = 10;

}  // namespace

std::string meter_text(int level_db) {
    const int marks = level_db < first_mark_db
                          ? 0
                          : std::min(meter_marks, 1 + (level_db - first_mark_db) / mark_step_db);
    std::string text(meter_marks, '.');
    std::fill_n(text.begin(), marks, '|');
    return text;
}

std::optional<window::Fact> recorded_voice_fact(const Voices& voices) {
    if (!voices.may_record || !voices.microphone || *voices.microphone == Microphone::none)
        return std::nullopt;
    return *voices.may_record
               ? window::Fact{say(Phrase::your_voice), say(Phrase::voice_is_recorded), true}
               : window::Fact{say(Phrase::your_voice), say(Phrase::voice_is_not_recorded), false};
}

std::optional<window::Fact> microphone_fact(const Voices& voices, const wire::Standing& standing) {
    if (!voices.microphone)
        return std::nullopt;
    const auto fact = [&](Phrase text, bool warning) {
        return window::Fact{say(Phrase::microphone), say(text, meter_text(voices.own_level_db)),
                            warning};
    };
    switch (*voices.microphone) {
        case Microphone::none:
            return std::nullopt;
        case Microphone::missing:
            return fact(Phrase::microphone_missing, true);
        case Microphone::closed:
            return fact(Phrase::microphone_closed, false);
        case Microphone::waits:
        case Microphone::open:
            break;
    }
    if (standing.muted)
        return fact(Phrase::microphone_muted, true);
    if (standing.role == wire::Role::observer)
        return fact(Phrase::microphone_not_heard, true);
    if (voices.microphone == Microphone::waits)
        return fact(Phrase::microphone_waits, false);
    return fact(Phrase::microphone_open, false);
}

}  // namespace theatron::viewer

// SPDX-License-Identifier: Apache-2.0
#include "viewer/voices.h"

#include <algorithm>

namespace theatron::viewer {
namespace {

constexpr int meter_marks = 5;
// The first mark is at a level that counts as speech, and each further one so much above it.
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

std::optional<xr::Fact> recorded_voice_fact(const Voices& voices) {
    if (!voices.may_record || !voices.microphone || *voices.microphone == Microphone::none)
        return std::nullopt;
    return *voices.may_record ? xr::Fact{"Your voice", "is recorded, F8 ends that", true}
                              : xr::Fact{"Your voice", "is not recorded, F8 agrees", false};
}

std::optional<xr::Fact> microphone_fact(const Voices& voices, const wire::Standing& standing) {
    if (!voices.microphone)
        return std::nullopt;
    const auto fact = [](const std::string& text, bool warning) {
        return xr::Fact{"Microphone", text, warning};
    };
    switch (*voices.microphone) {
        case Microphone::none:
            return std::nullopt;
        case Microphone::missing:
            return fact("missing: it is used when it is plugged in", true);
        case Microphone::closed:
            return fact("closed, L opens it", false);
        case Microphone::waits:
        case Microphone::open:
            break;
    }
    if (standing.muted)
        return fact("open, but an operator has muted you", true);
    if (standing.role == wire::Role::observer)
        return fact("open, but observers are not heard", true);
    if (voices.microphone == Microphone::waits)
        return fact("hold Enter to speak", false);
    return fact("open " + meter_text(voices.own_level_db), false);
}

}  // namespace theatron::viewer

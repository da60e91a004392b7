// SPDX-License-Identifier: Apache-2.0
// Sentences and words that this program itself says to its person, in every language: notes, facts,
// panels.
//
// The tables *.inc hold the phrases by key; a row without one of the languages does not compile.
// tools/check_phrases.py finds keys that nothing uses, and sentences that are in no table. Texts
// that come over the wire have codes instead: wire/text.h.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "phrases/language.h"

namespace theatron {

enum class Phrase : std::uint16_t {
#define PHRASE(key, ...) key,
#include "phrases/bar.inc"
#include "phrases/connection.inc"
#include "phrases/face.inc"
#include "phrases/form.inc"
#include "phrases/meeting.inc"
#include "phrases/pictures.inc"
#include "phrases/study.inc"
#include "phrases/window.inc"
#undef PHRASE
};

// For a person without a keyboard, phrases name no keys (touch.inc). Safe from any thread.
void set_by_touch(bool by_touch);

const Sentence& sentence_of(Phrase phrase);

// In the program's language.
template <class... Arguments>
std::string say(Phrase phrase, const Arguments&... arguments) {
    return filled_in(sentence_of(phrase).in(language()), {std::string(arguments)...});
}

}  // namespace theatron

// SPDX-License-Identifier: Apache-2.0
#include "phrases/phrase.h"

#include <algorithm>
#include <iterator>

namespace theatron {
namespace {

constexpr Sentence phrases[] = {
#define PHRASE(key, english, german) {english, german},
#include "phrases/connection.inc"
#include "phrases/meeting.inc"
#include "phrases/pictures.inc"
#include "phrases/window.inc"
#undef PHRASE
};
static_assert(std::none_of(std::begin(phrases), std::end(phrases), [](const Sentence& sentence) {
    return sentence.english.empty() || sentence.german.empty();
}));

}  // namespace

const Sentence& sentence_of(Phrase phrase) {
    return phrases[std::size_t(phrase)];
}

}  // namespace theatron

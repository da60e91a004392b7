// SPDX-License-Identifier: Apache-2.0
#include "phrases/phrase.h"

#include <algorithm>
#include <atomic>
#include <iterator>

namespace theatron {
namespace {

constexpr Sentence phrases[] = {
#define PHRASE(key, english, german) {english, german},
#include "phrases/bar.inc"
#include "phrases/connection.inc"
#include "phrases/form.inc"
#include "phrases/meeting.inc"
#include "phrases/pictures.inc"
#include "phrases/study.inc"
#include "phrases/window.inc"
#undef PHRASE
};
static_assert(std::none_of(std::begin(phrases), std::end(phrases), [](const Sentence& sentence) {
    return sentence.english.empty() || sentence.german.empty();
}));

struct WithoutKeys {
    Phrase phrase;
    Sentence sentence;
};
constexpr WithoutKeys without_keys[] = {
#define BY_TOUCH(key, english, german) {Phrase::key, {english, german}},
#include "phrases/touch.inc"
#undef BY_TOUCH
};

std::atomic<bool> is_by_touch = false;

}  // namespace

void set_by_touch(bool by_touch) {
    is_by_touch.store(by_touch, std::memory_order_relaxed);
}

const Sentence& sentence_of(Phrase phrase) {
    if (is_by_touch.load(std::memory_order_relaxed))
        for (const WithoutKeys& other : without_keys)
            if (other.phrase == phrase)
                return other.sentence;
    return phrases[std::size_t(phrase)];
}

}  // namespace theatron

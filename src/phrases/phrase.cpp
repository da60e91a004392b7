// SPDX-License-Identifier: Apache-2.0
#include "phrases/phrase.h"

#include <algorithm>
#include <atomic>
#include <iterator>

namespace theatron {
namespace {

constexpr Sentence phrases[] = {
#define PHRASE(key, ...) {__VA_ARGS__},
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
static_assert(std::all_of(std::begin(phrases), std::end(phrases),
                          [](const Sentence& sentence) { return sentence.is_complete(); }));

struct WithoutKeys {
    Phrase phrase;
    Sentence sentence;
};
constexpr WithoutKeys without_keys[] = {
#define BY_TOUCH(key, ...) {Phrase::key, {__VA_ARGS__}},
#include "phrases/touch.inc"
#undef BY_TOUCH
};
static_assert(std::all_of(std::begin(without_keys), std::end(without_keys),
                          [](const WithoutKeys& row) { return row.sentence.is_complete(); }));

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

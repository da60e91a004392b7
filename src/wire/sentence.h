// SPDX-License-Identifier: Apache-2.0
// The sentences of wire/text.h in the language of the program's person.
#pragma once

#include <string>

#include "phrases/language.h"
#include "phrases/phrase.h"
#include "wire/role.h"
#include "wire/text.h"

namespace theatron::wire {

struct Delivery;
struct Visitor;

// As english() and english_without_advice() of text.h.
std::string sentence(const Text& text, Language which = language());
std::string sentence_without_advice(const Text& text, Language which = language());

// As sent_part() of control.h.
std::string sent_part(const Delivery& delivery, Language which);

// The role as a word, and in "You are an expert now": in German and French it has no article.
inline std::string spoken(Role role) {
    switch (role) {
        case Role::expert:
            return say(Phrase::expert);
        case Role::publisher:
            return say(Phrase::publisher);
        case Role::observer:
            return say(Phrase::observer);
        case Role::operator_:
            return say(Phrase::operator_);
        case Role::relay:
            break;
    }
    return say(Phrase::unknown);
}
inline std::string spoken_with_article(Role role) {
    switch (role) {
        case Role::expert:
            return say(Phrase::an_expert);
        case Role::publisher:
            return say(Phrase::a_publisher);
        case Role::observer:
            return say(Phrase::an_observer);
        case Role::operator_:
            return say(Phrase::an_operator);
        case Role::relay:
            break;
    }
    return say(Phrase::unknown);
}
// "expert", or "expert, records" for somebody who would record.
std::string spoken(const Visitor& visitor);

}  // namespace theatron::wire

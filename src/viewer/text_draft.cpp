// SPDX-License-Identifier: Apache-2.0
#include "viewer/text_draft.h"

#include "base/outside_text.h"

namespace theatron::viewer {
namespace {

void erase_last_character(std::string& text) {
    const auto is_continued = [](char byte) {
        return (static_cast<unsigned char>(byte) & 0xC0) == 0x80;
    };
    while (!text.empty() && is_continued(text.back()))
        text.pop_back();
    if (!text.empty())
        text.pop_back();
}

}  // namespace

TextDraft::Result TextDraft::take(const window::FormKeyPress& press) {
    switch (press.key) {
        case window::FormKey::letters:
            text_ = clean_text(text_ + press.text, most_characters_);
            break;
        case window::FormKey::backspace:
            erase_last_character(text_);
            break;
        case window::FormKey::enter:
            return Result::finished;
        case window::FormKey::escape:
            return Result::given_up;
        default:
            break;
    }
    return Result::goes_on;
}

}  // namespace theatron::viewer

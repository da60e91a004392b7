// SPDX-License-Identifier: Apache-2.0
#include "viewer/text_draft.h"

#include "base/outside_text.h"
#include "base/utf8.h"

namespace theatron::viewer {

TextDraft::Result TextDraft::take(const window::FormKeyPress& press) {
    switch (press.key) {
        case window::FormKey::letters:
            text_ = clean_text(text_ + press.text, most_characters_);
            break;
        case window::FormKey::backspace:
            drop_last_character(text_);
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

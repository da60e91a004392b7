// SPDX-License-Identifier: Apache-2.0
// A text that a person is writing, at whose end the letters are added.
//
// Pure.
#pragma once

#include <cstddef>
#include <string>

#include "window/form_input.h"

namespace theatron::viewer {

class TextDraft {
public:
    explicit TextDraft(std::size_t most_characters) : most_characters_(most_characters) {}

    enum class Result { goes_on, finished, given_up };  // by Enter, by Esc
    Result take(const window::FormKeyPress& press);
    // Clean text (base/outside_text.h).
    const std::string& text() const { return text_; }
    void set(const std::string& text) { text_ = text; }

private:
    const std::size_t most_characters_;
    std::string text_;
};

}  // namespace theatron::viewer

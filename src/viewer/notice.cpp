// SPDX-License-Identifier: Apache-2.0
#include "viewer/notice.h"

#include <algorithm>
#include <utility>

namespace theatron::viewer {

void Notice::say(std::string text, TimePoint now) {
    text_ = std::move(text);
    said_at_ = now;
}

void Notice::take_back(const std::string& text) {
    if (text_ == text)
        text_.clear();
}

void Notice::begin(TimePoint now) {
    if (!began_at_)
        began_at_ = now;
}

const std::string& Notice::text(TimePoint now) const {
    static const std::string none;
    const bool is_over = began_at_ && now >= std::max(said_at_, *began_at_) + time_shown;
    return is_over ? none : text_;
}

}  // namespace theatron::viewer

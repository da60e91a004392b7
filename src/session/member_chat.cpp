// SPDX-License-Identifier: Apache-2.0
#include "session/member_chat.h"

#include <algorithm>
#include <utility>

#include "base/outside_text.h"
#include "base/shown_name.h"
#include "base/trimmed.h"

namespace theatron::session {

void MemberChat::on_connected() {
    sent_.reset();
}

std::vector<wire::ChatMessage> MemberChat::take(const wire::ChatMessages& message) {
    std::vector<wire::ChatMessage> news;
    for (const wire::ChatMessage& one : message.messages) {
        if (!unsent_.empty() && unsent_.front().id == one.id) {
            unsent_.pop_front();
            sent_.reset();
            ++version_;
        }
        const bool is_known = std::any_of(messages_.begin(), messages_.end(),
                                          [&](const auto& known) { return known.id == one.id; });
        if (is_known)
            continue;
        if (messages_.size() >= max_kept) {
            own_.erase(messages_.front().id);
            messages_.pop_front();
        }
        messages_.push_back(one);
        news.push_back(one);
        ++version_;
    }
    return news;
}

bool MemberChat::write(const std::string& text, std::uint64_t id) {
    std::string clean(trimmed(clean_text(text, wire::max_chat_text)));
    if (clean_name(clean, clean.size()).empty() || unsent_.size() >= max_unsent)
        return false;
    unsent_.push_back({id, std::move(clean)});
    own_.insert(id);
    ++version_;
    return true;
}

void MemberChat::go_on(const std::vector<std::uint64_t>& own,
                       const std::vector<wire::WriteChat>& unsent) {
    own_.insert(own.begin(), own.begin() + std::ptrdiff_t(std::min(own.size(), max_kept)));
    for (const wire::WriteChat& written : unsent)
        (void)write(written.text, written.id);
}

std::optional<wire::WriteChat> MemberChat::due(TimePoint now) {
    if (unsent_.empty() || (sent_ && now - *sent_ < repeated_after))
        return std::nullopt;
    sent_ = now;
    return unsent_.front();
}

std::vector<std::string> MemberChat::give_up() {
    std::vector<std::string> texts;
    // They stay one's own: the host may have one of them all the same.
    for (wire::WriteChat& written : std::exchange(unsent_, {}))
        texts.push_back(std::move(written.text));
    sent_.reset();
    version_ += !texts.empty();
    return texts;
}

}  // namespace theatron::session

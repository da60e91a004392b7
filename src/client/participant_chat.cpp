// SPDX-License-Identifier: Apache-2.0
// Messages of people to all others, and raised hands.
#include <utility>

#include "base/random_number.h"
#include "base/steady_clock.h"
#include "client/participant_shared.h"
#include "phrases/phrase.h"

namespace theatron::client {
namespace {

// The host sends what this program has missed, perhaps its own messages, some moments after the
// person's standing; and a hand that is not up after this time is raised again.
constexpr Duration mute_patience = std::chrono::seconds(2);
constexpr Duration hand_patience = std::chrono::seconds(3);

}  // namespace

void Participant::on_chat() {
    std::vector<std::string> remarks;
    {
        const std::lock_guard lock(shared_->mutex);
        for (const wire::ChatMessage& message : shared_->chat.take(session_.chat()))
            if (!shared_->chat.is_own(message.id))
                shared_->add_remark(remarks, message.name,
                                    say(Phrase::person_writes, message.name, message.text));
    }
    announce();
    for (const std::string& text : remarks)
        tell_written(text);
    tell_chat();
}

void Participant::tell_written(const std::string& text) const {
    if (options_.written)
        options_.written(text);
}

void Participant::tell_chat() {
    if (!session_.joined())
        return;
    const TimePoint now = steady_now();
    std::optional<wire::WriteChat> due;
    bool is_given_up = false;
    {
        const std::lock_guard lock(shared_->mutex);
        shared_->has_chat = session_.has(wire::Feature::chat);
        if (!shared_->status.standing.muted)
            shared_->muted_since.reset();
        else if (!shared_->muted_since)
            shared_->muted_since = now;
        is_given_up = shared_->muted_since && now - *shared_->muted_since >= mute_patience;
        if (shared_->has_chat && !shared_->muted_since)
            due = shared_->chat.due(now);
    }
    if (due)
        shared_->client->send_control(wire::encode(*due));
    if (is_given_up)
        give_up_chat();
    tell_hand(now);
}

// Again until the room shows it: a host takes few such wishes a second.
void Participant::tell_hand(TimePoint now) {
    std::optional<bool> told;
    {
        const std::lock_guard lock(shared_->mutex);
        std::optional<bool>& wish = shared_->hand_wish;
        if (!wish || !shared_->has_chat || !shared_->room.known())
            return;
        // The room may still show what was before this wish, so each is told once.
        std::optional<TimePoint>& told_at = shared_->hand_told;
        if (told_at && now - *told_at < hand_patience)
            return;
        if (told_at && shared_->own_hand_is_up() == *wish) {
            wish.reset();
            return;
        }
        shared_->hand_told = now;
        told = wish;
    }
    shared_->client->send_control(wire::encode(wire::RaiseHand{*told}));
}

void Participant::give_up_chat() {
    std::vector<std::string> texts;
    {
        const std::lock_guard lock(shared_->mutex);
        texts = shared_->chat.give_up();
    }
    for (const std::string& text : texts)
        tell_written(say(Phrase::message_not_sent, text));
}

void Participant::follow_hands() {
    std::vector<std::string> remarks;
    {
        const std::lock_guard lock(shared_->mutex);
        if (!options_.shows_chat || !shared_->room.known())
            return;
        for (const auto& [person, name] : shared_->hands.take(shared_->room.confirmed()))
            if (person != shared_->room.self())
                shared_->add_remark(remarks, name, say(Phrase::person_raises_hand, name));
        // The host has carried out the wish: whoever changes the hand now has the last word.
        const bool is_up = shared_->own_hand_is_up();
        if (std::exchange(shared_->hand_shown, is_up) != is_up && shared_->hand_told &&
            shared_->hand_wish == is_up)
            shared_->hand_wish.reset();
    }
    for (const std::string& text : remarks)
        remark(text);
}

session::MemberChat Participant::chat_so_far() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->chat;
}

Participant::Chat Participant::chat() const {
    const std::lock_guard lock(shared_->mutex);
    const session::MemberChat& chat = shared_->chat;
    Chat result{{chat.messages().begin(), chat.messages().end()}, {}, {}, chat.version()};
    for (const wire::ChatMessage& message : chat.messages())
        if (chat.is_own(message.id))
            result.own.insert(message.id);
    for (const wire::WriteChat& written : chat.unsent())
        result.unsent.push_back(written.text);
    return result;
}

std::uint64_t Participant::chat_version() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->chat.version();
}

bool Participant::has_chat() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->has_chat;
}

bool Participant::may_write() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->has_chat && !shared_->status.standing.muted;
}

bool Participant::write_chat(const std::string& text) {
    const std::lock_guard lock(shared_->mutex);
    if (!shared_->has_chat || shared_->status.standing.muted ||
        !shared_->chat.write(text, random_number()))
        return false;
    if (shared_->client)
        shared_->client->post([this] { tell_chat(); });
    return true;
}

bool Participant::raise_hand(bool raised) {
    const std::lock_guard lock(shared_->mutex);
    if (!shared_->client || !shared_->has_chat || shared_->status.phase != Phase::joined)
        return false;
    shared_->hand_wish = raised;
    shared_->hand_told.reset();
    shared_->client->post([this] { tell_hand(steady_now()); });
    return true;
}

bool Participant::hand_raised() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->own_hand_is_up();
}

bool Participant::wants_hand_raised() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->hand_wish.value_or(shared_->own_hand_is_up());
}

std::vector<session::RaisedHands::Hand> Participant::raised_hands() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->hands.raised();
}

}  // namespace theatron::client

// SPDX-License-Identifier: Apache-2.0
#include "or_screen/content.h"

#include <algorithm>

#include "pace/drawing_watch.h"
#include "phrases/phrase.h"
#include "room/people.h"
#include "room/srgb.h"
#include "viewer/age_text.h"

namespace theatron::or_screen {
namespace {

using client::Participant;

constexpr double silent_person_ms = 3000;

PersonCard card_of(const PersonNow& person) {
    PersonCard card;
    card.id = person.id;
    card.name = person.name;
    card.initials = session::initials_of(person.name);
    card.color = room::srgb_of(room::color_of(person.id));
    card.speaks = person.speaks;
    card.is_recorded = person.is_recorded;
    if (person.pose_age_ms.value_or(0) > silent_person_ms && !person.speaks) {
        card.state = say(Phrase::screen_no_sign, viewer::age_text(*person.pose_age_ms));
        card.warns = true;
    } else if (person.hand_raised) {
        card.state = say(Phrase::hand_is_up);
        card.warns = true;
    } else if (person.points && person.points_at_images) {
        card.state = say(Phrase::screen_points_at_images);
    } else if (person.points && person.pointed == Sight::hidden) {
        card.state = "points: hidden";
        card.warns = true;
    } else if (person.points && person.pointed == Sight::outside) {
        card.state = say(Phrase::screen_points_elsewhere);
        card.warns = true;
    } else if (person.points) {
        card.state = "points";
    } else if (person.speaks) {
        card.state = "speaks";
    } else if (person.muted) {
        card.state = "muted";
    } else {
        card.state = person.role == wire::Role::observer ? "observes" : "listens";
    }
    return card;
}

}  // namespace

std::vector<PersonCard> cards_of(const std::vector<PersonNow>& people, std::size_t most) {
    std::vector<PersonNow> shown = people;
    const auto is_active = [](const PersonNow& person) {
        return person.speaks || person.points || person.hand_raised;
    };
    const auto by_number = [](const PersonNow& a, const PersonNow& b) { return a.id < b.id; };
    std::sort(shown.begin(), shown.end(), by_number);
    if (shown.size() > most) {
        std::stable_partition(shown.begin(), shown.end(), is_active);
        shown.resize(most);
        std::sort(shown.begin(), shown.end(), by_number);
    }
    std::vector<PersonCard> cards;
    for (const PersonNow& person : shown)
        cards.push_back(card_of(person));
    return cards;
}

ScreenMessage message_of(const Participant::Status& status) {
    switch (status.phase) {
        case Participant::Phase::joined:
            return {};
        case Participant::Phase::connecting:
            return {say(Phrase::screen_connecting), status.host_name};
        case Participant::Phase::waiting:
            return {say(Phrase::screen_waits_at_door), say(Phrase::screen_operator_decides)};
        case Participant::Phase::lost:
            return {say(status.joins > 0 ? Phrase::screen_no_experts : Phrase::screen_not_open_yet),
                    say(Phrase::screen_goes_on, status.problem)};
        case Participant::Phase::refused:
            return {say(Phrase::screen_not_let_in),
                    say(Phrase::screen_tries_again, status.problem)};
        case Participant::Phase::ended:
            return {say(Phrase::session_is_over), say(Phrase::screen_joins_next, status.problem)};
    }
    return {};
}

std::vector<std::string> written_texts(const client::Participant::Chat& chat, TimePoint now) {
    // A host that has started anew may count its time anew: what is written in its future is old.
    const auto is_shown = [&](const wire::ChatMessage& message) {
        return now - message.at <= written_for && message.at - now <= written_for;
    };
    std::vector<std::string> texts;
    const std::size_t newest = chat.messages.size() - std::min(chat.messages.size(), most_written);
    for (std::size_t i = newest; i < chat.messages.size(); ++i)
        if (const wire::ChatMessage& message = chat.messages[i]; is_shown(message))
            texts.push_back(say(Phrase::person_writes, message.name, message.text));
    return texts;
}

void describe_picture(const client::CameraFigures& camera, double age_ms, Content& content) {
    const wire::CameraState& state = camera.camera.state;
    content.camera = camera.camera.description.name;
    const bool is_live = state.condition == wire::CameraCondition::live;
    const bool stands_still = !is_live || age_ms >= to_ms(pace::still_after);
    if (!content.playback.empty()) {
        if (stands_still)
            content.warning =
                say(Phrase::screen_no_new_picture, content.playback, viewer::age_text(age_ms));
        return;
    }
    content.age = viewer::age_text(age_ms);
    content.age_warns = !is_live || age_ms > viewer::old_picture_ms;
    if (stands_still)
        content.warning = say(Phrase::screen_picture_is_old, viewer::age_text(age_ms));
}

}  // namespace theatron::or_screen

// SPDX-License-Identifier: Apache-2.0
#include "or_screen/content.h"

#include <algorithm>

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
        card.state = "no sign for " + viewer::age_text(*person.pose_age_ms);
        card.warns = true;
    } else if (person.points && person.points_at_images) {
        card.state = "points at images";
    } else if (person.points && person.pointed == Sight::hidden) {
        card.state = "points: hidden";
        card.warns = true;
    } else if (person.points && person.pointed == Sight::outside) {
        card.state = "points elsewhere";
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
    const auto is_active = [](const PersonNow& person) { return person.speaks || person.points; };
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
            return {"Connecting", status.host_name};
        case Participant::Phase::waiting:
            return {"Waiting to be let in", "An operator of the session decides."};
        case Participant::Phase::lost:
            return {
                status.joins > 0 ? "No connection to the experts" : "The session is not open yet",
                "This screen goes on by itself. " + status.problem};
        case Participant::Phase::refused:
            return {"The host does not let this screen in",
                    status.problem + " This screen tries again by itself."};
        case Participant::Phase::ended:
            return {"The session is over",
                    status.problem + " This screen joins the next one by itself."};
    }
    return {};
}

void describe_picture(const client::CameraFigures& camera, double age_ms, Content& content) {
    const wire::CameraState& state = camera.camera.state;
    content.camera = camera.camera.description.name;
    const bool is_live = state.condition == wire::CameraCondition::live;
    constexpr double frozen_ms = 2000;
    const bool stands_still = !is_live || age_ms > frozen_ms;
    if (!content.playback.empty()) {
        if (stands_still)
            content.warning = content.playback + ": no new picture for " + viewer::age_text(age_ms);
        return;
    }
    content.age = viewer::age_text(age_ms);
    content.age_warns = !is_live || age_ms > viewer::old_picture_ms;
    if (stands_still)
        content.warning = "NOT LIVE: this picture is " + viewer::age_text(age_ms) + " old";
}

}  // namespace theatron::or_screen

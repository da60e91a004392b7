// SPDX-License-Identifier: Apache-2.0
#include "viewer/screen_offer.h"

#include <utility>

#include "phrases/phrase.h"
#include "session/shared_screen.h"

namespace theatron::viewer {

void ScreenOffer::follow(const session::RoomObjects& objects, ParticipantId self, TimePoint now) {
    std::set<session::ObjectId> shared;
    for (const auto& [id, object] : objects) {
        const auto screen = session::decode_shared_screen(object.kind, object.properties);
        if (!screen || !screen->camera || session::is_recorded(id) || object.creator == self ||
            object.creator == ParticipantId{})
            continue;
        shared.insert(id);
        // Numbers of objects grow with time: the last one is the newest.
        if (!known_.contains(id))
            offered_ = {id, screen->publisher, screen->name, now + offered_for};
    }
    known_ = std::move(shared);
    if (offered_ && !known_.contains(offered_->screen))
        offered_.reset();
}

window::PanelRow ScreenOffer::row(RoomPanel& panel) const {
    return {say(Phrase::screen_offered, offered_->publisher, offered_->name),
            "",
            {panel.button(say(Phrase::show), ShowScreen{offered_->screen}),
             panel.button(say(Phrase::not_now), CloseScreenOffer{})}};
}

}  // namespace theatron::viewer

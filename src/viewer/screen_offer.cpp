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
            offered_.push_back({id, screen->publisher, screen->name, now + offered_for});
    }
    known_ = std::move(shared);
    std::erase_if(offered_, [&](const Offered& offered) {
        return !known_.contains(offered.screen) || now >= offered.until;
    });
}

void ScreenOffer::close(session::ObjectId screen) {
    std::erase_if(offered_, [&](const Offered& offered) { return offered.screen == screen; });
}

const ScreenOffer::Offered* ScreenOffer::newest(TimePoint now) const {
    return offered_.empty() || now >= offered_.back().until ? nullptr : &offered_.back();
}

window::PanelRow ScreenOffer::row(RoomPanel& panel, TimePoint now) const {
    const Offered& offered = *newest(now);
    return {say(Phrase::screen_offered, offered.publisher, offered.name),
            "",
            {panel.button(say(Phrase::show), ShowScreen{offered.screen}),
             panel.button(say(Phrase::not_now), CloseScreenOffer{offered.screen})}};
}

}  // namespace theatron::viewer

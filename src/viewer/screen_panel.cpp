// SPDX-License-Identifier: Apache-2.0
#include "viewer/screen_panel.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "phrases/phrase.h"
#include "session/permissions.h"
#include "session/shared_screen.h"

namespace theatron::viewer {
namespace {

namespace request = session::request;

// "shared by Ben, 1.20 m wide, pinned, Anna holds it".
std::string state_of(const session::RoomObject& object, const session::SharedScreen& screen,
                     const ScreenPanelFacts& facts) {
    char width[32];
    std::snprintf(width, sizeof(width), "%.2f", object.scale);
    std::string text = (object.creator == ParticipantId{} ? say(Phrase::of_host)
                        : object.creator == facts.self    ? say(Phrase::you_share_it)
                                                       : say(Phrase::shared_by, screen.publisher)) +
                       ", " + say(Phrase::meters_wide, decimal(width));
    if (screen.pinned)
        text += ", " + say(Phrase::pinned);
    const ParticipantId holder = object.grip.holder;
    if (holder == facts.self && holder != ParticipantId{})
        text += ", " + say(Phrase::you_hold_it);
    else if (const auto name = facts.names.find(holder); name != facts.names.end())
        text += ", " + say(Phrase::holds_it, name->second);
    return text;
}

}  // namespace

Pose in_front_of(const ScreenPlace& screen) {
    const double distance_m = std::max(screen.width_m, 1.3 * screen.height_m);
    return screen.room_from_screen * Pose{Quat{}, {0, 0, -distance_m}};
}

bool may_decide_on_screen(const session::RoomObject& screen, ParticipantId self, wire::Role role) {
    return session::may(role, session::Right::manage) ||
           (screen.creator == self && session::may(role, session::Right::handle));
}

void add_screen_panel(const ScreenPanelFacts& facts, RoomPanel& panel) {
    using What = ChangeScreen::What;
    window::Panel screens{say(Phrase::screens), {}};
    for (const auto& [id, object] : *facts.objects) {
        const auto screen = session::decode_shared_screen(object.kind, object.properties);
        if (!screen || !screen->camera || session::is_recorded(id))
            continue;
        window::PanelRow row{screen->name, state_of(object, *screen, facts), {}};
        const auto add = [&, number = id](Phrase label, What what) {
            row.buttons.push_back(panel.button(say(label), ChangeScreen{what, number}));
        };
        // Nobody gets the pictures of an own screen.
        if (object.creator != facts.self)
            row.buttons.push_back(panel.button(say(Phrase::show), ShowScreen{id}));
        if (session::may(facts.role, session::Right::handle) && !screen->pinned &&
            object.grip.holder == ParticipantId{}) {
            add(Phrase::smaller, What::smaller);
            add(Phrase::larger, What::larger);
        }
        if (may_decide_on_screen(object, facts.self, facts.role)) {
            add(screen->pinned ? Phrase::unpin : Phrase::pin_in_place,
                screen->pinned ? What::unpin : What::pin);
            // The host's own screens do not end.
            if (object.creator != ParticipantId{})
                add(Phrase::end_share, What::end);
        }
        screens.rows.push_back(std::move(row));
    }
    if (!screens.rows.empty())
        panel.panels.push_back(std::move(screens));
}

bool change_screen(const ChangeScreen& change, client::Participant& participant) {
    const auto room = participant.room();
    auto screen = session::shared_screen_of(room.objects, change.screen);
    if (!screen || !screen->camera)
        return false;
    const session::RoomObject& object = room.objects.at(change.screen);
    using What = ChangeScreen::What;
    switch (change.what) {
        case What::smaller:
        case What::larger: {
            const double factor =
                change.what == What::larger ? screen_width_step : 1 / screen_width_step;
            const std::uint32_t grip = participant.ask_room(request::Grab{change.screen});
            participant.ask_room(
                request::Release{change.screen, grip, object.room_from_object,
                                 session::clamped_screen_width(object.scale * factor)});
            break;
        }
        case What::pin:
        case What::unpin:
            screen->pinned = change.what == What::pin;
            participant.ask_room(
                request::SetProperties{change.screen, session::encode_shared_screen(*screen)});
            break;
        case What::end:
            participant.ask_room(request::Remove{change.screen});
            break;
    }
    return true;
}

}  // namespace theatron::viewer

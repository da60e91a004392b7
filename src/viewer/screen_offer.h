// SPDX-License-Identifier: Apache-2.0
// Offers a screen that another person has begun to share: for a while, with buttons that show it or
// decline. The host's own screens belong to the room and are not offered.
//
// Pure; the time is passed in. Not thread safe.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "viewer/room_panel.h"

namespace theatron::viewer {

class ScreenOffer {
public:
    static constexpr Duration offered_for = std::chrono::seconds(30);

    // The newest objects of the room.
    void follow(const session::RoomObjects& objects, ParticipantId self, TimePoint now);
    // This one was shown, or is not wanted. One that was shared before it and was not answered is
    // offered then.
    void close(session::ObjectId screen);
    bool is_open(TimePoint now) const { return newest(now) != nullptr; }
    // "Ben shares a screen: monitor", with the buttons. Precondition: is_open(now).
    window::PanelRow row(RoomPanel& panel, TimePoint now) const;

private:
    struct Offered {
        session::ObjectId screen{};
        std::string publisher, name;
        TimePoint until;
    };
    const Offered* newest(TimePoint now) const;

    std::vector<Offered> offered_;  // the newest last
    std::set<session::ObjectId> known_;
};

}  // namespace theatron::viewer

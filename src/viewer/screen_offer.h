// SPDX-License-Identifier: Apache-2.0
// Offers a screen that another person has begun to share: for a while, with buttons that show it or
// decline. The host's own screens belong to the room and are not offered.
//
// Pure; the time is passed in. Not thread safe.
#pragma once

#include <optional>
#include <set>
#include <string>

#include "viewer/room_panel.h"

namespace theatron::viewer {

class ScreenOffer {
public:
    static constexpr Duration offered_for = std::chrono::seconds(30);

    // The newest objects of the room.
    void follow(const session::RoomObjects& objects, ParticipantId self, TimePoint now);
    // It was shown, or is not wanted.
    void close() { offered_.reset(); }
    bool is_open(TimePoint now) const { return offered_ && now < offered_->until; }
    // "Ben shares a screen: monitor", with the buttons. Precondition: is_open().
    window::PanelRow row(RoomPanel& panel) const;

private:
    struct Offered {
        session::ObjectId screen{};
        std::string publisher, name;
        TimePoint until;
    };
    std::optional<Offered> offered_;
    std::set<session::ObjectId> known_;
};

}  // namespace theatron::viewer

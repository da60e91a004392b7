// SPDX-License-Identifier: Apache-2.0
// What `theatron join` without a window does in the room for lines on standard input: scripts and
// tests stand, point and handle objects with these.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "client/participant.h"

namespace theatron::app {

// Use from one thread.
class RoomLines {
public:
    // The lines, for a person.
    static const char* help();

    // Carries out a line: "stand X Y Z AT_X AT_Y AT_Z", "point X Y Z AT_X AT_Y AT_Z",
    // "brick X Y Z", "grab NUMBER", "move X Y Z [DEGREES]", "release", "give NAME", "remove".
    // False if it is none of these. What is wrong with it is printed.
    bool obey(const std::string& line, client::Participant& participant);

    // A person from now on. Metres of the room.
    void stand(const Pose& room_from_head) { pose_.head = part_of(room_from_head); }

    // Several times a second: poses are repeated, so that they are not old.
    void on_tick(client::Participant& participant);

private:
    static wire::PartPose part_of(const Pose& room_from_part);
    bool change(const std::string& what, std::istream& words, client::Participant& participant);

    struct Held {
        session::ObjectId object{};
        std::uint32_t grip = 0;
        Pose room_from_object;
    };
    wire::PersonPose pose_;
    TimePoint sent_;
    std::optional<Held> held_;
    std::uint8_t next_color_ = 0;
};

// {"hash","people":[{"id","name","records"}],"objects":[{"id","kind","held_by","position",
// "scale"}]}
nlohmann::json room_json(const client::Participant& participant);

}  // namespace theatron::app

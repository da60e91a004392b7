// SPDX-License-Identifier: Apache-2.0
// Commands of `theatron join` without a window, one per line of standard input, with which scripts
// and tests stand, point and handle objects in the room.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "client/participant.h"
#include "viewer/tools/hold.h"

namespace theatron::app {

// Use from one thread.
class RoomLines {
public:
    // A text for the user that lists the commands.
    static const char* help();

    // Carries out a line: "stand X Y Z AT_X AT_Y AT_Z", "point [X Y Z AT_X AT_Y AT_Z]",
    // "call", "brick X Y Z", "grab NUMBER", "move X Y Z [DEGREES]", "width METRES", "release",
    // "give NAME", "remove", "pin NUMBER", "unpin NUMBER", "end NUMBER". False if it is none of
    // these. A sentence on a wrong line is printed.
    bool obey(const std::string& line, client::Participant& participant);

    // Gives the participant a head. Metres; y up, -z forward.
    void stand(const Pose& room_from_head);
    // That head; nullopt: none yet.
    const std::optional<Pose>& head() const { return room_from_head_; }

    // Call it several times a second: repeats the poses, so that they do not become stale.
    void on_tick(client::Participant& participant);

private:
    // Both return one sentence about what is wrong; empty if nothing is.
    std::string change(const std::string& what, std::istream& words,
                       client::Participant& participant);
    std::string handle(const std::string& what, std::istream& words,
                       client::Participant& participant);
    void print_refusals(client::Participant& participant, TimePoint now);

    wire::PersonPose pose_;
    bool was_seen_ = false;  // the head or a hand, by others
    std::optional<Pose> room_from_head_;
    TimePoint calls_until_, sent_, refusals_printed_;
    std::uint64_t refused_ = 0;  // not yet printed
    std::string refusal_;        // the newest of these
    viewer::Hold hold_;
    std::uint8_t next_color_ = 0;
};

// {"hash","self","people":[{"id","name","records","role","muted","calls","points","head",
// "left_hand","right_hand"}],"objects":[{"id","kind","creator","held_by","position","scale","mark",
// "screen"}]}; `position`, and places of heads and hands that are known, in metres; `held_by` 0 if
// no participant holds the object.
nlohmann::json room_json(const client::Participant& participant);

}  // namespace theatron::app

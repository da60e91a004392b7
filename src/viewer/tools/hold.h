// SPDX-License-Identifier: Apache-2.0
// Holding an object of the room: take, move, turn, scale, give, let go, remove. The same for the
// mouse's ray, for a controller or hand, and for typed lines.
//
// A pure state machine: the room is a value, and what the host is asked for comes back as values,
// which the caller passes on. Poses are in the room, in metres, of the object as it is drawn.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "room/people.h"
#include "session/case_objects.h"
#include "viewer/case_scene.h"
#include "viewer/tools/grasp.h"

namespace theatron::viewer {

// The room as far as holding needs it; all of it must outlive the call that takes it.
struct HoldRoom {
    ParticipantId self{};
    const session::RoomObjects& objects;
    const std::vector<room::RoomPerson>& people;     // the others
    const std::optional<session::CaseInRoom>& open;  // the case
    // How far its parts are drawn apart; null: they are not.
    const CaseScene* drawn = nullptr;
};

// Where an object is drawn, and the pose that it has in the room's state there: they differ for
// parts of an organ.
Pose shown_pose(const HoldRoom& room, session::ObjectId object);
Pose stored_pose(const HoldRoom& room, session::ObjectId object, const Pose& room_from_shown);
// The pose of an object after its release at `released`: bricks snap together.
Pose resting(const HoldRoom& room, session::ObjectId object, const Pose& released);

struct HoldStep {
    std::vector<session::Request> requests;  // for Participant::ask_room(), in this order
    std::string note;                        // for the person; without requests a refusal
};
// Passes them on.
void ask(const HoldStep& step, client::Participant& participant);
// For Participant::move_object().
struct HoldMove {
    session::ObjectId object{};
    Pose room_from_object;  // as the room's state has it
    double scale = 1;
};

class Hold {
public:
    // An object that a hand lets go this near to another person's head or hand is given to them.
    static constexpr double gives_within_m = 0.3;
    // The scales of an organ in two hands; those of a screen are its widths.
    static constexpr double least_scale = 0.1, largest_scale = 10;

    bool holds() const { return held_.has_value(); }
    // Both need an object that is held.
    session::ObjectId object() const { return held_->object; }
    double scale() const { return held_->scale; }

    // The object that a press on this one takes: for a part of an organ the organ, unless `part`.
    static session::ObjectId taken(const HoldRoom& room, session::ObjectId object, bool part);
    // Takes that. With a grip, it is held at `place` of the grip's ray. Nothing is asked for where
    // there is no such object, where another person holds it, and where it is a pinned screen.
    HoldStep take(const HoldRoom& room, session::ObjectId object, bool part,
                  const std::optional<Grip>& grip = std::nullopt, Vec3 place = {});
    // Forgets an object that this person does not hold any more: it was removed or given away, or
    // the host refused. True if there is still one.
    bool follow(const HoldRoom& room);
    // Without an object: goes on with one that somebody has given to this person. True if there is
    // one.
    bool adopt(const HoldRoom& room);
    void forget() { held_.reset(); }

    // The grasp of an object that was taken with a grip; null otherwise.
    Grasp* grasp() { return held_ && held_->grasp ? &*held_->grasp : nullptr; }
    // To a place that is no grip's. Needs an object.
    void put(const Pose& room_from_object);

    // Shared screens and organs have scales. False for others, and beyond their limits.
    bool set_scale(const HoldRoom& room, double scale);
    // The second of two hands, at this distance of the first one, begins to scale what the first
    // one holds; then moves; then lets go.
    bool begin_stretch(const HoldRoom& room, double distance_m);
    void stretch(const HoldRoom& room, double distance_m);
    void end_stretch() { stretch_.reset(); }

    std::optional<HoldMove> move(const HoldRoom& room) const;

    // All of these need an object, which is not held any more where something is asked for.
    HoldStep let_go(const HoldRoom& room);
    // As a hand does: to a person who is near, or else in its place.
    HoldStep let_go_by_hand(const HoldRoom& room);
    HoldStep give(const HoldRoom& room, ParticipantId to);
    HoldStep give_to_nearest(const HoldRoom& room);
    // A part of an organ is put down and hidden. Screens and organs have panels for that.
    HoldStep remove(const HoldRoom& room);

private:
    struct Held {
        session::ObjectId object{};
        std::optional<Grasp> grasp;
        Pose room_from_object;  // without a grasp
        double scale = 1;
    };
    struct Stretch {
        double distance_m = 1, scale = 1;  // when it began
    };
    Pose pose() const;
    std::uint32_t grip_number(const HoldRoom& room) const;

    std::optional<Held> held_;
    std::optional<Stretch> stretch_;
};

}  // namespace theatron::viewer

// SPDX-License-Identifier: Apache-2.0
// A person with a headset in the room: where they stand, what their hands hold and point at, and
// their menu.
//
// Uses no clock and no runtime of headsets; their frames come as plain values (xr/headset_frame.h).
#pragma once

#include <array>
#include <optional>
#include <string>

#include "viewer/live_scene.h"
#include "viewer/wrist_menu.h"
#include "wire/person_pose.h"
#include "xr/tracking_space.h"
#include "xr/xr_input.h"

namespace theatron::viewer {

// Use from one thread.
class Headset {
public:
    // An object that is let go this near to another person's head or hand is given to them.
    static constexpr double gives_within_m = 0.3;

    // The person begins where `room_from_eye` (z forward, y down) stands and looks. In a real room
    // the person first shows where its table is: a hand over the table's middle, which points to
    // the patient's head, and a grip.
    Headset(const Pose& room_from_eye, bool real_room)
        : begin_(room_from_eye), real_room_(real_room), places_table_(real_room) {}

    // Follows the person's head and hands at `now`, moves what they hold, and tells the scene their
    // hands, rays and menu, which has these facts.
    void on_frame(const xr::HeadsetFrame& frame, const MenuFacts& facts, LiveScene& scene,
                  client::Participant& participant, TimePoint now);

    // A row of the menu that was chosen since the last call, if it concerns others than this class:
    // microphone, leave, drawing, new_brick, go_to_person.
    std::optional<MenuRow> take_wish() { return std::exchange(wish_, std::nullopt); }

    // The runtime has moved its tracking space, and its next frame is in the new one;
    // `before_from_now` has the new origin as seen from the old one, if the runtime says it. The
    // person then stands where they were last brought, at that heading. In a real room the table
    // keeps its real place, or, where nobody knows the way, is placed again.
    void on_space_moved(const std::optional<Pose>& before_from_now);
    bool is_seated() const { return seated_; }
    bool places_table() const { return places_table_; }
    // 0 to 1: how much of the picture's sides is dark, while the person is moved.
    double vignette() const { return vignette_; }

    // Lets go of everything; nothing of the hands stays in the scene.
    void leave(LiveScene& scene, client::Participant& participant);

    // Brings the person to the place where this eye (z forward, y down) stands and looks.
    void go_to(const Pose& room_from_eye);

    // The head as a camera (z forward, y down), with the lens of all eyes together; needs a frame.
    const render::CameraView& head() const { return head_; }
    const std::vector<render::CameraView>& eyes() const { return eyes_; }
    // For messages.
    wire::PersonPose pose(TimePoint session_time) const;

    // The newest sentence for the user since the last call; may be empty.
    std::string take_note() { return std::exchange(note_, ""); }

private:
    struct Held {
        session::ObjectId object{};
        std::uint32_t grip = 0;  // the number of the request
        Pose aim_from_object;
        double scale = 1;
    };
    struct Hand {
        std::optional<Held> held;
        std::optional<std::size_t> row;  // of the menu, under the ray
        bool chose = false;              // by the grip that is still closed
        bool aims_by_grip = false;       // a bare hand that took nothing aims a teleport
        std::optional<Pose> room_from_aim;
        bool points = false;
    };
    void stand(Vec3 place, double heading);
    void follow_space(LiveScene& scene, client::Participant& participant);
    void let_all_go(LiveScene& scene, client::Participant& participant);
    void move(const xr::Intents& intents, const LiveScene& scene, double seconds);
    void turn(double degrees);
    void place_table(const xr::Intents& intents);
    void show_menu(const xr::Intents& intents, const MenuFacts& facts);
    void choose(const MenuRow& row);
    void on_hand(const xr::HandIntents& intents, Hand& hand, LiveScene& scene,
                 client::Participant& participant, double seconds);
    void aim(const xr::HandIntents& intents, Hand& hand, const LiveScene& scene);
    bool take(Hand& hand, LiveScene& scene, client::Participant& participant);
    void hold(const xr::HandIntents& intents, Hand& hand, Meeting& meeting,
              client::Participant& participant, double seconds);
    void let_go(Hand& hand, const Meeting& meeting, client::Participant& participant);
    void give(Hand& hand, ParticipantId to, const Meeting& meeting,
              client::Participant& participant);
    void tell(LiveScene& scene) const;

    Pose begin_;
    bool real_room_ = false, places_table_ = false;
    bool places_again_ = false;  // from the next frame on
    // The runtime has moved its space since the last frame, and how; no pose: nobody knows.
    bool space_moved_ = false;
    std::optional<Pose> before_from_now_;
    bool has_begun_ = false;
    Vec3 stood_;          // where the person was brought last, on the floor,
    double heading_ = 0;  // and the direction of the head then
    bool seated_ = false;
    double vignette_ = 0;
    WristMenu menu_;
    std::optional<MenuRow> wish_;
    Pose room_from_floor_;
    Pose floor_from_head_;
    TimePoint at_;
    xr::XrInput input_;
    std::array<Hand, 2> hands_;  // by Side
    std::optional<room::TeleportArc> arc_;
    render::CameraView head_;
    std::vector<render::CameraView> eyes_;
    std::string note_;
};

}  // namespace theatron::viewer

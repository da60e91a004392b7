// SPDX-License-Identifier: Apache-2.0
// A person with a headset in the room: where they stand, what their hands hold, point at and work
// with, their menu and their panels.
//
// Uses no clock and no runtime of headsets; their frames come as plain values (xr/headset_frame.h).
#pragma once

#include <array>
#include <optional>
#include <string>

#include "viewer/live_scene.h"
#include "viewer/tools/hold.h"
#include "viewer/tools/tool.h"
#include "viewer/wrist_menu.h"
#include "wire/person_pose.h"
#include "xr/tracking_space.h"
#include "xr/xr_input.h"

namespace theatron::viewer {

// Use from one thread.
class Headset {
public:
    // The person begins where `room_from_eye` (z forward, y down) stands and looks. In a real room
    // the person first shows where its table is: a hand over the table's middle, which points to
    // the patient's head, and a grip.
    Headset(const Pose& room_from_eye, bool real_room)
        : begin_(room_from_eye), real_room_(real_room), places_table_(real_room) {}

    // Follows the person's head and hands at `now`, moves what they hold, works with the chosen
    // tool, and tells the scene their hands, rays, panels and menu, which has these facts.
    void on_frame(const xr::HeadsetFrame& frame, const MenuFacts& facts, Tools& tools,
                  LiveScene& scene, client::Participant& participant, TimePoint now);

    // A row of the menu that was chosen since the last call, if it concerns others than this class:
    // microphone, leave, drawing, new_brick, go_to_person, panel, live.
    std::optional<MenuRow> take_wish() { return std::exchange(wish_, std::nullopt); }

    // Shows these panels on a plate, which comes before the person where there was none; none: no
    // plate.
    void show_panels(std::vector<window::Panel> panels);
    // The command of the panels' button that was pressed since the last call, or close_plate.
    std::optional<int> take_pressed() { return std::exchange(pressed_, std::nullopt); }

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
    // For messages; its time is that at which the picture of the last frame is seen.
    wire::PersonPose pose(TimePoint session_time) const;

    // The newest sentence for the user since the last call; may be empty.
    std::string take_note() { return std::exchange(note_, ""); }

private:
    struct Hand {
        Hold hold;
        bool stretches = false;  // it scales what the other hand holds
        // A plate under the ray, and the command there.
        const Plate* plate = nullptr;
        int command = Plate::no_command;
        bool chose = false;         // by the grip that is still closed
        bool aims_by_grip = false;  // a bare hand that took nothing aims a teleport
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
    void on_hand(const xr::HandIntents& intents, xr::Side side, Tools& tools, LiveScene& scene,
                 client::Participant& participant, double seconds);
    void find_plate(Hand& hand);
    void press(const Hand& hand);
    bool use_tool(const xr::HandIntents& intents, xr::Side side, Tools& tools, LiveScene& scene,
                  client::Participant& participant);
    void aim(const xr::HandIntents& intents, Hand& hand, const LiveScene& scene);
    bool take(Hand& hand, bool part, LiveScene& scene, client::Participant& participant);
    void hold(const xr::HandIntents& intents, Hand& hand, Meeting& meeting,
              client::Participant& participant, double seconds);
    void pass(const HoldStep& step, client::Participant& participant);
    Hand& other(const Hand& hand) { return hands_[&hand == &hands_[0] ? 1 : 0]; }
    void tell(LiveScene& scene);

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
    Plate menu_{menu_width_m};
    std::vector<MenuRow> menu_rows_;
    std::optional<MenuRow> wish_;
    static constexpr double panel_width_m = 0.5;
    Plate panel_{panel_width_m};
    std::vector<window::Panel> panels_;
    std::size_t first_row_ = 0;               // that the plate shows
    Vec3 floor_from_panel_, floor_from_eye_;  // the plate's upper edge, the head when it came
    std::optional<int> pressed_;
    std::optional<xr::Side> tool_hand_;  // that uses the tool
    Pose room_from_floor_;
    Pose floor_from_head_;
    Duration until_shown_{};
    TimePoint at_;
    xr::XrInput input_;
    std::array<Hand, 2> hands_;  // by Side
    std::optional<room::TeleportArc> arc_;
    render::CameraView head_;
    std::vector<render::CameraView> eyes_;
    std::string note_;
};

}  // namespace theatron::viewer

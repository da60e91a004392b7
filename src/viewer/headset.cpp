// SPDX-License-Identifier: Apache-2.0
#include "viewer/headset.h"

#include <algorithm>
#include <limits>

#include "phrases/phrase.h"
#include "viewer/looking_back.h"

namespace theatron::viewer {
namespace {

constexpr double walking_m_per_s = 1.4;
// For the sides of the picture to become dark, or clear again.
constexpr double vignette_seconds = 0.15;
constexpr double above_wrist_m = 0.06, before_head_m = 0.55;
// Cosines of the angle between the palm's direction and that to the face.
constexpr double palm_turned_to_face = 0.8, palm_turned_away = 0.6;
constexpr double pushing_m_per_s = 1.2, turning_degrees_per_s = 90;
// A longer pause was no movement of the person.
constexpr double longest_step_s = 0.1;
// A prediction of a longer time is none.
constexpr Duration longest_prediction = std::chrono::milliseconds(100);
// An object that is this much behind a measured surface is hidden by it.
constexpr double hidden_behind_m = 0.03;

// From a camera's frame (y down, z forward) to that of a head (y up, -z forward), and back.
constexpr Pose half_turn{Quat{0, 1, 0, 0}, {}};

render::PickRay ray_of(const Pose& room_from_aim) {
    return grip_of_hand(room_from_aim).ray;
}

// One view that sees what all eyes see, from their middle.
render::CameraView middle_of(const std::vector<render::CameraView>& eyes, const Pose& head) {
    render::CameraView view = eyes.empty() ? render::CameraView{} : eyes.front();
    for (const render::CameraView& eye : eyes) {
        view.left = std::min(view.left, eye.left);
        view.right = std::max(view.right, eye.right);
        view.top = std::min(view.top, eye.top);
        view.bottom = std::max(view.bottom, eye.bottom);
    }
    view.room_from_eye = head * half_turn;
    return view;
}

}  // namespace

void Headset::go_to(const Pose& room_from_eye) {
    begin_ = room_from_eye;
    has_begun_ = false;
}

void Headset::on_space_moved(const std::optional<Pose>& before_from_now) {
    // Several moves between two frames are one.
    if (!space_moved_)
        before_from_now_ = before_from_now;
    else if (before_from_now_ && before_from_now)
        before_from_now_ = *before_from_now_ * *before_from_now;
    else
        before_from_now_.reset();
    space_moved_ = true;
}

// With the first frame in the moved space: only that says where the head is in it.
void Headset::follow_space(LiveScene& scene, client::Participant& participant) {
    if (std::exchange(space_moved_, false)) {
        const auto moved =
            before_from_now_ ? xr::moved_space(room_from_floor_, *before_from_now_) : std::nullopt;
        if (!real_room_)
            stand(stood_, heading_);
        else if (moved)
            room_from_floor_ = *moved;
        else if (!places_table_) {
            places_again_ = true;
            note_ = say(Phrase::table_is_lost);
        }
    }
    if (!std::exchange(places_again_, false))
        return;
    // It would move with the room.
    let_all_go(scene, participant);
    places_table_ = true;
}

void Headset::on_frame(const xr::HeadsetFrame& frame, const MenuFacts& facts, Tools& tools,
                       LiveScene& scene, client::Participant& participant, TimePoint now) {
    const double seconds = std::clamp(to_seconds(now - at_), 0.0, longest_step_s);
    at_ = now;
    floor_from_head_ = frame.floor_from_head;
    until_shown_ = std::clamp(frame.until_shown, Duration{}, longest_prediction);
    if (!std::exchange(has_begun_, true)) {
        const Pose head = begin_ * half_turn;
        stand({head.translation.x, 0, head.translation.z}, xr::heading_of(head));
    }
    follow_space(scene, participant);
    const xr::Intents intents =
        input_.update(frame, {hands_[0].hold.holds(), hands_[1].hold.holds()});
    if (places_table_)
        place_table(intents);
    else if (!real_room_)
        move(intents, scene, seconds);

    for (const xr::Side side : {xr::left_side, xr::right_side})
        // A lost hand leaves what it held where it was.
        if (intents.hands[side].is_present)
            hands_[side].room_from_aim = room_from_floor_ * intents.hands[side].floor_from_aim;
    show_menu(intents, facts);
    arc_.reset();
    for (const xr::Side side : {xr::left_side, xr::right_side})
        on_hand(intents.hands[side], side, tools, scene, participant, seconds);
    if (!tool_hand_)
        (void)tools.on_pointer({}, {scene.meeting(), head_, {}, participant, now});

    eyes_.clear();
    for (const xr::HeadsetEye& eye : frame.eyes) {
        render::CameraView view;
        view.room_from_eye = room_from_floor_ * eye.floor_from_eye * half_turn;
        view.left = eye.left;
        view.right = eye.right;
        view.top = eye.top;
        view.bottom = eye.bottom;
        eyes_.push_back(view);
    }
    head_ = middle_of(eyes_, room_from_floor_ * floor_from_head_);
    tell(scene);
}

// Brings the head over a place of the floor. A seated person is lifted to the eyes of a standing
// one.
void Headset::stand(Vec3 place, double heading) {
    stood_ = {place.x, 0, place.z};
    heading_ = heading;
    room_from_floor_ = xr::standing_space(floor_from_head_, stood_, heading);
    if (seated_)
        room_from_floor_.translation.y = room::standing_eyes_m - floor_from_head_.translation.y;
}

void Headset::leave(LiveScene& scene, client::Participant& participant) {
    arc_.reset();
    menu_.show(false);
    let_all_go(scene, participant);
    panel_.show(false);
    tell(scene);
    scene.set_plates({});
}

void Headset::let_all_go(LiveScene& scene, client::Participant& participant) {
    for (Hand& hand : hands_) {
        if (hand.hold.follow(scene.meeting().held_room()))
            pass(hand.hold.let_go_by_hand(scene.meeting().held_room()), participant);
        hand = {};
    }
    tool_hand_.reset();
}

void Headset::turn(double degrees) {
    room_from_floor_ = xr::turned_space(room_from_floor_, floor_from_head_, degrees);
    heading_ += radians_of(degrees);
}

void Headset::move(const xr::Intents& intents, const LiveScene& scene, double seconds) {
    if (intents.turn_degrees != 0)
        turn(intents.turn_degrees);
    const bool walks = intents.walk != Vec2{};
    vignette_ = std::clamp(vignette_ + (walks ? seconds : -seconds) / vignette_seconds, 0.0, 1.0);
    if (!walks)
        return;
    const double heading = xr::heading_of(room_from_floor_ * floor_from_head_);
    const Vec3 way = rotate(rotation_about({0, 1, 0}, heading),
                            Vec3{intents.walk.x, 0, -intents.walk.y} * (walking_m_per_s * seconds));
    const Vec3 head = room_from_floor_ * floor_from_head_.translation;
    Vec3 to = head + way;
    if (scene.free_space())
        to = room::kept_inside(*scene.free_space(), to);
    const Vec3 moved{to.x - head.x, 0, to.z - head.z};
    room_from_floor_.translation = room_from_floor_.translation + moved;
    stood_ = stood_ + moved;
}

// The middle of the room's table is over the room's origin, with the patient's head at -x
// (docs/room.md). The real floor stays the floor.
void Headset::place_table(const xr::Intents& intents) {
    for (const xr::Side side : {xr::right_side, xr::left_side}) {
        const xr::HandIntents& hand = intents.hands[side];
        if (!hand.is_present)
            continue;
        const Vec3 at = hand.floor_from_grip.translation;
        const Quat rotation =
            rotation_about({0, 1, 0}, radians_of(90) - xr::heading_of(hand.floor_from_aim));
        room_from_floor_ = {rotation, -rotate(rotation, {at.x, 0, at.z})};
        if (hand.takes) {
            places_table_ = false;
            hands_[side].chose = true;
            note_ = say(Phrase::table_is_placed);
        }
        return;
    }
}

// At the left wrist: opened by a button of either controller, or by a bare left palm that is turned
// to the face. Without a left hand it stands before the head.
void Headset::show_menu(const xr::Intents& intents, const MenuFacts& facts) {
    const Pose head = room_from_floor_ * floor_from_head_;
    const xr::HandIntents& left = intents.hands[xr::left_side];
    const Pose grip = room_from_floor_ * left.floor_from_grip;
    if (left.is_present && left.is_bare) {
        const Vec3 palm = rotate(grip.rotation, {1, 0, 0});
        const double turned = dot(palm, normalized(head.translation - grip.translation));
        menu_.show(turned > (menu_.is_shown() ? palm_turned_away : palm_turned_to_face));
    } else if (intents.menu) {
        menu_.show(!menu_.is_shown());
    }
    if (places_table_)
        menu_.show(false);
    if (!menu_.is_shown())
        return;
    const Vec3 place = left.is_present ? grip.translation + Vec3{0, above_wrist_m, 0}
                                       : head * Vec3{0, -0.2, -before_head_m};
    menu_rows_ = menu_rows(facts);
    menu_.set_rows(plate_rows(menu_rows_));
    menu_.place(place, head.translation);
}

// The plate stays where it came while the person moves, and goes with them to another place.
void Headset::show_panels(std::vector<window::Panel> panels) {
    constexpr double ahead_m = 0.7, aside_m = 0.3, above_eyes_m = 0.05;
    if (panels.empty() || panels_.empty() || panels.front().title != panels_.front().title)
        first_row_ = 0;
    if (!panel_.is_shown() && !panels.empty()) {
        const Quat heading = rotation_about({0, 1, 0}, xr::heading_of(floor_from_head_));
        floor_from_eye_ = floor_from_head_.translation;
        floor_from_panel_ = floor_from_eye_ + rotate(heading, {-aside_m, above_eyes_m, -ahead_m});
    }
    panels_ = std::move(panels);
    panel_.show(!panels_.empty());
    panel_.set_rows(plate_rows(panels_, panel_width_m, first_row_));
}

void Headset::choose(const MenuRow& row) {
    switch (row.action) {
        case MenuAction::recentre:
            return stand(stood_, heading_);
        case MenuAction::seat:
            seated_ = !seated_;
            return stand(room_from_floor_ * floor_from_head_.translation,
                         xr::heading_of(room_from_floor_ * floor_from_head_));
        case MenuAction::turn_left:
            return turn(xr::XrInput::snap_degrees);
        case MenuAction::turn_right:
            return turn(-xr::XrInput::snap_degrees);
        case MenuAction::place_table:
            places_again_ = true;
            return;
        case MenuAction::microphone:
        case MenuAction::leave:
        case MenuAction::drawing:
        case MenuAction::new_brick:
        case MenuAction::go_to_person:
        case MenuAction::panel:
        case MenuAction::live:
            wish_ = row;
    }
}

void Headset::on_hand(const xr::HandIntents& intents, xr::Side side, Tools& tools, LiveScene& scene,
                      client::Participant& participant, double seconds) {
    Hand& hand = hands_[side];
    // The ray meets surfaces of the past, which are not there now.
    hand.points = intents.points && !scene.past_moment();
    hand.plate = nullptr;
    const bool has_menu = menu_.is_shown() && side == xr::left_side && intents.is_bare;
    const bool is_free = !hand.hold.holds() && !hand.stretches && tool_hand_ != side && !has_menu;
    if (hand.room_from_aim && is_free)
        find_plate(hand);
    if (intents.takes && hand.plate) {
        hand.chose = true;
        press(hand);
    } else if (tool_hand_ == side || (intents.takes && !hand.chose && !has_menu)) {
        if (!use_tool(intents, side, tools, scene, participant) && intents.takes)
            hand.aims_by_grip = !take(hand, tools.takes_parts(), scene, participant) &&
                                intents.is_bare && !real_room_ && !places_table_;
    }
    if (!intents.holds)
        hand.chose = false;
    hold(intents, hand, scene.meeting(), participant, seconds);
    aim(intents, hand, scene);
    if (!intents.is_present)
        hand.room_from_aim.reset();
}

void Headset::find_plate(Hand& hand) {
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const Plate* plate : {&menu_, &panel_})
        if (const auto hit = plate->pick(ray_of(*hand.room_from_aim));
            hit && hit->distance_m < nearest_m) {
            nearest_m = hit->distance_m;
            hand.plate = plate;
            hand.command = hit->command;
        }
}

void Headset::press(const Hand& hand) {
    if (hand.command == Plate::no_command)
        return;
    if (hand.plate == &menu_)
        return choose(menu_rows_[std::size_t(hand.command)]);
    if (hand.command == earlier_rows)
        first_row_ -= std::min(first_row_, rows_in_turn);
    else if (hand.command == later_rows)
        first_row_ += rows_in_turn;
    else
        pressed_ = hand.command;
    panel_.set_rows(plate_rows(panels_, panel_width_m, first_row_));
}

// True if the hand uses the tool, from a press that the tool takes to the release.
bool Headset::use_tool(const xr::HandIntents& intents, xr::Side side, Tools& tools,
                       LiveScene& scene, client::Participant& participant) {
    const bool goes_on = tool_hand_ == side;
    if (!goes_on && (tool_hand_ || places_table_ || scene.past_moment()))
        return false;
    const auto& aim = hands_[side].room_from_aim;
    const Pointer pointer{aim ? std::optional(ray_of(*aim)) : std::nullopt, !goes_on,
                          intents.lets_go || !intents.holds};
    const bool uses =
        tools.on_pointer(pointer, {scene.meeting(), head_, scene.cloud(), participant, at_});
    tool_hand_ = uses && !pointer.releases ? std::optional(side) : std::nullopt;
    return uses || goes_on;
}

// The one of two hands that aims second wins.
void Headset::aim(const xr::HandIntents& intents, Hand& hand, const LiveScene& scene) {
    const bool by_grip = hand.aims_by_grip;
    if (!intents.holds)
        hand.aims_by_grip = false;
    if (!scene.free_space() || !hand.room_from_aim || real_room_)
        return;
    const bool teleports = intents.teleports || (by_grip && intents.lets_go && intents.is_present);
    if (!teleports && !intents.aims_teleport && !hand.aims_by_grip)
        return;
    const render::PickRay ray = ray_of(*hand.room_from_aim);
    room::TeleportArc arc = room::teleport_arc(*scene.free_space(), ray.from, ray.direction);
    if (!teleports) {
        arc_ = std::move(arc);
    } else if (arc.landing) {
        stand(*arc.landing, xr::heading_of(room_from_floor_ * floor_from_head_));
        hand.room_from_aim = room_from_floor_ * intents.floor_from_aim;
    }
}

// True if the hand's ray met an object, also if it cannot be held.
bool Headset::take(Hand& hand, bool part, LiveScene& scene, client::Participant& participant) {
    Meeting& meeting = scene.meeting();
    const Grip grip = grip_of_hand(*hand.room_from_aim);
    const auto hit = meeting.pick(grip.ray, head_);
    if (!hit)
        return false;
    if (const auto surface = scene.pick_surface(grip.ray);
        surface && *surface < hit->picked.distance_m - hidden_behind_m)
        return false;
    if (scene.past_moment()) {
        note_ = say(Phrase::changes_nothing);
        return true;
    }
    const HoldRoom room = meeting.held_room();
    Hand& other = this->other(hand);
    if (other.hold.holds() && other.room_from_aim &&
        other.hold.object() == Hold::taken(room, hit->object, part)) {
        hand.stretches = other.hold.begin_stretch(
            room, length(other.room_from_aim->translation - grip.ray.from));
        if (hand.stretches)
            return true;
        other.hold.forget();
    }
    pass(hand.hold.take(room, hit->object, part, grip, hit->picked.place), participant);
    (void)meeting.take(participant);
    return true;
}

void Headset::hold(const xr::HandIntents& intents, Hand& hand, Meeting& meeting,
                   client::Participant& participant, double seconds) {
    const HoldRoom room = meeting.held_room();
    if (hand.stretches) {
        Hand& other = this->other(hand);
        hand.stretches = intents.holds && other.hold.follow(room) && other.room_from_aim;
        if (hand.stretches)
            other.hold.stretch(
                room, length(other.room_from_aim->translation - hand.room_from_aim->translation));
        else
            other.hold.end_stretch();
    }
    if (!hand.room_from_aim || !hand.hold.follow(room))
        return;
    Grasp& grasp = *hand.hold.grasp();
    grasp.point(grip_of_hand(*hand.room_from_aim));
    grasp.push(intents.pushes_away * pushing_m_per_s * seconds);
    if (intents.turns_held != 0)
        grasp.turn(intents.turns_held * turning_degrees_per_s * seconds);
    const HoldMove move = *hand.hold.move(room);
    (void)participant.move_object(move.object, move.room_from_object, move.scale);
    if (intents.gives)
        pass(hand.hold.give_to_nearest(room), participant);
    if (intents.lets_go && hand.hold.holds())
        pass(hand.hold.let_go_by_hand(room), participant);
}

void Headset::pass(const HoldStep& step, client::Participant& participant) {
    ask(step, participant);
    if (!step.note.empty())
        note_ = step.note;
}

void Headset::tell(LiveScene& scene) {
    Meeting& meeting = scene.meeting();
    meeting.set_arc(arc_);
    meeting.set_own_hands(hands_[0].room_from_aim, hands_[1].room_from_aim);
    std::vector<room::Pointer> rays;
    menu_.choose(std::nullopt);
    panel_.choose(std::nullopt);
    for (const Hand& hand : hands_) {
        for (Plate* plate : {&menu_, &panel_})
            if (hand.plate == plate)
                plate->choose(hand.command);
        if (hand.room_from_aim && !hand.hold.holds() && !arc_ && !places_table_) {
            const render::PickRay ray = ray_of(*hand.room_from_aim);
            rays.push_back({meeting.room().self, "", ray.from, ray.direction, std::nullopt});
        }
    }
    scene.set_own_pointers(std::move(rays));
    panel_.place_below(room_from_floor_ * floor_from_panel_, room_from_floor_ * floor_from_eye_);
    scene.set_plates({&menu_, &panel_});
    scene.set_table_outline(places_table_);
}

wire::PersonPose Headset::pose(TimePoint session_time) const {
    wire::PersonPose pose;
    pose.time = session_time + until_shown_;
    pose.head = part_of(room_from_floor_ * floor_from_head_);
    if (hands_[0].room_from_aim)
        pose.left_hand = part_of(*hands_[0].room_from_aim);
    if (hands_[1].room_from_aim)
        pose.right_hand = part_of(*hands_[1].room_from_aim);
    pose.points = pose.right_hand && hands_[1].points;
    return pose;
}

}  // namespace theatron::viewer

// SPDX-License-Identifier: Apache-2.0
#include "scripted_people.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/steady_clock.h"
#include "room/bricks.h"
#include "viewer/meeting.h"

namespace theatron::app {
namespace {

namespace request = session::request;

constexpr Duration pose_interval = std::chrono::milliseconds(30);
// The script repeats after `cycle_s`: the first person takes the brick, gives it to the second,
// who puts it back.
constexpr double cycle_s = 20, taken_s = 4, given_s = 9, put_back_s = 15;
// In the generated operating room, whose table stands at the origin. Metres.
constexpr Vec3 situs{0, 1, 0}, brick_home{0.45, 1.2, 0.3}, brick_away{-0.35, 1.35, 0.2};
constexpr std::array<Vec3, 2> heads{{{0.9, 1.6, -0.6}, {-0.9, 1.7, 0.1}}};
constexpr std::array<const char*, 2> person_names{"remote expert", "student"};

double smooth(double from, double to, double at) {
    const double share = std::clamp((at - from) / (to - from), 0.0, 1.0);
    return share * share * (3 - 2 * share);
}

Vec3 brick_at(double seconds) {
    const double out = smooth(taken_s, given_s + 2, seconds);
    const double back = smooth(given_s + 3, put_back_s, seconds);
    const double share = out - back;
    const Vec3 lift{0, 0.15 * std::sin(std::numbers::pi * share), 0};
    return brick_home * (1 - share) + brick_away * share + lift;
}

// A head or a hand that looks or points at `at`.
wire::PartPose part_towards(Vec3 place, Vec3 at) {
    return viewer::part_of(look_at(place, at, {0, 1, 0}) * Pose{Quat{0, 1, 0, 0}, {}});
}

wire::PersonPose pose_at(std::size_t person, double seconds, TimePoint now) {
    const double sway = 0.03 * std::sin(0.9 * seconds + 2.0 * double(person));
    const Vec3 head = heads[person] + Vec3{sway, 0.5 * sway, -sway};
    const bool holds = person == 0 ? seconds >= taken_s && seconds < given_s
                                   : seconds >= given_s && seconds < put_back_s;
    const Vec3 brick = brick_at(seconds);
    const double attention =
        smooth(taken_s - 1, taken_s, seconds) - smooth(put_back_s, put_back_s + 1, seconds);
    const Vec3 looks_at = situs * (1 - attention) + brick * attention;
    const Vec3 shoulder = head + Vec3{0, -0.35, 0};
    const Vec3 reach = normalized(looks_at - shoulder);
    const Vec3 hand = holds ? brick - reach * 0.06 : shoulder + reach * 0.45;
    wire::PersonPose pose;
    pose.time = now;
    pose.head = part_towards(head, looks_at);
    pose.right_hand = part_towards(hand, hand + reach);
    // The other hand rests before the body: a headset sees both.
    const Vec3 ahead = normalized(Vec3{reach.x, 0, reach.z});
    const Vec3 rest = shoulder + Vec3{0, -0.12, 0} + 0.26 * ahead + 0.17 * cross({0, 1, 0}, ahead);
    pose.left_hand = part_towards(rest, rest + ahead + Vec3{0, -0.3, 0});
    // The expert shows the student the situs while the brick rests.
    pose.points = person == 0 && attention == 0;
    return pose;
}

}  // namespace

ScriptedPeople::ScriptedPeople(const net::Link& link) : begin_(steady_now()) {
    for (std::size_t person = 0; person < people_.size(); ++person) {
        client::Participant::Options options;
        options.link = link;
        options.name = person_names[person];
        options.keeps_room = true;
        options.media = [](const wire::MediaHeader&, ByteView) {};
        people_[person] = std::make_unique<client::Participant>(std::move(options));
    }
}

void ScriptedPeople::on_tick() {
    const TimePoint now = steady_now();
    if (now - moved_ < pose_interval)
        return;
    moved_ = now;
    const double seconds = std::fmod(to_seconds(now - begin_), cycle_s);
    for (std::size_t person = 0; person < people_.size(); ++person)
        if (people_[person]->status().clock_known)
            people_[person]->send_pose(pose_at(person, seconds, people_[person]->now()));

    const client::Participant::Room room = people_[0]->room();
    for (const auto& [id, object] : room.objects)
        if (object.kind == session::ObjectKind::brick && object.creator == room.self)
            return handle(room, id, seconds);
    constexpr Duration again = std::chrono::seconds(2);
    if (now - created_ > again &&
        people_[0]->ask_room(request::Create{
            session::ObjectKind::brick, {{}, brick_home}, 1, room::encode_brick({4, 2, 0})}) != 0)
        created_ = now;
}

void ScriptedPeople::handle(const client::Participant::Room& room, session::ObjectId brick,
                            double seconds) {
    const session::Grip grip = room.objects.at(brick).grip;
    const Pose pose{rotation_about({0, 1, 0}, 0.3 * seconds), brick_at(seconds)};
    const ParticipantId first = room.self, second = people_[1]->room_self();
    client::Participant& holder = *people_[grip.holder == second ? 1 : 0];
    if (grip.holder == ParticipantId{}) {
        if (seconds >= taken_s && seconds < given_s)
            people_[0]->ask_room(request::Grab{brick});
    } else if (grip.holder == first && seconds >= given_s && seconds < put_back_s) {
        people_[0]->ask_room(request::HandOver{brick, grip.number, second});
    } else if (grip.holder != first && grip.holder != second) {
        return;
    } else if (seconds >= put_back_s) {
        holder.ask_room(request::Release{brick, grip.number, {{}, brick_home}, 1});
    } else {
        (void)holder.move_object(brick, pose, 1);
    }
}

}  // namespace theatron::app

// SPDX-License-Identifier: Apache-2.0
#include "viewer/head_text.h"

#include <charconv>
#include <cmath>
#include <set>

#include "base/error.h"
#include "base/options.h"

namespace theatron::viewer {
namespace {

constexpr double farthest_m = 100;  // from the room's origin

[[noreturn]] void refuse(const std::string& text) {
    throw Error("The person '" + text +
                "' is not understood; write CAMERA=X:Y:Z, where in the room the head is in metres, "
                "for example 1=0.2:1.65:-0.4 or 1=0.2:1.65:-0.4,yaw=90,pitch=-30,reach=1.1.");
}

// Three numbers between colons; false if they are not.
bool parse_place(const std::string& text, Vec3& place) {
    const char* at = text.data();
    const char* const end = at + text.size();
    for (double* number : {&place.x, &place.y, &place.z}) {
        if (number != &place.x && (at == end || *at++ != ':'))
            return false;
        const auto [next, error] = std::from_chars(at, end, *number);
        if (error != std::errc() || !(std::abs(*number) <= farthest_m))
            return false;
        at = next;
    }
    return at == end;
}

}  // namespace

SeenPerson parse_seen_person(const std::string& text, Seen who) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
        refuse(text);
    SeenPerson person{text.substr(0, equals), who, {}, 0};
    Options options = Options::parse("head:" + text.substr(equals + 1));
    const double yaw = radians_of(options.take_number("yaw", 0, -360, 360));
    const double pitch = radians_of(options.take_number("pitch", 0, -80, 80));
    person.reach_m = options.take_number("reach", render::usual_reach_m, 0.2, 20);
    options.require_no_problem();
    Vec3 eyes;
    if (!parse_place(options.value(), eyes))
        refuse(text);
    const Vec3 ahead{-std::sin(yaw) * std::cos(pitch), std::sin(pitch),
                     -std::cos(yaw) * std::cos(pitch)};
    person.room_from_head = look_at(eyes, eyes + ahead, {0, 1, 0});
    return person;
}

std::vector<SeenPerson> parse_seen_people(const std::vector<std::string>& others,
                                          const std::vector<std::string>& oneself) {
    std::vector<SeenPerson> people;
    std::set<std::string> cameras;
    const auto add = [&](const std::string& text, Seen who) {
        people.push_back(parse_seen_person(text, who));
        if (!cameras.insert(people.back().camera).second)
            throw Error("Camera '" + people.back().camera +
                        "' has two people; of one camera one person can be shown.");
    };
    for (const std::string& text : others)
        add(text, Seen::other);
    for (const std::string& text : oneself)
        add(text, Seen::oneself);
    return people;
}

}  // namespace theatron::viewer

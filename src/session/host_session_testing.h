// SPDX-License-Identifier: Apache-2.0
// A host's session with one camera, for tests.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "geometry/calibration.h"
#include "session/host_session.h"

namespace theatron::session {

// All actions of one type.
template <class T>
std::vector<T> actions_of(const std::vector<Action>& actions) {
    std::vector<T> result;
    for (const Action& a : actions)
        if (const auto* wanted = std::get_if<T>(&a))
            result.push_back(*wanted);
    return result;
}

// All messages of one type that are sent to a participant.
template <class T>
std::vector<T> messages_to(ParticipantId id, const std::vector<Action>& actions) {
    std::vector<T> result;
    for (const auto& a : actions_of<action::Send>(actions))
        if (a.participant == id)
            if (const auto* message = std::get_if<T>(&a.message))
                result.push_back(*message);
    return result;
}

inline constexpr ParticipantId alice{1}, bob{2}, carol{3}, dave{4};

class Host : public ::testing::Test {
protected:
    Host() : session(config()) {}

    static HostSession::CheckedCodec check(const std::string& text) {
        return text == "bad" ? HostSession::CheckedCodec{"", "There is no codec bad."}
                             : HostSession::CheckedCodec{text, ""};
    }
    static HostSession::Config config() {
        Calibration calibration;
        calibration.depth.size = calibration.color.size = {64, 48};
        calibration.depth.fx = calibration.depth.fy = 60;
        calibration.color.fx = calibration.color.fy = 60;
        wire::Camera camera;
        camera.calibration = encode_calibration(calibration);
        camera.depth_stream = depth_stream(CameraId{0});
        camera.color_stream = color_stream(CameraId{0});
        camera.has_color = true;
        HostSession::Config config;
        config.admission.tokens = {{"secret", Role::expert, {}},
                                   {"publish", Role::publisher, {}},
                                   {"short", Role::expert, from_us(5'000'000)}};
        config.admission.equal_secrets = [](std::string_view a, std::string_view b) {
            return a == b;
        };
        config.name = "OR";
        config.cameras = {camera};
        config.check_depth = config.check_color = check;
        return config;
    }

    void join(ParticipantId id, const std::string& depth = "trvl",
              const std::string& token = "secret", bool records = false) {
        session.on_connected(id, now);
        wire::Join hello;
        hello.token = token;
        hello.depth_codec = depth;
        hello.color_codec = "jpeg";
        hello.records = records;
        say(id, hello);
    }
    void join_to_record(ParticipantId id, const std::string& depth) {
        join(id, depth, "secret", true);
    }
    void say(ParticipantId id, const wire::ToHost& message) {
        session.on_control(id, wire::encode(message), now);
    }
    template <class T>
    std::vector<T> sent(ParticipantId id, const std::vector<Action>& actions) {
        return messages_to<T>(id, actions);
    }
    template <class T>
    static std::vector<T> all(const std::vector<Action>& actions) {
        return actions_of<T>(actions);
    }
    template <class T>
    static int count(const std::vector<Action>& actions) {
        return int(all<T>(actions).size());
    }

    TimePoint now = from_us(1'000'000);
    HostSession session;
};

}  // namespace theatron::session

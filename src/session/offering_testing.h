// SPDX-License-Identifier: Apache-2.0
// A host's session whose people offer cameras and send their pictures, for tests.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "session/host_session_testing.h"

namespace theatron::session {

class Offering : public Host {
protected:
    // `features`: of everybody, unless come() names others.
    explicit Offering(std::vector<wire::Feature> features) : features_(std::move(features)) {
        HostSession::Config c = config();
        c.admission.tokens = {{"or", Role::operator_, {}, "operator"},
                              {"see", Role::observer, {}, "observer"},
                              {"secret", Role::expert, {}, "expert"}};
        session_.emplace(std::move(c));
    }
    void come(ParticipantId id, const char* token = "secret") { come(id, token, features_); }
    void come(ParticipantId id, const char* token, std::vector<wire::Feature> features,
              bool records = false) {
        session_->on_connected(id, now);
        wire::Join hello;
        hello.token = token;
        hello.depth_codec = "trvl";
        hello.color_codec = "h264";
        hello.features = std::move(features);
        hello.records = records;
        tell(id, hello);
    }
    void tell(ParticipantId id, const wire::ToHost& message) {
        now += between;
        session_->on_control(id, wire::encode(message), now);
        taken = session_->take_actions();
    }
    template <class T>
    std::vector<T> to(ParticipantId id) const {
        return messages_to<T>(id, taken);
    }
    wire::Published offer(ParticipantId id, std::vector<wire::OfferedCamera> cameras) {
        tell(id, wire::Publish{std::move(cameras)});
        const auto answers = to<wire::Published>(id);
        EXPECT_EQ(answers.size(), 1u);
        return answers.empty() ? wire::Published{} : answers.front();
    }
    wire::TextCode problem_with(ParticipantId id, std::vector<wire::OfferedCamera> cameras) {
        return offer(id, std::move(cameras)).problem.code;
    }
    // The settings of its cameras, as their publisher was told last.
    std::vector<wire::StreamSetting> settings(ParticipantId id) const {
        const auto told = to<wire::Encode>(id);
        return told.empty() ? std::vector<wire::StreamSetting>() : told.back().settings;
    }
    // The receivers of a picture of this many bytes.
    std::vector<ParticipantId> send(ParticipantId id, const wire::StreamSetting& setting,
                                    std::size_t bytes) {
        wire::MediaHeader header;
        header.stream = setting.stream;
        header.setting = setting.setting;
        // Depth comes first; colour has the number of its depth.
        frame_ += is_depth(setting.stream);
        header.frame = header.reference = frame_;
        header.key = true;
        header.payload_size = std::uint32_t(bytes - wire::media_header_size);
        Bytes message(bytes);
        wire::write_media_header(header, message.data());
        return session_->on_media_from(id, message, now).receivers;
    }

    std::optional<HostSession> session_;
    std::vector<Action> taken;
    Duration between{};  // passes before each message

private:
    std::vector<wire::Feature> features_;
    FrameNumber frame_ = 0;
};

}  // namespace theatron::session

// SPDX-License-Identifier: Apache-2.0
// A camera of a person in the World: small depth pictures, each with its number in it, encoded as
// the host asks and sent by client::Participant.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "codec/depth_stream.h"
#include "image/image.h"
#include "world/world.h"

namespace theatron::world {

class SentCamera {
public:
    static constexpr Size size{32, 24};
    static constexpr double frames_per_second = 10;

    // Before the person joins: sends from then on, in each of their connections.
    SentCamera(Person& person, std::string name, bool may_record = true);
    ~SentCamera();

    // Its participant offers it; also again after stop().
    void start();
    void stop();
    // The host has given it a number, on this connection.
    bool is_published() const { return number_.has_value(); }
    // Pictures that were taken while the host wanted them.
    int sent() const { return sent_; }
    // Those in which the host wants its depth, sorted.
    std::vector<std::string> codecs() const;

    // The number in a picture of such a camera.
    static int number_in(DepthView depth) { return depth.row(0)[0] - 1000; }

private:
    struct Encoder {
        SettingId setting{};
        codec::DepthSetting parsed;
        codec::DepthStreamEncoder encoder;
        bool wants_key = true;
    };
    wire::OfferedCamera offer() const;
    void on_published(const std::vector<CameraId>& numbers);
    void on_encode(const std::vector<wire::StreamSetting>& settings);
    void picture();
    void send(Encoder& encoder, DepthView depth);
    void later();

    Person& person_;
    const std::string name_;
    const bool may_record_;
    std::optional<CameraId> number_;
    std::map<SettingId, std::unique_ptr<Encoder>> encoders_;
    DepthImage depth_;
    FrameNumber frame_ = 0;
    int sent_ = 0;
    std::optional<Schedule::Key> timer_;
};

}  // namespace theatron::world

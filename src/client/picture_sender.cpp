// SPDX-License-Identifier: Apache-2.0
#include "client/picture_sender.h"

#include <algorithm>
#include <utility>

#include "codec/depth_stream.h"
#include "geometry/screen.h"
#include "video/color_codec.h"

namespace theatron::client {
namespace {

constexpr double face_width_m = 0.28;

// The plane of a screen. Empty for codecs that this program does not have.
Bytes encoded_plane(const std::string& codec, std::uint8_t& id) {
    const auto parsed = codec::parse_depth_setting(codec);
    if (!parsed.problem.empty())
        return {};
    id = std::uint8_t(parsed.setting.id);
    DepthImage plane(screen_grid);
    std::fill(plane.pixels.begin(), plane.pixels.end(), std::uint16_t(screen_distance_mm));
    codec::DepthStreamEncoder encoder(parsed.setting);
    Bytes bytes(encoder.max_encoded_size(plane.size));
    bytes.resize(encoder.encode(plane.view(), 0, true, bytes).bytes);
    return bytes;
}

}  // namespace

wire::OfferedCamera PictureSender::face(Size picture, double frames_per_second) {
    return {"face",
            true,
            frames_per_second,
            encode_calibration(screen_calibration(picture, face_width_m, {})),
            false,
            wire::CameraKind::face};
}

wire::OfferedCamera PictureSender::screen(const std::string& name, Size picture,
                                          double frames_per_second) {
    Calibration calibration = screen_calibration(picture, usual_screen_width_m, usual_screen_place);
    calibration.registered = false;  // the host finds a free place
    return {name,
            true,
            frames_per_second,
            encode_calibration(calibration),
            false,
            wire::CameraKind::screen};
}

Participant::Publishing PictureSender::events() {
    Participant::Publishing events;
    events.published = [this](const std::vector<CameraId>& numbers) {
        const std::lock_guard lock(mutex_);
        numbers_ = numbers;
        settings_.clear();
    };
    events.encode = [this](const std::vector<wire::StreamSetting>& settings) {
        const std::lock_guard lock(mutex_);
        settings_.clear();
        for (const wire::StreamSetting& setting : settings)
            if (std::find(numbers_.begin(), numbers_.end(), camera_of(setting.stream)) !=
                numbers_.end())
                settings_.push_back(setting);
    };
    events.ended = [this](const std::vector<CameraId>& numbers) {
        const std::lock_guard lock(mutex_);
        if (numbers_.empty() ||
            std::find(numbers.begin(), numbers.end(), numbers_.front()) == numbers.end())
            return;
        numbers_.clear();
        settings_.clear();
        has_ended_ = true;
    };
    // Every picture is a key frame.
    events.encode_key = [](StreamId, SettingId) {};
    return events;
}

bool PictureSender::is_taken() const {
    const std::lock_guard lock(mutex_);
    return !numbers_.empty();
}

bool PictureSender::take_ended() {
    const std::lock_guard lock(mutex_);
    return std::exchange(has_ended_, false);
}

std::vector<PictureSender::Media> PictureSender::messages(ByteView jpeg, TimePoint captured,
                                                          TimePoint encoded) {
    std::vector<Media> messages;
    const std::lock_guard lock(mutex_);
    ++frame_;
    for (const wire::StreamSetting& setting : settings_) {
        wire::MediaHeader header;
        Bytes plane;
        if (is_depth(setting.stream)) {
            plane = encoded_plane(setting.codec, header.codec);
        } else {
            const auto parsed = video::parse_color_setting(setting.codec);
            if (!parsed.problem.empty() || parsed.setting.id != video::ColorCodecId::jpeg)
                continue;
            header.codec = std::uint8_t(video::ColorCodecId::jpeg);
        }
        const ByteView payload = is_depth(setting.stream) ? ByteView(plane) : jpeg;
        if (payload.empty())
            continue;
        header.key = true;
        header.stream = setting.stream;
        header.setting = setting.setting;
        header.frame = header.reference = frame_;
        header.payload_size = std::uint32_t(payload.size());
        header.moment = header.captured = header.delivered = captured;
        header.encoded = encoded;
        auto message = std::make_shared<Bytes>(wire::media_header_size);
        wire::write_media_header(header, message->data());
        message->insert(message->end(), payload.begin(), payload.end());
        messages.push_back({header, std::move(message)});
    }
    return messages;
}

void PictureSender::send(Participant& participant, ByteView jpeg, TimePoint captured) {
    for (Media& media : messages(jpeg, captured, participant.now()))
        participant.send_media(media.header, std::move(media.message));
}

}  // namespace theatron::client

// SPDX-License-Identifier: Apache-2.0
#include "world/sent_camera.h"

#include <algorithm>

#include "video/depth_codecs.h"

namespace theatron::world {
namespace {

Calibration calibration() {
    Calibration calibration;
    calibration.depth = pinhole(SentCamera::size, 60);
    return calibration;
}

}  // namespace

SentCamera::SentCamera(Person& person, std::string name, bool may_record)
    : person_(person), name_(std::move(name)), may_record_(may_record) {
    client::Participant::Publishing events;
    events.published = [this](const std::vector<CameraId>& numbers) { on_published(numbers); };
    events.encode = [this](const std::vector<wire::StreamSetting>& settings) {
        on_encode(settings);
    };
    events.encode_key = [this](StreamId, SettingId setting) {
        if (const auto found = encoders_.find(setting); found != encoders_.end())
            found->second->wants_key = true;
    };
    person.options.publishing = std::move(events);
    depth_.resize(size);
    later();
}

SentCamera::~SentCamera() {
    if (timer_)
        Schedule::instance().cancel(*timer_);
}

wire::OfferedCamera SentCamera::offer() const {
    wire::OfferedCamera offered;
    offered.name = name_;
    offered.frames_per_second = frames_per_second;
    offered.calibration = encode_calibration(calibration());
    offered.may_record = may_record_;
    return offered;
}

void SentCamera::start() {
    person_->publish({offer()});
}

void SentCamera::stop() {
    person_->publish({});
}

std::vector<std::string> SentCamera::codecs() const {
    std::vector<std::string> texts;
    for (const auto& [setting, encoder] : encoders_)
        texts.push_back(encoder->parsed.text);
    std::sort(texts.begin(), texts.end());
    return texts;
}

void SentCamera::on_published(const std::vector<CameraId>& numbers) {
    number_ = numbers.empty() ? std::nullopt : std::optional(numbers.front());
    encoders_.clear();
}

void SentCamera::on_encode(const std::vector<wire::StreamSetting>& settings) {
    std::map<SettingId, std::unique_ptr<Encoder>> encoders;
    for (const wire::StreamSetting& wanted : settings) {
        if (!number_ || wanted.stream != depth_stream(*number_))
            continue;
        auto& encoder = encoders[wanted.setting];
        if (const auto found = encoders_.find(wanted.setting); found != encoders_.end())
            encoder = std::move(found->second);
        else if (const auto parsed = video::parse_depth_setting(wanted.codec);
                 parsed.problem.empty())
            encoder = std::make_unique<Encoder>(Encoder{
                wanted.setting, parsed.setting, video::make_depth_encoder(parsed.setting), true});
    }
    std::erase_if(encoders, [](const auto& entry) { return !entry.second; });
    encoders_ = std::move(encoders);
}

void SentCamera::later() {
    timer_ = Schedule::instance().after(seconds_to_duration(1 / frames_per_second), [this] {
        picture();
        later();
    });
}

void SentCamera::picture() {
    if (!person_.is_in() || !number_ || encoders_.empty())
        return;
    std::fill(depth_.pixels.begin(), depth_.pixels.end(), std::uint16_t(1000 + sent_));
    for (auto& [setting, encoder] : encoders_)
        send(*encoder, std::as_const(depth_).view());
    ++frame_;
    ++sent_;
}

void SentCamera::send(Encoder& encoder, DepthView depth) {
    Bytes payload(encoder.encoder.max_encoded_size(size));
    const auto encoded =
        encoder.encoder.encode(depth, frame_, std::exchange(encoder.wants_key, false), payload);
    wire::MediaHeader header;
    header.codec = std::uint8_t(encoder.parsed.id);
    header.stream = depth_stream(*number_);
    header.setting = encoder.setting;
    header.frame = frame_;
    header.key = encoded.key;
    header.reference = encoded.reference_frame;
    header.temporal_layer = std::uint8_t(encoded.layer);
    header.payload_size = std::uint32_t(encoded.bytes);
    header.moment = header.captured = header.delivered = header.filtered = header.encoded =
        person_->now();
    const auto message = std::make_shared<Bytes>(wire::media_header_size + encoded.bytes);
    wire::write_media_header(header, message->data());
    std::copy_n(payload.begin(), encoded.bytes,
                message->begin() + std::ptrdiff_t(wire::media_header_size));
    person_->send_media(header, message);
}

}  // namespace theatron::world

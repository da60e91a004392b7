// SPDX-License-Identifier: Apache-2.0
#include "sound/voice_output.h"

#include <utility>

namespace theatron::sound {

VoiceOutput::VoiceOutput(std::function<void(std::span<const float>)> rendered)
    : rendered_(std::move(rendered)) {}

void VoiceOutput::begin(int channels) {
    const std::lock_guard lock(mutex_);
    channels_ = channels;
    if (channels_ == 2 && !spatial_)
        spatial_ = std::make_unique<SpatialVoices>();
    feed_ = std::make_unique<voice::SpeakerFeed>(channels);
}

TimePoint VoiceOutput::work(const voice::SpeakerFeed::Now& now) {
    const std::lock_guard lock(mutex_);
    if (!feed_)
        return TimePoint::max();
    return feed_->fill(now, [this](std::span<float> out, TimePoint heard) { render(out, heard); });
}

void VoiceOutput::render(std::span<float> out, TimePoint heard) {
    if (channels_ == 2)
        render_in_space(out, heard);
    else
        mixer_.pull(out, heard);
    if (!rendered_)
        return;
    if (channels_ == 2) {
        one_channel_.resize(out.size() / 2);
        for (std::size_t i = 0; i < one_channel_.size(); ++i)
            one_channel_[i] = (out[2 * i] + out[2 * i + 1]) / 2;
        out = one_channel_;
    }
    rendered_(out);
}

void VoiceOutput::render_in_space(std::span<float> out, TimePoint heard) {
    constexpr Vec3 ahead{0, 0, -full_loudness_m};
    const std::size_t count = out.size() / 2;
    if (!head_from_room_) {
        one_channel_.resize(count);
        mixer_.pull(one_channel_, heard);
        for (std::size_t i = 0; i < count; ++i)
            out[2 * i] = out[2 * i + 1] = one_channel_[i];
        return;
    }
    placed_.clear();
    for (const voice::Mixer::Heard& voice : mixer_.pull_each(count, heard)) {
        const auto place = heads_.find(voice.speaker);
        placed_.push_back({voice.speaker,
                           place != heads_.end() ? *head_from_room_ * place->second : ahead,
                           voice.samples});
    }
    spatial_->mix(placed_, out);
}

void VoiceOutput::hear(ParticipantId speaker, ByteView packet, TimePoint now) {
    const std::lock_guard lock(mutex_);
    speakers_.hear(speaker, packet, now);
    // Without a device nothing would take the packets.
    if (feed_)
        mixer_.put(speaker, packet, now);
}

void VoiceOutput::place(const Pose& room_from_head, std::map<ParticipantId, Vec3> heads) {
    const Pose head_from_room = inverse(room_from_head);
    const std::lock_guard lock(mutex_);
    head_from_room_ = head_from_room;
    heads_ = std::move(heads);
}

std::set<ParticipantId> VoiceOutput::speaking(TimePoint now) const {
    const std::lock_guard lock(mutex_);
    return speakers_.speaking(now);
}

std::map<ParticipantId, int> VoiceOutput::levels_db(TimePoint now) const {
    const std::lock_guard lock(mutex_);
    return speakers_.levels_db(now);
}

VoiceOutput::Figures VoiceOutput::figures() const {
    const std::lock_guard lock(mutex_);
    Figures figures;
    figures.speakers = mixer_.speakers();
    figures.unreadable = mixer_.unreadable();
    if (spatial_)
        figures.space = spatial_->way();
    if (feed_) {
        figures.missing = feed_->missing();
        figures.lead = feed_->lead();
    }
    return figures;
}

}  // namespace theatron::sound

// SPDX-License-Identifier: Apache-2.0
// The voices of the others, from their packets to a loudspeaker: who speaks, jitter buffers,
// decoding, and places around the listener's head.
//
// Reads no clock and has no thread. Three threads use it: the device's play(), a FeedThread's
// work(), and any others the rest. Only these others and work() share a lock.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "base/bytes.h"
#include "base/ids.h"
#include "geometry/vec.h"
#include "sound/spatial_voices.h"
#include "voice/mixer.h"
#include "voice/speaker_feed.h"
#include "voice/speakers.h"

namespace theatron::sound {

class VoiceOutput {
public:
    // `rendered`, which may be empty, gets what the loudspeaker plays next, as one channel, from
    // work().
    explicit VoiceOutput(std::function<void(std::span<const float>)> rendered = {});

    // A device is about to use this object, and none does at present. Channels: 1, all voices at
    // one place, or 2, for the listener's ears.
    void begin(int channels);
    // The device takes its next samples; see SpeakerFeed::play().
    void play(std::span<float> out, TimePoint now) noexcept { feed_->play(out, now); }
    // To be called as SpeakerFeed::fill().
    TimePoint work(const voice::SpeakerFeed::Now& now);

    // A packet of this speaker has arrived. Before the first begin() none is kept.
    void hear(ParticipantId speaker, ByteView packet, TimePoint now);
    // The listener's head (y up, -z ahead), and those of the others, all in the room. A voice whose
    // place is not known is heard from ahead; before the first call, all are at one place.
    void place(const Pose& room_from_head, std::map<ParticipantId, Vec3> heads);

    // As voice::Speakers has them; without a device, too.
    std::set<ParticipantId> speaking(TimePoint now) const;
    std::map<ParticipantId, int> levels_db(TimePoint now) const;

    struct Figures {
        std::vector<voice::Mixer::Speaker> speakers;
        std::uint64_t unreadable = 0;     // packets
        std::optional<SpatialWay> space;  // once a device has had two channels
        std::uint64_t missing = 0;        // samples that the present device asked for in vain
        Duration lead{};                  // SpeakerFeed::lead()
    };
    Figures figures() const;

private:
    // With mutex_ held.
    void render(std::span<float> out, TimePoint heard);
    void render_in_space(std::span<float> out, TimePoint heard);

    const std::function<void(std::span<const float>)> rendered_;
    mutable std::mutex mutex_;  // all below; the device's thread uses feed_ without it
    voice::Speakers speakers_;
    voice::Mixer mixer_;
    int channels_ = 0;
    std::unique_ptr<SpatialVoices> spatial_;
    std::optional<Pose> head_from_room_;
    std::map<ParticipantId, Vec3> heads_;
    std::vector<float> one_channel_;
    std::vector<SpatialVoices::Voice> placed_;
    std::unique_ptr<voice::SpeakerFeed> feed_;
};

}  // namespace theatron::sound

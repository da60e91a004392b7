// SPDX-License-Identifier: Apache-2.0
// The voices of others at their places around a listener, for headphones: OpenAL Soft computes how
// two ears hear each of them (HRTF), without a sound device of its own. Where it cannot do this, a
// voice is only louder in the nearer ear.
#pragma once

#include <memory>
#include <span>

#include "base/ids.h"
#include "geometry/vec.h"

namespace theatron::sound {

enum class SpatialWay { hrtf, panning };

// A voice is not weaker than at its source up to this distance in metres; beyond it, the loudness
// falls half as fast as in open air, so that voices stay understandable across the room. As in the
// page (apps/web/page/voice.js).
inline constexpr double full_loudness_m = 1.5, rolloff = 0.5;
double loudness_at(double distance_m);

// Loudness of a voice in the left and the right ear without HRTF. `from_head`: see below.
struct EarGains {
    float left = 1, right = 1;
};
EarGains panned(Vec3 from_head);

// Use from one thread at a time.
class SpatialVoices {
public:
    struct Voice {
        ParticipantId speaker{};
        Vec3 from_head;                  // metres; x right, y up, -z ahead
        std::span<const float> samples;  // 48 kHz; of all voices equally many
    };

    // `wanted`: panning is for tests and machines without HRTF.
    explicit SpatialVoices(SpatialWay wanted = SpatialWay::hrtf);
    ~SpatialVoices();
    SpatialVoices(const SpatialVoices&) = delete;
    SpatialVoices& operator=(const SpatialVoices&) = delete;

    // The way in which voices are placed.
    SpatialWay way() const { return renderer_ ? SpatialWay::hrtf : SpatialWay::panning; }

    // Fills `out` with the sum, a left and a right sample in turns, -1 to 1. Each call continues
    // the one before; a speaker who is missing in one begins anew. With HRTF all is heard 32
    // samples later.
    void mix(std::span<const Voice> voices, std::span<float> out);

private:
    class Renderer;
    std::unique_ptr<Renderer> renderer_;  // null: panning
};

}  // namespace theatron::sound

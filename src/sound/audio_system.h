// SPDX-License-Identifier: Apache-2.0
// The sound devices of a machine as audio_thread.h uses them: those of SDL, or a stand-in in tests.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "sound/sound_device.h"

namespace theatron::sound {

// Everything may take as long as the system likes. All calls from one thread.
class AudioSystem {
public:
    struct Wanted {
        std::string name;  // or "default"
        bool captures = false;
        int channels = 1;
    };
    using DeviceId = std::uint32_t;
    // The samples that a microphone has delivered, or a place for those that a loudspeaker takes.
    using Block = std::function<void(std::span<float>)>;

    virtual ~AudioSystem() = default;
    // From now on `block` is called, on a thread of the system's. Throws Error with a sentence.
    virtual DeviceId open(const Wanted& wanted, Block block) = 0;
    // `block` is not called any more.
    virtual void close(DeviceId device) = 0;
    // False once it has been unplugged.
    virtual bool works(DeviceId device) = 0;
    virtual DeviceList devices() = 0;
};

// SDL's audio, which begins with the first call and never ends: beginning and ending it while a
// machine has no device is what its ALSA driver does not survive (docs/decisions/leaving.md).
std::unique_ptr<AudioSystem> sdl_audio();

}  // namespace theatron::sound

// SPDX-License-Identifier: Apache-2.0
// One thread that alone uses the sound of a machine, since SDL's audio can be used by one thread
// only. Nobody waits for it: a system that does not answer costs the sound and nothing else.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "sound/audio_system.h"
#include "sound/sound_device.h"

namespace theatron::sound {

// All functions from any thread, and at once.
class AudioThread {
public:
    explicit AudioThread(std::unique_ptr<AudioSystem> system);
    // Leaves a thread behind that stands in the system still after `patience`.
    ~AudioThread();
    AudioThread(const AudioThread&) = delete;
    AudioThread& operator=(const AudioThread&) = delete;

    // A device that is being opened. Once it is destroyed `block` is not called any more; devices
    // are opened and closed in the order in which they are made and destroyed.
    std::unique_ptr<SoundDevice> open(AudioSystem::Wanted wanted, AudioSystem::Block block);

    // `answer` gets the devices of the machine, on the audio thread.
    void ask(std::function<void(DeviceList)> answer);

    // False if something that was asked for is not done after this time.
    bool wait_until_idle(Duration patience);

    // The one of this program, with SDL.
    static AudioThread& shared();

private:
    static constexpr Duration patience = std::chrono::milliseconds(500);
    struct Shared;
    std::shared_ptr<Shared> shared_;
};

}  // namespace theatron::sound

// SPDX-License-Identifier: Apache-2.0
// WAV files in the place of sound devices: a thread delivers or takes a block every 10 ms.
#pragma once

#include "sound/sound_device.h"

namespace theatron::sound {

// Any rate and format that SDL reads; it is converted. Throws Error if the file cannot be read.
std::unique_ptr<SoundDevice> open_wav_microphone(const std::string& path, Deliver deliver);

// Throws Error if the file cannot be written.
std::unique_ptr<SoundDevice> open_wav_speaker(const std::string& path, Fill fill, int channels = 1);

}  // namespace theatron::sound

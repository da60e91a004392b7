// SPDX-License-Identifier: Apache-2.0
// Microphones and loudspeakers: devices of this machine by SDL, or WAV files at the same pace, for
// tests and scripts. All samples are 48 kHz, -1 to 1, those of microphones mono.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/time.h"

namespace theatron::sound {

// Samples of each channel in a block of both; 10 ms.
inline constexpr int block_samples = 480;

// Delivers or takes blocks on a thread of its own until it is destroyed.
class SoundDevice {
public:
    virtual ~SoundDevice() = default;
    // The system has not answered yet whether it can be used.
    virtual bool is_opening() const { return false; }
    // False before, where it cannot be used, and once it has been unplugged: no samples come or go.
    virtual bool works() const { return true; }
    // A sentence, where it cannot be used.
    virtual std::string problem() const { return ""; }
    // The time at which the first sample was spoken or is heard, if it is known: of a file, as if
    // it were a sound card with two blocks.
    virtual std::optional<TimePoint> began() const { return std::nullopt; }
};

// True for a name that means a WAV file.
bool is_file(const std::string& name);

// The devices of this machine, without files. Both lists are empty where `problem` is not, which
// is then one sentence.
struct DeviceList {
    std::vector<std::string> microphones, loudspeakers;
    std::string problem;
};
// Waits for the system's answer, which may take long; for commands.
DeviceList devices(Duration patience = std::chrono::seconds(5));
// Does not wait for it. `answer` is called on another thread, once, unless the system hangs.
void ask_devices(std::function<void(DeviceList)> answer);

using Deliver = std::function<void(std::span<const float>)>;
using Fill = std::function<void(std::span<float>)>;

// `name`: "default", the name of a device, or a file that ends in .wav; behind the file's
// end comes silence. A device of this machine is opened behind the caller's back: see
// SoundDevice::is_opening(). Throws Error where a file cannot be used.
std::unique_ptr<SoundDevice> open_microphone(const std::string& name, Deliver deliver);

// The same for a loudspeaker; a file is written, of 16 bits, and complete when the device is
// destroyed. It must not exist yet. `channels`: 1, or 2 for a left and a right sample in turns.
std::unique_ptr<SoundDevice> open_speaker(const std::string& name, Fill fill, int channels = 1);

}  // namespace theatron::sound

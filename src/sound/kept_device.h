// SPDX-License-Identifier: Apache-2.0
// A microphone or loudspeaker that comes back: one that was unplugged, or is not there yet, is
// opened as soon as it can be. It can be exchanged while it runs.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "sound/sound_device.h"

namespace theatron::sound {

class KeptDevice {
public:
    // Time between two attempts, and between two looks at a device.
    static constexpr Duration usual_interval = std::chrono::milliseconds(500);

    // Opens the device of this name; throws Error with a sentence if it cannot.
    using Open = std::function<std::unique_ptr<SoundDevice>(const std::string& name)>;

    // Asks for `name` at once. `kind` is "microphone" or "loudspeaker". `say` gets sentences for
    // people: why it cannot be opened (once), that it is gone, that it is there again; from the
    // caller's thread or one of its own. Files are not tried again. Where `usual_instead`, the
    // usual device takes the place of one that cannot be opened now.
    KeptDevice(std::string kind, const std::string& name, Open open,
               std::function<void(const std::string&)> say, Duration interval = usual_interval,
               bool usual_instead = false);
    ~KeptDevice();

    bool works() const;
    // SoundDevice::began() of the present device.
    std::optional<TimePoint> began() const;
    std::string name() const;

    // Another device from now on; the old one ends first. One that cannot be opened is said, and
    // tried again. From any thread but those of the device.
    void change(const std::string& name);

private:
    // Both with mutex_ held.
    void open_now();
    void look();
    void note_failure(const std::string& problem);

    // An answer of the system is looked for this often.
    static constexpr Duration answer_interval = std::chrono::milliseconds(20);

    const std::string kind_;
    const Open open_;
    const std::function<void(const std::string&)> say_;
    const Duration interval_;

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::string name_;
    std::unique_ptr<SoundDevice> device_;
    bool usual_instead_;
    bool is_first_try_ = true, was_used_ = false;
    bool ends_ = false;
    std::thread thread_;
};

}  // namespace theatron::sound

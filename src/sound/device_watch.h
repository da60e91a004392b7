// SPDX-License-Identifier: Apache-2.0
// The sound devices of this machine, asked for again and again without waiting: the system may take
// long to answer.
#pragma once

#include <functional>
#include <memory>

#include "sound/sound_device.h"

namespace theatron::sound {

// From one thread.
class DeviceWatch {
public:
    static constexpr Duration usual_interval = std::chrono::seconds(2);

    // `ask` calls its argument with the answer, once, at any time and on any thread.
    using Ask = std::function<void(std::function<void(DeviceList)>)>;
    explicit DeviceWatch(Ask ask = ask_devices, Duration interval = usual_interval);

    // The newest answer; empty before the first one. Asks again where the last answer was asked
    // for this interval ago.
    DeviceList devices_at(TimePoint now);

private:
    struct Answers;
    const Ask ask_;
    const Duration interval_;
    TimePoint next_{};
    std::shared_ptr<Answers> answers_;
};

}  // namespace theatron::sound

// SPDX-License-Identifier: Apache-2.0
#include "sound/sound_device.h"

#include <future>
#include <utility>

#include "sound/audio_thread.h"
#include "sound/wav_device.h"

namespace theatron::sound {

bool is_file(const std::string& name) {
    return name.ends_with(".wav") || name.ends_with(".WAV");
}

void ask_devices(std::function<void(DeviceList)> answer) {
    AudioThread::shared().ask(std::move(answer));
}

DeviceList devices(Duration patience) {
    const auto asked = std::make_shared<std::promise<DeviceList>>();
    ask_devices([asked](DeviceList found) { asked->set_value(std::move(found)); });
    std::future<DeviceList> answer = asked->get_future();
    if (answer.wait_for(patience) == std::future_status::ready)
        return answer.get();
    return {{}, {}, "The sound of this machine does not answer. You can take part without it."};
}

std::unique_ptr<SoundDevice> open_microphone(const std::string& name, Deliver deliver) {
    if (is_file(name))
        return open_wav_microphone(name, std::move(deliver));
    return AudioThread::shared().open({name, true, 1}, std::move(deliver));
}

std::unique_ptr<SoundDevice> open_speaker(const std::string& name, Fill fill, int channels) {
    if (is_file(name))
        return open_wav_speaker(name, std::move(fill), channels);
    return AudioThread::shared().open({name, false, channels}, std::move(fill));
}

}  // namespace theatron::sound

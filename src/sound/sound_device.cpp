// SPDX-License-Identifier: Apache-2.0
#include "sound/sound_device.h"

#define SDL_MAIN_HANDLED
#include <SDL.h>

#include <utility>
#include <vector>

#include "base/error.h"
#include "sound/wav_device.h"
#include "voice/packet.h"

namespace theatron::sound {
namespace {

constexpr const char* without_sound = " You can take part without it.";

// SDL's audio, while an object of this lives.
struct Audio {
    explicit Audio(const std::string& what) {
        SDL_SetMainReady();
        SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
        if (SDL_InitSubSystem(SDL_INIT_AUDIO) != 0)
            throw Error("This machine has no sound for " + what + " (" + SDL_GetError() + ")." +
                        without_sound);
    }
    ~Audio() { SDL_QuitSubSystem(SDL_INIT_AUDIO); }
    Audio(const Audio&) = delete;
    Audio& operator=(const Audio&) = delete;
};

std::string list_of(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names)
        text += (text.empty() ? "'" : ", '") + name + "'";
    return text.empty() ? "none" : text;
}

std::vector<std::string> names_of(bool captures) {
    std::vector<std::string> names;
    for (int i = 0; i < SDL_GetNumAudioDevices(captures); ++i)
        if (const char* name = SDL_GetAudioDeviceName(i, captures))
            names.emplace_back(name);
    return names;
}

class SdlDevice : public SoundDevice {
public:
    SdlDevice(const std::string& name, bool captures, int channels, Deliver deliver, Fill fill)
        : audio_(captures ? "a microphone" : "a loudspeaker"),
          deliver_(std::move(deliver)),
          fill_(std::move(fill)) {
        SDL_AudioSpec wanted{};
        wanted.freq = voice::sample_rate;
        wanted.format = AUDIO_F32SYS;
        wanted.channels = Uint8(channels);
        wanted.samples = block_samples;
        wanted.userdata = this;
        wanted.callback = [](void* self, Uint8* bytes, int size) {
            auto& device = *static_cast<SdlDevice*>(self);
            const std::span samples(reinterpret_cast<float*>(bytes),
                                    std::size_t(size) / sizeof(float));
            if (device.deliver_)
                device.deliver_(samples);
            else
                device.fill_(samples);
        };
        SDL_AudioSpec got{};
        // Without permitted changes SDL converts to the wanted format.
        id_ = SDL_OpenAudioDevice(name == "default" ? nullptr : name.c_str(), captures, &wanted,
                                  &got, 0);
        if (id_ == 0)
            throw Error("The " + std::string(captures ? "microphone '" : "loudspeaker '") + name +
                        "' cannot be opened (" + SDL_GetError() +
                        "); check that it is plugged in and that this program may use it. There "
                        "are: default, " +
                        list_of(names_of(captures)) + "." + without_sound);
        SDL_PauseAudioDevice(id_, 0);
    }
    ~SdlDevice() override { SDL_CloseAudioDevice(id_); }
    // SDL stops a device that the system has taken away.
    bool works() const override { return SDL_GetAudioDeviceStatus(id_) != SDL_AUDIO_STOPPED; }
    SdlDevice(const SdlDevice&) = delete;
    SdlDevice& operator=(const SdlDevice&) = delete;

private:
    Audio audio_;
    Deliver deliver_;
    Fill fill_;
    SDL_AudioDeviceID id_ = 0;
};

}  // namespace

bool is_file(const std::string& name) {
    return name.ends_with(".wav") || name.ends_with(".WAV");
}

DeviceList devices() {
    try {
        const Audio audio("this program");
        return {names_of(true), names_of(false), ""};
    } catch (const Error& error) {
        return {{}, {}, error.what()};
    }
}

std::unique_ptr<SoundDevice> open_microphone(const std::string& name, Deliver deliver) {
    if (is_file(name))
        return open_wav_microphone(name, std::move(deliver));
    return std::make_unique<SdlDevice>(name, true, 1, std::move(deliver), nullptr);
}

std::unique_ptr<SoundDevice> open_speaker(const std::string& name, Fill fill, int channels) {
    if (is_file(name))
        return open_wav_speaker(name, std::move(fill), channels);
    return std::make_unique<SdlDevice>(name, false, channels, nullptr, std::move(fill));
}

}  // namespace theatron::sound

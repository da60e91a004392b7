// SPDX-License-Identifier: Apache-2.0
#define SDL_MAIN_HANDLED
#include <SDL.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "sound/audio_system.h"
#include "voice/packet.h"

namespace theatron::sound {
namespace {

constexpr const char* without_sound = " You can take part without it.";

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

class SdlAudio : public AudioSystem {
public:
    DeviceId open(const Wanted& wanted, Block block) override {
        begin(wanted.captures ? "a microphone" : "a loudspeaker");
        auto kept = std::make_unique<Block>(std::move(block));
        SDL_AudioSpec spec{};
        spec.freq = voice::sample_rate;
        spec.format = AUDIO_F32SYS;
        spec.channels = Uint8(wanted.channels);
        spec.samples = block_samples;
        spec.userdata = kept.get();
        spec.callback = [](void* to, Uint8* bytes, int size) {
            (*static_cast<Block*>(to))(
                {reinterpret_cast<float*>(bytes), std::size_t(size) / sizeof(float)});
        };
        SDL_AudioSpec got{};
        // Without permitted changes SDL converts to the wanted format.
        const DeviceId id =
            SDL_OpenAudioDevice(wanted.name == "default" ? nullptr : wanted.name.c_str(),
                                wanted.captures, &spec, &got, 0);
        if (id == 0)
            throw Error("The " + std::string(wanted.captures ? "microphone '" : "loudspeaker '") +
                        wanted.name + "' cannot be opened (" + SDL_GetError() +
                        "); check that it is plugged in and that this program may use it. There "
                        "are: default, " +
                        list_of(names_of(wanted.captures)) + "." + without_sound);
        blocks_[id] = std::move(kept);
        SDL_PauseAudioDevice(id, 0);
        return id;
    }

    void close(DeviceId device) override {
        SDL_CloseAudioDevice(device);
        blocks_.erase(device);
    }

    // SDL stops a device that the system has taken away.
    bool works(DeviceId device) override {
        return SDL_GetAudioDeviceStatus(device) != SDL_AUDIO_STOPPED;
    }

    DeviceList devices() override {
        try {
            begin("this program");
        } catch (const Error& error) {
            return {{}, {}, error.what()};
        }
        return {names_of(true), names_of(false), ""};
    }

private:
    // Not as a subsystem: SDL counts those without a lock, and a window has others.
    void begin(const std::string& what) {
        has_begun_ = has_begun_ || SDL_AudioInit(nullptr) == 0;
        if (has_begun_)
            return;
        throw Error("This machine has no sound for " + what + " (" + SDL_GetError() + ")." +
                    without_sound);
    }

    bool has_begun_ = false;
    std::map<DeviceId, std::unique_ptr<Block>> blocks_;
};

}  // namespace

std::unique_ptr<AudioSystem> sdl_audio() {
    return std::make_unique<SdlAudio>();
}

}  // namespace theatron::sound

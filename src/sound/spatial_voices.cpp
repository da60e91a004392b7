// SPDX-License-Identifier: Apache-2.0
#include "sound/spatial_voices.h"

#define AL_ALEXT_PROTOTYPES
#include <AL/al.h>
#include <AL/alc.h>
#include <AL/alext.h>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "voice/packet.h"

namespace theatron::sound {
namespace {

// A source of OpenAL that has played all of its samples stops, and begins anew with a click. So
// each is given these before the first ones of a voice, and never runs dry.
constexpr std::size_t lead_samples = 32;
// A head between the ears takes loudness from both; this makes up for it ahead.
constexpr float head_gain = 1.5f;
constexpr float far_ear_gain = 0.5f;
constexpr int most_sources = 64;

}  // namespace

double loudness_at(double distance_m) {
    return full_loudness_m /
           (full_loudness_m + rolloff * (std::max(distance_m, full_loudness_m) - full_loudness_m));
}

EarGains panned(Vec3 from_head) {
    const double distance = length(from_head);
    const auto loudness = float(loudness_at(distance));
    const auto side = float(distance > 0 ? from_head.x / distance : 0);  // 1: right
    const auto gain = [&](float away) {
        return loudness * (1 - (1 - far_ear_gain) * std::max(0.0f, away));
    };
    return {gain(side), gain(-side)};
}

// A device of OpenAL that renders into memory.
class SpatialVoices::Renderer {
public:
    // Null if this machine's OpenAL cannot do it.
    static std::unique_ptr<Renderer> open() {
        if (!alcIsExtensionPresent(nullptr, "ALC_SOFT_loopback") ||
            !alcIsExtensionPresent(nullptr, "ALC_EXT_thread_local_context"))
            return nullptr;
        auto renderer = std::make_unique<Renderer>();
        return renderer->has_hrtf() ? std::move(renderer) : nullptr;
    }

    Renderer() : device_(alcLoopbackOpenDeviceSOFT(nullptr)) {
        if (!device_ || !alcIsExtensionPresent(device_, "ALC_SOFT_HRTF"))
            return;
        const std::array<ALCint, 15> wishes{ALC_FORMAT_CHANNELS_SOFT,
                                            ALC_STEREO_SOFT,
                                            ALC_FORMAT_TYPE_SOFT,
                                            ALC_FLOAT_SOFT,
                                            ALC_FREQUENCY,
                                            voice::sample_rate,
                                            ALC_HRTF_SOFT,
                                            ALC_TRUE,
                                            ALC_MONO_SOURCES,
                                            most_sources,
                                            ALC_OUTPUT_LIMITER_SOFT,
                                            ALC_FALSE,
                                            ALC_MAX_AUXILIARY_SENDS,
                                            0,
                                            0};
        context_ = alcCreateContext(device_, wishes.data());
        if (!context_)
            return;
        const Current current(context_);
        alListenerf(AL_GAIN, head_gain);
        alDistanceModel(AL_INVERSE_DISTANCE_CLAMPED);
    }
    ~Renderer() {
        if (context_) {
            const Current current(context_);
            for (auto& [speaker, source] : sources_)
                remove(source);
        }
        if (context_)
            alcDestroyContext(context_);
        if (device_)
            alcCloseDevice(device_);
    }
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    void mix(std::span<const Voice> voices, std::span<float> out) {
        const Current current(context_);
        std::erase_if(sources_, [&](auto& entry) {
            const bool is_gone = std::none_of(voices.begin(), voices.end(), [&](const Voice& v) {
                return v.speaker == entry.first;
            });
            if (is_gone)
                remove(entry.second);
            return is_gone;
        });
        for (const Voice& voice : voices)
            play(voice);
        alcRenderSamplesSOFT(device_, out.data(), ALCsizei(out.size() / 2));
        for (float& v : out)
            v = std::clamp(v, -1.0f, 1.0f);
    }

private:
    // OpenAL's calls on this thread concern this context.
    struct Current {
        explicit Current(ALCcontext* context) { alcSetThreadContext(context); }
        ~Current() { alcSetThreadContext(nullptr); }
        Current(const Current&) = delete;
        Current& operator=(const Current&) = delete;
    };

    bool has_hrtf() const {
        ALCint is_on = ALC_FALSE;
        if (context_)
            alcGetIntegerv(device_, ALC_HRTF_SOFT, 1, &is_on);
        return is_on == ALC_TRUE;
    }

    void play(const Voice& voice) {
        const auto [found, is_new] = sources_.try_emplace(voice.speaker, 0u);
        const ALuint source = is_new ? found->second = begin() : found->second;
        const Vec3& place = voice.from_head;
        alSource3f(source, AL_POSITION, float(place.x), float(place.y), float(place.z));
        put(source, free_buffer(source), voice.samples);
        ALint state = 0;
        alGetSourcei(source, AL_SOURCE_STATE, &state);
        if (state != AL_PLAYING)
            alSourcePlay(source);
    }

    static ALuint begin() {
        ALuint source = 0, buffer = 0;
        alGenSources(1, &source);
        alGenBuffers(1, &buffer);
        alSourcef(source, AL_REFERENCE_DISTANCE, float(full_loudness_m));
        alSourcef(source, AL_ROLLOFF_FACTOR, float(rolloff));
        constexpr std::array<float, lead_samples> silence{};
        put(source, buffer, silence);
        return source;
    }

    static void put(ALuint source, ALuint buffer, std::span<const float> samples) {
        alBufferData(buffer, AL_FORMAT_MONO_FLOAT32, samples.data(),
                     ALsizei(samples.size() * sizeof(float)), voice::sample_rate);
        alSourceQueueBuffers(source, 1, &buffer);
    }

    // One that the source has played, or a new one.
    static ALuint free_buffer(ALuint source) {
        ALint played = 0;
        alGetSourcei(source, AL_BUFFERS_PROCESSED, &played);
        ALuint buffer = 0;
        for (; played > 0; --played) {
            if (buffer != 0)
                alDeleteBuffers(1, &buffer);
            alSourceUnqueueBuffers(source, 1, &buffer);
        }
        if (buffer == 0)
            alGenBuffers(1, &buffer);
        return buffer;
    }

    static void remove(ALuint source) {
        alSourceStop(source);
        ALint queued = 0;
        alGetSourcei(source, AL_BUFFERS_QUEUED, &queued);
        std::vector<ALuint> buffers(std::size_t(std::max(queued, 0)));
        if (!buffers.empty())
            alSourceUnqueueBuffers(source, queued, buffers.data());
        alDeleteSources(1, &source);
        alDeleteBuffers(ALsizei(buffers.size()), buffers.data());
    }

    ALCdevice* const device_;
    ALCcontext* context_ = nullptr;
    std::map<ParticipantId, ALuint> sources_;
};

SpatialVoices::SpatialVoices(SpatialWay wanted)
    : renderer_(wanted == SpatialWay::hrtf ? Renderer::open() : nullptr) {}

SpatialVoices::~SpatialVoices() = default;

void SpatialVoices::mix(std::span<const Voice> voices, std::span<float> out) {
    if (renderer_)
        return renderer_->mix(voices, out);
    std::fill(out.begin(), out.end(), 0.0f);
    for (const Voice& voice : voices) {
        const EarGains gains = panned(voice.from_head);
        for (std::size_t i = 0; i < out.size() / 2; ++i) {
            out[2 * i] += gains.left * voice.samples[i];
            out[2 * i + 1] += gains.right * voice.samples[i];
        }
    }
    for (float& v : out)
        v = std::clamp(v, -1.0f, 1.0f);
}

}  // namespace theatron::sound

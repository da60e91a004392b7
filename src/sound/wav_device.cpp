// SPDX-License-Identifier: Apache-2.0
#include "sound/wav_device.h"

#define SDL_MAIN_HANDLED
#include <SDL.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "base/bytes.h"
#include "base/error.h"
#include "base/fault.h"
#include "base/log.h"
#include "base/steady_clock.h"
#include "base/thread_name.h"
#include "sound/wav_bytes.h"
#include "voice/packet.h"

namespace theatron::sound {
namespace {

constexpr Duration block_time = std::chrono::milliseconds(10);

// Calls a function every 10 ms, on the average exactly, until it is destroyed.
class Pace {
public:
    explicit Pace(std::function<void()> block)
        : begin_(steady_now()), thread_([this, block = std::move(block)] {
              name_this_thread("sound");
              TimePoint next = begin_;
              while (!ends_) {
                  (void)contain("sound", block);
                  next += block_time;
                  std::this_thread::sleep_for(next - steady_now());
              }
          }) {}
    ~Pace() {
        ends_ = true;
        thread_.join();
    }
    Pace(const Pace&) = delete;
    Pace& operator=(const Pace&) = delete;

    TimePoint begin() const { return begin_; }  // of the first call

private:
    const TimePoint begin_;
    std::atomic<bool> ends_ = false;
    std::thread thread_;
};

// Sample rates of sound cards. Converting from one far below would need memory without end.
constexpr int least_wav_rate = 4000, most_wav_rate = 384'000;
// An hour of the best quality.
constexpr std::uintmax_t max_wav_bytes = std::uintmax_t(2) << 30;

std::vector<float> read_wav(const std::string& path) {
    const std::string name = "The sound file '" + path + "'";
    std::error_code failed;
    // Reading a pipe or a device would never end.
    if (!std::filesystem::is_regular_file(path, failed))
        throw Error(std::filesystem::exists(path, failed) ? name + " is no regular file."
                                                          : name + " does not exist.");
    if (std::filesystem::file_size(path, failed) >= max_wav_bytes)
        throw Error(name + " is larger than the 2 GiB that are read.");
    Bytes file(std::filesystem::file_size(path, failed));
    std::ifstream(path, std::ios::binary)
        .read(reinterpret_cast<char*>(file.data()), std::streamsize(file.size()));
    mend_streamed_wav(file);
    SDL_AudioSpec spec{};
    Uint8* bytes = nullptr;
    Uint32 size = 0;
    SDL_RWops* const in = SDL_RWFromConstMem(file.data(), int(file.size()));
    if (!in || !SDL_LoadWAV_RW(in, 1, &spec, &bytes, &size))
        throw Error(name + " cannot be read (" + SDL_GetError() + "); it must be a WAV file.");
    const std::unique_ptr<Uint8, void (*)(Uint8*)> owner(bytes, SDL_FreeWAV);
    if (spec.freq < least_wav_rate || spec.freq > most_wav_rate)
        throw Error(name + " has " + std::to_string(spec.freq) +
                    " samples a second; it must have from 4,000 to 384,000.");
    const std::unique_ptr<SDL_AudioStream, void (*)(SDL_AudioStream*)> stream(
        SDL_NewAudioStream(spec.format, spec.channels, spec.freq, AUDIO_F32SYS, 1,
                           voice::sample_rate),
        SDL_FreeAudioStream);
    if (size == 0)
        throw Error(name + " holds no sound.");
    if (!stream || size > Uint32(std::numeric_limits<int>::max()) ||
        SDL_AudioStreamPut(stream.get(), bytes, int(size)) != 0 ||
        SDL_AudioStreamFlush(stream.get()) != 0)
        throw Error(name + " cannot be converted (" + SDL_GetError() + ").");
    std::vector<float> samples(std::size_t(SDL_AudioStreamAvailable(stream.get())) / sizeof(float));
    SDL_AudioStreamGet(stream.get(), samples.data(), int(samples.size() * sizeof(float)));
    return samples;
}

class WavMicrophone : public SoundDevice {
public:
    WavMicrophone(const std::string& path, Deliver deliver)
        : samples_(read_wav(path)), deliver_(std::move(deliver)), pace_([this] { next(); }) {}

    // A block is taken when it has been spoken.
    std::optional<TimePoint> began() const override { return pace_.begin() - block_time; }

private:
    void next() {
        std::vector<float> block(block_samples);
        const std::size_t count = std::min(block.size(), samples_.size() - done_);
        std::copy_n(samples_.begin() + std::ptrdiff_t(done_), count, block.begin());
        done_ += count;
        deliver_(block);
    }

    const std::vector<float> samples_;
    const Deliver deliver_;
    std::size_t done_ = 0;
    Pace pace_;
};

void write(std::ofstream& file, ByteView bytes) {
    file.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
}

class WavSpeaker : public SoundDevice {
public:
    WavSpeaker(const std::string& path, Fill fill, int channels)
        : path_(path), channels_(channels), fill_(std::move(fill)) {
        if (std::error_code failed;
            std::filesystem::exists(std::filesystem::symlink_status(path, failed)))
            throw Error("The sound file '" + path + "' exists already; name another file.");
        file_.open(path, std::ios::binary | std::ios::trunc);
        write(file_, wav_head(0, channels_));
        if (!file_)
            throw Error("The sound file '" + path + "' cannot be written; check its folder.");
        pace_ = std::make_unique<Pace>([this] { next(); });
    }
    ~WavSpeaker() override {
        pace_.reset();
        file_.seekp(0);
        write(file_, wav_head(size_, channels_));
    }

    // A sound card plays the block before meanwhile.
    std::optional<TimePoint> began() const override { return pace_->begin() + block_time; }

private:
    void next() {
        std::vector<float> block(std::size_t(channels_ * block_samples));
        fill_(block);
        Bytes bytes;
        ByteWriter out(bytes);
        for (const float v : block)
            out.put(std::int16_t(std::lround(std::clamp(v, -1.0f, 1.0f) * 32767)));
        // The head's sizes have 32 bits.
        constexpr std::uint32_t most_bytes = std::numeric_limits<std::uint32_t>::max() - 36 - 1920;
        if (is_full_)
            return;
        write(file_, bytes);
        file_.flush();
        if (!file_ || size_ > most_bytes) {
            is_full_ = true;
            log::say("The sound file '" + path_ +
                     (file_ ? "' is as long as a WAV file can be; it ends here."
                            : "' cannot be written any more; it ends here. Check the disk."));
            file_.clear();
            return;
        }
        size_ += std::uint32_t(bytes.size());
    }

    const std::string path_;
    const int channels_;
    std::ofstream file_;
    bool is_full_ = false;
    const Fill fill_;
    std::uint32_t size_ = 0;
    std::unique_ptr<Pace> pace_;
};

}  // namespace

std::unique_ptr<SoundDevice> open_wav_microphone(const std::string& path, Deliver deliver) {
    return std::make_unique<WavMicrophone>(path, std::move(deliver));
}

std::unique_ptr<SoundDevice> open_wav_speaker(const std::string& path, Fill fill, int channels) {
    return std::make_unique<WavSpeaker>(path, std::move(fill), channels);
}

}  // namespace theatron::sound

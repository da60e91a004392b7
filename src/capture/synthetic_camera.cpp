// SPDX-License-Identifier: Apache-2.0
#include "capture/synthetic_camera.h"

#include <algorithm>
#include <map>
#include <mutex>

#include "base/lasting_error.h"
#include "base/time.h"
#include "capture/playback.h"
#include "synthetic/frame_cache.h"
#include "synthetic/growing_loop.h"
#include "synthetic/played_part.h"

namespace theatron::capture {
namespace {

class SyntheticRecording final : public Recording {
public:
    SyntheticRecording(const synthetic::LoopOptions& options, const Progress& progress)
        : loop_(options, progress), fps_(options.frames_per_second) {}

    std::size_t frames() const { return loop_.frames(); }

    std::optional<Duration> offset() override {
        if (next_ == loop_.frames())
            return std::nullopt;
        return seconds_to_duration(double(next_) / fps_);
    }
    void skip() override { ++next_; }
    bool read(Frame& out) override {
        loop_.read(next_++, out);
        return true;
    }
    void rewind() override { next_ = 0; }

private:
    synthetic::FrameLoop loop_;
    double fps_;
    std::size_t next_ = 0;
};

// The cameras of one room in this process share it, and with it the moment that they show.
std::shared_ptr<synthetic::PlayedPart> shared_part(synthetic::LoopOptions options) {
    static std::mutex mutex;
    static std::map<std::string, std::weak_ptr<synthetic::PlayedPart>> parts;
    options.camera = 0;
    const std::lock_guard lock(mutex);
    std::weak_ptr<synthetic::PlayedPart>& known = parts[synthetic::key_of(options)];
    auto part = known.lock();
    if (!part)
        known = part = std::make_shared<synthetic::PlayedPart>(synthetic::frames_of(options));
    return part;
}

// Plays what is rendered so far, without an end.
class GrowingRecording final : public Recording {
public:
    GrowingRecording(const synthetic::LoopOptions& options, const Progress& progress)
        : loop_(options, std::size_t(to_seconds(first_part) * options.frames_per_second), progress),
          part_(shared_part(options)),
          camera_(part_->add_camera(loop_.frames())),
          frames_(synthetic::frames_of(options)),
          fps_(options.frames_per_second),
          next_(part_->newest()),
          begin_(next_) {}
    // The other cameras wait for this one no more.
    ~GrowingRecording() override { part_->note_frames(camera_, frames_); }

    std::optional<Duration> offset() override {
        return seconds_to_duration(double(next_ - begin_) / fps_);
    }
    void skip() override { ++next_; }
    bool read(Frame& out) override {
        part_->note_frames(camera_, loop_.frames());
        // A turn that began before this camera came may go beyond its frames.
        loop_.read(std::min(part_->frame_at(next_++), loop_.frames() - 1), out);
        return true;
    }
    void rewind() override { next_ = begin_; }

private:
    // Long enough to see that people move.
    static constexpr Duration first_part = std::chrono::seconds(1);

    synthetic::GrowingLoop loop_;
    std::shared_ptr<synthetic::PlayedPart> part_;
    std::size_t camera_, frames_;
    double fps_;
    std::uint64_t next_, begin_;
};

Size color_size(const std::string& name, const std::string& specification) {
    if (name == "720")
        return {1280, 720};
    if (name == "1080")
        return {1920, 1080};
    if (name == "depth")
        return {640, 360};
    if (name == "off")
        return {};
    throw LastingError("In the camera '" + specification +
                       "', color must be 720, 1080, depth or off, not '" + name + "'.");
}

// Accepts noise=off as well as noise=0.
bool take_switch(Options& options, const std::string& name) {
    const std::string value = options.take(name, "on");
    if (value == "on" || value == "1")
        return true;
    if (value == "off" || value == "0")
        return false;
    throw LastingError("In the camera '" + options.text() + "', " + name + " must be on or off.");
}

synthetic::LoopOptions take_loop_options(Options& options) {
    synthetic::LoopOptions loop;
    const std::string variant = options.value();
    if (!variant.empty() && variant != "room" && variant != "surgeon")
        throw LastingError("There is no synthetic scene '" + variant +
                           "'; there are room and surgeon.");
    loop.variant = variant == "surgeon" ? synthetic::Variant::surgeon : synthetic::Variant::room;
    loop.cameras = options.take_int("cameras", 2, 1, synthetic::max_viewpoints);
    loop.camera = options.take_int("camera", 0, 0, loop.cameras - 1);
    loop.scene.seed = std::uint32_t(options.take_int("seed", 1, 0, 1'000'000));
    loop.scene.loop = seconds_to_duration(options.take_number("seconds", 20, 2, 120));
    loop.frames_per_second = options.take_number("fps", 30, 1, 60);
    loop.noise = take_switch(options, "noise");
    loop.scene.people = take_switch(options, "people");
    loop.color = color_size(options.take("color", "720"), options.text());
    loop.folder = options.take("cache");
    const std::string quality = options.take("quality", "full");
    if (quality == "quick") {
        loop.scene.detail = 0.2;
        loop.depth_divisor = 2;
        if (loop.color.area() > 0)
            loop.color = {640, 360};
    } else if (quality != "full") {
        throw LastingError("In the camera '" + options.text() +
                           "', quality must be full or quick.");
    }
    return loop;
}

}  // namespace

std::unique_ptr<Camera> open_synthetic_camera(Options& options, const Progress& progress) {
    const synthetic::LoopOptions loop = take_loop_options(options);
    PlaybackOptions playback;
    playback.loop = options.take_flag("loop", true);
    playback.start = options.take_int("start", 0, 0, 1'000'000);
    const bool preload = options.take_flag("preload");
    const bool waits = take_switch(options, "wait");
    options.require_no_problem();
    if (!waits && (preload || !playback.loop || playback.start != 0))
        throw LastingError("In the camera '" + options.text() +
                           "', wait=off plays what is rendered so far, again and again; leave out "
                           "loop, start and preload.");

    CameraInfo info;
    info.name = std::string(loop.variant == synthetic::Variant::room ? "or" : "surgeon") +
                std::to_string(loop.camera);
    info.calibration = synthetic::loop_calibration(loop);
    info.frames_per_second = loop.frames_per_second;
    if (!waits)
        return make_recorded_camera(std::move(info),
                                    std::make_unique<GrowingRecording>(loop, progress), playback);
    auto recording = std::make_unique<SyntheticRecording>(loop, progress);
    if (!preload)
        return make_recorded_camera(std::move(info), std::move(recording), playback);
    const std::size_t frames = recording->frames();
    return make_recorded_camera(
        std::move(info), std::make_unique<MemoryRecording>(*recording, frames, progress), playback);
}

}  // namespace theatron::capture

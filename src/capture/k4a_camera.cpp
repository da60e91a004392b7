// SPDX-License-Identifier: Apache-2.0
#include "capture/k4a_camera.h"

#include <algorithm>
#include <cstring>

#include "base/log.h"
#include "capture/device_clock.h"
#include "capture/k4a_device.h"
#include "capture/time_pairing.h"
#include "image/frame_pool.h"

namespace theatron::capture {
namespace k4a {
namespace {

// A colour picture may arrive this many frames after its depth picture.
constexpr std::size_t max_depth_waiting = 2;

HostNow host_now(TimePoint now) {
    const auto since_1970 = std::chrono::system_clock::now().time_since_epoch();
    return {now, std::chrono::duration_cast<Duration>(since_1970)};
}

class K4aCamera final : public Camera {
public:
    K4aCamera(const Library& library, const Settings& settings, const Patience& patience,
              Clock clock)
        : settings_(settings),
          patience_(patience),
          time_(std::move(clock)),
          device_(library, settings),
          pairing_(settings.period() / 2, settings.period() / 4,
                   settings.color == Size{} ? 0 : max_depth_waiting) {
        info_.name =
            "k4a-" + (device_.serial().empty() ? std::to_string(settings.index) : device_.serial());
        info_.calibration = device_.calibration(settings);
        info_.frames_per_second = settings.frames_per_second;
        info_.live = true;
        device_.start(settings);
    }

    const CameraInfo& info() const override { return info_; }

    Capture next(Duration timeout) override {
        if (over_)
            return *over_;
        TimePoint now = time_.now();
        const TimePoint deadline = now + timeout;
        do {
            if (const auto frame = take_paired())
                return deliver(frame);
            CapturePtr capture;
            const WaitResult result = device_.wait(deadline - now, capture);
            if (result == WaitResult::failed)
                return fail("was unplugged or has failed");
            if (capture)
                add(capture);
            else
                // Prevents a busy loop if the library does not wait.
                time_.sleep(std::clamp<Duration>(deadline - time_.now(), 0ms, 1ms));
            if (const auto frame = take_paired())
                return deliver(frame);
            waited_ += time_.now() - now;
            if (const std::string problem = silence(); !problem.empty())
                return fail(problem);
            now = time_.now();
        } while (now < deadline);
        return {};
    }

private:
    using FramePointer = std::shared_ptr<Frame>;

    void add(const CapturePtr& capture) {
        const ImagePtr depth = device_.depth_of(capture);
        const ImagePtr color = device_.color_of(capture);
        FramePointer depth_frame = depth ? read_depth(depth) : nullptr;
        FramePointer color_frame = color ? read_color(color) : nullptr;
        // Pictures that the library paired stay together, regardless of their times.
        if (settings_.configuration.synchronized_only && depth_frame && color_frame) {
            std::swap(depth_frame->color, color_frame->color);
            paired_ = std::move(depth_frame);
            return;
        }
        if (color_frame)
            pairing_.add_color({device_.device_time(color), std::move(color_frame)});
        if (depth_frame)
            pairing_.add_depth({device_.device_time(depth), std::move(depth_frame)});
    }

    FramePointer read_depth(const ImagePtr& image) {
        const std::optional<DepthPicture> picture = device_.depth_picture(image, settings_.depth);
        if (!picture) {
            note_damage("a depth picture is damaged and left out");
            return nullptr;
        }
        FramePointer frame = pool_.take();
        frame->depth.resize(settings_.depth);
        const std::size_t row = std::size_t(settings_.depth.width);
        for (int y = 0; y < settings_.depth.height; ++y)
            std::memcpy(frame->depth.pixels.data() + std::size_t(y) * row,
                        picture->bytes + std::size_t(y) * picture->stride_bytes,
                        row * sizeof(std::uint16_t));
        clear(frame->color);
        // Depth is computed after the transfer, so it arrives about one frame late.
        const TimePoint arrived =
            host_time(device_.system_ns(image), host_now(time_.now()), settings_.period());
        frame->times = {};
        frame->times.captured = clock_.captured(device_.device_time(image), arrived);
        return frame;
    }

    FramePointer read_color(const ImagePtr& image) {
        const std::optional<ByteView> jpeg = device_.jpeg_picture(image, settings_.color);
        if (!jpeg) {
            note_damage("a colour picture is damaged and left out");
            return nullptr;
        }
        FramePointer frame = pool_.take();
        clear(frame->color);
        frame->color.jpeg.assign(jpeg->begin(), jpeg->end());
        frame->color.size = settings_.color;
        return frame;
    }

    static void clear(ColorData& color) {
        color.size = {};
        color.pixels.pixels.clear();
        color.jpeg.clear();
    }

    FramePointer take_paired() {
        if (paired_)
            return std::exchange(paired_, nullptr);
        auto pair = pairing_.take();
        if (!pair)
            return nullptr;
        if (pair->color)
            std::swap(pair->depth.payload->color, pair->color->payload->color);
        return std::move(pair->depth.payload);
    }

    Capture deliver(const FramePointer& frame) {
        frame->number = number_++;
        frame->times.delivered = time_.now();
        waited_ = {};
        damaged_ = false;
        return {.kind = Capture::Kind::frame, .frame = frame, .problem = {}};
    }

    // The reason why the camera counts as gone, as the end of a sentence, or empty.
    std::string silence() {
        const bool begun = number_ > 0;
        const Duration limit = begun ? patience_.between : patience_.to_begin;
        if (waited_ <= limit)
            return {};
        const std::string seconds = std::to_string(limit / 1s) + " seconds";
        if (damaged_)
            return "has sent only damaged pictures for " + seconds;
        // A subordinate has no pictures until the master is started.
        if (!begun && settings_.configuration.sync == SyncRole::subordinate) {
            if (!std::exchange(waiting_noted_, true))
                log::warning("capture", "the camera waits for its master, which must be started",
                             {{"camera", info_.name}});
            return {};
        }
        return "has sent no depth picture for " + seconds;
    }

    Capture fail(const std::string& how) {
        over_ = {.kind = Capture::Kind::failed,
                 .frame = {},
                 .problem = "The camera '" + settings_.name() + "' (" + info_.name + ") " + how +
                            "; check its USB cable and power supply, then start it again."};
        return *over_;
    }

    void note_damage(std::string_view what) {
        damaged_ = true;
        if (!std::exchange(damage_noted_, true))
            log::warning("capture", what, {{"camera", info_.name}});
    }

    Settings settings_;
    Patience patience_;
    const Clock time_;
    OpenDevice device_;
    CameraInfo info_;
    FramePool pool_;
    TimePairing<FramePointer> pairing_;
    FramePointer paired_;  // by the library, not yet returned
    DeviceClock clock_;
    FrameNumber number_ = 0;
    Duration waited_{};     // in next(), since the last frame
    bool damaged_ = false;  // a picture, since the last frame
    bool damage_noted_ = false;
    bool waiting_noted_ = false;
    std::optional<Capture> over_;
};

}  // namespace

std::unique_ptr<Camera> start_camera(const Library& library, const Settings& settings,
                                     const Patience& patience, Clock clock) {
    return std::make_unique<K4aCamera>(library, settings, patience, std::move(clock));
}

}  // namespace k4a

std::unique_ptr<Camera> open_k4a_camera(Options& options, const Progress&) {
    const k4a::Settings settings = k4a::take_settings(options);
    return k4a::start_camera(k4a::load_library(), settings, {});
}

}  // namespace theatron::capture

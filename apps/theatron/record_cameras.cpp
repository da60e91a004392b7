// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>

#include "base/error.h"
#include "base/steady_clock.h"
#include "record_source.h"
#include "send/camera_lane.h"

namespace theatron::app {
namespace {

// A camera that gives no picture for so long keeps the others waiting no more.
constexpr Duration first_frame_patience = std::chrono::seconds(5);
// An encoder may still have the last frame of a camera that has ended.
constexpr Duration encoding_patience = std::chrono::milliseconds(500);

// A recording wants every frame: half a second of them may wait for the encoder.
constexpr std::size_t waiting_frames = 15;

constexpr SettingId depth_setting{1}, color_setting{2};

record::RecordedCamera describe(CameraId id, const capture::CameraInfo& info,
                                const RecordCodecs& codecs) {
    record::RecordedCamera camera;
    camera.id = id;
    camera.name = info.name;
    camera.frames_per_second = info.frames_per_second;
    camera.calibration = encode_calibration(info.calibration);
    const auto [depth, color] = std::pair(info.calibration.depth.size, info.calibration.color.size);
    camera.depth = {codecs.depth, depth.width, depth.height};
    if (color != Size{})
        camera.color = record::RecordedStream{codecs.color, color.width, color.height};
    return camera;
}

class CameraRecording final : public RecordSource {
public:
    CameraRecording(const std::vector<std::string>& specifications, const std::string& file,
                    const RecordCodecs& codecs, const capture::Progress& progress)
        : codecs_(codecs) {
        std::vector<std::unique_ptr<capture::Camera>> cameras;
        std::vector<record::RecordedCamera> descriptions;
        for (const std::string& specification : specifications) {
            cameras.push_back(capture::open_camera(specification, progress));
            descriptions.push_back(
                describe(CameraId(descriptions.size()), cameras.back()->info(), codecs));
        }
        recorder_ = std::make_unique<record::Recorder>(file, descriptions,
                                                       record::ClockPair{steady_now(), utc_now()});
        opened_ = steady_now();
        double fps = 1;
        for (const auto& camera : cameras)
            fps = std::max(fps, camera->info().frames_per_second);
        const auto moments = std::make_shared<send::SharedMoments>(fps);
        for (auto& camera : cameras) {
            send::CameraLane::Events events;
            events.media = [this](send::EncodedMedia media) {
                (void)recorder_->add(media.header, std::move(media.message), steady_now());
            };
            events.state = [this](wire::CameraState state) { on_state(std::move(state)); };
            send::CameraLane::Options options;
            options.waiting_frames = waiting_frames;
            options.moments = moments;
            lanes_.push_back(std::make_unique<send::CameraLane>(
                CameraId(lanes_.size()), std::move(camera), events, workers_, std::move(options)));
        }
    }

    ~CameraRecording() override { lanes_.clear(); }

    void tick() override {
        if (begun_)
            return;
        const bool all_there = std::all_of(lanes_.begin(), lanes_.end(), [](const auto& lane) {
            return lane->figures().frames > 0;
        });
        if (!all_there && steady_now() - opened_ < first_frame_patience)
            return;
        begun_ = true;
        for (const auto& lane : lanes_) {
            const send::LaneFigures figures = lane->figures();
            dropped_before_ += figures.dropped_newest;
            lane->set_settings({{depth_setting, codecs_.depth}}, {{color_setting, codecs_.color}});
        }
    }

    record::Recorder* recorder() override { return begun_ ? recorder_.get() : nullptr; }

    bool ended(std::string& remark) override {
        const std::lock_guard lock(mutex_);
        if (over_ < lanes_.size() || steady_now() - over_since_ < encoding_patience)
            return false;
        remark = problem_;
        return true;
    }

    std::uint64_t lost() const override {
        std::uint64_t dropped = 0;
        for (const auto& lane : lanes_)
            dropped += lane->figures().dropped_newest;
        return dropped - dropped_before_;
    }

    void stop() override {
        for (const auto& lane : lanes_)
            lane->set_settings({}, {});
    }

private:
    void on_state(wire::CameraState state) {
        using Condition = wire::CameraCondition;
        if (state.condition == Condition::live || state.condition == Condition::stale)
            return;
        const std::lock_guard lock(mutex_);
        ++over_;
        over_since_ = steady_now();
        if (state.condition == Condition::failed)
            problem_ = state.problem;
    }

    const RecordCodecs codecs_;
    std::unique_ptr<record::Recorder> recorder_;
    TimePoint opened_;
    bool begun_ = false;
    std::uint64_t dropped_before_ = 0;

    std::mutex mutex_;      // guards all below
    std::size_t over_ = 0;  // cameras that have ended or failed
    TimePoint over_since_;
    std::string problem_;

    send::Workers workers_;
    // Last: their threads use all of the above.
    std::vector<std::unique_ptr<send::CameraLane>> lanes_;
};

}  // namespace

std::unique_ptr<RecordSource> record_cameras(const std::vector<std::string>& specifications,
                                             const std::string& file, const RecordCodecs& codecs,
                                             const capture::Progress& progress) {
    return std::make_unique<CameraRecording>(specifications, file, codecs, progress);
}

}  // namespace theatron::app

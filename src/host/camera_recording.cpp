// SPDX-License-Identifier: Apache-2.0
#include "host/camera_recording.h"

#include <algorithm>
#include <set>

#include "base/error.h"
#include "base/log.h"
#include "send/camera_lane.h"

namespace theatron::host {
namespace {

// A camera that gives no picture for this time keeps the others waiting no more.
constexpr Duration first_frame_patience = std::chrono::seconds(5);
// At the end: for the last pictures of the cameras, which are still being encoded.
constexpr Duration encoding_patience = std::chrono::milliseconds(1500);
constexpr Duration file_patience = std::chrono::seconds(20);

// A recording wants every frame: half a second of them may wait for the encoder.
constexpr std::size_t waiting_frames = 15;

constexpr SettingId depth_setting{1}, color_setting{2};

record::RecordedCamera describe(CameraId id, const capture::CameraInfo& info,
                                const record::RecordCodecs& codecs) {
    record::RecordedCamera camera;
    camera.id = id;
    camera.name = info.name;
    camera.frames_per_second = info.frames_per_second;
    camera.calibration = encode_calibration(without_person(info.calibration));
    const auto [depth, color] = std::pair(info.calibration.depth.size, info.calibration.color.size);
    camera.depth = {codecs.depth, depth.width, depth.height};
    if (color != Size{})
        camera.color = record::RecordedStream{codecs.color, color.width, color.height};
    return camera;
}

class CameraRecording final : public record::RecordSource {
public:
    CameraRecording(const std::vector<std::string>& specifications, const std::string& file,
                    const record::RecordCodecs& codecs, const record::Recorder::Options& recorder,
                    const capture::Progress& progress)
        : codecs_(codecs), intake_(file, recorder) {
        std::vector<std::unique_ptr<capture::Camera>> cameras;
        double fps = 1;
        for (const std::string& specification : specifications) {
            cameras.push_back(capture::open_camera(specification, progress));
            fps = std::max(fps, cameras.back()->info().frames_per_second);
            names_.push_back(cameras.back()->info().name);
        }
        opened_ = steady_now();
        const auto moments = std::make_shared<send::SharedMoments>(fps);
        for (std::size_t i = 0; i < cameras.size(); ++i) {
            send::CameraLane::Events events;
            events.media = [this](send::EncodedMedia media) { on_media(std::move(media)); };
            events.state = [this](wire::CameraState state) { on_state(state); };
            send::CameraLane::Options options;
            options.waiting_frames = waiting_frames;
            options.every_frame = true;
            options.moments = moments;
            options.open_again = [specification = specifications[i]] {
                return capture::open_camera(specification);
            };
            lanes_.push_back(std::make_unique<send::CameraLane>(
                CameraId(i), std::move(cameras[i]), events, workers_, std::move(options)));
        }
        plays_only_ = std::all_of(lanes_.begin(), lanes_.end(),
                                  [](const auto& lane) { return lane->waits(); });
        not_encoded_before_.resize(lanes_.size());
        not_encoded_at_end_.resize(lanes_.size());
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
        std::vector<record::RecordedCamera> cameras;
        std::map<StreamId, SettingId> settings;
        for (const auto& lane : lanes_) {
            cameras.push_back(describe(lane->id(), lane->info(), codecs_));
            settings[depth_stream(lane->id())] = depth_setting;
            settings[color_stream(lane->id())] = color_setting;
        }
        intake_.describe(std::move(cameras), std::move(settings), true, steady_now());
        for (std::size_t i = 0; i < lanes_.size(); ++i) {
            not_encoded_before_[i] = lanes_[i]->figures().dropped_newest;
            lanes_[i]->set_settings({{depth_setting, codecs_.depth}},
                                    {{color_setting, codecs_.color}});
            lanes_[i]->hold(false);
        }
        const std::lock_guard lock(mutex_);
        for (const CameraId camera : ended_)
            intake_.on_end(camera);
    }

    record::Intake& intake() override { return intake_; }
    // Where all cameras wait for the work on their pictures, time passes with the pictures: however
    // late they are, they keep the distances that they have in their files.
    record::Intake::Now now() const override {
        const std::lock_guard lock(mutex_);
        return {steady_now(), {plays_only_ && played_ ? *played_ : steady_now(), utc_now()}};
    }

    std::optional<End> ended() override {
        const std::lock_guard lock(mutex_);
        // A file's last pictures are waited for as the others were.
        const bool has_work = std::any_of(lanes_.begin(), lanes_.end(), [](const auto& lane) {
            return lane->waits() && lane->wait_until_encoded(Duration(0)) > 0;
        });
        if (ended_.size() + failed_.size() < lanes_.size() || (begun_ && has_work))
            return std::nullopt;
        const bool is_fault = !failed_.empty() || ended_with_problem_;
        return End{"", is_fault ? std::optional(record::Lack::camera_failed) : std::nullopt};
    }

    std::uint64_t not_encoded(CameraId camera) const override {
        const auto i = std::size_t(camera);
        return begun_ ? lanes_[i]->figures().dropped_newest - not_encoded_before_[i] +
                            not_encoded_at_end_[i]
                      : 0;
    }

    std::uint64_t lost_in_source(CameraId camera) const override {
        const send::LaneFigures figures = lanes_[std::size_t(camera)]->figures();
        return figures.camera.lost_pictures + figures.damaged_colors;
    }

    bool was_gone(CameraId camera) const override {
        const std::lock_guard lock(mutex_);
        return failed_.contains(camera) ||
               lanes_[std::size_t(camera)]
                       ->figures()
                       .camera.figures.troubles[int(capture::Trouble::gone)] > 0;
    }

    // All that the cameras have given is encoded first, so that the last depth has its colour.
    void stop() override {
        for (const auto& lane : lanes_)
            lane->close();
        const TimePoint until = steady_now() + encoding_patience;
        for (const auto& lane : lanes_)
            (void)lane->wait_until_encoded(std::max(until - steady_now(), Duration(0)));
        // Those of a file are as many as may wait, also where the machine is slow.
        const TimePoint latest = steady_now() + file_patience;
        for (const auto& lane : lanes_)
            if (begun_ && lane->waits())
                (void)lane->wait_until_encoded(std::max(latest - steady_now(), Duration(0)));
        const std::lock_guard lock(media_mutex_);
        stopped_ = true;
        for (std::size_t i = 0; i < lanes_.size(); ++i) {
            if (begun_)
                not_encoded_at_end_[i] = lanes_[i]->wait_until_encoded(Duration(0));
            lanes_[i]->set_settings({}, {});
        }
    }

private:
    // On working threads.
    void on_media(send::EncodedMedia media) {
        const wire::MediaHeader header = media.header;
        const std::lock_guard lock(media_mutex_);
        if (stopped_)
            return;
        {
            const std::lock_guard played(mutex_);
            played_ = std::max(played_.value_or(header.captured), header.captured);
        }
        if (intake_.take(header, std::move(media.message), "", now()))
            lanes_[std::size_t(camera_of(header.stream))]->request_key(header.stream,
                                                                       header.setting);
    }

    // On the workers' looking thread.
    void on_state(const wire::CameraState& state) {
        using Condition = wire::CameraCondition;
        const std::lock_guard lock(mutex_);
        const std::string camera = "Camera " + names_[std::size_t(state.camera)];
        const std::string problem = wire::english(state.problem);
        Condition& before = conditions_[state.camera];
        const bool plays_damage = !state.problem.empty() && (state.condition == Condition::live ||
                                                             state.condition == Condition::ended);
        if (plays_damage && (damage_said_.insert(state.camera).second || state.condition != before))
            log::say(camera + ": " + problem);
        if (state.condition == before)
            return;
        before = state.condition;
        if (state.condition == Condition::stale) {
            log::say(camera + " stands still. " + problem);
        } else if (state.condition == Condition::live) {
            log::say(camera + " is live again.");
        } else if (state.condition == Condition::failed) {
            log::say(camera + " has failed: " + problem);
            failed_.insert(state.camera);
        } else {
            ended_.insert(state.camera);
            ended_with_problem_ = ended_with_problem_ || !problem.empty();
            intake_.on_end(state.camera);
        }
    }

    const record::RecordCodecs codecs_;
    record::Intake intake_;
    std::vector<std::string> names_;
    TimePoint opened_;
    std::atomic<bool> begun_ = false;
    bool plays_only_ = false;
    std::vector<std::uint64_t> not_encoded_before_, not_encoded_at_end_;

    std::mutex media_mutex_;
    bool stopped_ = false;  // what is encoded from now on counts as missing

    mutable std::mutex mutex_;  // guards all up to the workers
    std::map<CameraId, wire::CameraCondition> conditions_;
    std::set<CameraId> ended_, failed_, damage_said_;
    bool ended_with_problem_ = false;
    std::optional<TimePoint> played_;  // capture of the newest picture

    send::Workers workers_;
    // Last: their threads use all of the above.
    std::vector<std::unique_ptr<send::CameraLane>> lanes_;
};

}  // namespace

std::unique_ptr<record::RecordSource> record_cameras(const std::vector<std::string>& specifications,
                                                     const std::string& file,
                                                     const record::RecordCodecs& codecs,
                                                     const record::Recorder::Options& options,
                                                     const capture::Progress& progress) {
    return std::make_unique<CameraRecording>(specifications, file, codecs, options, progress);
}

}  // namespace theatron::host

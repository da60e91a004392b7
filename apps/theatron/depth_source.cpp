// SPDX-License-Identifier: Apache-2.0
#include "depth_source.h"

#include <set>

#include "base/error.h"
#include "base/log.h"
#include "base/steady_clock.h"
#include "client/participant.h"

namespace theatron::app {
namespace {

void check_cameras(const std::vector<DepthSource::Camera>& cameras) {
    std::set<std::string> names;
    for (const DepthSource::Camera& camera : cameras)
        if (!names.insert(camera.name).second)
            throw Error("Two cameras are called '" + camera.name +
                        "'; the file of places tells cameras apart by their names.");
    if (cameras.size() < 2)
        throw Error(
            "Cameras are registered to each other: give at least two with --camera, or the link of "
            "a session that has two.");
}

class OwnCameras final : public DepthSource {
public:
    OwnCameras(const std::vector<std::string>& specifications, const capture::Progress& progress) {
        for (const std::string& specification : specifications) {
            open_.push_back({capture::open_camera(specification, progress)});
            const capture::CameraInfo& info = open_.back().camera->info();
            cameras_.push_back({info.name, info.calibration, ""});
        }
        check_cameras(cameras_);
    }

    bool next(const Sink& sink) override {
        using Kind = capture::Capture::Kind;
        bool more = false;
        for (std::size_t c = 0; c < open_.size(); ++c) {
            if (open_[c].ended)
                continue;
            const capture::Capture got = open_[c].camera->next(std::chrono::milliseconds(5));
            if (got.kind == Kind::failed)
                throw Error(got.problem);
            open_[c].ended = got.kind == Kind::end;
            more = more || !open_[c].ended;
            if (got.kind == Kind::frame &&
                got.frame->depth.size == cameras_[c].calibration.depth.size)
                sink(c, got.frame->depth.view(), got.frame->times.captured);
        }
        return more;
    }

private:
    struct Open {
        std::unique_ptr<capture::Camera> camera;
        bool ended = false;
    };
    std::vector<Open> open_;
};

class SessionCameras final : public DepthSource {
public:
    explicit SessionCameras(const net::Link& link) {
        client::Participant::Options options;
        options.link = link;
        options.name = "registration";
        // Exact depth of every picture, however long it takes.
        options.depth_codec = "strata";
        options.delivery = {};
        options.remark = [](const std::string& text) { log::say(text); };
        participant_ = std::make_unique<client::Participant>(options);
        wait_for_cameras();
        check_cameras(cameras_);
    }

    bool next(const Sink& sink) override {
        participant_->wait_for_frame(20ms);
        const client::Participant::Status status = participant_->status();
        using Phase = client::Participant::Phase;
        if (status.phase == Phase::refused)
            throw Error(status.problem);
        if (status.phase == Phase::ended)
            return false;
        std::uint64_t generation = 0;
        const auto now = participant_->cameras(generation);
        if (generation != generation_ && !is_same(now))
            throw Error("The session's cameras have changed meanwhile; begin again.");
        generation_ = generation;
        bool more = false;
        for (std::size_t c = 0; c < now.size(); ++c) {
            cameras_[c].filter = now[c].state.filter;
            more = more || now[c].state.condition != wire::CameraCondition::ended;
        }
        for (const receive::CameraFramePtr& frame : participant_->take_frames())
            for (std::size_t c = 0; c < ids_.size(); ++c)
                if (ids_[c] == frame->camera &&
                    frame->depth.size == cameras_[c].calibration.depth.size)
                    sink(c, frame->depth.view(), frame->times.captured);
        return more;
    }

private:
    void wait_for_cameras() {
        constexpr Duration patience = std::chrono::seconds(15);
        const TimePoint begin = steady_now();
        while (true) {
            (void)participant_->wait_for_frame(50ms);
            const client::Participant::Status status = participant_->status();
            if (status.phase == client::Participant::Phase::refused)
                throw Error(status.problem);
            const auto cameras = participant_->cameras(generation_);
            if (status.phase == client::Participant::Phase::joined && !cameras.empty()) {
                for (const client::Participant::Camera& camera : cameras) {
                    ids_.push_back(camera.description.id);
                    cameras_.push_back(
                        {camera.description.name, camera.calibration, camera.state.filter});
                }
                return;
            }
            if (steady_now() - begin > patience)
                throw Error(status.problem.empty() ? "The session has no cameras."
                                                   : status.problem);
        }
    }

    // A registration is of these cameras with these lenses; their conditions may change.
    bool is_same(const std::vector<client::Participant::Camera>& now) const {
        if (now.size() != ids_.size())
            return false;
        for (std::size_t c = 0; c < ids_.size(); ++c)
            if (now[c].description.id != ids_[c] || now[c].description.name != cameras_[c].name ||
                !(now[c].calibration.depth == cameras_[c].calibration.depth))
                return false;
        return true;
    }

    std::vector<CameraId> ids_;
    std::uint64_t generation_ = 0;
    std::unique_ptr<client::Participant> participant_;
};

}  // namespace

std::unique_ptr<DepthSource> open_cameras(const std::vector<std::string>& specifications,
                                          const capture::Progress& progress) {
    return std::make_unique<OwnCameras>(specifications, progress);
}

std::unique_ptr<DepthSource> join_for_depth(const net::Link& link) {
    return std::make_unique<SessionCameras>(link);
}

}  // namespace theatron::app

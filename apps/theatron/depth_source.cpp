// SPDX-License-Identifier: Apache-2.0
#include "depth_source.h"

#include <algorithm>

#include "base/error.h"
#include "base/log.h"
#include "base/steady_clock.h"
#include "client/participant.h"
#include "geometry/screen.h"

namespace theatron::app {
namespace {

// Goes through the cameras there are, and keeps those of a choice.
class Chooser {
public:
    explicit Chooser(const WantedCameras& choice) : choice_(choice) {}

    bool takes(const std::string& name, const Calibration& calibration, bool is_in_room) {
        const auto& only = choice_.only;
        there_ += (there_.empty() ? "'" : ", '") + name + "'";
        if (!only.empty() && std::find(only.begin(), only.end(), name) == only.end())
            return false;
        const char* reason = nullptr;
        if (!is_in_room || calibration.person != 0)
            reason = "it moves with a person";
        else if (is_screen(calibration))
            reason = "it is a screen";
        else if (calibration.depth.size.area() == 0)
            reason = "it has no depth";
        else if (choice_.known && !choice_.known->contains(name))
            reason = "the file of places does not have it";
        if (reason) {
            log::say("'" + name + "' is left out: " + reason + ".");
            return false;
        }
        if (!taken_.insert(name).second)
            throw Error("Two cameras are called '" + name +
                        "'; the file of places tells cameras apart by their names.");
        return true;
    }

    // After all cameras.
    void check() const {
        for (const std::string& name : choice_.only)
            if (!taken_.contains(name))
                throw Error("No camera to be registered is called '" + name + "'; there are " +
                            there_ + ".");
        if (taken_.size() >= 2)
            return;
        if (choice_.known)
            throw Error(
                "Surfaces are compared between cameras, and fewer than two of these are in the "
                "file of places; register them with the board.");
        throw Error(
            "Cameras are registered to each other: give at least two with --camera, or the link of "
            "a session that has two.");
    }

private:
    const WantedCameras& choice_;
    std::set<std::string> taken_;
    std::string there_;  // for people
};

class OwnCameras final : public DepthSource {
public:
    OwnCameras(const std::vector<std::string>& specifications, const WantedCameras& choice,
               const capture::Progress& progress) {
        Chooser chooser(choice);
        for (const std::string& specification : specifications) {
            Open open{capture::open_camera(specification, progress)};
            const capture::CameraInfo& info = open.camera->info();
            if (!chooser.takes(info.name, info.calibration, true))
                continue;
            cameras_.push_back({info.name, info.calibration, ""});
            open_.push_back(std::move(open));
        }
        chooser.check();
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
    SessionCameras(const net::Link& link, const WantedCameras& choice) {
        client::Participant::Options options;
        options.link = link;
        options.name = "registration";
        // Exact depth of every picture, however long it takes.
        options.depth_codec = "strata";
        options.delivery = {};
        options.remark = [](const std::string& text) { log::say(text); };
        participant_ = std::make_unique<client::Participant>(options);
        wait_for_cameras(choice);
    }

    bool next(const Sink& sink) override {
        participant_->wait_for_frame(20ms);
        const client::Participant::Status status = participant_->status();
        using Phase = client::Participant::Phase;
        if (status.phase == Phase::refused)
            throw Error(status.problem);
        if (status.phase == Phase::ended)
            return false;
        if (status.phase != Phase::joined)
            return true;
        std::uint64_t generation = 0;
        const auto now = participant_->cameras(generation);
        bool more = false;
        for (std::size_t c = 0; c < ids_.size(); ++c) {
            const auto found = std::find_if(now.begin(), now.end(), [&](const auto& camera) {
                return camera.description.id == ids_[c];
            });
            if (found == now.end() || !is_same(*found, cameras_[c]))
                throw Error("The camera '" + cameras_[c].name +
                            "' has left the session or has changed meanwhile; begin again.");
            cameras_[c].filter = found->state.filter;
            more = more || found->state.condition != wire::CameraCondition::ended;
        }
        for (const receive::CameraFramePtr& frame : participant_->take_frames())
            for (std::size_t c = 0; c < ids_.size(); ++c)
                if (ids_[c] == frame->camera &&
                    frame->depth.size == cameras_[c].calibration.depth.size)
                    sink(c, frame->depth.view(), frame->times.captured);
        return more;
    }

private:
    void wait_for_cameras(const WantedCameras& choice) {
        constexpr Duration patience = std::chrono::seconds(15);
        const TimePoint begin = steady_now();
        while (true) {
            (void)participant_->wait_for_frame(50ms);
            const client::Participant::Status status = participant_->status();
            if (status.phase == client::Participant::Phase::refused)
                throw Error(status.problem);
            std::uint64_t generation = 0;
            const auto cameras = participant_->cameras(generation);
            if (status.phase == client::Participant::Phase::joined && !cameras.empty()) {
                Chooser chooser(choice);
                for (const client::Participant::Camera& camera : cameras) {
                    if (!chooser.takes(camera.description.name, camera.calibration,
                                       camera.description.kind == wire::CameraKind::room))
                        continue;
                    ids_.push_back(camera.description.id);
                    cameras_.push_back(
                        {camera.description.name, camera.calibration, camera.state.filter});
                }
                chooser.check();
                return;
            }
            if (steady_now() - begin > patience)
                throw Error(status.problem.empty() ? "The session has no cameras."
                                                   : status.problem);
        }
    }

    // A registration is of these cameras with these lenses; their conditions may change.
    static bool is_same(const client::Participant::Camera& now, const Camera& before) {
        return now.description.name == before.name &&
               now.calibration.depth == before.calibration.depth;
    }

    std::vector<CameraId> ids_;
    std::unique_ptr<client::Participant> participant_;
};

}  // namespace

std::unique_ptr<DepthSource> open_cameras(const std::vector<std::string>& specifications,
                                          const WantedCameras& choice,
                                          const capture::Progress& progress) {
    return std::make_unique<OwnCameras>(specifications, choice, progress);
}

std::unique_ptr<DepthSource> join_for_depth(const net::Link& link, const WantedCameras& choice) {
    return std::make_unique<SessionCameras>(link, choice);
}

}  // namespace theatron::app

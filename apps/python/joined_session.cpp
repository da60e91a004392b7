// SPDX-License-Identifier: Apache-2.0
#include "joined_session.h"

#include "base/error.h"
#include "video/color_codec.h"
#include "video/depth_codecs.h"

namespace theatron::python {
namespace {

using Phase = client::Participant::Phase;

constexpr Duration patience = std::chrono::milliseconds(100);

void require(const std::string& problem) {
    if (!problem.empty())
        throw Error(problem);
}

client::Participant::Options options_of(const JoinedSession::Options& given) {
    client::Participant::Options options;
    options.name = given.name;
    const auto depth = video::parse_depth_setting(given.depth_codec);
    require(depth.problem);
    require(video::missing_depth_decoder(depth.setting));
    options.depth_codec = depth.setting.text;
    if (given.color_codec != video::auto_color) {
        const auto color = video::parse_color_setting(given.color_codec);
        require(color.problem);
        require(video::missing_color_decoder(color.setting));
    }
    options.color_codec = given.color_codec;
    options.link = net::parse_link(given.link);
    return options;
}

class SessionReader final : public FrameReader {
public:
    explicit SessionReader(std::weak_ptr<JoinedSession> session) : session_(std::move(session)) {}

    Answer next(TakenFrame& out) override {
        const std::shared_ptr<JoinedSession> session = session_.lock();
        return session ? session->next(out) : Answer::end;
    }
    void seek(Duration) override {
        throw Error("A session is live; record it with 'theatron record', and open the recording.");
    }
    capture::PictureLosses losses() const override { return {}; }

private:
    const std::weak_ptr<JoinedSession> session_;
};

}  // namespace

JoinedSession::JoinedSession(const Options& options) : participant_(options_of(options)) {}

bool JoinedSession::is_joined() {
    const client::Participant::Status status = participant_.status();
    if (status.phase == Phase::refused || status.phase == Phase::ended)
        throw Error(status.problem.empty() ? "The session has ended." : status.problem);
    if (status.phase == Phase::joined && status.clock_known)
        return true;
    participant_.wait_for_frame(patience);
    return false;
}

std::vector<std::shared_ptr<const CameraView>> JoinedSession::cameras() {
    const std::lock_guard lock(mutex_);
    note_cameras();
    std::vector<std::shared_ptr<const CameraView>> cameras;
    for (const auto& [id, view] : views_)
        cameras.push_back(view);
    return cameras;
}

void JoinedSession::note_cameras() {
    const std::uint64_t before = generation_;
    const auto cameras = participant_.cameras(generation_);
    if (generation_ == before)
        return;
    std::map<CameraId, std::shared_ptr<const CameraView>> views;
    for (const client::Participant::Camera& camera : cameras) {
        const CameraId id = camera.description.id;
        const auto old = views_.find(id);
        const bool is_same = old != views_.end() &&
                             old->second->calibration() == camera.calibration &&
                             old->second->name() == camera.description.name;
        views[id] = is_same ? old->second
                            : std::make_shared<const CameraView>(int(id), camera.description.name,
                                                                 camera.calibration);
    }
    views_ = std::move(views);
}

FrameReader::Answer JoinedSession::next(TakenFrame& out) {
    const std::lock_guard lock(mutex_);
    if (waiting_.empty()) {
        participant_.wait_for_frame(patience);
        for (receive::CameraFramePtr& frame : participant_.take_frames())
            waiting_.push_back(std::move(frame));
    }
    note_cameras();
    while (!waiting_.empty()) {
        const receive::CameraFramePtr frame = std::move(waiting_.front());
        waiting_.pop_front();
        const auto view = views_.find(frame->camera);
        // Its camera has left, or has another lens now.
        if (view == views_.end() || view->second->calibration().depth.size != frame->depth.size)
            continue;
        out = taken(*frame);
        return FrameReader::Answer::frame;
    }
    const client::Participant::Status status = participant_.status();
    if (status.phase == Phase::refused)
        throw Error(status.problem);
    return status.phase == Phase::ended ? FrameReader::Answer::end : FrameReader::Answer::nothing;
}

// Others have the frame, too, so it is copied.
TakenFrame JoinedSession::taken(const receive::CameraFrame& frame) {
    std::shared_ptr<Frame> copy = pool_.take();
    copy->number = frame.number;
    copy->times = frame.times;
    copy->depth = frame.depth;
    copy->color.jpeg.clear();
    if (frame.color)
        copy->color.pixels = *frame.color;
    else
        copy->color.pixels.resize({});
    copy->color.size = copy->color.pixels.size;
    if (!first_)
        first_ = frame.times.captured;
    return {.camera = views_.at(frame.camera),
            .frame = std::move(copy),
            .is_own = true,
            .seconds = to_seconds(frame.times.captured - *first_),
            .moment_us = to_us(frame.moment),
            .utc = utc_now() - (participant_.now() - frame.times.captured)};
}

std::unique_ptr<FrameReader> read_session(std::weak_ptr<JoinedSession> session) {
    return std::make_unique<SessionReader>(std::move(session));
}

}  // namespace theatron::python

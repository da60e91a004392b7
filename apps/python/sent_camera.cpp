// SPDX-License-Identifier: Apache-2.0
#include "sent_camera.h"

#include "base/error.h"
#include "base/steady_clock.h"

namespace theatron::python {
namespace {

using Phase = client::Participant::Phase;

std::vector<std::unique_ptr<capture::Camera>> one_camera(
    std::shared_ptr<capture::PushedFrames> frames) {
    std::vector<std::unique_ptr<capture::Camera>> cameras;
    cameras.push_back(capture::make_pushed_camera(std::move(frames)));
    return cameras;
}

client::Participant::Options options_of(const SentCamera::Options& given,
                                        publish::CameraPublisher& publisher) {
    client::Participant::Options options;
    options.link = net::parse_link(given.link);
    options.name = given.person;
    options.sends_only = true;
    options.publishing = publisher.events();
    return options;
}

}  // namespace

SentCamera::SentCamera(const Options& options)
    : frames_(std::make_shared<capture::PushedFrames>(options.info)),
      publisher_(one_camera(frames_), {.may_record = options.may_record}),
      participant_(options_of(options, publisher_)),
      publishing_(publisher_, participant_) {}

SentCamera::~SentCamera() {
    frames_->end();
}

void SentCamera::require_session() const {
    const client::Participant::Status status = participant_.status();
    if (!status.publish_problem.empty())
        throw Error(status.publish_problem);
    if (status.phase == Phase::refused || status.phase == Phase::ended)
        throw Error(status.problem.empty() ? "The session has ended." : status.problem);
    if (publisher_.has_ended())
        throw Error("Somebody has ended the share of this camera.");
}

bool SentCamera::is_in_session() {
    require_session();
    if (publisher_.figures().front().number)
        return true;
    participant_.wait_for_frame(std::chrono::milliseconds(100));
    return false;
}

void SentCamera::send(std::shared_ptr<Frame> frame, Duration age) {
    require_session();
    if (const std::string problem = frames_->push(std::move(frame), steady_now() - age);
        !problem.empty())
        throw Error(problem);
}

bool SentCamera::is_wanted() const {
    return !publisher_.figures().front().lane.encoders.empty();
}

std::uint64_t SentCamera::taken() const {
    return publisher_.figures().front().lane.frames;
}

}  // namespace theatron::python

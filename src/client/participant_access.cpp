// SPDX-License-Identifier: Apache-2.0
// The calls of other threads: facts, frames and figures of a participant, and its wishes.
#include <utility>

#include "base/steady_clock.h"
#include "client/participant_figures.h"
#include "client/participant_shared.h"

namespace theatron::client {

Participant::Status Participant::status() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->status;
}

std::vector<Participant::Camera> Participant::cameras(std::uint64_t& generation) const {
    const std::lock_guard lock(shared_->mutex);
    generation = shared_->generation;
    return shared_->cameras;
}

std::vector<wire::StreamSetting> Participant::settings() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->settings;
}

std::vector<receive::CameraFramePtr> Participant::take_frames() {
    const std::lock_guard lock(shared_->mutex);
    std::vector<receive::CameraFramePtr> frames;
    for (auto& [camera, frame] : shared_->newest)
        frames.push_back(std::move(frame));
    shared_->newest.clear();
    return frames;
}

void Participant::want_frames() {
    decoders_->want_frames();
}

bool Participant::wait_for_frame(Duration timeout) {
    std::unique_lock lock(shared_->mutex);
    return shared_->changed.wait_for(lock, timeout, [&] { return !shared_->newest.empty(); });
}

std::vector<receive::StreamFigures> Participant::figures() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->status.clock_known ? shared_->figures : without_ages(shared_->figures);
}

MomentFigures Participant::moments() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->moments;
}

void Participant::reset_figures() {
    const std::lock_guard lock(shared_->mutex);
    shared_->reset_wanted = true;
}

TimePoint Participant::now() const {
    return session_time(steady_now());
}

TimePoint Participant::session_time(TimePoint steady) const {
    const std::lock_guard lock(shared_->mutex);
    return steady + shared_->clock.offset();
}

void Participant::choose_codecs(const std::string& depth, const std::string& color) {
    const std::lock_guard lock(shared_->mutex);
    if (!depth.empty())
        shared_->depth_wish = depth;
    if (!color.empty())
        shared_->color_wish = color;
}

void Participant::choose_codecs(CameraId camera, const std::string& depth,
                                const std::string& color) {
    const std::lock_guard lock(shared_->mutex);
    wire::ChooseCodecs& wish = shared_->camera_wishes[camera];
    if (!depth.empty())
        wish.depth_codec = depth;
    if (!color.empty())
        wish.color_codec = color;
}

void Participant::choose_delivery(const wire::ChooseDelivery& goal) {
    const std::lock_guard lock(shared_->mutex);
    shared_->delivery_wish = goal;
    shared_->status.goal = goal;
}

std::optional<wire::SetRenderer> Participant::take_renderer_command() {
    const std::lock_guard lock(shared_->mutex);
    return std::exchange(shared_->renderer_command, std::nullopt);
}

void Participant::tell_renderer(const std::string& renderer) {
    const std::lock_guard lock(shared_->mutex);
    shared_->renderer = renderer;
}

}  // namespace theatron::client

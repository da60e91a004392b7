// SPDX-License-Identifier: Apache-2.0
// The host's cameras as people change them: adjusted, and their recording played.
#include <optional>
#include <utility>

#include "base/log.h"
#include "base/steady_clock.h"
#include "capture/recording_camera.h"
#include "host/host_impl.h"
#include "wire/manage_text.h"

namespace theatron::host {

void Host::adjust(std::size_t camera, const session::CameraAdjustment& adjustment) {
    impl_->server->post([impl = impl_.get(), camera, adjustment] {
        const auto refusal =
            impl->session->adjust(CameraId(camera), adjustment, "host", steady_now());
        if (refusal != wire::ManageRefusal::none)
            log::say(wire::text_of(refusal));
        impl->carry_out();
    });
}

std::vector<session::CameraAdjustment> Host::adjustments() const {
    const std::lock_guard lock(impl_->figures_mutex);
    std::vector<session::CameraAdjustment> all(impl_->lanes.size());
    for (std::size_t i = 0; i < all.size(); ++i)
        if (const auto found = impl_->adjusted_figures.find(CameraId(i));
            found != impl_->adjusted_figures.end())
            all[i] = found->second;
    return all;
}

void Host::play(wire::PlayAction action, Duration position) {
    impl_->server->post([impl = impl_.get(), action, position] {
        impl->carry_out(session::action::Play{action, position, "host"});
        impl->carry_out();
    });
}

std::optional<wire::Playback> Host::playback() const {
    if (!impl_->played)
        return std::nullopt;
    const TimePoint now = steady_now();
    const auto state = impl_->played->transport->state(now);
    return wire::Playback{state.position, now, impl_->played->transport->length(),
                          state.paused || state.at_end, ""};
}

// The watch compares the cameras where they are shown. An operator's word on where a camera is ends
// the alarm of its own motion.
void Host::Impl::carry_out(const session::action::Adjusted& a) {
    const session::CameraStreams* camera = session->streams().cameras().find(a.camera);
    if (!camera || camera->publisher() != session::host_publisher)
        return;
    correct_place(*camera);
    if (a.states_place)
        place_watch->accept_place(std::size_t(camera->description().id));
    crop(*camera);
}

void Host::Impl::crop(const session::CameraStreams& camera) {
    std::optional<capture::Crop> kept;
    if (const auto& region = camera.adjustment().region)
        kept = capture::Crop{region->x, region->y, {region->width, region->height}};
    if (send::CameraLane* lane = lanes.find(std::size_t(camera.description().id)))
        lane->set_crop(kept);
}

void Host::Impl::correct_place(const session::CameraStreams& camera) {
    const auto calibration = decode_calibration(camera.description().calibration);
    if (!calibration)
        return;
    const auto number = std::size_t(camera.description().id);
    place_watch->correct_place(number, calibration->room_from_camera);
    gain_watch->correct_place(number, calibration->room_from_camera);
}

// From the thread of the watch. All at once: each change would begin a segment of recordings.
void Host::Impl::take_gains(const SettledGains::Gains& gains) {
    server->post([this, gains] {
        for (std::size_t i = 0; i < gains.size(); ++i)
            if (gains[i]) {
                session->set_estimated_gain(CameraId(i), *gains[i]);
                log::info("host", "colour gain estimated",
                          {{"camera", int(i)},
                           {"red", gains[i]->x},
                           {"green", gains[i]->y},
                           {"blue", gains[i]->z}});
            }
        carry_out();
    });
}

void Host::Impl::carry_out(const session::action::Play& a) {
    if (!played)
        return;
    const TimePoint now = steady_now();
    switch (a.action) {
        case wire::PlayAction::pause:
            played->transport->pause(now);
            break;
        case wire::PlayAction::resume:
            played->transport->resume(now);
            break;
        case wire::PlayAction::seek:
            played->transport->seek(a.position, now);
            break;
    }
    follow_playback(a.by);
}

// Tells all where the recording is, and where its cameras were then.
void Host::Impl::follow_playback(const std::string& by) {
    if (!played)
        return;
    const TimePoint now = steady_now();
    const capture::Transport::State state = played->transport->state(now);
    const bool is_new = !told_playback || told_playback->changes != state.changes ||
                        told_playback->rounds != state.rounds ||
                        told_playback->at_end != state.at_end;
    if (is_new) {
        told_playback = state;
        session->set_playback(
            {state.position, now, played->transport->length(), state.paused || state.at_end, by});
    }
    const bool has_room = played->recording->room().present;
    for (auto& [id, camera] : played_cameras) {
        const Bytes& now_there =
            capture::calibration_at(played->recording->cameras()[camera.number], state.position);
        const Bytes& shown = *std::exchange(camera.calibration, &now_there);
        if (shown == now_there || !capture::differ_in_place_only(shown, now_there))
            continue;
        const auto calibration = decode_calibration(now_there);
        if (!calibration)
            continue;
        session->set_calibration(
            id, encode_calibration(has_room ? *calibration : without_person(*calibration)));
        correct_place(*session->streams().cameras().find(id));
    }
}

}  // namespace theatron::host

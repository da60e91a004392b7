// SPDX-License-Identifier: Apache-2.0
// Pictures that go from their publisher to their receiver, and not through the host.
#include <algorithm>

#include "base/error.h"
#include "base/log.h"
#include "base/steady_clock.h"
#include "client/participant_shared.h"

namespace theatron::client {

// The participant publishes cameras, so the session's clock is known.
void Participant::listen_for_receivers() {
    if (!options_.direct || direct_sender_ || !session_.has(wire::Feature::direct))
        return;
    const Duration offset = now() - steady_now();
    try {
        direct_sender_ = DirectSender::open({[this](StreamId stream, SettingId setting) {
                                                 const std::lock_guard lock(shared_->mutex);
                                                 shared_->broken.insert({stream, setting});
                                             },
                                             [offset] { return steady_now() + offset; }});
    } catch (const Error& e) {
        log::warning("direct", "pictures go through the host only", {{"why", e.what()}});
    }
    if (direct_sender_)
        shared_->client->send_control(wire::encode(direct_sender_->offer()));
}

// All permissions come from the host, and end with its connection.
void Participant::end_direct() {
    direct_sender_.reset();
    to_host_ = {};
    if (direct_reception_)
        direct_reception_->set_grants({});
    arrivals_.clear();
    const std::lock_guard lock(shared_->mutex);
    shared_->direct_streams.clear();
}

void Participant::on_direct_receivers() {
    if (!direct_sender_)
        return;
    const wire::DirectReceivers& message = session_.direct_receivers();
    direct_sender_->set_receivers(message.receivers);
    to_host_.hold({message.not_to_host.begin(), message.not_to_host.end()});
}

void Participant::on_direct_grants() {
    if (direct_reception_)
        direct_reception_->set_grants(session_.direct_grants());
}

// From the threads of the connections to publishers.
DirectReception::Events Participant::direct_events() {
    DirectReception::Events events;
    events.media = [this](std::uint64_t link, ParticipantId publisher, Bytes& message) {
        const std::lock_guard lock(shared_->mutex);
        if (shared_->client)
            shared_->client->post(
                [this, link, publisher, bytes = std::make_shared<Bytes>(std::move(message))] {
                    on_direct_media(link, publisher, *bytes);
                });
    };
    events.ended = [this](ParticipantId publisher) {
        const std::lock_guard lock(shared_->mutex);
        if (shared_->client)
            shared_->client->post([this, publisher] {
                for (const wire::Camera& camera : session_.cameras())
                    if (camera.publisher == publisher)
                        for (const StreamId stream : {camera.depth_stream, camera.color_stream})
                            arrivals_.end(stream);
            });
    };
    return events;
}

// A publisher sends its own cameras only.
void Participant::on_direct_media(std::uint64_t link, ParticipantId publisher, Bytes& message) {
    const std::size_t size = message.size();
    const auto header = wire::parse_media_header(message);
    const auto is_its_own = [&](const wire::Camera& camera) {
        return camera.publisher == publisher &&
               (camera.depth_stream == header->stream || camera.color_stream == header->stream);
    };
    const auto& cameras = session_.cameras();
    const bool is_wanted = header && session_.joined() &&
                           std::any_of(cameras.begin(), cameras.end(), is_its_own) &&
                           arrivals_.take(*header, session::Way::direct, steady_now());
    if (is_wanted)
        note_moment(*header);
    if (is_wanted && options_.media)
        options_.media(*header, message);
    else if (is_wanted && !decoders_->on_media(message, direct_link | link))
        return;  // on_taken() follows
    direct_reception_->taken(link, size);
}

bool Participant::has_come_directly(ByteView message) {
    if (!arrivals_.is_used())
        return false;
    const auto header = wire::parse_media_header(message);
    return header && !arrivals_.take(*header, session::Way::by_host, steady_now());
}

SettingId Participant::direct_setting(StreamId stream, TimePoint now) const {
    for (const wire::Camera& camera : session_.cameras())
        if (camera.depth_stream == stream || camera.color_stream == stream)
            return arrivals_.direct_setting(
                stream, seconds_to_duration(1 / std::max(camera.frames_per_second, 1.0)), now);
    return {};
}

void Participant::note_direct_streams(TimePoint now) {
    if (!arrivals_.is_used())
        return;
    std::set<StreamId> streams;
    for (const wire::Camera& camera : session_.cameras())
        for (const StreamId stream : {camera.depth_stream, camera.color_stream})
            if (direct_setting(stream, now) != SettingId{})
                streams.insert(stream);
    const std::lock_guard lock(shared_->mutex);
    shared_->direct_streams = std::move(streams);
}

std::set<StreamId> Participant::direct_streams() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->direct_streams;
}

}  // namespace theatron::client

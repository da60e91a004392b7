// SPDX-License-Identifier: Apache-2.0
// Pictures that come from a relay, and not from the host.
#include <algorithm>

#include "base/steady_clock.h"
#include "client/participant_shared.h"

namespace theatron::client {

// All permissions come from the host, and end with its connection.
void Participant::end_relays() {
    if (relay_reception_)
        relay_reception_->set_grants({});
    arrivals_.clear();
    const std::lock_guard lock(shared_->mutex);
    shared_->relayed_streams.clear();
}

void Participant::on_relay_grants() {
    if (relay_reception_)
        relay_reception_->set_grants(session_.relay_grants());
}

// From the threads of the connections to relays.
RelayReception::Events Participant::relay_events() {
    RelayReception::Events events;
    events.media = [this](std::uint64_t link, Bytes& message) {
        const std::lock_guard lock(shared_->mutex);
        if (shared_->client)
            shared_->client->post(
                [this, link, bytes = std::make_shared<Bytes>(std::move(message))] {
                    on_relayed_media(link, *bytes);
                });
    };
    events.ended = [this] {
        const std::lock_guard lock(shared_->mutex);
        if (shared_->client)
            shared_->client->post([this] {
                for (const wire::Camera& camera : session_.cameras())
                    for (const StreamId stream : {camera.depth_stream, camera.color_stream})
                        arrivals_.end(stream);
                next_report_ = steady_now();  // the host is to send again
            });
    };
    return events;
}

void Participant::on_relayed_media(std::uint64_t link, Bytes& message) {
    const std::size_t size = message.size();
    const auto header = wire::parse_media_header(message);
    const auto has_stream = [&](const wire::Camera& camera) {
        return camera.depth_stream == header->stream || camera.color_stream == header->stream;
    };
    const auto& cameras = session_.cameras();
    const bool is_wanted = header && session_.joined() &&
                           std::any_of(cameras.begin(), cameras.end(), has_stream) &&
                           arrivals_.take(*header, session::Way::by_relay, steady_now());
    if (is_wanted)
        note_moment(*header);
    if (is_wanted && options_.media)
        options_.media(*header, message);
    else if (is_wanted && !decoders_->on_media(message, relayed_link | link))
        return;  // on_taken() follows
    relay_reception_->taken(link, size);
}

bool Participant::has_come_by_relay(ByteView message) {
    if (!arrivals_.is_used())
        return false;
    const auto header = wire::parse_media_header(message);
    return header && !arrivals_.take(*header, session::Way::by_host, steady_now());
}

SettingId Participant::relayed_setting(StreamId stream, TimePoint now) const {
    for (const wire::Camera& camera : session_.cameras())
        if (camera.depth_stream == stream || camera.color_stream == stream)
            return arrivals_.relayed_setting(
                stream, seconds_to_duration(1 / std::max(camera.frames_per_second, 1.0)), now);
    return {};
}

void Participant::note_relayed_streams(TimePoint now) {
    if (!arrivals_.is_used())
        return;
    std::set<StreamId> streams;
    for (const wire::Camera& camera : session_.cameras())
        for (const StreamId stream : {camera.depth_stream, camera.color_stream})
            if (relayed_setting(stream, now) != SettingId{})
                streams.insert(stream);
    const std::lock_guard lock(shared_->mutex);
    shared_->relayed_streams = std::move(streams);
}

std::set<StreamId> Participant::relayed_streams() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->relayed_streams;
}

}  // namespace theatron::client

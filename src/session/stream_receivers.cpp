// SPDX-License-Identifier: Apache-2.0
// The receivers of streams: their wishes, their settings, and messages to them.
#include <algorithm>
#include <set>
#include <utility>

#include "session/streams.h"
#include "wire/no_codec.h"

namespace theatron::session {

void Streams::join(ParticipantId id, const CodecWish& wish, bool records, bool takes_faces,
                   bool is_by_relay) {
    StreamReceiver& receiver = receivers_[id];
    receiver.wish = wish;
    receiver.records = records;
    receiver.takes_faces = takes_faces;
    receiver.is_by_relay = is_by_relay;
    receiver.delivery.set_codecs(codecs_, region_is_drawn_);
    receiver.delivery.set_wish(wish.depth, wish.color);
    for (auto& [camera, streams] : cameras_)
        if (receiver.gets(streams, id)) {
            receiver.request(streams, id, true);
            receiver.request(streams, id, false);
        }
    apply();
}

void Streams::set_by_relay(ParticipantId id, bool is_by_relay) {
    if (const auto found = receivers_.find(id); found != receivers_.end())
        found->second.is_by_relay = is_by_relay;
}

void Streams::leave(ParticipantId id) {
    receivers_.erase(id);
    for (auto& [number, camera] : cameras_) {
        camera.receivers.erase(id);
        camera.table(true).leave(id);
        camera.table(false).leave(id);
    }
    apply();
}

void Streams::tell_again(ParticipantId id) {
    if (const auto found = receivers_.find(id); found != receivers_.end()) {
        for (auto& [number, camera] : cameras_)
            if (const auto announced = camera.receivers.find(id);
                announced != camera.receivers.end())
                announced->second = {};
        send(id, found->second.delivery.message({}));
        tell_receiver(id, found->second);
    }
    if (!cameras_.of(id).empty())
        tell_publisher(id);
}

void Streams::choose(ParticipantId id, const CodecWish& wish,
                     const std::vector<CameraId>& cameras) {
    const auto found = receivers_.find(id);
    if (found == receivers_.end())
        return;
    StreamReceiver& receiver = found->second;
    std::vector<CameraId> known = cameras;
    std::erase_if(known, [&](CameraId camera) { return !cameras_.find(camera); });
    if (known.empty() && !cameras.empty())
        return;
    receiver.choose(wish, known);
    for (auto& [number, camera] : cameras_) {
        const bool is_meant =
            known.empty() || std::find(known.begin(), known.end(), number) != known.end();
        if (!is_meant || !receiver.gets(camera, id))
            continue;
        if (!wish.depth.empty())
            receiver.request(camera, id, true);
        if (!wish.color.empty())
            receiver.request(camera, id, false);
    }
    take_step(id, receiver);
    apply();
}

void Streams::fix(ParticipantId id, const CodecWish& codecs) {
    const auto found = receivers_.find(id);
    if (found == receivers_.end() || found->second.fixed == codecs)
        return;
    StreamReceiver& receiver = found->second;
    receiver.fix(codecs);
    receiver.delivery.set_codecs(steps_for(receiver), region_is_drawn_);
    for (auto& [number, camera] : cameras_)
        if (receiver.gets(camera, id)) {
            receiver.request(camera, id, true);
            receiver.request(camera, id, false);
        }
    take_step(id, receiver);
    apply();
}

// The steps that a slow link may take.
CodecSteps Streams::steps_for(const StreamReceiver& receiver) const {
    CodecSteps steps = codecs_;
    if (!receiver.fixed.depth.empty())
        steps.lossy_outside_region = nullptr;
    if (!receiver.fixed.color.empty())
        steps.coarser = nullptr;
    return steps;
}

// Asks for the encodings of the receiver's step.
void Streams::take_step(ParticipantId id, StreamReceiver& receiver) {
    for (auto& [number, camera] : cameras_)
        if (receiver.gets(camera, id))
            receiver.take_step(camera, id);
}

void Streams::set_goal(ParticipantId id, const wire::ChooseDelivery& goal) {
    const auto found = receivers_.find(id);
    if (found == receivers_.end())
        return;
    found->second.delivery.set_goal(goal);
    found->second.max_kbit_per_s = goal.max_kbit_per_s;
    ++changes_;
    actions_.push_back(action::SetCeiling{id, goal.max_kbit_per_s * 125ull});
}

void Streams::on_link(ParticipantId id, const LinkMeasure& link, TimePoint now) {
    const auto found = receivers_.find(id);
    if (found == receivers_.end())
        return;
    StreamReceiver& receiver = found->second;
    std::vector<Delivery::Given> given;
    for (const auto& [number, camera] : cameras_)
        if (receiver.gets(camera, id))
            given.push_back(
                {&camera.table(true).given(id),
                 camera.description().has_color ? &camera.table(false).given(id) : nullptr,
                 camera.table(true).wished(id), camera.table(false).wished(id)});
    Delivery& delivery = receiver.delivery;
    if (!delivery.update(link, given, cameras_.frames_per_second(), rates_, made_in(id), now))
        return;
    const wire::Delivery message = delivery.message(link.delay);
    actions_.push_back(
        action::Stepped{id, wire::sent_part(message) + ": " + wire::english(message.reason)});
    send(id, message);
    take_step(id, receiver);
    apply();
}

void Streams::look_back(ParticipantId id, std::set<CameraId> cameras) {
    const auto found = receivers_.find(id);
    if (found == receivers_.end())
        return;
    StreamReceiver& receiver = found->second;
    for (const CameraId camera : std::exchange(receiver.past, std::move(cameras))) {
        CameraStreams* known = cameras_.find(camera);
        if (!known || receiver.past.contains(camera))
            continue;
        known->receivers[id] = {};
        receiver.delivery.forget(depth_stream(camera));
        receiver.delivery.forget(color_stream(camera));
    }
    ++changes_;
    tell_receiver(id, receiver);
}

std::string Streams::step_of(ParticipantId id) {
    const auto found = receivers_.find(id);
    return found == receivers_.end() ? "" : wire::sent_part(found->second.delivery.message({}));
}

// The longer one of depth and colour, each the mean of all cameras. Settings are measured
// separately: a slow one does not make frames of other settings late.
Duration Streams::made_in(ParticipantId id) const {
    Duration depth{}, color{};
    int cameras = 0;
    for (const auto& [number, camera] : cameras_) {
        const auto announced = camera.receivers.find(id);
        if (announced == camera.receivers.end())
            continue;
        ++cameras;
        depth += camera.made_in(announced->second.depth);
        color += camera.made_in(announced->second.color);
    }
    return std::max(depth, color) / std::max(cameras, 1);
}

// Encoders and receivers in line with the tables.

void Streams::apply() {
    ++changes_;
    change_encodings();
    for (auto& [id, receiver] : receivers_)
        tell_receiver(id, receiver);
}

void Streams::change_encodings() {
    const bool is_change = std::any_of(cameras_.begin(), cameras_.end(),
                                       [](const auto& entry) { return entry.second.has_change(); });
    encodings_wait_ = is_change && !encoding_changes_.take(now_);
    if (!is_change || encodings_wait_)
        return;
    std::set<ParticipantId> publishers;
    for (auto& [id, camera] : cameras_) {
        const auto gone = camera.take_change();
        if (!gone)
            continue;
        for (const SettingId setting : *gone) {
            key_requests_.forget(setting);
            rates_.forget(setting);
        }
        if (camera.publisher() == host_publisher)
            actions_.push_back(action::ChangeSettings{id});
        else
            publishers.insert(camera.publisher());
    }
    for (const ParticipantId publisher : publishers)
        tell_publisher(publisher);
}

void Streams::tell_publisher(ParticipantId publisher) {
    wire::Encode message;
    for (const auto& [id, camera] : cameras_) {
        if (camera.publisher() != publisher)
            continue;
        for (const bool depth : {true, false})
            if (depth || camera.description().has_color)
                for (const ActiveSetting& setting : camera.table(depth).active())
                    message.settings.push_back({camera.stream(depth), setting.id, setting.codec});
    }
    send(publisher, std::move(message));
}

void Streams::tell_receiver(ParticipantId id, StreamReceiver& receiver) {
    wire::Settings message;
    for (auto& [number, camera] : cameras_) {
        const auto announced = camera.receivers.find(id);
        if (announced == camera.receivers.end() || receiver.past.contains(number))
            continue;
        const ActiveSetting& depth = camera.table(true).given(id);
        const ActiveSetting& color = camera.table(false).given(id);
        const CameraStreams::Told now{depth.id, color.id,
                                      receiver.step_for(camera, id).highest_layer};
        const CameraStreams::Told before = std::exchange(announced->second, now);
        if (before.depth == now.depth && before.color == now.color)
            continue;
        for (const bool is_depth : {true, false}) {
            if (!is_depth && !camera.description().has_color)
                continue;
            const ActiveSetting& setting = is_depth ? depth : color;
            message.settings.push_back({camera.stream(is_depth), setting.id, setting.codec});
            if (setting.id != before.of(is_depth) && setting.codec != wire::no_codec &&
                !receiver.is_by_relay)
                key_requests_.request({camera.stream(is_depth), setting.id});
        }
        if (message.note.empty())
            message.note = receiver.note_on(camera, id);
    }
    if (!message.settings.empty())
        send(id, std::move(message));
}

}  // namespace theatron::session

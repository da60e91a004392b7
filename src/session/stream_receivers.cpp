// SPDX-License-Identifier: Apache-2.0
// The receivers of streams: their wishes, their settings, and messages to them.
#include <algorithm>
#include <set>
#include <utility>

#include "session/face_limits.h"
#include "session/streams.h"
#include "wire/no_codec.h"

namespace theatron::session {

const std::string& Streams::Receiver::wished(CameraId camera, bool depth) const {
    const auto single = wishes.find(camera);
    const auto pick = [&](const Wish& w) -> const std::string& {
        return depth ? w.depth : w.color;
    };
    return single != wishes.end() && !pick(single->second).empty() ? pick(single->second)
                                                                   : pick(wish);
}

void Streams::join(ParticipantId id, const Wish& wish, bool records, bool takes_faces) {
    Receiver& receiver = receivers_[id];
    receiver.wish = wish;
    receiver.records = records;
    receiver.takes_faces = takes_faces;
    receiver.delivery.set_codecs(config_.codecs, region_is_drawn_);
    receiver.delivery.set_wish(wish.depth, wish.color);
    for (auto& [camera, streams] : cameras_)
        if (gets(streams, id, receiver)) {
            set_wish(id, receiver, streams, true);
            set_wish(id, receiver, streams, false);
        }
    apply();
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
    if (!of(id).empty())
        tell_publisher(id);
}

void Streams::choose(ParticipantId id, const Wish& wish, const std::vector<CameraId>& cameras) {
    const auto found = receivers_.find(id);
    if (found == receivers_.end())
        return;
    Receiver& receiver = found->second;
    const auto take_over = [&](Wish& target) {
        if (!wish.depth.empty())
            target.depth = wish.depth;
        if (!wish.color.empty())
            target.color = wish.color;
    };
    if (cameras.empty()) {
        take_over(receiver.wish);
        for (auto& [camera, single] : receiver.wishes) {
            if (!wish.depth.empty())
                single.depth.clear();
            if (!wish.color.empty())
                single.color.clear();
        }
    }
    for (const CameraId camera : cameras)
        if (cameras_.contains(camera))
            take_over(receiver.wishes[camera]);
    receiver.delivery.set_wish(receiver.wish.depth, receiver.wish.color);
    for (auto& [camera, streams] : cameras_) {
        const bool is_meant =
            cameras.empty() || std::find(cameras.begin(), cameras.end(), camera) != cameras.end();
        if (!gets(streams, id, receiver) || !is_meant)
            continue;
        if (!wish.depth.empty())
            set_wish(id, receiver, streams, true);
        if (!wish.color.empty())
            set_wish(id, receiver, streams, false);
    }
    take_step(id, receiver);
    apply();
}

void Streams::set_wish(ParticipantId id, Receiver& receiver, CameraStreams& camera, bool depth) {
    camera.receivers.try_emplace(id);
    SettingTable& table = camera.table(depth);
    if (camera.is_face())
        table.wish(id, std::string(depth ? face_depth_codec : face_color_codec));
    else
        table.wish(id, receiver.wished(camera.description().id, depth));
    if (receiver.records)
        table.pin(id);
}

const LadderStep& Streams::step_for(ParticipantId id, Receiver& receiver,
                                    const CameraStreams& camera) {
    return receiver.delivery.step_of(
        receiver.delivery.ladder(camera.table(true).wished(id), camera.table(false).wished(id)));
}

// Asks for the encodings of the receiver's step.
void Streams::take_step(ParticipantId id, Receiver& receiver) {
    for (auto& [number, camera] : cameras_)
        if (gets(camera, id, receiver))
            take_step(id, receiver, camera);
}

void Streams::take_step(ParticipantId id, Receiver& receiver, CameraStreams& camera) {
    if (camera.is_face())
        return;  // fewer pictures are sent, but no other ones
    const LadderStep step = step_for(id, receiver, camera);
    camera.table(true).stopgap(id, step.depth_codec);
    camera.table(false).stopgap(id, step.color_codec);
}

void Streams::set_goal(ParticipantId id, const wire::ChooseDelivery& goal) {
    const auto found = receivers_.find(id);
    if (found == receivers_.end())
        return;
    found->second.delivery.set_goal(goal);
    found->second.has_ceiling = goal.max_kbit_per_s > 0;
    ++changes_;
    actions_.push_back(action::SetCeiling{id, goal.max_kbit_per_s * 125ull});
}

void Streams::on_link(ParticipantId id, const LinkMeasure& link, TimePoint now) {
    const auto found = receivers_.find(id);
    if (found == receivers_.end())
        return;
    Receiver& receiver = found->second;
    std::vector<Delivery::Given> given;
    for (const auto& [number, camera] : cameras_)
        if (gets(camera, id, receiver))
            given.push_back(
                {&camera.table(true).given(id),
                 camera.description().has_color ? &camera.table(false).given(id) : nullptr,
                 camera.table(true).wished(id), camera.table(false).wished(id)});
    Delivery& delivery = receiver.delivery;
    if (!delivery.update(link, given, frames_per_second(), rates_, made_in(id), now))
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
    Receiver& receiver = found->second;
    for (const CameraId camera : std::exchange(receiver.past, std::move(cameras))) {
        const auto known = cameras_.find(camera);
        if (known == cameras_.end() || receiver.past.contains(camera))
            continue;
        known->second.receivers[id] = {};
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

double Streams::frames_per_second() const {
    double fastest = 1;
    for (const auto& [id, camera] : cameras_)
        fastest = std::max(fastest, camera.description().frames_per_second);
    return fastest;
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
    for (auto& [id, receiver] : receivers_)
        tell_receiver(id, receiver);
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

void Streams::tell_receiver(ParticipantId id, Receiver& receiver) {
    wire::Settings message;
    for (auto& [number, camera] : cameras_) {
        const auto announced = camera.receivers.find(id);
        if (announced == camera.receivers.end() || receiver.past.contains(number))
            continue;
        const ActiveSetting& depth = camera.table(true).given(id);
        const ActiveSetting& color = camera.table(false).given(id);
        const CameraStreams::Told now{depth.id, color.id,
                                      step_for(id, receiver, camera).highest_layer};
        const CameraStreams::Told before = std::exchange(announced->second, now);
        if (before.depth == now.depth && before.color == now.color)
            continue;
        for (const bool is_depth : {true, false}) {
            if (!is_depth && !camera.description().has_color)
                continue;
            const ActiveSetting& setting = is_depth ? depth : color;
            message.settings.push_back({camera.stream(is_depth), setting.id, setting.codec});
            if (setting.id != before.of(is_depth) && setting.codec != wire::no_codec)
                key_requests_.request({camera.stream(is_depth), setting.id});
        }
        if (message.note.empty())
            message.note = note_for(id, receiver, camera);
    }
    if (!message.settings.empty())
        send(id, std::move(message));
}

// Empty if the receiver gets the settings that it requested. It requests none for faces.
wire::Text Streams::note_for(ParticipantId id, Receiver& receiver, const CameraStreams& camera) {
    if (camera.is_face())
        return {};
    for (const bool depth : {true, false}) {
        const LadderStep& step = step_for(id, receiver, camera);
        const std::string& asked = receiver.records
                                       ? receiver.wished(camera.description().id, depth)
                                   : depth ? step.depth_codec
                                           : step.color_codec;
        if (camera.table(depth).given(id).codec != asked)
            return {wire::TextCode::all_encodings_taken,
                    {std::to_string(SettingTable::max_active), asked}};
    }
    return {};
}

}  // namespace theatron::session

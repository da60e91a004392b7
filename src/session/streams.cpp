// SPDX-License-Identifier: Apache-2.0
#include "session/streams.h"

#include <algorithm>
#include <set>
#include <utility>

namespace theatron::session {

// Cameras.

void Streams::add(ParticipantId publisher, std::vector<wire::Camera> cameras,
                  const std::string& publisher_name, const std::vector<std::string>& given_names) {
    std::vector<const CameraStreams*> added;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const std::string given_name = given_names.empty() ? cameras[i].name : given_names[i];
        CameraStreams& camera =
            cameras_.add(publisher, std::move(cameras[i]), publisher_name, given_name);
        added.push_back(&camera);
        for (auto& [id, receiver] : receivers_)
            if (receiver.gets(camera, id)) {
                receiver.request(camera, id, true);
                receiver.request(camera, id, false);
                receiver.take_step(camera, id);
            }
    }
    for (const auto& [id, receiver] : receivers_) {
        wire::CamerasAdded message;
        for (const CameraStreams* camera : added)
            if (camera->is_told_to(id, receiver.takes_faces))
                message.cameras.push_back(camera->description());
        if (!message.cameras.empty())
            send(id, std::move(message));
    }
    apply();
}

const std::vector<ActiveSetting>& Streams::settings(CameraId id, bool depth) const {
    static const std::vector<ActiveSetting> none;
    const CameraStreams* camera = cameras_.find(id);
    return camera ? camera->table(depth).active() : none;
}

void Streams::remove(const std::vector<CameraId>& cameras, Removal why) {
    ++changes_;
    std::map<ParticipantId, wire::CamerasRemoved> removals;
    for (const CameraId id : cameras) {
        const CameraStreams* camera = cameras_.find(id);
        if (!camera)
            continue;
        for (const bool depth : {true, false})
            for (const ActiveSetting& setting : camera->table(depth).active()) {
                key_requests_.forget(setting.id);
                rates_.forget(setting.id);
            }
        for (auto& [participant, receiver] : receivers_) {
            receiver.forget(id);
            if (camera->is_told_to(participant, receiver.takes_faces))
                removals[participant].cameras.push_back(id);
        }
        cameras_.remove(id);
    }
    for (auto& [id, message] : removals) {
        message.interrupted = why == Removal::interrupted;
        send(id, std::move(message));
    }
}

void Streams::on_state(const wire::CameraState& state) {
    CameraStreams* camera = cameras_.find(state.camera);
    if (!camera)
        return;
    camera->state = state;
    for (const auto& [id, announced] : camera->receivers)
        send(id, state);
}

wire::ManageRefusal Streams::adjust(CameraId camera, const CameraAdjustment& adjustment) {
    const wire::ManageRefusal refusal = cameras_.adjust(camera, adjustment);
    if (refusal == wire::ManageRefusal::none)
        tell_changed(*cameras_.find(camera));
    return refusal;
}

void Streams::set_calibration(CameraId id, const Bytes& calibration) {
    CameraStreams* camera = cameras_.find(id);
    if (!camera)
        return;
    cameras_.set_calibration(*camera, calibration);
    tell_changed(*camera);
}

void Streams::set_estimated_gain(CameraId id, Vec3 gain) {
    CameraStreams* camera = cameras_.find(id);
    if (camera && camera->set_estimated_gain(gain))
        tell_changed(*camera);
}

void Streams::tell_changed(const CameraStreams& camera) {
    for (const auto& [receiver, wishes] : receivers_)
        if (receiver != camera.publisher())
            send(receiver, wire::CameraChanged{camera.description()});
}

void Streams::on_region(bool is_drawn) {
    if (std::exchange(region_is_drawn_, is_drawn) == is_drawn)
        return;
    for (auto& [id, receiver] : receivers_) {
        // A region adds steps down, which a recorder does not take.
        if (receiver.records)
            continue;
        receiver.delivery.set_codecs(steps_for(receiver), is_drawn);
        send(id, receiver.delivery.message({}));
        take_step(id, receiver);
    }
    apply();
}

void Streams::on_encoding(CameraId id, SettingId setting, bool keeps_up, double ms_per_picture) {
    CameraStreams* camera = cameras_.find(id);
    if (!camera)
        return;
    const bool depth = camera->table(true).find(setting) != nullptr;
    const ActiveSetting* active = camera->table(depth).find(setting);
    if (!active)
        return;  // the setting has ended meanwhile
    // Receivers get one note for a codec, however many cameras are too slow in it.
    const bool is_known = std::any_of(cameras_.begin(), cameras_.end(), [&](const auto& entry) {
        return entry.second.is_slow(depth, active->codec);
    });
    if (!camera->set_slow(depth, setting, !keeps_up))
        return;
    if (!keeps_up && !is_known) {
        const wire::Text note{wire::TextCode::encoding_is_slow,
                              {active->codec, std::to_string(int(ms_per_picture + 0.5))}};
        for (const auto& [receiver, announced] : camera->receivers)
            if (announced.of(depth) == setting)
                send(receiver, wire::Settings{{}, note});
    }
    apply();
}

// Media.

std::vector<ParticipantId> Streams::on_media(const wire::MediaHeader& header, std::size_t size,
                                             TimePoint now) {
    const CameraId number = camera_of(header.stream);
    CameraStreams* camera = cameras_.find(number);
    if (!camera)
        return {};
    const auto layer = camera->on_media(header, now);
    if (!layer)
        return {};
    rates_.add(header.setting, *layer, size, now);

    const bool depth = is_depth(header.stream);
    const bool chain = camera->table(depth).find(header.setting)->traits.chain;
    std::vector<ParticipantId> result;
    for (const auto& [id, announced] : camera->receivers) {
        if (announced.of(depth) != header.setting)
            continue;
        StreamReceiver& receiver = receivers_.at(id);
        if (receiver.past.contains(number))
            continue;
        const int own_layer = depth ? *layer : camera->color_layer(header.frame, announced.depth);
        if (!chain && !receiver.records &&
            !receiver.delivery.lets_through(header.stream, own_layer, announced.highest_layer))
            continue;
        result.push_back(id);
    }
    return result;
}

const ActiveSetting* Streams::kept_setting(StreamId stream) const {
    const CameraStreams* camera = cameras_.find(camera_of(stream));
    if (!camera || !camera->may_be_kept())
        return nullptr;
    const auto& active = camera->table(is_depth(stream)).active();
    return active.empty() ? nullptr : &active.front();
}

std::vector<ParticipantId> Streams::receivers(StreamId stream, SettingId setting) const {
    std::vector<ParticipantId> result;
    if (const CameraStreams* camera = cameras_.find(camera_of(stream)))
        for (const auto& [id, announced] : camera->receivers)
            if (announced.of(is_depth(stream)) == setting)
                result.push_back(id);
    return result;
}

std::vector<StreamUse> Streams::uses() const {
    std::vector<StreamUse> result;
    for (const auto& [id, camera] : cameras_)
        for (const bool depth : {true, false})
            for (const ActiveSetting& setting : camera.table(depth).active()) {
                StreamUse use{camera.stream(depth), setting.id, {}};
                for (const auto& [number, announced] : camera.receivers) {
                    const StreamReceiver& receiver = receivers_.at(number);
                    if (announced.of(depth) == setting.id && !receiver.past.contains(id))
                        use.receivers.push_back(
                            {number, announced.highest_layer, receiver.max_kbit_per_s});
                }
                result.push_back(std::move(use));
            }
    return result;
}

int Streams::layer_of(const wire::MediaHeader& header) const {
    const CameraStreams* camera = cameras_.find(camera_of(header.stream));
    const bool depth = is_depth(header.stream);
    const ActiveSetting* setting = camera ? camera->table(depth).find(header.setting) : nullptr;
    // All frames of a chain go to everybody.
    if (!setting || setting->traits.chain)
        return 0;
    if (depth)
        return camera->color_layer(header.frame, header.setting);
    // Those who see a colour setting have the same depth setting, but for few.
    for (const auto& [id, announced] : camera->receivers)
        if (announced.color == header.setting)
            return camera->color_layer(header.frame, announced.depth);
    return 0;
}

void Streams::request_key(StreamId stream, SettingId setting) {
    const CameraStreams* camera = cameras_.find(camera_of(stream));
    if (camera && camera->table(is_depth(stream)).find(setting))
        key_requests_.request({stream, setting});
}

void Streams::request_key(ParticipantId receiver, StreamId stream, SettingId setting) {
    const CameraStreams* camera = cameras_.find(camera_of(stream));
    if (!camera)
        return;
    const auto announced = camera->receivers.find(receiver);
    if (announced != camera->receivers.end() && announced->second.of(is_depth(stream)) == setting)
        key_requests_.request({stream, setting});
}

void Streams::on_tick(TimePoint now) {
    now_ = now;
    cameras_.on_time(now);
    if (encodings_wait_)
        change_encodings();
    for (const KeyRequests::Key& key : key_requests_.take(now)) {
        const CameraStreams* camera = cameras_.find(camera_of(key.stream));
        if (camera && camera->publisher() != host_publisher)
            send(camera->publisher(), wire::EncodeKey{key.stream, key.setting});
        else if (camera)
            actions_.push_back(action::RequestKey{key});
    }
}

bool Streams::all_wait(CameraId id, const std::function<bool(ParticipantId)>& is_behind) const {
    const CameraStreams* camera = cameras_.find(id);
    if (!camera || camera->receivers.empty())
        return false;
    return std::all_of(camera->receivers.begin(), camera->receivers.end(), [&](const auto& entry) {
        const StreamReceiver& receiver = receivers_.at(entry.first);
        return !receiver.past.contains(id) && !receiver.delivery.adapts() && is_behind(entry.first);
    });
}

}  // namespace theatron::session

// SPDX-License-Identifier: Apache-2.0
#include "session/streams.h"

#include <algorithm>
#include <cassert>
#include <set>
#include <utility>

#include "geometry/calibration.h"

namespace theatron::session {
namespace {

// Moves a camera whose place in the room is not known.
void stand_apart(wire::Camera& camera, double distance_m) {
    auto calibration = decode_calibration(camera.calibration);
    if (!calibration || calibration->registered || distance_m == 0)
        return;
    calibration->room_from_camera.translation.x += distance_m;
    camera.calibration = encode_calibration(*calibration);
}

bool can_be_adjusted(const CameraStreams& camera, const CameraAdjustment& adjustment) {
    const auto calibration = decode_calibration(camera.description().calibration);
    return calibration && calibration->person == 0 &&
           camera.description().frame == wire::CameraFrame::room &&
           (!adjustment.region || camera.publisher() == host_publisher) &&
           is_within_limits(adjustment, calibration->depth.size);
}

}  // namespace

// Cameras.

int Streams::free_slot() const {
    std::set<int> taken;
    for (const auto& [id, camera] : cameras_)
        if (!camera.is_face())
            taken.insert(camera.slot);
    int slot = 0;
    while (taken.contains(slot))
        ++slot;
    return slot;
}

void Streams::add(ParticipantId publisher, std::vector<wire::Camera> cameras,
                  const std::string& publisher_name) {
    assert(has_numbers_for(cameras.size()));
    for (wire::Camera& camera : cameras) {
        camera.id = CameraId(next_camera_++);
        camera.depth_stream = depth_stream(camera.id);
        camera.color_stream = color_stream(camera.id);
        camera.publisher = publisher;
        camera.may_record = camera.may_record || publisher == host_publisher;
        const int slot = free_slot();
        stand_apart(camera, slot * unregistered_distance_m);
        CameraStreams& streams =
            cameras_.try_emplace(camera.id, camera, numbers_, config_.usual, config_.codecs)
                .first->second;
        streams.slot = slot;
        streams.publisher_name = publisher_name;
        if (const CameraAdjustment* kept =
                adjustments_.find(publisher_name, camera.name, streams.registered());
            kept && can_be_adjusted(streams, *kept)) {
            streams.adjust(*kept);
            camera = streams.description();
        }
        for (auto& [id, receiver] : receivers_)
            if (gets(streams, id, receiver)) {
                set_wish(id, receiver, streams, true);
                set_wish(id, receiver, streams, false);
                take_step(id, receiver, streams);
            }
    }
    for (const auto& [id, receiver] : receivers_) {
        wire::CamerasAdded added;
        for (const wire::Camera& camera : cameras)
            if (cameras_.at(camera.id).is_told_to(id, receiver.takes_faces))
                added.cameras.push_back(camera);
        if (!added.cameras.empty())
            send(id, std::move(added));
    }
    apply();
}

const std::vector<ActiveSetting>& Streams::settings(CameraId id, bool depth) const {
    static const std::vector<ActiveSetting> none;
    const CameraStreams* camera = find(id);
    return camera ? camera->table(depth).active() : none;
}

void Streams::remove(const std::vector<CameraId>& cameras) {
    ++changes_;
    std::map<ParticipantId, wire::CamerasRemoved> removals;
    for (const CameraId camera : cameras) {
        const auto found = cameras_.find(camera);
        if (found == cameras_.end())
            continue;
        for (const bool depth : {true, false})
            for (const ActiveSetting& setting : found->second.table(depth).active()) {
                key_requests_.forget(setting.id);
                rates_.forget(setting.id);
            }
        for (auto& [id, receiver] : receivers_) {
            receiver.wishes.erase(camera);
            receiver.past.erase(camera);
            receiver.delivery.forget(depth_stream(camera));
            receiver.delivery.forget(color_stream(camera));
            if (found->second.is_told_to(id, receiver.takes_faces))
                removals[id].cameras.push_back(camera);
        }
        cameras_.erase(found);
    }
    for (auto& [id, message] : removals)
        send(id, std::move(message));
}

const CameraStreams* Streams::find(CameraId camera) const {
    const auto found = cameras_.find(camera);
    return found == cameras_.end() ? nullptr : &found->second;
}

std::vector<CameraId> Streams::of(ParticipantId publisher) const {
    std::vector<CameraId> result;
    for (const auto& [id, camera] : cameras_)
        if (camera.publisher() == publisher)
            result.push_back(id);
    return result;
}

std::vector<wire::Camera> Streams::cameras() const {
    std::vector<wire::Camera> result;
    for (const auto& [id, camera] : cameras_)
        result.push_back(camera.description());
    return result;
}

std::size_t Streams::faces() const {
    return std::size_t(std::count_if(cameras_.begin(), cameras_.end(),
                                     [](const auto& entry) { return entry.second.is_face(); }));
}

std::vector<wire::Camera> Streams::seen_by(ParticipantId participant, bool takes_faces) const {
    std::vector<wire::Camera> result;
    for (const auto& [id, camera] : cameras_)
        if (camera.is_told_to(participant, takes_faces))
            result.push_back(camera.description());
    return result;
}

std::vector<wire::CameraState> Streams::states_seen_by(ParticipantId participant,
                                                       bool takes_faces) const {
    std::vector<wire::CameraState> result;
    for (const auto& [id, camera] : cameras_)
        if (camera.is_told_to(participant, takes_faces) && camera.state)
            result.push_back(*camera.state);
    return result;
}

void Streams::on_state(const wire::CameraState& state) {
    const auto found = cameras_.find(state.camera);
    if (found == cameras_.end())
        return;
    found->second.state = state;
    for (const auto& [id, announced] : found->second.receivers)
        send(id, state);
}

wire::ManageRefusal Streams::adjust(CameraId id, const CameraAdjustment& adjustment) {
    const auto found = cameras_.find(id);
    if (found == cameras_.end() || !can_be_adjusted(found->second, {}))
        return wire::ManageRefusal::no_such_camera;
    CameraStreams& camera = found->second;
    if (!can_be_adjusted(camera, adjustment))
        return wire::ManageRefusal::beyond_limits;
    camera.adjust(adjustment);
    adjustments_.keep({camera.publisher_name, camera.description().name, camera.registered(),
                       camera.adjustment()});
    tell_changed(camera);
    return wire::ManageRefusal::none;
}

void Streams::set_calibration(CameraId id, const Bytes& calibration) {
    const auto found = cameras_.find(id);
    if (found == cameras_.end())
        return;
    wire::Camera apart;
    apart.calibration = calibration;
    stand_apart(apart, found->second.slot * unregistered_distance_m);
    found->second.set_calibration(apart.calibration);
    tell_changed(found->second);
}

void Streams::set_estimated_gain(CameraId id, Vec3 gain) {
    const auto found = cameras_.find(id);
    if (found != cameras_.end() && found->second.set_estimated_gain(gain))
        tell_changed(found->second);
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
        receiver.delivery.set_codecs(config_.codecs, is_drawn);
        send(id, receiver.delivery.message({}));
        take_step(id, receiver);
    }
    apply();
}

void Streams::on_encoding(CameraId id, SettingId setting, bool keeps_up, double ms_per_picture) {
    const auto found = cameras_.find(id);
    if (found == cameras_.end())
        return;
    CameraStreams& camera = found->second;
    const bool depth = camera.table(true).find(setting) != nullptr;
    const ActiveSetting* active = camera.table(depth).find(setting);
    if (!active)
        return;  // the setting has ended meanwhile
    // Receivers get one note for a codec, however many cameras are too slow in it.
    const bool is_known = std::any_of(cameras_.begin(), cameras_.end(), [&](const auto& entry) {
        return entry.second.is_slow(depth, active->codec);
    });
    if (!camera.set_slow(depth, setting, !keeps_up))
        return;
    if (!keeps_up && !is_known) {
        const wire::Text note{wire::TextCode::encoding_is_slow,
                              {active->codec, std::to_string(int(ms_per_picture + 0.5))}};
        for (const auto& [receiver, announced] : camera.receivers)
            if (announced.of(depth) == setting)
                send(receiver, wire::Settings{{}, note});
    }
    apply();
}

// Media.

std::vector<ParticipantId> Streams::on_media(const wire::MediaHeader& header, std::size_t size,
                                             TimePoint now) {
    const auto found = cameras_.find(camera_of(header.stream));
    if (found == cameras_.end())
        return {};
    CameraStreams& camera = found->second;
    const auto layer = camera.on_media(header, now);
    if (!layer)
        return {};
    rates_.add(header.setting, *layer, size, now);

    const bool depth = is_depth(header.stream);
    const bool chain = camera.table(depth).find(header.setting)->traits.chain;
    std::vector<ParticipantId> result;
    for (const auto& [id, announced] : camera.receivers) {
        if (announced.of(depth) != header.setting)
            continue;
        Receiver& receiver = receivers_.at(id);
        if (receiver.past.contains(found->first))
            continue;
        const int own_layer = depth ? *layer : camera.color_layer(header.frame, announced.depth);
        if (!chain && !receiver.records &&
            !receiver.delivery.lets_through(header.stream, own_layer, announced.highest_layer))
            continue;
        result.push_back(id);
    }
    return result;
}

const ActiveSetting* Streams::kept_setting(StreamId stream) const {
    const CameraStreams* camera = find(camera_of(stream));
    if (!camera || !camera->may_be_kept())
        return nullptr;
    const auto& active = camera->table(is_depth(stream)).active();
    return active.empty() ? nullptr : &active.front();
}

std::vector<ParticipantId> Streams::receivers(StreamId stream, SettingId setting) const {
    std::vector<ParticipantId> result;
    if (const CameraStreams* camera = find(camera_of(stream)))
        for (const auto& [id, announced] : camera->receivers)
            if (announced.of(is_depth(stream)) == setting)
                result.push_back(id);
    return result;
}

std::vector<StreamUse> Streams::uses() const {
    std::vector<StreamUse> result;
    for (const auto& [id, camera] : cameras_) {
        if (camera.publisher() == host_publisher || camera.is_face())
            continue;
        for (const bool depth : {true, false}) {
            const ActiveSetting* kept = kept_setting(camera.stream(depth));
            for (const ActiveSetting& setting : camera.table(depth).active()) {
                StreamUse use{camera.publisher(),
                              camera.stream(depth),
                              setting.id,
                              {},
                              kept && kept->id == setting.id};
                for (const auto& [number, announced] : camera.receivers) {
                    const Receiver& receiver = receivers_.at(number);
                    if (announced.of(depth) == setting.id && !receiver.past.contains(id))
                        use.receivers.push_back(
                            {number, !receiver.records && !receiver.has_ceiling});
                }
                result.push_back(std::move(use));
            }
        }
    }
    return result;
}

void Streams::request_key(StreamId stream, SettingId setting) {
    const CameraStreams* camera = find(camera_of(stream));
    if (camera && camera->table(is_depth(stream)).find(setting))
        key_requests_.request({stream, setting});
}

void Streams::request_key(ParticipantId receiver, StreamId stream, SettingId setting) {
    const CameraStreams* camera = find(camera_of(stream));
    if (!camera)
        return;
    const auto announced = camera->receivers.find(receiver);
    if (announced != camera->receivers.end() && announced->second.of(is_depth(stream)) == setting)
        key_requests_.request({stream, setting});
}

void Streams::on_tick(TimePoint now) {
    for (const KeyRequests::Key& key : key_requests_.take(now)) {
        const CameraStreams* camera = find(camera_of(key.stream));
        if (camera && camera->publisher() != host_publisher)
            send(camera->publisher(), wire::EncodeKey{key.stream, key.setting});
        else if (camera)
            actions_.push_back(action::RequestKey{key});
    }
}

bool Streams::all_wait(CameraId id, const std::function<bool(ParticipantId)>& is_behind) const {
    const CameraStreams* camera = find(id);
    if (!camera || camera->receivers.empty())
        return false;
    return std::all_of(camera->receivers.begin(), camera->receivers.end(), [&](const auto& entry) {
        const Receiver& receiver = receivers_.at(entry.first);
        return !receiver.past.contains(id) && !receiver.delivery.adapts() && is_behind(entry.first);
    });
}

}  // namespace theatron::session

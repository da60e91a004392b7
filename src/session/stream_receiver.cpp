// SPDX-License-Identifier: Apache-2.0
#include "session/stream_receiver.h"

#include "session/own_pictures.h"
#include "wire/no_codec.h"

namespace theatron::session {

const std::string& StreamReceiver::wished(CameraId camera, bool depth) const {
    if (!fixed.of(depth).empty())
        return fixed.of(depth);
    const auto single = wishes.find(camera);
    return single != wishes.end() && !single->second.of(depth).empty() ? single->second.of(depth)
                                                                       : wish.of(depth);
}

void StreamReceiver::choose(const CodecWish& chosen, const std::vector<CameraId>& cameras) {
    const auto take_over = [&](CodecWish& target) {
        if (!chosen.depth.empty())
            target.depth = chosen.depth;
        if (!chosen.color.empty())
            target.color = chosen.color;
    };
    for (const CameraId camera : cameras)
        take_over(wishes[camera]);
    if (cameras.empty()) {
        take_over(wish);
        for (auto& [camera, single] : wishes) {
            if (!chosen.depth.empty())
                single.depth.clear();
            if (!chosen.color.empty())
                single.color.clear();
        }
    }
    tell_delivery();
}

void StreamReceiver::fix(const CodecWish& codecs) {
    fixed = codecs;
    tell_delivery();
}

void StreamReceiver::tell_delivery() {
    const auto usual = [&](bool depth) {
        return fixed.of(depth).empty() ? wish.of(depth) : fixed.of(depth);
    };
    delivery.set_wish(usual(true), usual(false));
}

void StreamReceiver::request(CameraStreams& camera, ParticipantId id, bool depth) const {
    camera.receivers.try_emplace(id);
    SettingTable& table = camera.table(depth);
    const OwnPictureLimits* own = own_picture_limits(camera.offered_as());
    const std::string& asked = wished(camera.description().id, depth);
    if (own && asked != wire::no_codec)
        table.wish(id, std::string(depth ? own->depth_codec : own->color_codec));
    else
        table.wish(id, asked);
    if (records)
        table.pin(id);
}

const LadderStep& StreamReceiver::step_for(const CameraStreams& camera, ParticipantId id) {
    return delivery.step_of(
        delivery.ladder(camera.table(true).wished(id), camera.table(false).wished(id)));
}

void StreamReceiver::take_step(CameraStreams& camera, ParticipantId id) {
    if (camera.has_one_encoding())
        return;  // fewer pictures are sent, but no other ones
    const LadderStep step = step_for(camera, id);
    camera.table(true).stopgap(id, step.depth_codec);
    camera.table(false).stopgap(id, step.color_codec);
}

wire::Text StreamReceiver::note_on(const CameraStreams& camera, ParticipantId id) {
    if (camera.has_one_encoding())
        return {};
    for (const bool depth : {true, false}) {
        const LadderStep& step = step_for(camera, id);
        const std::string& asked = records ? wished(camera.description().id, depth)
                                   : depth ? step.depth_codec
                                           : step.color_codec;
        if (camera.table(depth).given(id).codec != asked)
            return {wire::TextCode::all_encodings_taken,
                    {std::to_string(SettingTable::max_active), asked}};
    }
    return {};
}

void StreamReceiver::forget(CameraId camera) {
    wishes.erase(camera);
    past.erase(camera);
    delivery.forget(depth_stream(camera));
    delivery.forget(color_stream(camera));
}

}  // namespace theatron::session

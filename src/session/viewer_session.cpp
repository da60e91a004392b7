// SPDX-License-Identifier: Apache-2.0
#include "session/viewer_session.h"

#include <algorithm>

#include "session/announced_cameras.h"

namespace theatron::session {
Bytes ViewerSession::begin() {
    joined_ = false;
    refusal_.clear();
    note_.clear();
    settings_.clear();
    camera_states_.clear();
    delivery_ = {};
    renderer_word_ = {};
    goodbye_.clear();
    wire::Join join;
    join.token = wishes_.token;
    join.name = wishes_.name;
    join.depth_codec = wishes_.depth_codec;
    join.color_codec = wishes_.color_codec;
    join.target_latency_ms = wishes_.delivery.target_latency_ms;
    join.max_kbit_per_s = wishes_.delivery.max_kbit_per_s;
    join.records = wishes_.records;
    return wire::encode(join);
}

ViewerSession::Change ViewerSession::on_control(ByteView bytes) {
    auto message = wire::decode_to_participant(bytes);
    if (!message)
        return Change::nothing;
    if (auto* welcome = std::get_if<wire::Welcome>(&*message)) {
        AnnouncedCameras judged = judge_cameras(std::move(welcome->cameras));
        welcome_ = std::move(*welcome);
        welcome_.cameras = std::move(judged.accepted);
        left_out_ = std::move(judged.left_out);
        camera_states_.clear();
        joined_ = true;
        return Change::welcomed;
    }
    if (auto* refused = std::get_if<wire::Refused>(&*message)) {
        refusal_ = refused->reason.empty() ? "The host gave no reason." : refused->reason;
        return Change::refused;
    }
    if (auto* settings = std::get_if<wire::Settings>(&*message)) {
        if (!settings->settings.empty())
            settings_ = std::move(settings->settings);
        note_ = std::move(settings->note);
        return Change::settings;
    }
    if (auto* state = std::get_if<wire::CameraState>(&*message)) {
        const bool known =
            std::any_of(cameras().begin(), cameras().end(),
                        [&](const wire::Camera& c) { return c.id == state->camera; });
        if (!joined_ || !known)
            return Change::nothing;
        camera_states_[state->camera] = std::move(*state);
        return Change::camera;
    }
    if (auto* pong = std::get_if<wire::Pong>(&*message)) {
        pong_ = *pong;
        return Change::pong;
    }
    if (auto* delivery = std::get_if<wire::Delivery>(&*message)) {
        delivery_ = std::move(*delivery);
        return Change::delivery;
    }
    if (auto* word = std::get_if<wire::SetRenderer>(&*message)) {
        renderer_word_ = std::move(*word);
        return Change::renderer;
    }
    if (auto* goodbye = std::get_if<wire::Goodbye>(&*message)) {
        goodbye_ = goodbye->reason.empty() ? "The session has ended." : goodbye->reason;
        return Change::goodbye;
    }
    return Change::nothing;
}

Bytes ViewerSession::choose(const std::string& depth_codec, const std::string& color_codec) {
    if (!depth_codec.empty())
        wishes_.depth_codec = depth_codec;
    if (!color_codec.empty())
        wishes_.color_codec = color_codec;
    return wire::encode(wire::ChooseCodecs{depth_codec, color_codec});
}

Bytes ViewerSession::choose_delivery(const wire::ChooseDelivery& goal) {
    wishes_.delivery = goal;
    return wire::encode(goal);
}

}  // namespace theatron::session

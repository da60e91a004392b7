// SPDX-License-Identifier: Apache-2.0
#include "session/viewer_session.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "geometry/calibration.h"
#include "session/announced_cameras.h"

namespace theatron::session {
namespace {

// A host of another age may know only the English sentence.
wire::Text refusal_text(wire::Refused& refused) {
    if (!refused.reason.empty() &&
        (wire::is_known(refused.reason.code) || refused.in_english.empty()))
        return std::move(refused.reason);
    if (!refused.in_english.empty())
        return wire::as_written(std::move(refused.in_english));
    return {wire::TextCode::no_reason};
}

// A host answers with a protocol that both know, or refuses; this one did neither. Empty if all is
// well.
wire::Text protocol_problem(std::uint16_t of_host) {
    if (of_host < wire::protocol_min)
        return {wire::TextCode::host_too_old,
                {std::to_string(of_host), std::to_string(wire::protocol_min)}};
    if (of_host > wire::protocol_max)
        return {wire::TextCode::program_too_old,
                {std::to_string(wire::protocol_max), std::to_string(of_host)}};
    return {};
}

}  // namespace

Bytes ViewerSession::begin() {
    joined_ = false;
    refusal_ = {};
    note_ = {};
    settings_.clear();
    camera_states_.clear();
    delivery_ = {};
    renderer_command_ = {};
    goodbye_ = {};
    standing_ = {};
    playback_.reset();
    patient_ = asked_patient_ = {};
    visitors_.clear();
    relay_grants_.clear();
    relay_receivers_ = {};
    study_step_ = {};
    study_reply_ = {};
    wire::Join join;
    join.token = wishes_.token;
    join.name = wishes_.name;
    join.depth_codec = wishes_.depth_codec;
    join.color_codec = wishes_.color_codec;
    join.target_latency_ms = wishes_.delivery.target_latency_ms;
    join.max_kbit_per_s = wishes_.delivery.max_kbit_per_s;
    join.records = wishes_.records;
    join.features = wishes_.features;
    join.person = wishes_.person;
    join.run = wishes_.run;
    return wire::encode(join);
}

ViewerSession::Change ViewerSession::on_control(ByteView bytes) {
    auto message = wire::decode_to_participant(bytes);
    if (!message)
        return Change::nothing;
    if (auto* welcome = std::get_if<wire::Welcome>(&*message)) {
        if (wire::Text problem = protocol_problem(welcome->protocol); !problem.empty()) {
            refusal_ = std::move(problem);
            return Change::refused;
        }
        std::vector<wire::Camera> cameras = std::exchange(welcome->cameras, {});
        welcome_ = std::move(*welcome);
        camera_states_.clear();
        settings_.clear();
        add_cameras(std::move(cameras));
        joined_ = true;
        return Change::welcomed;
    }
    if (auto* refused = std::get_if<wire::Refused>(&*message)) {
        refusal_ = refusal_text(*refused);
        return Change::refused;
    }
    if (auto* settings = std::get_if<wire::Settings>(&*message)) {
        take_settings(std::move(settings->settings));
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
    if (auto* added = std::get_if<wire::CamerasAdded>(&*message)) {
        if (!joined_)
            return Change::nothing;
        add_cameras(std::move(added->cameras));
        return Change::cameras;
    }
    if (const auto* removed = std::get_if<wire::CamerasRemoved>(&*message)) {
        if (!joined_)
            return Change::nothing;
        remove_cameras(*removed);
        return Change::cameras;
    }
    if (auto* changed = std::get_if<wire::CameraChanged>(&*message))
        return joined_ && change_camera(std::move(changed->camera)) ? Change::cameras
                                                                    : Change::nothing;
    if (auto* published = std::get_if<wire::Published>(&*message)) {
        published_ = std::move(*published);
        return Change::published;
    }
    if (auto* ended = std::get_if<wire::ShareEnded>(&*message)) {
        share_ended_ = std::move(*ended);
        return joined_ ? Change::unshared : Change::nothing;
    }
    if (auto* encode = std::get_if<wire::Encode>(&*message)) {
        encode_ = std::move(*encode);
        return Change::encode;
    }
    if (const auto* key = std::get_if<wire::EncodeKey>(&*message)) {
        encode_key_ = *key;
        return Change::encode_key;
    }
    if (auto* pong = std::get_if<wire::Pong>(&*message)) {
        pong_ = *pong;
        return Change::pong;
    }
    if (auto* delivery = std::get_if<wire::Delivery>(&*message)) {
        delivery_ = std::move(*delivery);
        return Change::delivery;
    }
    if (auto* command = std::get_if<wire::SetRenderer>(&*message)) {
        renderer_command_ = std::move(*command);
        return Change::renderer;
    }
    if (auto* goodbye = std::get_if<wire::Goodbye>(&*message)) {
        goodbye_ = goodbye->reason.empty() ? wire::Text{wire::TextCode::session_over}
                                           : std::move(goodbye->reason);
        return Change::goodbye;
    }
    if (std::holds_alternative<wire::RoomSnapshot>(*message) ||
        std::holds_alternative<wire::RoomChange>(*message) ||
        std::holds_alternative<wire::RoomDecision>(*message)) {
        room_ = std::move(*message);
        return joined_ ? Change::room : Change::nothing;
    }
    return on_people(std::move(*message));
}

ViewerSession::Change ViewerSession::on_people(wire::ToParticipant message) {
    if (auto* waiting = std::get_if<wire::Waiting>(&message)) {
        waiting_ = std::move(*waiting);
        return joined_ ? Change::nothing : Change::waiting;
    }
    if (!joined_)
        return Change::nothing;
    if (const auto* standing = std::get_if<wire::Standing>(&message)) {
        standing_ = *standing;
        return Change::standing;
    }
    if (auto* visitors = std::get_if<wire::Visitors>(&message)) {
        visitors_ = std::move(visitors->visitors);
        return Change::visitors;
    }
    if (const auto* managed = std::get_if<wire::Managed>(&message)) {
        managed_ = *managed;
        return Change::managed;
    }
    if (auto* offer = std::get_if<wire::OfferedCases>(&message)) {
        offered_cases_ = std::move(offer->cases);
        return Change::cases;
    }
    if (auto* playback = std::get_if<wire::Playback>(&message)) {
        playback_ = std::move(*playback);
        return Change::playback;
    }
    if (auto* patient = std::get_if<wire::Patient>(&message)) {
        patient_ = std::move(*patient);
        return Change::patient;
    }
    if (auto* answer = std::get_if<wire::AskedPatient>(&message)) {
        asked_patient_ = std::move(answer->patient);
        return Change::asked_patient;
    }
    if (auto* grants = std::get_if<wire::RelayGrants>(&message)) {
        relay_grants_ = std::move(grants->grants);
        return Change::relay_grants;
    }
    if (auto* receivers = std::get_if<wire::RelayReceivers>(&message)) {
        relay_receivers_ = std::move(*receivers);
        return Change::relay_receivers;
    }
    if (auto* step = std::get_if<wire::StudyStep>(&message)) {
        study_step_ = std::move(*step);
        return Change::study;
    }
    if (const auto* reply = std::get_if<wire::StudyReplied>(&message)) {
        study_reply_ = *reply;
        return Change::study_reply;
    }
    if (auto* chat = std::get_if<wire::ChatMessages>(&message)) {
        chat_ = std::move(*chat);
        return Change::chat;
    }
    if (auto* content = std::get_if<wire::Content>(&message)) {
        content_ = std::move(*content);
        return Change::content;
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

Bytes ViewerSession::choose(CameraId camera, const std::string& depth_codec,
                            const std::string& color_codec) {
    return wire::encode(wire::ChooseCodecs{depth_codec, color_codec, {camera}});
}

bool ViewerSession::has(wire::Feature feature) const {
    return std::find(welcome_.features.begin(), welcome_.features.end(), feature) !=
           welcome_.features.end();
}

// Settings of cameras that were left out are ignored.
void ViewerSession::take_settings(std::vector<wire::StreamSetting> settings) {
    for (wire::StreamSetting& setting : settings) {
        const bool known =
            std::any_of(cameras().begin(), cameras().end(), [&](const wire::Camera& c) {
                return c.depth_stream == setting.stream || c.color_stream == setting.stream;
            });
        const auto found =
            std::find_if(settings_.begin(), settings_.end(),
                         [&](const wire::StreamSetting& s) { return s.stream == setting.stream; });
        if (found != settings_.end())
            *found = std::move(setting);
        else if (known)
            settings_.push_back(std::move(setting));
    }
}

// Existing cameras come first and stay. A camera of another session is ignored.
void ViewerSession::add_cameras(std::vector<wire::Camera> cameras) {
    std::erase_if(cameras, [&](const wire::Camera& c) { return c.session != welcome_.session; });
    std::vector<wire::Camera> all = std::exchange(welcome_.cameras, {});
    all.insert(all.end(), std::make_move_iterator(cameras.begin()),
               std::make_move_iterator(cameras.end()));
    AnnouncedCameras judged = judge_cameras(std::move(all));
    welcome_.cameras = std::move(judged.accepted);
    left_out_ = std::move(judged.left_out);
    interrupted_.clear();
}

// Only what does not concern its streams may change. False, and nothing changes, if there is no
// such camera or its description cannot be used.
bool ViewerSession::change_camera(wire::Camera camera) {
    for (wire::Camera& known : welcome_.cameras) {
        if (known.id != camera.id || known.session != camera.session ||
            known.has_color != camera.has_color || known.kind != camera.kind)
            continue;
        const auto before = decode_calibration(known.calibration),
                   now = decode_calibration(camera.calibration);
        if (!before || !now || before->depth != now->depth || before->color != now->color)
            return false;
        known.calibration = std::move(camera.calibration);
        known.adjustment = std::move(camera.adjustment);
        left_out_.clear();
        interrupted_.clear();
        return true;
    }
    return false;
}

void ViewerSession::remove_cameras(const wire::CamerasRemoved& removed) {
    const auto is_gone = [&](CameraId camera) {
        return std::find(removed.cameras.begin(), removed.cameras.end(), camera) !=
               removed.cameras.end();
    };
    left_out_.clear();
    interrupted_ = removed.interrupted ? removed.cameras : std::vector<CameraId>{};
    std::erase_if(welcome_.cameras, [&](const wire::Camera& c) { return is_gone(c.id); });
    std::erase_if(camera_states_, [&](const auto& entry) { return is_gone(entry.first); });
    std::erase_if(settings_,
                  [&](const wire::StreamSetting& s) { return is_gone(camera_of(s.stream)); });
}

Bytes ViewerSession::choose_delivery(const wire::ChooseDelivery& goal) {
    wishes_.delivery = goal;
    return wire::encode(goal);
}

}  // namespace theatron::session

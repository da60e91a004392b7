// SPDX-License-Identifier: Apache-2.0
// A participant's side of a session: joins, and keeps the state that the host sent.
//
// A pure state machine, the same in the native client and in the browser.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "wire/control.h"

namespace theatron::session {

class ViewerSession {
public:
    struct Wishes {
        std::string token;
        std::string name;
        std::string depth_codec = "strata";
        std::string color_codec = "jpeg:quality=85";
        wire::ChooseDelivery delivery;
        // As in wire::Join.
        bool records = false;
        std::vector<wire::Feature> features = {};
        Bytes person = {};
        std::uint64_t run = 0;
    };

    explicit ViewerSession(Wishes wishes) : wishes_(std::move(wishes)) {}

    // Begins a session on a new connection. Returns the first message to send.
    Bytes begin();

    // The part of the state that a message of the host changed.
    enum class Change {
        nothing,
        welcomed,    // cameras() are known; they may be others than those of the connection before
        cameras,     // some of cameras() came, left or are described anew
        refused,     // refusal() says why; the connection is to be ended
        settings,    // settings(), and note(): the host's comment on them
        camera,      // camera_states()
        pong,        // pong() answers a ping
        delivery,    // delivery(): the host sends more or less
        renderer,    // renderer_command(): how the host wants this participant to draw
        published,   // published(): the answer to an offer
        unshared,    // share_ended(): others have ended screens of this participant
        encode,      // encode(): how to encode the cameras that this participant publishes
        encode_key,  // encode_key(): the host requests a key frame of one of them
        room,        // room(): a message for MemberRoom
        waiting,     // an operator decides first; welcomed or refused follows
        standing,    // standing(): this participant's role
        visitors,    // visitors(): the people who wait for this operator
        managed,     // managed(): the host's answer to a decision
        cases,       // offered_cases(): all cases of the host
        content,     // content(): a piece of what this participant has asked for
        playback,    // playback(): where the recording is that the host plays
        patient,     // patient(): who the patient of the open case is
        asked_patient,    // asked_patient(): the answer to wire::AskPatient
        study,            // study_step(): what this participant of a study is to be shown
        study_reply,      // study_reply(): of a participant whom this program leads
        chat,             // chat(): what people have written
        relay_grants,     // relay_grants(): the relays that this participant may connect to
        relay_receivers,  // relay_receivers(): who may connect to this relay
        goodbye,          // goodbye() says why: the session is over, the connection will end
    };
    // Safe for untrusted input: damaged and unknown messages change nothing.
    Change on_control(ByteView message);

    // Requests other codecs; an empty text keeps the codec. Returns the message
    // to send.
    Bytes choose(const std::string& depth_codec, const std::string& color_codec);
    // The same for one camera, until the next choice for it or for all.
    static Bytes choose(CameraId camera, const std::string& depth_codec,
                        const std::string& color_codec);

    // Requests another goal. Returns the message to send.
    Bytes choose_delivery(const wire::ChooseDelivery& goal);

    bool joined() const { return joined_; }
    const wire::Welcome& welcome() const { return welcome_; }
    // The cameras that judge_cameras() accepts; their calibrations can be decoded.
    const std::vector<wire::Camera>& cameras() const { return welcome_.cameras; }
    // About each camera that was not accepted, of the last message that named cameras.
    const std::vector<wire::Text>& left_out() const { return left_out_; }
    // The cameras that have left with the newest change, if their publisher's connection broke.
    const std::vector<CameraId>& interrupted() const { return interrupted_; }
    // The settings of accepted cameras only.
    const std::vector<wire::StreamSetting>& settings() const { return settings_; }
    // The host has this part of the protocol for this participant.
    bool has(wire::Feature feature) const;
    bool may_publish() const { return has(wire::Feature::publish); }
    const wire::Text& note() const { return note_; }
    // The states of accepted cameras only.
    const std::map<CameraId, wire::CameraState>& camera_states() const { return camera_states_; }
    const wire::Text& refusal() const { return refusal_; }
    const wire::Pong& pong() const { return pong_; }
    const wire::Delivery& delivery() const { return delivery_; }
    // The newest command of this connection's host; empty before the first.
    const wire::SetRenderer& renderer_command() const { return renderer_command_; }
    // Empty as long as the session goes on.
    const wire::Text& goodbye() const { return goodbye_; }
    const wire::Published& published() const { return published_; }
    const wire::ShareEnded& share_ended() const { return share_ended_; }
    const wire::Encode& encode() const { return encode_; }
    const wire::EncodeKey& encode_key() const { return encode_key_; }
    // ObjectsSnapshot, ObjectChange or RoomDecision.
    const wire::ToParticipant& room() const { return room_; }
    const wire::Waiting& waiting() const { return waiting_; }
    const wire::Standing& standing() const { return standing_; }
    const std::vector<wire::Visitor>& visitors() const { return visitors_; }
    const wire::Managed& managed() const { return managed_; }
    const std::vector<wire::OfferedCase>& offered_cases() const { return offered_cases_; }
    const wire::Content& content() const { return content_; }
    // Empty: the host plays no recording.
    const std::optional<wire::Playback>& playback() const { return playback_; }
    // Empty: not known, or this participant may not know it. To be shown to this person alone, and
    // kept nowhere else.
    const wire::Patient& patient() const { return patient_; }
    // The newest answer, without texts if this participant may not know them; as patient().
    const wire::Patient& asked_patient() const { return asked_patient_; }
    const std::vector<wire::RelayGrant>& relay_grants() const { return relay_grants_; }
    const wire::RelayReceivers& relay_receivers() const { return relay_receivers_; }
    const wire::StudyStep& study_step() const { return study_step_; }
    const wire::StudyReplied& study_reply() const { return study_reply_; }
    const wire::ChatMessages& chat() const { return chat_; }
    const Wishes& wishes() const { return wishes_; }

private:
    void take_settings(std::vector<wire::StreamSetting> settings);
    void add_cameras(std::vector<wire::Camera> cameras);
    bool change_camera(wire::Camera camera);
    void remove_cameras(const wire::CamerasRemoved& removed);

    Change on_people(wire::ToParticipant message);

    Wishes wishes_;
    bool joined_ = false;
    wire::Welcome welcome_;
    std::vector<wire::Text> left_out_;
    std::vector<CameraId> interrupted_;
    std::vector<wire::StreamSetting> settings_;
    wire::Text note_;
    std::map<CameraId, wire::CameraState> camera_states_;
    wire::Text refusal_;
    wire::Pong pong_;
    wire::Delivery delivery_;
    wire::SetRenderer renderer_command_;
    wire::Text goodbye_;
    wire::Published published_;
    wire::ShareEnded share_ended_;
    wire::Encode encode_;
    wire::EncodeKey encode_key_;
    wire::ToParticipant room_;
    wire::Waiting waiting_;
    wire::Standing standing_;
    std::vector<wire::Visitor> visitors_;
    wire::Managed managed_;
    std::vector<wire::OfferedCase> offered_cases_;
    wire::Content content_;
    std::optional<wire::Playback> playback_;
    wire::Patient patient_, asked_patient_;
    std::vector<wire::RelayGrant> relay_grants_;
    wire::RelayReceivers relay_receivers_;
    wire::StudyStep study_step_;
    wire::StudyReplied study_reply_;
    wire::ChatMessages chat_;
};

}  // namespace theatron::session

// SPDX-License-Identifier: Apache-2.0
// The host's authority over a session: dispatches each message of a participant, once admission has
// let the participant in, to the state machine that it concerns. A pure state machine: messages and
// times go in, actions come out.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/ids.h"
#include "base/time.h"
#include "session/admission.h"
#include "session/camera_adjusting.h"
#include "session/host_actions.h"
#include "session/host_chat.h"
#include "session/host_room.h"
#include "session/link_budgets.h"
#include "session/look_backs.h"
#include "session/membership.h"
#include "session/offered_cases.h"
#include "session/own_faces.h"
#include "session/relay_paths.h"
#include "session/renderers.h"
#include "session/shared_cameras.h"
#include "session/streams.h"
#include "session/studies.h"
#include "wire/control.h"
#include "wire/media_header.h"

namespace theatron::session {

class HostSession {
public:
    // A codec in canonical spelling, which is not empty, or a sentence about the problem.
    struct CheckedCodec {
        std::string codec;
        std::string problem;
    };
    using CheckCodec = std::function<CheckedCodec(const std::string&)>;

    struct Config {
        Admission::Config admission;
        wire::SessionId session{};          // of this run
        std::string name;                   // of the room, shown to participants
        std::vector<wire::Camera> cameras;  // the host's own from the beginning; their numbers and
                                            // streams are given, from 0 on
        std::set<CameraId> absent = {};     // numbers among them, of cameras that come later
        CheckCodec check_depth, check_color;
        SessionCameras::Config streams;
        ObjectsSnapshot room;       // from the previous run
        HostRoom::Authors authors;  // of its marks
        // Those of them that may_know_patient() are told who the patient of the open case is.
        std::vector<Role> patient_for = {Role::operator_};
        PastBounds past = {};                     // that participants may look back at
        RelayPaths::MakeSecret make_secret = {};  // empty: there are no relays
        OwnFaces::MakeDigest make_digest = {};    // empty: nobody shows a face of their own
    };

    explicit HostSession(Config config);
    HostSession(const HostSession&) = delete;
    HostSession& operator=(const HostSession&) = delete;

    // `address`: at which the host sees the participant; empty: not known.
    void on_connected(ParticipantId participant, TimePoint now, const std::string& address = "");
    void on_control(ParticipantId participant, ByteView message, TimePoint now);
    void on_closed(ParticipantId participant);
    void on_tick(TimePoint now);
    // Call it ten times a second for each participant.
    void on_link(ParticipantId participant, const LinkMeasure& link, TimePoint now);
    // Messages to this participant were dropped because it did not read: sends the state again.
    void resynchronise(ParticipantId participant);
    // Ends the session: all participants get a Goodbye with this reason. Further ones are refused
    // until an operator comes, with whom a new session begins: its room is empty, and decisions on
    // people are forgotten.
    void end(wire::TextCode reason = wire::TextCode::session_over);
    bool has_ended() const { return has_ended_; }

    // Other tokens are valid from now on. Participants who came by a link that is no longer among
    // them are removed. `makers`: of links that were not made at the host, for the audit log.
    void set_tokens(std::vector<Admission::Token> tokens,
                    const std::map<std::string, std::string>& makers = {});
    // Makes a link invalid. `by`: as in AuditEvent.
    void revoke_link(const std::string& link, const std::string& by);
    // Carries out a decision of somebody who is no participant, as one of an operator. `by`: as in
    // AuditEvent.
    wire::ManageRefusal manage(const wire::Manage& decision, TimePoint now,
                               const std::string& by = at_the_host);
    // Everyone who waits for admission.
    std::vector<wire::Visitor> visitors() const;
    // The tokens of links by which those came who were removed and are kept out.
    std::vector<std::string> tokens_of_removed() const { return membership_.tokens_of_removed(); }

    // Those who are sent a frame.
    struct Recipients {
        std::vector<ParticipantId> receivers;
        std::vector<ParticipantId> relays;  // sealed, for their receivers
        int layer = 0;                      // of the frame, for these
    };
    // A frame of a camera of the host was encoded, `size` bytes.
    Recipients on_media(const wire::MediaHeader& header, std::size_t size, TimePoint now);
    // A participant has sent a media message. A message that belongs to no camera of this
    // participant ends its connection with a reason.
    Recipients on_media_from(ParticipantId publisher, ByteView message, TimePoint now);
    // The key with which the pictures for relays are sealed now.
    const RelayPaths::Key& relay_key(TimePoint now) const { return relays_.key(now); }

    // A frame of a camera of the host was encoded: it may be kept for looking back.
    void keep(const wire::MediaHeader& header, ByteView message, TimePoint now) {
        look_back_.keep(header, message, now);
    }
    // See LookBacks.
    std::vector<LookBacks::Due> take_past(TimePoint now) { return look_back_.take_due(now); }
    std::optional<TimePoint> past_due() const { return look_back_.due(); }
    std::size_t past_bytes() const { return look_back_.bytes(); }

    // The relays, and what comes from them.
    const RelayPaths& relays() const { return relays_; }

    // A pose of an object in the room, to be sent to the receivers of the result at once.
    HostRoom::Forward on_object_pose(ParticipantId participant, const wire::State& state,
                                     TimePoint now) {
        return room_.on_pose(participant, state, now);
    }
    const HostRoom& room() const { return room_; }
    // See OwnFaces.
    bool on_own_face(ParticipantId participant, const wire::State& state, TimePoint now) {
        return faces_.put(participant, state, now);
    }
    std::shared_ptr<const Bytes> own_face(const ContentHash& content) const {
        return faces_.content(content);
    }
    // See HostRoom::replay().
    std::vector<ObjectPose> replay_room(const RoomObjects& recorded, TimePoint now);
    // The cases that can be opened from now on, in this order, at most wire::max_offered_cases, and
    // their patients, as far as they are known, and their content.
    void set_cases(std::vector<CaseFacts> cases, std::vector<wire::Patient> patients = {},
                   OfferedCases::Content content = {}) {
        cases_.set(std::move(cases), std::move(patients), std::move(content));
    }
    // The participant has sent far more poses or voice than a host sends on: its connection ends.
    void end_flood(ParticipantId participant, TimePoint now);
    // False, and counted, if its role does not allow this.
    bool allow(ParticipantId participant, Right right);

    // See CameraAdjusting.
    wire::ManageRefusal adjust(CameraId camera, const CameraAdjustment& adjustment,
                               const std::string& by, TimePoint now) {
        return adjusting_.adjust(camera, adjustment, by, now);
    }
    // One of Config::absent has come; its number is camera.id.
    void add_camera(wire::Camera camera) { shared_.add_own({std::move(camera)}); }
    // See Streams.
    void set_calibration(CameraId camera, const Bytes& calibration) {
        streams_.set_calibration(camera, calibration);
    }
    void set_estimated_gain(CameraId camera, Vec3 gain) {
        streams_.set_estimated_gain(camera, gain);
    }
    // Where the recording of the host is from now on; told to all.
    void set_playback(const wire::Playback& playback);

    // The condition of the host's own cameras, and measurements of encoding them.
    void on_camera(const wire::CameraState& state) { streams_.on_state(state); }
    void on_region(bool is_drawn) { streams_.on_region(is_drawn); }
    void on_encoding(CameraId camera, SettingId setting, bool keeps_up, double ms_per_picture) {
        streams_.on_encoding(camera, setting, keeps_up, ms_per_picture);
    }
    // A frame could not be sent: this stream needs a key frame.
    void on_broken_stream(StreamId stream, SettingId setting) {
        streams_.request_key(stream, setting);
    }

    // See Renderers: that of all participants, of one, or of those with a name.
    void set_renderer(const wire::SetRenderer& wish) { renderers_.set(wish); }
    void set_renderer(ParticipantId participant, const wire::SetRenderer& wish) {
        renderers_.set(participant, wish);
    }
    void set_renderer(const std::string& name, const wire::SetRenderer& wish) {
        renderers_.set(name, wish);
    }

    // See Admission.
    bool knows_again(const wire::Join& hello, TimePoint now) const {
        return admission_.knows_again(hello, now);
    }

    // Actions for the host to carry out, in order.
    std::vector<Action> take_actions();

    // The settings in which a camera is to be encoded.
    const std::vector<ActiveSetting>& depth_settings(CameraId camera = {}) const;
    const std::vector<ActiveSetting>& color_settings(CameraId camera = {}) const;
    // See Streams.
    bool all_wait(CameraId camera, const std::function<bool(ParticipantId)>& is_behind) const {
        return streams_.all_wait(camera, is_behind);
    }
    std::vector<ParticipantId> receivers(StreamId stream, SettingId setting) const {
        return streams_.receivers(stream, setting);
    }
    std::string step_of(ParticipantId participant) { return streams_.step_of(participant); }
    const Streams& streams() const { return streams_; }
    const std::map<ParticipantId, Admission::Participant>& participants() const {
        return admission_.participants();
    }

private:
    using Participant = Admission::Participant;

    static CheckedCodec checked(const CheckCodec& check, const std::string& codec);
    void join(ParticipantId id, const wire::Join& message, TimePoint now);
    void enter(ParticipantId id, const wire::Join& message);
    void begin_again(const std::string& by);
    // Answers a message that the participant's role does not allow.
    void deny(ParticipantId id, const wire::ToHost& message);
    // One for each kind of message of a participant who has joined.
    void carry_out(ParticipantId id, const wire::Join& message, TimePoint now);
    void carry_out(ParticipantId id, const wire::ChooseCodecs& message, TimePoint now);
    void carry_out(ParticipantId id, const wire::RequestKey& message, TimePoint now);
    void carry_out(ParticipantId id, const wire::Ping& message, TimePoint now);
    void carry_out(ParticipantId id, const wire::Report& message, TimePoint now);
    void carry_out(ParticipantId id, const wire::ChooseDelivery& message, TimePoint now);
    void carry_out(ParticipantId id, const wire::Publish& message, TimePoint now);
    void carry_out(ParticipantId id, const wire::Unpublish& message, TimePoint now);
    void carry_out(ParticipantId id, const wire::CameraState& message, TimePoint now);
    void carry_out(ParticipantId id, const wire::RoomRequest& message, TimePoint now);
    void carry_out(ParticipantId id, const wire::Manage& message, TimePoint now);
    void carry_out(ParticipantId id, const wire::RequestContent& message, TimePoint now);
    void carry_out(ParticipantId id, const wire::VoiceConsent& message, TimePoint now);
    void carry_out(ParticipantId id, const wire::AdjustCamera& message, TimePoint now);
    void carry_out(ParticipantId id, const wire::Play& message, TimePoint now);
    void carry_out(ParticipantId id, const wire::LookBack& message, TimePoint now);
    void carry_out(ParticipantId id, const wire::OfferRelay& message, TimePoint now);
    void carry_out(ParticipantId id, const wire::RelayReport& message, TimePoint now);
    void carry_out(ParticipantId id, const wire::AskPatient& message, TimePoint now);
    void carry_out(ParticipantId id, const wire::ShowStudy& message, TimePoint now);
    void carry_out(ParticipantId id, const wire::StudyReply& message, TimePoint now);
    void carry_out(ParticipantId id, const wire::SetCondition& message, TimePoint now);
    void carry_out(ParticipantId id, const wire::WriteChat& message, TimePoint now);
    void carry_out(ParticipantId id, const wire::RaiseHand& message, TimePoint now);
    wire::ManageRefusal set_condition(ParticipantId by, const wire::SetCondition& condition);
    void end_condition(ParticipantId id);
    void end_leading(ParticipantId leader);
    void follow_relays();
    Recipients recipients(std::vector<ParticipantId> receivers, const wire::MediaHeader& header,
                          TimePoint now);
    void carry_out_late(ParticipantId id, Participant& participant, TimePoint now);
    // `by`: the operator; 0: no participant. `by_name`: as in AuditEvent.
    wire::ManageRefusal manage(const wire::Manage& decision, ParticipantId by,
                               const std::string& by_name, TimePoint now);
    wire::ManageRefusal clear_objects(ParticipantId id, const std::string& by);
    void set_role(ParticipantId id, Role role);
    // This connection and the others of the same person.
    std::vector<ParticipantId> connections_of(ParticipantId id);
    void remove_without_link(const std::string& by);
    static PersonFacts facts_of(const Participant& person);
    void tell_standing(ParticipantId id);
    void tell_operators();
    void tell_of_own_id(ParticipantId newcomer);
    void tell_playback(ParticipantId id);
    void audit_link(AuditEvent::What what, Role role, const std::string& link,
                    const std::string& by);
    void audit(AuditEvent::What what, ParticipantId id, std::string by = "",
               std::string detail = "");
    void describe_session(ParticipantId id);
    void leave_everything(ParticipantId id, Removal cameras);
    void refuse(ParticipantId id, wire::Text reason);
    void make_way(const Admission::Replaced& replaced);
    void send(ParticipantId id, wire::ToParticipant message);

    const Config config_;
    std::vector<Action> actions_;
    Admission admission_;
    LinkBudgets link_budgets_;
    TimePoint noted_here_;  // for the budgets
    TimePoint now_;         // of the newest message, frame or tick
    Membership membership_;
    Streams streams_;
    LookBacks look_back_;
    RelayPaths relays_;
    std::uint64_t streams_seen_ = 0;  // Streams::changes() at the last follow_paths()
    HostRoom room_;
    SharedCameras shared_;
    CameraAdjusting adjusting_;
    Renderers renderers_;
    OfferedCases cases_;
    OwnFaces faces_;
    Studies studies_;
    HostChat chat_;
    bool has_ended_ = false;
    std::optional<wire::Playback> playback_;
};

}  // namespace theatron::session

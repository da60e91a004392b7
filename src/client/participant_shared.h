// SPDX-License-Identifier: Apache-2.0
// State of a participant that several threads use.
#pragma once

#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/line_limit.h"
#include "base/steady_clock.h"
#include "client/participant.h"
#include "net/clock_sync.h"

namespace theatron::client {

// In the number of a connection to a relay; see Decoders::on_media().
inline constexpr std::uint64_t relayed_link = std::uint64_t(1) << 63;

// People whose poses and expressions are kept; a session has fewer.
inline constexpr std::size_t max_poses = 256;

// The loop that makes connections, one after the other.
struct Participant::Loop {
    virtual ~Loop() = default;
};

// State shared with other threads, under `mutex`.
// A value that Decoders::set_cameras() never returns.
inline constexpr std::uint64_t no_generation = ~std::uint64_t(0);

struct Participant::Shared {
    mutable std::mutex mutex;
    std::condition_variable changed;
    Status status;
    std::vector<Camera> cameras;
    std::uint64_t generation = 0;
    std::vector<wire::StreamSetting> settings;
    std::map<CameraId, receive::CameraFramePtr> newest;  // not yet taken
    std::uint64_t decoder_generation = 0;                // of the cameras that these belong to
    std::uint64_t connection = 0;                        // counts them
    std::size_t taken = 0;    // bytes that decoders took, not yet passed to the client
    bool is_telling = false;  // tell_taken() has been posted
    std::vector<receive::StreamFigures> figures;
    MomentFigures moments;
    bool reset_wanted = false;
    net::ClockSync clock;
    net::Client* client = nullptr;  // while one runs
    bool stopping = false;
    std::string depth_wish, color_wish;  // codecs to ask for
    std::optional<wire::ChooseDelivery> delivery_wish;
    std::optional<wire::SetRenderer> renderer_command;  // not yet taken
    std::string renderer;
    std::map<ParticipantId, wire::PersonPose> poses;
    std::optional<wire::PersonPose> own_pose;  // not yet sent
    std::map<ParticipantId, wire::FaceExpression> expressions;
    std::optional<wire::FaceExpression> own_expression;  // not yet sent
    std::shared_ptr<const Bytes> own_face;               // null: none is shown
    session::FaceUpload::State own_face_state{};
    std::deque<Bytes> voice;  // packets not yet sent
    bool voice_may_record = false;
    bool asks_voice_consent = false;  // the host does, on this connection
    session::MemberChat chat;
    bool has_chat = false;                 // the host has one, on the newest connection
    std::optional<TimePoint> muted_since;  // on this connection
    std::optional<bool> hand_wish;         // that the room does not show yet
    std::optional<TimePoint> hand_told;    // when the host was told of it
    bool hand_shown = false;               // by the newest room
    session::RaisedHands hands;            // of the room's people
    session::MemberRoom room;
    bool is_telling_room = false;    // tell_room() has been posted
    bool is_asking_content = false;  // request_content() has been posted
    bool has_standing = false;       // on this connection
    std::vector<wire::Visitor> visitors;
    std::uint32_t decisions = 0;                           // sent, for their numbers
    std::deque<wire::Managed> managed;                     // answers not yet taken
    bool may_adjust = false;                               // the host knows adjustments
    std::optional<wire::Playback> playback;                // of the host's recording
    bool can_look_back = false;                            // the host keeps the last minute
    wire::Patient patient;                                 // empty: not known
    wire::Patient asked_patient;                           // the newest answer
    bool may_ask_patient = false;                          // the host answers
    std::optional<Study> study;                            // on this connection
    std::uint64_t study_steps = 0;                         // that have come
    bool may_lead_study = false;                           // the host knows studies
    std::deque<wire::StudyReplied> study_replies;          // not yet taken
    std::map<CameraId, wire::ChooseCodecs> camera_wishes;  // the same for single cameras
    std::array<std::vector<wire::OfferedCamera>, Participant::offers>
        offers;                     // by Participant::Offer
    std::size_t media_waiting = 0;  // for the participant's thread
    LineLimit remarks_of_others{8};
    // Adds a remark about another participant, who must not hide what others do by all that it
    // does.
    void add_remark(std::vector<std::string>& remarks, const std::string& source,
                    const std::string& text) {
        if (const auto left_out = remarks_of_others.take(source, steady_now()))
            remarks.push_back(*left_out > 0 ? text + " (+" + std::to_string(*left_out) + ")"
                                            : text);
    }
    bool own_hand_is_up() const { return hands.has(room.self()); }
    std::set<std::pair<StreamId, SettingId>> broken;  // frames of these were dropped
    std::set<StreamId> relayed_streams;               // at the last tick
};

}  // namespace theatron::client

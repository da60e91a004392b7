// SPDX-License-Identifier: Apache-2.0
// The implementation of a Host: the state that its threads share. That of the network port,
// which several sessions may share, is in host/host_port.h.
#pragma once

#include <atomic>
#include <condition_variable>
#include <map>
#include <mutex>
#include <set>

#include "base/fault.h"
#include "base/line_limit.h"
#include "base/steady_clock.h"
#include "capture/camera_places.h"
#include "host/case_shelf.h"
#include "host/filter_choice.h"
#include "host/gain_watch.h"
#include "host/host.h"
#include "host/host_identity.h"
#include "host/host_port.h"
#include "host/lane_slots.h"
#include "host/link_keeper.h"
#include "host/missing_camera.h"
#include "host/place_watch.h"
#include "host/recording_program.h"
#include "host/room_file.h"
#include "host/room_replay.h"
#include "host/session_audit.h"
#include "host/session_port.h"
#include "host/thumbnail.h"
#include "net/sealed_media.h"
#include "send/color_watch.h"
#include "send/media_queue.h"
#include "session/audit_budget.h"
#include "session/host_session.h"
#include "session/pose_board.h"
#include "session/voice_floor.h"

namespace theatron::host {

// `people_are_replayed`: the people whom the recording has are in the room.
wire::Camera describe(const capture::CameraInfo& info, bool people_are_replayed);

// For the outbox of a receiver.
net::Media media_of(const wire::MediaHeader& header, std::shared_ptr<const Bytes> message);

struct Host::Impl {
    std::atomic<std::size_t>& participants;
    std::shared_ptr<HostPort> port;  // perhaps with other sessions
    std::filesystem::path state_folder;
    std::unique_ptr<LinkKeeper> links;
    std::uint64_t links_read = 0;                  // how often; used by the owner of the host
    std::atomic<std::uint64_t> links_applied = 0;  // the newest that the session knows
    std::string metrics_token;
    bool asks = false;
    bool has_ended = false;     // the session, before the host did
    bool ends_by_host = false;  // as in Host
    wire::TextCode farewell = wire::TextCode::session_over;
    std::string in_logs;                  // the session's name; empty: the first one
    std::unique_ptr<SessionAudit> audit;  // may be null
    session::AuditBudget audited;         // server's thread
    std::unique_ptr<session::HostSession> session;
    std::unique_ptr<SessionPort> server;
    capture::CameraPlaces places;      // does not change once lanes run
    std::deque<Thumbnail> thumbnails;  // by camera; does not change once lanes run
    std::unique_ptr<RecordingProgram> recording;
    LaneSlots lanes;
    std::shared_ptr<send::SharedMoments> moments;  // of all lanes
    // A camera that was missing when the host began, by its number.
    struct Missing {
        std::string specification, name;  // as expected_name()
        LoadedFilter filter;
        std::string problem;  // why it is not there, or not taken; `search` knows the newest
        std::unique_ptr<MissingCamera> search;  // null: it is not tried any more
    };
    mutable std::mutex missing_mutex;
    std::map<std::size_t, Missing> missing;   // guarded by missing_mutex
    std::unique_ptr<PlaceWatch> place_watch;  // does not change once lanes run
    std::unique_ptr<GainWatch> gain_watch;    // does not change once lanes run
    send::ColorWatch color_watch;             // on the thread of the server
    std::vector<FilterSource> filters;        // by camera; used by the owner of the host
    send::MediaQueue media;                   // from the lanes to the server's thread
    std::mutex states_mutex;
    std::map<CameraId, wire::CameraState> new_states;   // the same way; the newest of each
    std::map<CameraId, wire::CameraState> lane_states;  // as the lanes report them
    std::map<CameraId, wire::Text> misplaced;           // what place_watch says; by states_mutex
    // Last logged state of each camera; `problem` is kept from the time when it was last live.
    // Server's thread.
    std::map<CameraId, wire::CameraState> told_states;
    // Addresses of peers; server's thread.
    std::map<net::PeerId, std::string> addresses;
    std::map<net::PeerId, TimePoint> heard;  // when the last control message came
    LineLimit joins, changes;                // of log lines; server's thread
    // The cameras with a region of interest; server's thread.
    std::set<std::size_t> with_region;
    std::set<std::size_t> held;  // lanes; server's thread
    session::PoseBoard poses;    // server's thread
    session::VoiceFloor voices;  // server's thread
    // Seals the pictures for relays; server's thread.
    std::optional<net::MediaSealer> sealer;
    // Problems of the host that operators know, and when they were told; server's thread.
    std::map<std::pair<ParticipantId, std::string>, TimePoint> told_problems;
    std::optional<StateLock> state_lock;
    std::unique_ptr<RoomFile> room_file;  // server's thread
    std::optional<TimePoint> alarm_at;    // of the server; server's thread
    // Frames dropped per camera because a receiver was too slow; server's thread.
    std::map<CameraId, std::uint64_t> dropped_slow;
    // Bytes of participants' cameras, and the time from its moment to the exposure of the newest
    // picture; server's thread.
    struct Received {
        std::uint64_t bytes = 0;
        std::optional<Duration> sync_offset;
        std::optional<bool> is_compared;  // it is a camera of the room, no screen
    };
    std::map<CameraId, Received> received;
    mutable std::mutex figures_mutex;
    std::vector<HostFigures::Participant> participant_figures;
    std::vector<HostFigures::Published> published_figures;
    std::map<CameraId, session::CameraAdjustment> adjusted_figures;
    std::vector<wire::Visitor> visitor_figures;
    std::vector<std::string> case_problem_figures;
    std::string registration_problem;
    bool ended_figure = false;
    std::size_t past_figure = 0;
    std::vector<std::string> tokens_held_back;
    std::map<CameraId, std::uint64_t> dropped_slow_figures;
    std::string name;
    const TimePoint begun = steady_now();

    std::set<net::PeerId> leaving;  // a Goodbye was sent to them; server's thread
    std::mutex goodbye_mutex;
    std::condition_variable goodbye_changed;
    bool all_left = false;  // guarded by goodbye_mutex

    // The recording that the cameras play; does not change once lanes run.
    std::optional<PlayedRecording> played;
    struct PlayedCamera {
        std::size_t number = 0;              // in the recording
        const Bytes* calibration = nullptr;  // of the recording, as it is shown
    };
    std::map<CameraId, PlayedCamera> played_cameras;  // server's thread
    // Last playback state that was sent to participants; server's thread.
    std::optional<capture::Transport::State> told_playback;
    std::unique_ptr<RoomReplay> replay;             // uses the lanes and the server
    std::unique_ptr<CaseShelf> cases;               // its thread posts to the server; may be null
    std::optional<CaseShelf::Offer> offered_cases;  // the newest; server's thread
    std::string said_lost_case;                     // server's thread

    explicit Impl(std::atomic<std::size_t>& count) : participants(count) {}
    ~Impl() {
        const bool has_begun = server && server->has_begun();
        // While the session still answers, so that nothing is missing in its file.
        if (has_begun && recording)
            recording->end();
        if (has_begun)
            (void)contain("the goodbye of a session", [&] { say_goodbye(); });
        replay.reset();
        drop_missing();
        // The server's thread uses the lanes: it leaves them first. The lanes use the watches,
        // whose threads post to the server.
        if (server)
            server->leave();
        if (has_begun)
            (void)contain("the end of a session", [&] { keep_for_next_time(); });
        lanes.clear();
        place_watch.reset();
        gain_watch.reset();
    }

    // Saves the room, and ends the audit log of this session.
    void keep_for_next_time();
    // `port` is set before; it opens for the first session.
    void open(const SessionOptions& options, const capture::Progress& progress);
    void audit_beginning();
    std::string token_of(wire::Role role) const;
    net::Server::Handler handler();
    PortSession in_port();
    void start_replay();
    // The camera of this number gets its lane.
    void start_lane(std::size_t number, const std::string& specification,
                    std::unique_ptr<capture::Camera> camera, const LoadedFilter& filter);
    std::unique_ptr<capture::Camera> open_or_miss(std::size_t number,
                                                  const std::string& specification,
                                                  const capture::Progress& progress);
    void require_any(const std::vector<std::unique_ptr<capture::Camera>>& cameras) const;
    // Tries to open those that are in `missing`.
    void start_searches();
    void drop_missing();
    // The name of a camera, also of a missing one.
    std::string camera_name(std::size_t camera) const;

    // All below on the server's thread.
    // A camera that was missing is there.
    void take_found(std::size_t number, std::unique_ptr<capture::Camera> camera);
    void add_found(std::size_t number, const Missing& expected,
                   std::unique_ptr<capture::Camera> camera);
    // A decision of somebody who is no participant. `by`: as in session::AuditEvent.
    void decide(const wire::Manage& decision, const std::string& by = session::at_the_host);
    void take_links();
    // On any thread: the link of a recording that has ended, once; its end is in the audit log.
    std::optional<std::string> ended_recording();
    void follow_recording();
    void carry_out();
    void carry_out(const session::action::Send& a);
    void carry_out(const session::action::Close& a);
    void carry_out(const session::action::Drop& a);
    void carry_out(const session::action::End& a);
    void carry_out(const session::action::Joined& a);
    void carry_out(const session::action::RequestKey& a);
    void carry_out(const session::action::ChangeSettings& a);
    void carry_out(const session::action::TakeMedia& a);
    void carry_out(const session::action::KeepEverything& a);
    void carry_out(const session::action::SetCeiling& a);
    void carry_out(const session::action::Delay& a);
    void carry_out(const session::action::ChangeRights& a);
    void carry_out(const session::action::Stepped& a);
    void carry_out(const session::action::Drawing& a);
    void carry_out(const session::action::Audit& a);
    void carry_out(const session::action::RevokeLink& a);
    void carry_out(const session::action::SendContent& a);
    void carry_out(const session::action::SendState& a);
    void carry_out(const session::action::Adjusted& a);
    void carry_out(const session::action::Play& a);
    void follow_playback(const std::string& by);
    void crop(const session::CameraStreams& camera);
    void correct_place(const session::CameraStreams& camera);
    void hold_lane(std::size_t camera);
    void hold_lanes();
    void release_lanes();
    void distribute_media();
    void distribute(const send::EncodedMedia& media);
    // A participant has sent a media message.
    void forward(net::PeerId publisher, std::shared_ptr<const Bytes> message);
    void note_received(ParticipantId publisher, const wire::MediaHeader& header, std::size_t size);
    void send_media(const net::Media& encoded, const std::vector<ParticipantId>& receivers);
    // To relays, if there are any.
    void send_sealed(const wire::MediaHeader& header, ByteView message,
                     const session::HostSession::Recipients& to);
    void on_camera_states();
    void take_state(net::PeerId peer, const wire::State& state);
    // The peer is told why.
    void end_flood(net::PeerId peer, const std::string& why);
    void forward_object_pose(net::PeerId peer, const wire::State& state);
    void forward_voice(net::PeerId peer, const wire::Voice& voice);
    void replay_room(const RoomReplay::Change& change);
    void replay_voices(const std::vector<RoomReplay::Speech>& speech);
    void set_alarm();
    void on_alarm();
    void send_past();
    void send_poses();
    void send_poses_to(ParticipantId receiver,
                       const std::vector<session::PoseBoard::Entry>& entries);
    void measure_links();
    void take_cases(const CaseShelf::Offer& offer);
    // A sentence if the open case is not offered any more; else empty.
    std::string lost_case() const;
    std::vector<std::string> case_problems() const;
    void note_participants();
    void tell_problems();

    void note_left(net::PeerId peer);

    // Sends a Goodbye to all participants, and waits a little until they have left.
    void say_goodbye();

    // From any thread.
    void take_media(send::EncodedMedia encoded);
    void take_camera_state(wire::CameraState state);
    void take_place(CameraId camera, const wire::Text& problem);
    void take_gains(const SettledGains::Gains& gains);
    bool pass_on(wire::CameraState state);
    std::vector<std::string> http_tokens() const;
    // The link whose token this is; it may have expired. On any thread.
    std::optional<session::Admission::Token> find_token(const std::string& secret) const;
    // True if a participant with this role waits for admission.
    bool must_ask(wire::Role role) const;
    // True if somebody who came by the link of this token was removed and is kept out.
    bool is_held_back(const std::string& secret) const;
    HostFigures figures() const;
    send::LaneFigures figures_of_missing(std::size_t camera) const;
    HostFigures::Problems problems() const;
};

}  // namespace theatron::host

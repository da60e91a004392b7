// SPDX-License-Identifier: Apache-2.0
// A participant: one connection to a host, with automatic reconnection, and the
// newest decoded images of every camera. In a browser the page's events take the place of its
// threads.
#pragma once

#include <array>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/moment_meter.h"
#include "client/attempts.h"
#include "client/case_keeper.h"
#include "client/decoders.h"
#include "client/face_keeper.h"
#include "client/relay_reception.h"
#include "geometry/calibration.h"
#include "net/client.h"
#include "session/camera_adjustment.h"
#include "session/face_upload.h"
#include "session/key_requests.h"
#include "session/member_chat.h"
#include "session/member_room.h"
#include "session/raised_hands.h"
#include "session/relay_arrivals.h"
#include "session/viewer_session.h"
#include "wire/face_expression.h"
#include "wire/person_pose.h"

namespace theatron::client {

class Participant {
public:
    static constexpr std::size_t max_remark_characters = 300;

    // Callbacks of a participant that sends cameras, on the participant's thread.
    struct Publishing {
        // The numbers of the cameras of publish(), in their order. Each connection gives new
        // numbers; an empty list: the connection is lost, or the host refused the cameras.
        std::function<void(const std::vector<CameraId>&)> published;
        // Somebody has ended these screens for all; they are not offered again.
        std::function<void(const std::vector<CameraId>&)> ended;
        // The settings of these cameras from now on; a stream without a setting is not encoded.
        std::function<void(const std::vector<wire::StreamSetting>&)> encode;
        // The next frame of this stream in this setting must be a key frame.
        std::function<void(StreamId, SettingId)> encode_key;
    };

    struct Options {
        net::Link link;
        std::string name = "guest";
        std::string depth_codec = "strata";
        std::string color_codec = "jpeg:quality=85";
        wire::ChooseDelivery delivery{150, 0};
        bool is_page = false;   // as in Attempts
        std::uint64_t run = 0;  // as in wire::Join; 0: a number of this participant's own
        // The messages and the hand of an earlier stay of the same run.
        session::MemberChat chat = {};
        bool raises_hand = false;
        bool records = false;     // as in wire::Join
        bool sends_only = false;  // as in wire::Join: gets no cameras of others
        Bytes person;             // the secret of client/person_id.h
        // Messages for the user: reconnecting, refused, a camera ended. Called
        // from the participant's thread with one line of clean text.
        std::function<void(const std::string&)> remark;
        // Messages of others as one line with their author, and own ones that are not sent: to be
        // shown to the person and kept nowhere, so not for a log. From the participant's thread.
        std::function<void(const std::string&)> written;
        // If set, media is not decoded but passed to this function. Called from
        // the participant's thread; the message is valid during the call.
        std::function<void(const wire::MediaHeader&, ByteView message)> media;
        // Called when cameras() or settings() are new, or when the clock becomes known on this
        // connection. From the participant's thread, before the media to which this applies.
        std::function<void()> described;
        // These cameras have left, since their publisher's connection broke. From the
        // participant's thread, before `described` without them.
        std::function<void(const std::vector<CameraId>&)> interrupted;
        // Another participant's pose has arrived; a pose without head and hands means that the
        // participant has left. Called from the participant's thread.
        std::function<void(ParticipantId, const wire::PersonPose&)> pose;
        // A packet of voice (voice/packet.h) of another participant has arrived. Called from the
        // participant's thread; the packet is valid during the call.
        std::function<void(ParticipantId speaker, ByteView packet)> voice;
        // Called when a frame can be taken or the connection has changed, from the
        // participant's thread or a decoding thread.
        std::function<void()> news;
        Publishing publishing;  // needed for publish()
        Publishing face;        // needed for publish_face()
        Publishing screen;      // needed for show_screen()
        // Is told of the faces of others (wire::CameraKind::face), too; they are cameras.
        bool takes_faces = false;
        // Keeps the objects of the room; needed for room() and the functions below it.
        bool keeps_room = false;
        // Takes the content of the case that is open in the room; needs keeps_room.
        bool keeps_cases = false;
        // Takes the own faces of the others; see own_faces().
        bool takes_own_faces = false;
        // Shows patient() to this person, and to nobody else.
        bool shows_patient = false;
        // This person agrees that others record its voice; see allow_voice_recording().
        bool voice_may_record = false;
        // Shows steps of a study to this person, or leads one as an operator's program.
        bool knows_studies = false;
        // Shows this person what people write, and who raises a hand; needs keeps_room for that.
        bool shows_chat = false;
        // Shows the colour of one camera as it is, without depth and renderer.
        bool draws_flat = false;
        // Takes pictures from a relay, where the host names one. Not in a browser.
        bool by_relay = false;
        // Frames without depth, of cameras whose depth is not asked for (wire/no_codec.h), can be
        // taken, too.
        bool takes_color_alone = false;
        // An object of the room or its pose has changed. Called from the participant's thread.
        std::function<void()> room_changed;
    };

    // How long a person waits for a host that was stopped and may return; then the visit ends.
    // Recorders and publishers wait for ever.
    static constexpr Duration return_patience = std::chrono::minutes(2);

    // Begins to connect at once, on a thread of its own. Throws Error if name, token and
    // codecs do not fit into the first message.
    explicit Participant(Options options);
    ~Participant();

    enum class Phase {
        connecting,
        waiting,  // until an operator lets this participant in
        joined,
        lost,     // and tried again
        refused,  // for good, or before it was ever in
        ended,
    };
    struct Status {
        Phase phase = Phase::connecting;
        std::string problem;       // why lost, refused or ended
        bool is_outdated = false;  // as in Attempts::Judged
        std::string host_name;
        Duration round_trip{};         // the shortest of the last exchanges
        Duration newest_round_trip{};  // of the last one
        int pongs = 0;                 // exchanges so far
        Duration clock_error{};
        bool clock_known = false;  // now() is the session's time
        bool has_room = false;     // people and objects will come, or are here
        int joins = 0;             // successful joins; 1 if the connection was never lost
        wire::ChooseDelivery goal;
        std::uint64_t media_dropped = 0;  // frames of send_media() that were too late to be sent
        std::string publish_problem;  // why the host refused the cameras of publish(); else empty
        std::string face_problem;     // the same of publish_face()
        std::string screen_problem;   // the same of show_screen()
        wire::Standing standing;      // this participant's role, while joined
        wire::Delivery delivery;      // the part of the requested data that the host sends
    };
    Status status() const;

    struct Camera {
        wire::Camera description;
        Calibration calibration;
        wire::CameraState state;
        wire::TextCode told_problem = wire::TextCode::none;  // when it was last live
    };
    // All cameras of the session. `generation` grows whenever some came, left or changed.
    std::vector<Camera> cameras(std::uint64_t& generation) const;

    // How the host sends each stream to this participant.
    std::vector<wire::StreamSetting> settings() const;

    // From within `media` and `described` only: asks the host for a key frame.
    void request_key(StreamId stream, SettingId setting);

    // The newest frame of each camera that has a new one since the last call.
    std::vector<receive::CameraFramePtr> take_frames();
    // For a page: see Decoders::want_frames().
    void want_frames();

    // Waits until a frame can be taken, at most `timeout`. False after the timeout.
    bool wait_for_frame(Duration timeout);

    std::vector<receive::StreamFigures> figures() const;
    // Figures of the pictures that have arrived, of the room's cameras, without the past.
    MomentFigures moments() const;
    void reset_figures();
    // The streams whose frames come from a relay now.
    std::set<StreamId> relayed_streams() const;

    // Estimated session time, now and at a time of the steady clock.
    TimePoint now() const;
    TimePoint session_time(TimePoint steady) const;

    // Requests other codecs; an empty text keeps the codec.
    void choose_codecs(const std::string& depth, const std::string& color);

    // The same for one camera, until codecs are chosen for all.
    void choose_codecs(CameraId camera, const std::string& depth, const std::string& color);

    // From any thread: offers these cameras to the session, again after each loss of the
    // connection; an empty list withdraws them. The host's numbers for them go to
    // Options::publishing.
    void publish(std::vector<wire::OfferedCamera> cameras);
    // The same for the picture of this person's face, apart from the cameras: a camera of
    // CameraKind::face. Its number goes to Options::face.
    void publish_face(std::optional<wire::OfferedCamera> face);
    // The same for a screen whose pictures come as JPEG: a camera of CameraKind::screen. Its number
    // goes to Options::screen. One that others have ended is not offered again.
    void show_screen(std::optional<wire::OfferedCamera> screen);
    // From any thread: sends a frame of such a camera, encoded as the host asked, with the camera's
    // stream in its header and session times (now()). `message` is header and payload. A frame that
    // cannot be sent in time is dropped, and a key frame is requested.
    void send_media(const wire::MediaHeader& header, std::shared_ptr<const Bytes> message);
    // From any thread: reports the condition of such a camera.
    void tell_camera(const wire::CameraState& state);

    // The host's newest renderer command since the last call, if any. Each join also gives one,
    // with an empty renderer: commands of an earlier connection no longer apply.
    std::optional<wire::SetRenderer> take_renderer_command();
    // Reports this participant's renderer to the host.
    void tell_renderer(const std::string& renderer);

    // Sends this participant's pose, from any thread. Only the newest one is sent; the others get
    // up to 90 in a second (session/pose_board.h).
    void send_pose(const wire::PersonPose& pose);
    // The newest pose of each other participant that sent one.
    std::map<ParticipantId, wire::PersonPose> poses() const;

    // The same for what this participant's face shows, and the faces of the others. Nothing is sent
    // without this call; one of state `none` ends it.
    void send_expression(const wire::FaceExpression& expression);
    std::map<ParticipantId, wire::FaceExpression> expressions() const;

    // From any thread: the others see this face (face/sent_face.h) of this person from now on,
    // again after each loss of the connection; null ends it, and the host forgets it. At most
    // wire::max_own_face_bytes. It leaves in pieces, beside everything else.
    void show_own_face(std::shared_ptr<const Bytes> face);
    session::FaceUpload::State own_face_state() const;
    // The faces of the others that have come whole. Empty without Options::takes_own_faces.
    FaceKeeper::Faces own_faces() const;

    // Sends a packet of this participant's voice (voice/packet.h), from any thread. The oldest are
    // dropped if they cannot be sent at once. The others get it with this participant's number.
    void send_voice(ByteView packet);
    // From any thread: this person agrees from now on that others record its voice, or no longer.
    // The host sends it to no recorder before that. Holds on later connections, too.
    void allow_voice_recording(bool agrees);
    bool voice_may_record() const;
    // False if the host is too old to know of such an agreement: then nobody records the voice.
    bool asks_voice_consent() const;

    // Messages of people to all others, from any thread; empty without Options::shows_chat.
    struct Chat {
        std::vector<wire::ChatMessage> messages;  // the oldest first
        std::set<std::uint64_t> own;              // those of this program, by WriteChat::id
        std::vector<std::string> unsent;          // of this person, that the host may not have yet
        std::uint64_t version = 0;                // grows with each change
    };
    Chat chat() const;
    // For Options::chat of the next stay.
    session::MemberChat chat_so_far() const;
    std::uint64_t chat_version() const;
    // The host has a chat and raised hands; and this person may write there.
    bool has_chat() const;
    bool may_write() const;
    // False: nothing of it is visible, the person may not write, or too many messages wait for the
    // host. Where the connection is lost, the message is sent once there is another one.
    bool write_chat(const std::string& text);
    // Raises this person's hand, or takes it down. False: not joined, or the host is of an earlier
    // version. The room says whether the hand is up.
    bool raise_hand(bool raised);
    bool hand_raised() const;
    // For Options::raises_hand of the next stay: what the person asked for last, also where the
    // room does not show it yet.
    bool wants_hand_raised() const;
    // All hands that are up, the first that was raised first.
    std::vector<session::RaisedHands::Hand> raised_hands() const;

    // The room, from any thread. A request or a move changes room() at once; a refusal of the host
    // takes that back. People are objects of kind `person` (session/room_bytes.h).
    struct Room {
        ParticipantId self{};
        std::uint64_t version = 0;  // grows with every change
        session::RoomObjects objects;
    };
    Room room() const;
    std::uint64_t room_version() const;
    // The participants that record, without those of a replay.
    struct Recording {
        std::string name;
        TimePoint since;  // session time
    };
    std::vector<Recording> recordings() const;
    ParticipantId room_self() const;
    // Sends a request to the host. Returns its number; 0 while the room is not known.
    std::uint32_t ask_room(const session::Request& request);
    // Moves an object (metres) that this participant holds. False if it does not hold it.
    bool move_object(session::ObjectId object, const Pose& room_from_object, double scale);
    // The oldest refusal of a request not taken yet, with the request's number; if any.
    std::optional<std::pair<std::uint32_t, session::Refusal>> take_room_refusal();

    // The host's cases, from any thread. Empty without Options::keeps_cases.
    std::vector<wire::OfferedCase> cases() const;
    // See CaseKeeper::open().
    std::optional<OpenCase> open_case(std::uint64_t& version) const;
    // The patient of the open case; empty: not known, or this person may not know it. Show
    // it to this person alone, and keep it nowhere else: neither in files nor in figures or logs.
    wire::Patient patient() const;
    // Asks whose case this offered one is, before it is opened. False, and there will be no answer:
    // not joined, without Options::shows_patient, or the host is of an earlier version.
    bool ask_patient(const ContentHash& offered);
    // The newest answer; its texts are empty where this person may not know them. As patient().
    wire::Patient asked_patient() const;

    // For operators, from any thread: the people who wait for admission now.
    std::vector<wire::Visitor> visitors() const;
    // Sends a decision on a person. Returns its number; 0 while not joined.
    std::uint32_t manage(wire::ManageAction action, ParticipantId person = {},
                         wire::Role role = {});
    // Adjusts a camera for all; kept within its limits. The answer is a Managed, too. Returns its
    // number; 0 while not joined, or where the host cannot do this.
    std::uint32_t adjust(CameraId camera, const session::CameraAdjustment& adjustment);
    // Asks the host to play its recording, for all. The answer is a Managed, too. Returns its
    // number; 0 while not joined, or where the host cannot do this.
    std::uint32_t play(wire::PlayAction action, Duration position = {});
    // Where that recording is; empty: the host plays none.
    std::optional<wire::Playback> playback() const;
    // Shows this participant the cameras of the room as they were `ago`, as far as the host keeps
    // it, and goes on from there; 0: the present again. The others are not concerned. Returns its
    // number; 0 while not joined, or where the host keeps nothing.
    std::uint32_t look_back(Duration ago);
    bool can_look_back() const;
    // True from the host's answer on, until it sends the present again.
    bool looks_back() const { return !past_cameras().empty(); }
    // The cameras whose past the host sends.
    std::set<CameraId> past_cameras() const;
    // The oldest answer to a decision that is not taken yet, if any.
    std::optional<wire::Managed> take_managed();

    // The step of a study that this person is to see, and a number that grows with each one that
    // comes; nullopt: none has come on this connection.
    struct Study {
        wire::StudyStep step;
        std::uint64_t version = 0;
    };
    std::optional<Study> study() const;
    // Sends this person's reply to a step. False: not joined.
    bool reply_to_study(const wire::StudyReply& reply);
    // For an operator's program that leads a study: shows a step to a participant, sets what it
    // sees. The answers are Managed, too. Both return their number; 0 while not joined, or where
    // the host knows no studies.
    std::uint32_t show_study(ParticipantId person, const wire::StudyStep& step);
    std::uint32_t set_condition(const wire::SetCondition& condition);
    // The oldest reply that is not taken yet, if any.
    std::optional<wire::StudyReplied> take_study_reply();

    // Requests another target latency and ceiling.
    void choose_delivery(const wire::ChooseDelivery& goal);

private:
    void start();
    void give_up();
    bool begin_connection(net::Client& client);
    std::optional<Duration> end_connection(const net::Client::End& end);
    net::Client::Handler handler();
    Decoders::Events decoded_events();
    void on_control(ByteView message);
    bool on_media(Bytes& message);
    void on_taken(std::uint64_t connection, std::size_t bytes);
    void tell_taken();
    void on_state(const wire::State& state);
    void tell_pose();
    void tell_expression();
    void on_expression(ParticipantId person, ByteView body);
    void send_own_face();
    void on_own_face(ParticipantId person, ByteView body);
    void tell_voice();
    void tell_voice_consent();
    void on_chat();
    void tell_chat();
    void give_up_chat();
    void tell_written(const std::string& text) const;
    void tell_hand(TimePoint now);
    void follow_hands();
    void on_room_message();
    void tell_content();
    void request_content();
    void tell_room();
    void on_waiting();
    void on_standing();
    void follow_role(wire::Role before, wire::Role now);
    void on_visitors();
    void on_managed();
    void on_playback();
    void on_patient();
    void on_study();
    void on_study_reply();
    std::uint32_t decide(auto decision);
    // Cameras of one offer are answered and withdrawn together.
    enum class Offer : std::size_t { cameras, face, screen };
    static constexpr std::array all_offers{Offer::cameras, Offer::face, Offer::screen};
    static constexpr std::size_t offers = all_offers.size();
    const Publishing& events(Offer offer) const {
        return offer == Offer::face     ? options_.face
               : offer == Offer::screen ? options_.screen
                                        : options_.publishing;
    }
    void set_offer(Offer which, std::optional<wire::OfferedCamera> camera);
    std::string& problem_of(Offer offer) const;
    std::vector<CameraId>& numbers(Offer offer) { return numbers_[std::size_t(offer)]; }
    void offer_cameras(Offer offer);
    void offer_all();
    // On the participant's thread, before it leaves: its cameras end, and none has broken off.
    void withdraw();
    void end_offered(Offer offer, const wire::ShareEnded& message);
    void forget_numbers(Offer offer);
    void take_back(std::vector<CameraId> cameras);
    void on_published();
    void on_share_ended();
    void refuse_cameras(Offer offer, const wire::Text& why);
    void on_encode();
    void on_encode_key(StreamId stream, SettingId setting);
    void on_encode_keys();
    void push_media(const wire::MediaHeader& header, std::shared_ptr<const Bytes> message);
    // Relays.
    void end_relays();
    void on_relay_grants();
    void on_relayed_media(std::uint64_t link, Bytes& message);
    RelayReception::Events relay_events();
    bool has_come_by_relay(ByteView message);
    SettingId relayed_setting(StreamId stream, TimePoint now) const;
    void note_relayed_streams(TimePoint now);
    void compare_cameras();
    void note_moment(const wire::MediaHeader& header);
    void on_welcome();
    void on_cameras();
    void on_camera_states();
    void on_tick();
    bool waits() const;  // for admission
    void ping(TimePoint local);
    void announce() const;
    void remark(const std::string& text) const;

    const Options options_;

    // The participant's thread only, unless under mutex_.
    session::ViewerSession session_;
    TimePoint next_ping_, next_report_;
    int pings_ = 0;
    std::array<std::vector<CameraId>, offers> numbers_;  // of the cameras that it sends
    std::deque<Offer> offered_;                          // without an answer of the host
    session::KeyRequests missing_keys_;  // of its own streams, where frames could not be sent
    session::RelayArrivals arrivals_;
    std::map<CameraId, ParticipantId> compared_;  // cameras in moments_, and their publishers
    MomentMeter moments_;
    session::FaceUpload upload_;

    struct Shared;
    std::unique_ptr<Shared> shared_;
    // Their threads use shared_.
    std::unique_ptr<RelayReception> relay_reception_;  // null without Options::by_relay
    std::unique_ptr<Decoders> decoders_;               // its threads use all above
    std::unique_ptr<CaseKeeper> cases_;                // its threads use all above; may be null
    std::unique_ptr<FaceKeeper> faces_;                // may be null
    Attempts attempts_;

    // The thread, in a browser the page's events: participant_loop_native.cpp, _web.cpp.
    struct Loop;
    struct ThreadLoop;
    struct EventLoop;
    std::unique_ptr<Loop> loop_;
};

}  // namespace theatron::client

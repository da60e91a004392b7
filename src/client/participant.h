// SPDX-License-Identifier: Apache-2.0
// A participant: one connection to a host that finds back by itself, and the
// newest decoded images of every camera.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "client/decoders.h"
#include "geometry/calibration.h"
#include "net/client.h"
#include "session/viewer_session.h"
#include "wire/person_pose.h"

namespace theatron::client {

class Participant {
public:
    static constexpr std::size_t max_remark_characters = 300;

    struct Options {
        net::Link link;
        std::string name = "guest";
        std::string depth_codec = "strata";
        std::string color_codec = "jpeg:quality=85";
        wire::ChooseDelivery delivery{150, 0};
        bool records = false;  // as in wire::Join
        // Told what a person should know: reconnecting, refused, a camera ended.
        // Called from the participant's thread with one line of clean text.
        std::function<void(const std::string&)> remark;
        // If set, media goes here as it comes instead of being decoded. Called
        // from the participant's thread; the message is valid during the call.
        std::function<void(const wire::MediaHeader&, ByteView message)> media;
        // Told that cameras() or settings() are new, or that the clock is known on this connection.
        // Called from the participant's thread, before the media that this is about.
        std::function<void()> described;
        // Somebody's pose has come; one without parts says that this participant has left. Called
        // from the participant's thread.
        std::function<void(ParticipantId, const wire::PersonPose&)> pose;
        // Told that a frame can be taken or the connection has changed. Called from
        // the participant's thread.
        std::function<void()> news;
    };

    // Begins to connect at once, on a thread of its own. Throws Error for a codec
    // that does not exist.
    explicit Participant(Options options);
    ~Participant();

    enum class Phase { connecting, joined, lost, refused, ended };
    struct Status {
        Phase phase = Phase::connecting;
        std::string problem;  // why lost, refused or ended
        std::string host_name;
        Duration round_trip{};         // the shortest of the last exchanges
        Duration newest_round_trip{};  // of the last one
        int pongs = 0;                 // how many exchanges there were
        Duration clock_error{};
        bool clock_known = false;  // now() is the session's time
        int joins = 0;             // how often it got in, 1 without any loss
        wire::ChooseDelivery goal;
        wire::Delivery delivery;  // how much of what was asked for the host sends
    };
    Status status() const;

    struct Camera {
        wire::Camera description;
        Calibration calibration;
        wire::CameraState state;
    };
    // All cameras of the host; `generation` grows whenever they changed.
    std::vector<Camera> cameras(std::uint64_t& generation) const;

    // How the host sends each stream to this participant.
    std::vector<wire::StreamSetting> settings() const;

    // From within `media` and `described` only: asks the host for a key frame.
    void request_key(StreamId stream, SettingId setting);

    // The newest frame of each camera that is newer than what was taken before.
    std::vector<receive::CameraFramePtr> take_frames();

    // Waits until some frame is there to be taken, at most `timeout`.
    bool wait_for_frame(Duration timeout);

    std::vector<receive::StreamFigures> figures() const;
    void reset_figures();

    // Session time now, as well as it is known; of a moment on the steady clock.
    TimePoint now() const;
    TimePoint session_time(TimePoint steady) const;

    // Other codecs from now on; an empty text keeps the codec.
    void choose_codecs(const std::string& depth, const std::string& color);

    // What the host said about drawing since the last call, if anything. With a new connection its
    // earlier words no longer hold: that is a word, too.
    std::optional<wire::SetRenderer> take_renderer_word();
    // Tells the host how this participant draws.
    void tell_renderer(const std::string& renderer);

    // Where this participant is, from any thread. The newest is sent; the others get up to 90 a
    // second (session/pose_board.h).
    void send_pose(const wire::PersonPose& pose);
    // The newest pose of each of the others who sent one.
    std::map<ParticipantId, wire::PersonPose> poses() const;

    // Another target latency and ceiling from now on.
    void choose_delivery(const wire::ChooseDelivery& goal);

private:
    void run();
    void give_up();
    net::Client::Handler handler();
    Decoders::Events decoded_events();
    void on_control(ByteView message);
    bool on_media(Bytes& message);
    void on_taken(std::uint64_t connection, std::size_t bytes);
    void tell_taken();
    void on_state(const wire::State& state);
    void tell_pose();
    void on_camera_states();
    void on_tick();
    void ping(TimePoint local);
    void announce() const;
    void remark(const std::string& text) const;

    const Options options_;

    // The participant's thread only, unless under mutex_.
    session::ViewerSession session_;
    TimePoint next_ping_, next_report_;
    int pings_ = 0;

    struct Shared;
    std::unique_ptr<Shared> shared_;
    std::unique_ptr<Decoders> decoders_;  // its threads use what is shared
    std::thread thread_;
};

}  // namespace theatron::client

// SPDX-License-Identifier: Apache-2.0
// The host's authority over a session: who is in, with what rights, and which
// encodings each participant gets. A pure state machine: messages and times go
// in, messages and wishes to the cameras come out.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/ids.h"
#include "base/time.h"
#include "session/delivery.h"
#include "session/host_actions.h"
#include "session/key_requests.h"
#include "session/request_budget.h"
#include "session/setting_table.h"
#include "session/stream_rates.h"
#include "wire/control.h"
#include "wire/media_header.h"

namespace theatron::session {

class HostSession {
public:
    // A codec text in its one spelling, which is not empty, or what is wrong with it.
    struct CheckedCodec {
        std::string codec;
        std::string problem;
    };
    using CheckCodec = std::function<CheckedCodec(const std::string&)>;

    struct Config {
        std::string token;  // who shows it may join
        std::string name;   // of the room, shown to participants
        std::vector<wire::Camera> cameras;
        CheckCodec check_depth, check_color;
        // Compares secrets in constant time; given, because this module has no crypto.
        std::function<bool(std::string_view, std::string_view)> equal_secrets;
        CodecSteps steps;  // how to send less
        // In their one spelling; others cannot take their places (SettingTable). Empty: none.
        std::string usual_depth, usual_color;
    };

    explicit HostSession(Config config);
    HostSession(const HostSession&) = delete;
    HostSession& operator=(const HostSession&) = delete;

    // Connections that have not joined by then are closed.
    static constexpr Duration join_deadline = std::chrono::seconds(5);
    // Each may have much waiting to be sent (net::Outbox::max_kept_bytes). One more is refused.
    static constexpr int max_recorders = 4;

    void on_connected(ParticipantId participant, TimePoint now);
    void on_control(ParticipantId participant, ByteView message, TimePoint now);
    void on_closed(ParticipantId participant);
    // Messages to this participant were lost, because it did not read: tells it everything again.
    void resynchronise(ParticipantId participant);
    void on_camera(const wire::CameraState& state);
    // Whether any camera has a region of interest. Without one no depth may be lossy
    // for the sake of a slow link.
    void on_region(bool is_drawn);
    // How everybody should draw, also who joins later. Forgets what was said to single ones.
    void set_renderer(const wire::SetRenderer& word);
    // How one should draw, as long as it stays.
    void set_renderer(ParticipantId participant, const wire::SetRenderer& word);
    // How those with this name should draw, now and when they join again.
    void set_renderer(const std::string& name, const wire::SetRenderer& word);
    // Encoding one camera in this setting keeps up with it no longer, or does again: it takes
    // `ms_per_picture` of a core. Those who get the setting are told.
    void on_encoding(CameraId camera, SettingId setting, bool keeps_up, double ms_per_picture);
    // A frame could not be sent: this participant's stream needs a key frame.
    void on_broken_stream(StreamId stream, SettingId setting);
    // Ten times a second for each participant.
    void on_link(ParticipantId participant, const LinkMeasure& link, TimePoint now);
    void on_tick(TimePoint now);
    // The session is over: everybody is told so.
    void end();

    // A frame was encoded, `size` bytes. Who gets it.
    std::vector<ParticipantId> on_media(const wire::MediaHeader& header, std::size_t size,
                                        TimePoint now);

    // What is to be done, in order.
    std::vector<Action> take_actions();

    const std::vector<ActiveSetting>& depth_settings() const { return depth_.active(); }
    const std::vector<ActiveSetting>& color_settings() const { return color_.active(); }

    // Whether a frame would have to wait at everybody who takes part. Who is sent less when
    // frames are late is not waited for; with nobody there is none to wait for.
    bool all_wait(const std::function<bool(ParticipantId)>& is_behind) const;

    // Who gets frames of this stream in this setting.
    std::vector<ParticipantId> receivers(StreamId stream, SettingId setting) const;

    struct Participant {
        // `streams`: how many the host has.
        explicit Participant(std::size_t streams) : budget(streams) {}

        bool joined = false;
        bool closing = false;
        bool takes_part() const { return joined && !closing; }
        TimePoint connected;
        std::string name;
        std::uint16_t protocol = 0;
        bool records = false;                  // as in wire::Join
        std::string asked_depth, asked_color;  // codecs that it asked for
        SettingId depth_setting{}, color_setting{};
        std::vector<wire::StreamReport> report;          // the newest
        std::string renderer;                            // how it draws, as it says; may be empty
        TimePoint renderer_noted;                        // when that was last believed
        std::optional<wire::SetRenderer> renderer_word;  // said to this one alone
        Delivery delivery;
        RequestBudget budget;
        // The newest of what was asked for too often; carried out as soon as it may be.
        std::optional<wire::ChooseCodecs> late_codecs;
        std::optional<wire::ChooseDelivery> late_goal;
    };
    const std::map<ParticipantId, Participant>& participants() const { return participants_; }

private:
    void join(ParticipantId id, const wire::Join& message);
    void describe_session(ParticipantId id);
    void carry_out(ParticipantId id, const wire::ToHost& message, TimePoint now);
    void keep_for_later(Participant& participant, wire::ToHost message);
    void carry_out_late(ParticipantId id, Participant& participant, TimePoint now);
    Duration made_in(const Participant& participant) const;
    void choose(ParticipantId id, const std::string& depth, const std::string& color);
    void set_goal(ParticipantId id, const wire::ChooseDelivery& goal);
    void wish(ParticipantId id, const std::string& depth, const std::string& color);
    void set_wish(ParticipantId id);
    void take_step(ParticipantId id);
    bool is_chain(SettingId color) const;
    int layer_for(const Participant& participant, const wire::MediaHeader& header) const;
    double frames_per_second() const;
    void note_report(ParticipantId id, const wire::Report& report, TimePoint now);
    void tell_renderer(ParticipantId id);
    void refuse(ParticipantId id, std::string reason);
    void apply_settings();
    void send(ParticipantId id, wire::ToParticipant message);
    std::string check(const CheckCodec& check, const std::string& text, std::string& codec) const;

    Config config_;
    std::map<ParticipantId, Participant> participants_;
    std::map<CameraId, wire::CameraState> camera_states_;
    bool region_is_drawn_ = false;
    std::optional<wire::SetRenderer> renderer_word_;           // to all
    std::map<std::string, wire::SetRenderer> renderer_words_;  // to those with a name
    SettingNumbers numbers_;
    SettingTable depth_, color_;
    std::set<std::pair<CameraId, SettingId>> slow_;
    std::vector<ActiveSetting> announced_depth_, announced_color_;
    KeyRequests key_requests_;
    StreamRates rates_;
    std::map<SettingId, Duration> made_in_;  // from exposure to encoded, about
    struct NewestDepth {
        FrameNumber frame = 0;
        int layer = 0;
    };
    std::map<std::pair<CameraId, SettingId>, NewestDepth> newest_depth_;
    std::vector<Action> actions_;
};

}  // namespace theatron::session

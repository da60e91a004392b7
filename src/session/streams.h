// SPDX-License-Identifier: Apache-2.0
// The cameras of a session and their receivers: both come and go, each receiver chooses codecs for
// each camera, and each camera is encoded in as few settings as serve all of its receivers.
//
// A pure state machine; it appends to the actions that it was given.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "base/ids.h"
#include "base/time.h"
#include "session/announced_cameras.h"
#include "session/camera_streams.h"
#include "session/delivery.h"
#include "session/host_actions.h"
#include "session/key_requests.h"
#include "session/stream_rates.h"

namespace theatron::session {

// The publisher of the host's own cameras.
inline constexpr ParticipantId host_publisher{0};

class Streams {
public:
    struct Config {
        CodecSteps codecs;           // how to send less
        CameraStreams::Usual usual;  // in their one spelling; empty: none
    };
    // `actions` outlives the streams.
    Streams(Config config, std::vector<Action>& actions)
        : config_(std::move(config)), actions_(actions) {}
    Streams(const Streams&) = delete;
    Streams& operator=(const Streams&) = delete;

    // Between cameras whose places in the room are not known, along x: so far that none stands in
    // another's picture.
    static constexpr double unregistered_distance_m = 12;

    // Cameras. Numbers and streams are given here; numbers never come again. Cameras without a
    // place in the room are put beside each other. Needs has_numbers_for() them.
    void add(ParticipantId publisher, std::vector<wire::Camera> cameras);
    // The number of the camera that comes next, and of those behind it.
    CameraId next_id(std::size_t further) const { return CameraId(next_camera_ + int(further)); }
    bool has_numbers_for(std::size_t cameras) const {
        return next_camera_ + int(cameras) <= max_camera_number + 1;
    }
    std::size_t size() const { return cameras_.size(); }
    // How to encode a camera; empty if there is no such camera.
    const std::vector<ActiveSetting>& settings(CameraId camera, bool depth) const;
    // Cameras that are not there are passed over.
    void remove(const std::vector<CameraId>& cameras);
    // Null if there is no such camera.
    const CameraStreams* find(CameraId camera) const;
    std::vector<CameraId> of(ParticipantId publisher) const;
    std::vector<wire::Camera> cameras() const;
    // Those that a participant receives: all but its own.
    std::vector<wire::Camera> seen_by(ParticipantId participant) const;
    std::vector<wire::CameraState> states_seen_by(ParticipantId participant) const;
    void on_state(const wire::CameraState& state);
    // `is_drawn`: some camera has a region of interest. Without one no depth may be lossy for the
    // sake of a slow link.
    void on_region(bool is_drawn);
    // Encoding keeps up with the camera no longer, or does again: it takes `ms_per_picture` of a
    // core. Those who get the setting are told.
    void on_encoding(CameraId camera, SettingId setting, bool keeps_up, double ms_per_picture);

    // Receivers. Codecs are in their one spelling.
    struct Wish {
        std::string depth, color;
    };
    // One that records is sent everything, and keeps its encodings whatever others do.
    void join(ParticipantId receiver, const Wish& wish, bool records);
    void leave(ParticipantId receiver);
    // An empty text keeps the codec. No cameras: of all, also of those that come.
    void choose(ParticipantId receiver, const Wish& wish, const std::vector<CameraId>& cameras);
    void set_goal(ParticipantId receiver, const wire::ChooseDelivery& goal);
    // The measurements of a receiver's link, ten times a second.
    void on_link(ParticipantId receiver, const LinkMeasure& link, TimePoint now);
    // Messages to this participant were lost: sends it everything that holds now.
    void tell_again(ParticipantId participant);
    // The step on which this receiver is, for people; empty if it receives nothing.
    std::string step_of(ParticipantId receiver);

    // Media. A frame was encoded, `size` bytes. Returns its receivers.
    std::vector<ParticipantId> on_media(const wire::MediaHeader& header, std::size_t size,
                                        TimePoint now);
    // The receivers of this stream in this setting.
    std::vector<ParticipantId> receivers(StreamId stream, SettingId setting) const;
    // The stream needs a key frame.
    void request_key(StreamId stream, SettingId setting);
    // The same, asked for by a receiver; nothing if it does not get that.
    void request_key(ParticipantId receiver, StreamId stream, SettingId setting);
    void on_tick(TimePoint now);

    // True if a frame of this camera would have to wait at every receiver. Receivers that are sent
    // less when frames are late do not count as waiting; without any receiver it is false.
    bool all_wait(CameraId camera, const std::function<bool(ParticipantId)>& is_behind) const;

private:
    struct Receiver {
        Wish wish;
        std::map<CameraId, Wish> wishes;  // for single cameras; empty texts: as `wish`
        bool records = false;
        Delivery delivery;

        const std::string& wished(CameraId camera, bool depth) const;
    };

    void send(ParticipantId participant, wire::ToParticipant message) {
        actions_.push_back(action::Send{participant, std::move(message)});
    }
    void set_wish(ParticipantId id, Receiver& receiver, CameraStreams& camera, bool depth);
    void take_step(ParticipantId id, Receiver& receiver);
    void take_step(ParticipantId id, Receiver& receiver, CameraStreams& camera);
    int free_slot() const;
    const LadderStep& step_for(ParticipantId id, Receiver& receiver, const CameraStreams& camera);
    // Brings encoders and receivers in line with the tables.
    void apply();
    void tell_publisher(ParticipantId publisher);
    void tell_receiver(ParticipantId id, Receiver& receiver);
    std::string note_for(ParticipantId id, Receiver& receiver, const CameraStreams& camera);
    Duration made_in(ParticipantId id) const;
    double frames_per_second() const;

    const Config config_;
    std::vector<Action>& actions_;
    SettingNumbers numbers_;
    int next_camera_ = 0;
    std::map<CameraId, CameraStreams> cameras_;
    std::map<ParticipantId, Receiver> receivers_;
    KeyRequests key_requests_;
    StreamRates rates_;
    bool region_is_drawn_ = false;
};

}  // namespace theatron::session

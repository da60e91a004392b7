// SPDX-License-Identifier: Apache-2.0
// The cameras of a session and their receivers. Both come and go, each receiver chooses codecs for
// each camera, and each camera is encoded in as few settings as its receivers need.
//
// A pure state machine; it appends its actions to the list given to the constructor.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/ids.h"
#include "base/time.h"
#include "session/announced_cameras.h"
#include "session/camera_adjustment.h"
#include "session/camera_streams.h"
#include "session/delivery.h"
#include "session/host_actions.h"
#include "session/kept_adjustments.h"
#include "session/key_requests.h"
#include "session/stream_rates.h"

namespace theatron::session {

// The publisher of the host's own cameras.
inline constexpr ParticipantId host_publisher{0};

// A stream of a participant's camera in one of its settings, and those who get it.
struct StreamUse {
    struct Receiver {
        ParticipantId id{};
        bool may_be_direct = false;  // it needs not every frame, and has no ceiling
    };
    ParticipantId publisher{};
    StreamId stream{};
    SettingId setting{};
    std::vector<Receiver> receivers;
    bool is_kept = false;  // for looking back
};

class Streams {
public:
    struct Config {
        CodecSteps codecs;                             // for the ladders
        CameraStreams::Usual usual;                    // in canonical spelling; empty: none
        std::vector<KeptAdjustment> adjustments = {};  // of the previous run
    };
    // `actions` must outlive the streams.
    Streams(Config config, std::vector<Action>& actions)
        : config_(std::move(config)), actions_(actions), adjustments_(config_.adjustments) {}
    Streams(const Streams&) = delete;
    Streams& operator=(const Streams&) = delete;

    // Distance along x between cameras without a known place in the room: so large that none is in
    // another's picture.
    static constexpr double unregistered_distance_m = 12;

    // Adds cameras and gives them their numbers and streams; no number is used twice. Cameras
    // without a place in the room are put side by side. Cameras that were adjusted before are so
    // again. `publisher_name` is empty for the host. Needs has_numbers_for() them.
    void add(ParticipantId publisher, std::vector<wire::Camera> cameras,
             const std::string& publisher_name = "");
    // The number of the next camera, or of the one `further` behind it.
    CameraId next_id(std::size_t further) const { return CameraId(next_camera_ + int(further)); }
    bool has_numbers_for(std::size_t cameras) const {
        return next_camera_ + int(cameras) <= max_camera_number + 1;
    }
    std::size_t size() const { return cameras_.size(); }
    // The settings in which a camera is to be encoded; empty if there is no such camera.
    const std::vector<ActiveSetting>& settings(CameraId camera, bool depth) const;
    // Unknown cameras are skipped.
    void remove(const std::vector<CameraId>& cameras);
    // Null if there is no such camera.
    const CameraStreams* find(CameraId camera) const;
    std::vector<CameraId> of(ParticipantId publisher) const;
    std::vector<wire::Camera> cameras() const;
    // The cameras that a participant receives: all but its own.
    std::vector<wire::Camera> seen_by(ParticipantId participant, bool takes_faces = false) const;
    std::vector<wire::CameraState> states_seen_by(ParticipantId participant,
                                                  bool takes_faces = false) const;
    // The pictures of faces among the cameras.
    std::size_t faces() const;
    void on_state(const wire::CameraState& state);
    // Adjusts a camera for all who see it. Cameras that move with a person cannot be, and only the
    // host's own have a region.
    wire::ManageRefusal adjust(CameraId camera, const CameraAdjustment& adjustment);
    // A camera is registered anew, with the same lenses; told to all who see it.
    void set_calibration(CameraId camera, const Bytes& calibration);
    // The same for gains that were estimated; a camera keeps those of its own (CameraStreams).
    void set_estimated_gain(CameraId camera, Vec3 gain);
    // Those of all cameras that are or were here.
    const std::vector<KeptAdjustment>& adjustments() const { return adjustments_.all(); }
    // `is_drawn`: some camera has a region of interest. Without one, depth never becomes lossy
    // because of a slow link.
    void on_region(bool is_drawn);
    // Encoding no longer keeps up with the camera, or does again: it takes `ms_per_picture` of a
    // core. The receivers of the setting get a note.
    void on_encoding(CameraId camera, SettingId setting, bool keeps_up, double ms_per_picture);

    // Receivers. Codecs are in canonical spelling.
    struct Wish {
        std::string depth, color;
    };
    // A receiver that records gets everything, and others do not change its encodings. Faces go to
    // receivers that take them, in codecs of their own (face_limits.h).
    void join(ParticipantId receiver, const Wish& wish, bool records, bool takes_faces = false);
    void leave(ParticipantId receiver);
    // An empty text keeps the codec. Empty `cameras`: for all, also for later ones.
    void choose(ParticipantId receiver, const Wish& wish, const std::vector<CameraId>& cameras);
    void set_goal(ParticipantId receiver, const wire::ChooseDelivery& goal);
    // The receiver is shown the past of exactly these cameras (look_back.h): it gets nothing of
    // their present, and no settings. Those of before that are not among them it gets anew.
    void look_back(ParticipantId receiver, std::set<CameraId> cameras);
    // Numbers for settings of the past.
    SettingId take_number() { return numbers_.take(); }
    void give_number_back(SettingId number) { numbers_.give_back(number); }
    // The measurements of a receiver's link, ten times a second.
    void on_link(ParticipantId receiver, const LinkMeasure& link, TimePoint now);
    // Messages to this participant were dropped: sends it the current state.
    void tell_again(ParticipantId participant);
    // The step of this receiver, as text for people; empty if it receives nothing.
    std::string step_of(ParticipantId receiver);

    // Media. A frame was encoded, `size` bytes. Returns its receivers.
    std::vector<ParticipantId> on_media(const wire::MediaHeader& header, std::size_t size,
                                        TimePoint now);
    // The setting of this stream that is kept for looking back: the one that has been active for
    // longest. Null if the camera may not be kept, or is not encoded.
    const ActiveSetting* kept_setting(StreamId stream) const;
    // The receivers of this stream in this setting.
    std::vector<ParticipantId> receivers(StreamId stream, SettingId setting) const;
    // All streams of participants' cameras, without faces, whose frames have limits at the host.
    std::vector<StreamUse> uses() const;
    // Grows whenever uses() may have changed.
    std::uint64_t changes() const { return changes_; }
    // The stream needs a key frame.
    void request_key(StreamId stream, SettingId setting);
    // The same at the request of a receiver; ignored if it does not get this stream and setting.
    void request_key(ParticipantId receiver, StreamId stream, SettingId setting);
    void on_tick(TimePoint now);

    // True if a frame of this camera would have to wait at every receiver; those who look back wait
    // for none. Receivers that are sent
    // less when frames are late do not count as waiting; without any receiver it is false.
    bool all_wait(CameraId camera, const std::function<bool(ParticipantId)>& is_behind) const;

private:
    struct Receiver {
        Wish wish;
        std::map<CameraId, Wish> wishes;  // for single cameras; empty texts: as `wish`
        bool records = false, takes_faces = false;
        bool has_ceiling = false;
        std::set<CameraId> past;  // that it is shown the past of
        Delivery delivery;

        const std::string& wished(CameraId camera, bool depth) const;
    };

    void send(ParticipantId participant, wire::ToParticipant message) {
        actions_.push_back(action::Send{participant, std::move(message)});
    }
    static bool gets(const CameraStreams& camera, ParticipantId id, const Receiver& receiver) {
        return camera.is_for(id, receiver.takes_faces, receiver.records);
    }
    void tell_changed(const CameraStreams& camera);
    void set_wish(ParticipantId id, Receiver& receiver, CameraStreams& camera, bool depth);
    void take_step(ParticipantId id, Receiver& receiver);
    void take_step(ParticipantId id, Receiver& receiver, CameraStreams& camera);
    int free_slot() const;
    const LadderStep& step_for(ParticipantId id, Receiver& receiver, const CameraStreams& camera);
    // Brings encoders and receivers in line with the tables.
    void apply();
    void tell_publisher(ParticipantId publisher);
    void tell_receiver(ParticipantId id, Receiver& receiver);
    wire::Text note_for(ParticipantId id, Receiver& receiver, const CameraStreams& camera);
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
    KeptAdjustments adjustments_;
    std::uint64_t changes_ = 0;
};

}  // namespace theatron::session

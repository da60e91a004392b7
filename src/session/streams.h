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
#include "session/host_actions.h"
#include "session/key_requests.h"
#include "session/request_budget.h"
#include "session/session_cameras.h"
#include "session/stream_rates.h"
#include "session/stream_receiver.h"

namespace theatron::session {

// A stream in one of its settings, and those who get its present.
struct StreamUse {
    struct Receiver {
        ParticipantId id{};
        int highest_layer = 0;             // that it is sent
        std::uint32_t max_kbit_per_s = 0;  // of all that it is sent; 0: no ceiling
    };
    StreamId stream{};
    SettingId setting{};
    std::vector<Receiver> receivers;
};

// Why cameras leave: it was decided, by their publisher or by somebody else, or their publisher's
// connection broke.
enum class Removal { decided, interrupted };

class Streams {
public:
    // Changes of encodings in a session. Those beyond this limit wait for a tick, and what has
    // become of them by then is one change: whoever joins in other codecs again and again makes
    // little work for the encoders.
    static constexpr RequestBudget::Limit encoding_changes{2, 40};

    // `actions` must outlive the streams.
    Streams(const SessionCameras::Config& config, std::vector<Action>& actions)
        : codecs_(config.codecs), actions_(actions), cameras_(config, numbers_) {}
    Streams(const Streams&) = delete;
    Streams& operator=(const Streams&) = delete;

    // Adds cameras (SessionCameras::add()) and tells those who see them.
    // `given_names`: those that have another name now; empty: none have.
    void add(ParticipantId publisher, std::vector<wire::Camera> cameras,
             const std::string& publisher_name = "",
             const std::vector<std::string>& given_names = {});
    // As in SessionCameras.
    void keep_numbers(int below) { cameras_.keep_numbers(below); }
    // Unknown cameras are skipped.
    void remove(const std::vector<CameraId>& cameras, Removal why);
    const SessionCameras& cameras() const { return cameras_; }
    // The settings in which a camera is to be encoded; empty if there is no such camera.
    const std::vector<ActiveSetting>& settings(CameraId camera, bool depth) const;
    void on_state(const wire::CameraState& state);
    // The following three are told to all who see the camera. See SessionCameras.
    wire::ManageRefusal adjust(CameraId camera, const CameraAdjustment& adjustment);
    void set_calibration(CameraId camera, const Bytes& calibration);
    // Gains that were estimated; a camera keeps those of its own (CameraStreams).
    void set_estimated_gain(CameraId camera, Vec3 gain);
    // `is_drawn`: some camera has a region of interest. Without one, depth never becomes lossy
    // because of a slow link.
    void on_region(bool is_drawn);
    // Encoding no longer keeps up with the camera, or does again: it takes `ms_per_picture` of a
    // core. The receivers of the setting get a note.
    void on_encoding(CameraId camera, SettingId setting, bool keeps_up, double ms_per_picture);

    // Receivers. One that records gets everything, and others do not change its encodings. Faces go
    // to receivers that take them, in codecs of their own (own_pictures.h).
    void join(ParticipantId receiver, const CodecWish& wish, bool records, bool takes_faces = false,
              bool is_by_relay = false);
    // Its frames come from a relay, or no longer: the relay sees to its key frames.
    void set_by_relay(ParticipantId receiver, bool is_by_relay);
    void leave(ParticipantId receiver);
    // An empty text keeps the codec. Empty `cameras`: for all, also for later ones.
    void choose(ParticipantId receiver, const CodecWish& wish,
                const std::vector<CameraId>& cameras);
    // A study sets these codecs for all cameras: a slow link makes them no coarser. An empty text
    // gives back what the receiver has chosen.
    void fix(ParticipantId receiver, const CodecWish& codecs);
    void set_goal(ParticipantId receiver, const wire::ChooseDelivery& goal);
    // The receiver is shown the past of exactly these cameras (look_backs.h): it gets nothing of
    // their present, and no settings. The cameras of an earlier call that are not among them it
    // gets anew.
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
    // All streams that are encoded.
    std::vector<StreamUse> uses() const;
    // The layer of a frame after its on_media(), for receivers of its setting.
    int layer_of(const wire::MediaHeader& header) const;
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
    void send(ParticipantId participant, wire::ToParticipant message) {
        actions_.push_back(action::Send{participant, std::move(message)});
    }
    void tell_changed(const CameraStreams& camera);
    CodecSteps steps_for(const StreamReceiver& receiver) const;
    void take_step(ParticipantId id, StreamReceiver& receiver);
    // Brings encoders and receivers in line with the tables.
    void apply();
    void change_encodings();
    void tell_publisher(ParticipantId publisher);
    void tell_receiver(ParticipantId id, StreamReceiver& receiver);
    Duration made_in(ParticipantId id) const;

    const CodecSteps codecs_;  // for the ladders
    std::vector<Action>& actions_;
    SettingNumbers numbers_;
    SessionCameras cameras_;
    std::map<ParticipantId, StreamReceiver> receivers_;
    KeyRequests key_requests_;
    StreamRates rates_;
    bool region_is_drawn_ = false;
    std::uint64_t changes_ = 0;
    TokenBucket encoding_changes_{encoding_changes.per_second, encoding_changes.at_once};
    bool encodings_wait_ = false;
    TimePoint now_;  // at the last tick
};

}  // namespace theatron::session

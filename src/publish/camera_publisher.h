// SPDX-License-Identifier: Apache-2.0
// The cameras of a participant: opens them, encodes them in the host's settings, and sends them.
//
//     publish::CameraPublisher publisher({"synthetic"}, "", {});
//     client::Participant::Options options{...};
//     options.publishing = publisher.events();
//     client::Participant participant(options);
//     const publish::Publishing running(publisher, participant);
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "capture/camera.h"
#include "capture/camera_places.h"
#include "client/participant.h"
#include "send/camera_lane.h"
#include "send/color_watch.h"

namespace theatron::publish {

// The part that is the same for all cameras of a publisher.
struct Sharing {
    bool may_record = false;                         // others may record them
    wire::CameraKind kind = wire::CameraKind::room;  // face: of one camera, the only one
};

class CameraPublisher {
public:
    // Opens the cameras; throws Error with one sentence if one cannot be opened. `places`: a file
    // with their poses in the room (docs/formats/places.md); empty: the cameras have none. With
    // CameraKind::person the cameras see the participant, whom the first one finds in its first
    // depth images (own_camera.h); this takes up to `person_patience` longer.
    CameraPublisher(std::vector<std::string> specifications, const std::string& places,
                    const capture::Progress& progress, const Sharing& sharing = {});
    // The same with cameras that are open; none of them is opened again when it fails.
    explicit CameraPublisher(std::vector<std::unique_ptr<capture::Camera>> cameras,
                             const Sharing& sharing = {});
    static constexpr Duration person_patience = std::chrono::seconds(3);
    ~CameraPublisher();

    std::vector<std::string> camera_names() const;
    Size depth_size(std::size_t camera) const {
        return lanes_.at(camera)->info().calibration.depth.size;
    }
    // As CameraLane::set_filter; without it depth is sent as the camera gave it.
    void set_filter(std::size_t camera, const filter::ChainSettings& settings,
                    std::shared_ptr<const filter::Background> background) {
        lanes_.at(camera)->set_filter(settings, std::move(background));
    }

    // Others have ended the shares of all cameras: nothing is sent any more.
    bool has_ended() const;

    struct Figures {
        std::optional<CameraId> number;  // in the session; nothing: it is not in a session
        bool has_ended = false;          // somebody has ended its share
        send::LaneFigures lane;
    };
    std::vector<Figures> figures() const;
    // Figures of the cameras' pictures, without screens.
    MomentFigures moments() const { return moments_->figures(); }

    // For the options of the participant that sends them; valid as long as the publisher. Those of
    // a face are for Options::face, else for Options::publishing.
    client::Participant::Publishing events();

    // Offers the cameras to the session of `participant`, which must exist until end() returns.
    void begin(client::Participant& participant);
    // Withdraws the cameras. `participant` is not used after this has returned.
    void end();

private:
    void open_all(std::vector<std::unique_ptr<capture::Camera>> cameras, const Sharing& sharing);
    void open(std::size_t camera, std::unique_ptr<capture::Camera> opened);
    void on_ended(const std::vector<CameraId>& numbers);
    void on_published(const std::vector<CameraId>& numbers);
    void on_encode(const std::vector<wire::StreamSetting>& settings);
    void on_encode_key(StreamId stream, SettingId setting);
    void on_media(std::size_t camera, const send::EncodedMedia& encoded);
    TimePoint told_moment(TimePoint moment, Duration offset);
    void on_state(std::size_t camera, wire::CameraState state);
    std::size_t camera_with(CameraId number) const;
    std::optional<CameraId> number_of(std::size_t camera) const;

    const std::vector<std::string> specifications_;  // empty: of a camera that was open
    const capture::CameraPlaces places_;
    const bool is_face_;
    std::vector<wire::OfferedCamera> offers_;

    mutable std::mutex mutex_;  // guards all up to `moments_`
    client::Participant* participant_ = nullptr;
    std::vector<std::size_t> offered_;       // the cameras of the offers, in their order
    std::vector<CameraId> numbers_;          // given by the host, by offer; may be empty
    std::vector<wire::CameraState> states_;  // newest, by camera

    // Newest moments as they were told, in session time, by the time here: all pictures of a moment
    // have the same one, although the offset between the clocks is estimated anew all the time.
    std::map<TimePoint, TimePoint> told_moments_;

    std::shared_ptr<send::SharedMoments> moments_;  // of all lanes
    send::ColorWatch color_watch_;
    send::Workers workers_;
    std::vector<std::unique_ptr<send::CameraLane>> lanes_;  // never change
};

// Calls begin(), and end() when it is destroyed.
class Publishing {
public:
    Publishing(CameraPublisher& publisher, client::Participant& participant)
        : publisher_(publisher) {
        publisher_.begin(participant);
    }
    ~Publishing() { publisher_.end(); }
    Publishing(const Publishing&) = delete;
    Publishing& operator=(const Publishing&) = delete;

private:
    CameraPublisher& publisher_;
};

}  // namespace theatron::publish

// SPDX-License-Identifier: Apache-2.0
// The cameras that participants share with a session, and the screens among them: how they come
// and leave, and the pictures that their publishers send.
//
// A pure state machine on the parts of a HostSession, of which it gets references: they must
// outlive it. Messages are appended to the list of actions.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "base/bytes.h"
#include "base/ids.h"
#include "base/time.h"
#include "session/admission.h"
#include "session/host_actions.h"
#include "session/host_room.h"
#include "session/look_backs.h"
#include "session/own_pictures.h"
#include "session/streams.h"
#include "wire/control.h"
#include "wire/media_header.h"

namespace theatron::session {

class SharedCameras {
public:
    SharedCameras(wire::SessionId session, Admission& admission, Streams& streams, HostRoom& room,
                  LookBacks& look_back, std::vector<Action>& actions)
        : session_(session),
          admission_(admission),
          streams_(streams),
          room_(room),
          look_back_(look_back),
          actions_(actions) {}

    // The numbers below this one are those of the host's own cameras. Before the first is added.
    void keep_numbers(int below) { streams_.keep_numbers(below); }
    // The host's own, which have their numbers, at the beginning or later. Screens of a recording,
    // and those at a place that the host's person chose, stay where they are.
    void add_own(std::vector<wire::Camera> cameras);
    // Answers the offer of a participant.
    void publish(ParticipantId id, const wire::Publish& offer);
    // Removes cameras of this participant.
    void unpublish(ParticipantId id, const wire::Unpublish& left);
    void remove(ParticipantId id, const std::vector<CameraId>& cameras, Removal why);
    void remove_all(ParticipantId id, Removal why) { remove(id, streams_.cameras().of(id), why); }
    // Ends the share of a publisher's camera, of which its publisher is told.
    void end_share(CameraId camera, ParticipantId by);
    // The condition of a camera, if it is the participant's.
    void on_state(ParticipantId id, const wire::CameraState& state);

    struct Received {
        std::vector<ParticipantId> receivers;
        wire::Text problem;  // the participant must be refused for this reason; empty: none
        std::optional<wire::MediaHeader> header = {};  // of a frame that has receivers
    };
    // A media message of a participant. One that is late, for a camera or a setting that is gone,
    // has no receivers.
    Received on_media(ParticipantId id, ByteView message, TimePoint now);

    // The budgets of requests follow the number of streams.
    void set_budgets();

private:
    struct PlacedScreen {
        CameraId camera{};
        ScreenOffer offer;
        HostRoom::ChosenPlace chosen;
    };
    enum class Placing { all, only_unplaced };
    // Gives the screens among these cameras their places in the room, one after the other. `offer`
    // has the facts of their publisher.
    std::vector<PlacedScreen> place_screens(const ScreenOffer& offer,
                                            std::vector<wire::Camera>& cameras,
                                            Placing which) const;
    void name_cameras(ParticipantId publisher, std::vector<wire::Camera>& cameras) const;
    void take_media(ParticipantId publisher);
    // A face and a screen of a browser have limits of their own.
    bool lets_through(Admission::Participant& publisher, const CameraStreams& camera,
                      const wire::MediaHeader& header, std::size_t size, TimePoint now);
    void audit(AuditEvent::What what, ParticipantId id, CameraId camera,
               const std::string& by = "");
    void send(ParticipantId id, wire::ToParticipant message) {
        actions_.push_back(action::Send{id, std::move(message)});
    }

    const wire::SessionId session_;
    Admission& admission_;
    Streams& streams_;
    HostRoom& room_;
    LookBacks& look_back_;
    std::vector<Action>& actions_;
    std::map<SettingId, OwnPicturePace> paces_;  // of active settings of faces and shown screens
};

}  // namespace theatron::session

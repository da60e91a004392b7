// SPDX-License-Identifier: Apache-2.0
// The room of a session on the host: takes requests of participants, and returns messages to them
// as actions. RoomState decides; this class reads and writes the messages.
//
// Without sockets, threads or clock.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "session/case_objects.h"
#include "session/host_actions.h"
#include "session/replayed_room.h"
#include "session/request_budget.h"
#include "session/room_bytes.h"
#include "session/room_state.h"
#include "session/shared_screen.h"
#include "wire/envelope.h"

namespace theatron::session {

// A camera of a publisher that is a screen.
struct ScreenOffer {
    ParticipantId publisher{};
    std::string publisher_name;
    Bytes person;  // as in wire::Join
    std::string name;
    Calibration calibration;  // is_screen()
};

class HostRoom {
public:
    // Poses of objects from one participant: per second, and in a burst; more is a flood.
    static constexpr RequestBudget::Limit pose_limit{400, 800};
    // The latest time of a pose, after the host's present time.
    static constexpr Duration max_pose_lead = std::chrono::seconds(1);

    // Objects that the people of one link may have made in the room, on whichever connections.
    static constexpr std::size_t max_objects_by_one_link = 1024;
    // Places among RoomState::max_objects for cases, shared screens and operators: what others make
    // takes none of them.
    static constexpr std::size_t kept_objects = 256;

    // Screens whose source is away; the oldest gives way.
    static constexpr std::size_t max_kept_screens = 32;

    // The persons (wire::Join) who made these objects, or share these screens.
    using Authors = std::map<ObjectId, Bytes>;

    // Continues from `restored`. `actions` must outlive this object.
    HostRoom(const ObjectsSnapshot& restored, std::vector<Action>& actions, Authors authors = {})
        : state_(restored), authors_(std::move(authors)), actions_(actions) {
        (void)end_presenting(std::nullopt);
        take_restored_sharers();
        forget_sources();
    }

    // Adds the person object of a participant. With `keeps_room` it gets the room and its changes.
    // `person`: as in wire::Join; somebody who comes back is the author of their marks again.
    // `link`: by which it came.
    void join(ParticipantId id, const PersonFacts& facts, bool keeps_room, TimePoint now = {},
              const Bytes& person = {}, const std::string& link = "");
    // A program that is nobody in the room gets the room and its changes, and changes nothing.
    void watch(ParticipantId id);
    // Its role or another fact has changed.
    void set_person(ParticipantId id, const PersonFacts& facts);
    void leave(ParticipantId id);
    // See RoomState.
    void clear();
    // Removes what this participant, who may have left, and its person have made: bricks, marks and
    // shared screens whose source is away. {}: those of whom nobody knows who made them. Returns
    // how many.
    std::size_t clear_of(ParticipantId id);
    // Returns the camera of a shared screen that the request has ended for all.
    std::optional<CameraId> on_request(ParticipantId id, const wire::RoomRequest& message);
    // Refuses a request unread, for this reason.
    void refuse(ParticipantId id, const wire::RoomRequest& message, Refusal refusal);
    void send_snapshot(ParticipantId id);

    struct ChosenPlace {
        ScreenPlace place;
        std::optional<ObjectId> kept;  // the screen that its source was before
    };
    // A publisher's camera that is a screen. Returns its place in the room: where it was before, if
    // its source was here before and no screen stands there now; the place of its calibration, if
    // that has one; else a place that is free, or the usual place. `further` are the screens of
    // the same offer that come before it: their places and objects are taken.
    //
    // A source is known by its person and by the names of the publisher and of the camera; of
    // several with the same ones, the first that is offered is the first that there was.
    ChosenPlace place_screen(const ScreenOffer& offer,
                             const std::vector<ChosenPlace>& further = {}) const;
    // Makes the screen an object of the room, at this place. Nothing may have changed in the room
    // since place_screen(), except that `further` screens were added.
    void add_screen(CameraId camera, const ScreenOffer& offer, const ChosenPlace& chosen);
    // Its source has left. The place is kept, as are those of at most max_kept_screens sources.
    void remove_screen(CameraId camera);

    // The cases that participants may open: by creating an organ whose properties name the case.
    // One case is open at a time; another one replaces it.
    void set_cases(std::vector<CaseFacts> cases) { cases_ = std::move(cases); }
    const std::vector<CaseFacts>& cases() const { return cases_; }
    // The case that is open; not that of a replayed recording.
    std::optional<ContentHash> open_case() const;
    // That one, and the one of a recording that is replayed.
    std::set<ContentHash> shown_cases() const;

    struct Forward {
        std::vector<ParticipantId> receivers;
        bool is_flood = false;
    };
    // A pose of an object from `id`. Returns the participants that it must be sent to at once.
    Forward on_pose(ParticipantId id, const wire::State& state, TimePoint now);

    // The room of a recording, now, with its recorded numbers; an empty one ends the replay. Nobody
    // can change its objects. Returns the poses of held objects, which must be sent at once to all
    // receivers().
    std::vector<ObjectPose> replay(const RoomObjects& recorded, TimePoint now);
    // The participants that keep the room.
    std::vector<ParticipantId> receivers() const;

    // Without a replayed recording.
    ObjectsSnapshot snapshot() const { return state_.snapshot(); }
    // Those of the objects of snapshot(), at least. A person's id proves who somebody is, so it
    // stays at the host.
    Authors authors() const;
    std::uint64_t revision() const { return state_.revision(); }
    // Grows with each change of snapshot().
    std::uint64_t version() const { return state_.revision() - replayed_changes_; }
    std::uint64_t replayed_changes() const { return replayed_changes_; }

private:
    struct Member {
        bool keeps_room = false;
        bool watches = false;
        Role role{};
        std::string name;
        Bytes person;               // as in wire::Join
        std::string link;           // by which it came
        std::uint32_t decided = 0;  // its newest request
        TokenBucket poses{pose_limit.per_second, pose_limit.at_once};
    };
    // True if the request gives an object to a participant whose role does not allow to hold it.
    bool gives_to_observer(const Request& request) const;
    // Why the participant may not make a brick or a mark; none: it may.
    Refusal judge_place_for(ParticipantId id, const Request& request) const;
    void note_author(ParticipantId id, const Request& request, const RoomState::Decision& decision);
    // The decision on a request that concerns the objects of a case; nullopt: it is an ordinary
    // one.
    std::optional<RoomState::Decision> decide_on_case(ParticipantId id, std::uint32_t number,
                                                      const Request& request);
    // The same of marks.
    std::optional<RoomState::Decision> decide_on_mark(ParticipantId id, std::uint32_t number,
                                                      const Request& request);
    // The same of shared screens (host_room_screens.cpp).
    std::optional<RoomState::Decision> decide_on_screen(ParticipantId id, const Request& request);
    // The camera of the shared screen that the request is to end.
    std::optional<CameraId> camera_of_removed(const Request& request) const;
    bool is_sharer(ParticipantId id, ObjectId screen) const;
    // The screen of a source that was here before and is away, and that none of `further` is.
    std::optional<ObjectId> find_kept(const ScreenOffer& offer,
                                      const std::vector<ChosenPlace>& further) const;
    // After a restart: those among the authors.
    void take_restored_sharers();
    // After a restart no source is here.
    void forget_sources();
    void drop_oldest_kept();
    // Makes the member of the same person the one who shares the screens.
    void take_own_screens(ParticipantId id);
    // Makes a participant the presenter of no screen; without one: all participants.
    std::vector<ObjectChange> end_presenting(std::optional<ParticipantId> presenter);
    RoomState::Decision open_case(ParticipantId id, const request::Create& request);
    void tell(const ObjectChange& change);
    void send(ParticipantId id, wire::ToParticipant message) {
        actions_.push_back(action::Send{id, std::move(message)});
    }

    RoomState state_;
    ReplayedRoom replayed_;
    std::uint64_t replayed_changes_ = 0;
    std::vector<CaseFacts> cases_;
    Authors authors_;
    std::map<ObjectId, std::string> links_;  // by which the authors came, in this run of the host
    Authors sharers_;                        // of screens, also of those whose source is away
    std::map<ParticipantId, Member> members_;
    std::vector<Action>& actions_;
};

}  // namespace theatron::session

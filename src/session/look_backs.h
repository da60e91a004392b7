// SPDX-License-Identifier: Apache-2.0
// Participants who look back: each sees the cameras of the room as they were some seconds ago, at
// the pace at which the pictures came, while the session goes on for the others.
//
// The pictures of the past have settings of their own numbers, which only this participant is told:
// so no picture of the present that is still on its way is taken for one of the past, nor the other
// way round. A pure state machine; it appends its messages to the list given to the constructor.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "session/host_actions.h"
#include "session/past.h"
#include "session/streams.h"
#include "wire/control.h"

namespace theatron::session {

class LookBacks {
public:
    // Below this the receiver is shown the present.
    static constexpr Duration least = std::chrono::seconds(1);

    // `streams` and `actions` must outlive it.
    LookBacks(const PastBounds& bounds, Streams& streams, std::vector<Action>& actions)
        : past_(bounds), streams_(streams), actions_(actions) {}

    bool is_possible() const { return past_.reach() > Duration(0); }
    std::size_t bytes() const { return past_.bytes(); }

    // A picture of any camera; it is kept if it may be (CameraStreams::may_be_kept) and is of the
    // one setting that is kept of its stream.
    void keep(const wire::MediaHeader& header, ByteView message, TimePoint now);
    // The pictures of this camera until now are not shown again.
    void forget(CameraId camera, TimePoint now) { past_.forget(camera, now); }
    // Nothing is kept of the session so far, and all see the present.
    void clear();
    void on_tick(TimePoint now) { past_.on_time(now); }

    // Shows the participant what was `ago`, within the reach, or the oldest that is kept.
    wire::ManageRefusal begin(ParticipantId participant, Duration ago, TimePoint now);
    // Shows it the present again.
    void end(ParticipantId participant);
    // Its connection has ended.
    void leave(ParticipantId participant);

    struct Due {
        ParticipantId receiver{};
        wire::MediaHeader header;              // with the number of the past's setting
        std::shared_ptr<const Bytes> message;  // with that number, too
    };
    // The pictures that are to be sent now, in order.
    std::vector<Due> take_due(TimePoint now);
    // When the next one is to be sent; empty: as long as no other comes, none.
    std::optional<TimePoint> due() const;

private:
    struct Shown {
        SettingId number{};    // that the participant is told
        SettingId original{};  // of the kept pictures
        std::string codec;
        bool has_begun = false;  // with a key frame
    };
    struct Looker {
        Duration behind{};  // from being kept to being sent again
        Past::Position next = 0;
        std::set<CameraId> cameras;
        std::map<StreamId, Shown> shown;
    };

    void announce(ParticipantId id, Looker& looker, const std::vector<Past::Position>& pictures);
    void give_numbers_back(Looker& looker);
    void follow_bounds(Looker& looker, TimePoint now) const;
    bool is_shown(ParticipantId id, const Past::Picture& picture) const;

    Past past_;
    Streams& streams_;
    std::vector<Action>& actions_;
    std::map<ParticipantId, Looker> lookers_;
};

}  // namespace theatron::session

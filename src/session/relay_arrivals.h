// SPDX-License-Identifier: Apache-2.0
// A receiver's frames that come on two ways, from a relay and from the host.
// Both are the same frames with the same numbers, so the first of the two is taken and the other
// left out; a chain of references stays whole whichever way each of its frames comes.
//
// A pure state machine; time is passed in.
#pragma once

#include <map>

#include "base/ids.h"
#include "base/time.h"
#include "wire/media_header.h"

namespace theatron::session {

enum class Way : std::uint8_t { by_host, by_relay };

class RelayArrivals {
public:
    // Without a frame of the relay for `patience`, or for `patience_in_periods` of a slow camera,
    // the stream does not come from it.
    static constexpr Duration patience = std::chrono::milliseconds(700);
    static constexpr int patience_in_periods = 3;
    // A frame that is older than the newest one is left out as long as that one is newer than this:
    // later, its encoder counts anew.
    static constexpr Duration memory = std::chrono::seconds(1);

    // A frame has come. False: it has come before, or a newer one has.
    bool take(const wire::MediaHeader& header, Way way, TimePoint now);

    // The setting of this stream whose frames come from a relay; {}: none. `period`: between two
    // frames of its camera.
    SettingId relayed_setting(StreamId stream, Duration period, TimePoint now) const;

    // False until a frame of a relay has come: then all frames can be taken without take().
    bool is_used() const { return !streams_.empty(); }
    // The relay's way of this stream has ended.
    void end(StreamId stream);
    void clear() { streams_.clear(); }

private:
    struct Stream {
        SettingId setting{};
        FrameNumber newest = 0;
        TimePoint taken;  // the newest
        SettingId relayed{};
        TimePoint came_by_relay;
    };
    std::map<StreamId, Stream> streams_;  // of which a frame of a relay has come
};

}  // namespace theatron::session

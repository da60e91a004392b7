// SPDX-License-Identifier: Apache-2.0
// The bar with which people play the recording that a host shows to all.
#pragma once

#include <optional>

#include "client/participant.h"
#include "viewer/room_panel.h"

namespace theatron::viewer {

// The recording's position at this session time.
Duration position_at(const wire::Playback& playback, TimePoint session_time);
// "1:02"; "1:00:02" from an hour on.
std::string clock_text(Duration position);

// For pictures of it: "RECORDING 0:12 / 1:02", "RECORDING 0:12 / 1:02, paused by Anna".
std::string playback_text(const wire::Playback& playback, TimePoint session_time);

// Use from one thread.
class Playing {
public:
    static constexpr Duration step = std::chrono::seconds(5);
    // Between two places that a slider that is moved asks for.
    static constexpr Duration seek_every = std::chrono::milliseconds(250);

    // False: the host plays no recording.
    bool carry_out(const PlayStep& play, client::Participant& participant, TimePoint now);
    // The slider is held at this position, seconds.
    void slide(double position);
    void on_tick(client::Participant& participant, TimePoint now);

    // The bar, if the host plays a recording; with buttons if this person may use them.
    std::optional<window::PanelRow> bar(const client::Participant& participant, bool may_play,
                                        TimePoint now, RoomPanel& panel) const;

private:
    void seek(client::Participant& participant, Duration position, TimePoint now);

    std::optional<Duration> wanted_;  // not asked for yet
    Duration asked_{};                // the last one
    TimePoint asked_at_;
};

}  // namespace theatron::viewer

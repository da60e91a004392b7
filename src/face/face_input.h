// SPDX-License-Identifier: Apache-2.0
// The channels of a face now, and whether they are tracked.
//
// A tracker that falls silent leaves no grimace: after 250 ms the face relaxes, and one second
// after the last values it is neutral. Time is passed in.
#pragma once

#include <optional>
#include <string_view>

#include "base/time.h"
#include "face/sources.h"

namespace theatron::face {

enum class Tracking : std::uint8_t { waiting, tracked, relaxing, lost };

// "waiting", "tracked", "relaxing", "lost": for a status line.
std::string_view to_text(Tracking tracking);

struct FaceNow {
    Channels values{};
    ChannelMask present;
    Tracking tracking = Tracking::waiting;
};

class FaceInput {
public:
    static constexpr Duration silent_after = 250ms;
    static constexpr Duration neutral_after = 1s;

    void put(const Mapped& mapped, TimePoint now) {
        last_ = mapped;
        at_ = now;
    }
    FaceNow at(TimePoint now) const;

private:
    Mapped last_;
    std::optional<TimePoint> at_;
};

}  // namespace theatron::face

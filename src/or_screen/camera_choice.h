// SPDX-License-Identifier: Apache-2.0
// The camera whose picture the OR screen shows: the one that sees best what people point at.
#pragma once

#include <optional>
#include <vector>

#include "base/ids.h"
#include "base/time.h"
#include "geometry/calibration.h"
#include "image/view.h"

namespace theatron::or_screen {

// How well a camera sees these places of the room, on average: pixels of its colour picture per
// millimetre, less towards the picture's edges, a fifth where the depth picture does not tell, and
// nothing for hidden places. 0 without places. Pure.
double score_of(const Calibration& calibration, DepthView depth, const std::vector<Vec3>& places);

struct CameraScore {
    CameraId camera{};
    bool is_live = false;
    double score = 0;
};

// Reads no clock. The picture does not jump between cameras that see about equally well.
class CameraChoice {
public:
    // Another camera must have been better than the shown one by this factor for some time, and
    // the shown one must have been shown for a while. Where the shown one sees nothing of it, half
    // of the time suffices.
    static constexpr double much_better = 1.4;
    static constexpr Duration better_for = std::chrono::seconds(2);
    static constexpr Duration shown_for = std::chrono::seconds(6);

    // The camera to show; nothing without cameras. One that is not live is left at once for a live
    // one, and one that is gone for any.
    std::optional<CameraId> choose(const std::vector<CameraScore>& cameras, TimePoint now);

private:
    struct Rival {
        CameraId camera{};
        TimePoint since;
    };
    void show(CameraId camera, TimePoint now);

    std::optional<CameraId> shown_;
    TimePoint shown_since_;
    std::optional<Rival> rival_;
};

}  // namespace theatron::or_screen

// SPDX-License-Identifier: Apache-2.0
// Counts the pictures of several cameras by moment (capture/moments.h): how far apart those of one
// moment were taken, and how many came without the others of their moment. Pure: it reads no clock.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "base/ids.h"
#include "base/time.h"

namespace theatron {

struct MomentFigures {
    // Between the first and the last exposure of a moment of which all cameras have a picture.
    double skew_p50_ms = 0, skew_max_ms = 0;
    std::uint64_t whole = 0;  // such moments
    // Pictures of moments of which a camera has none, although it had some before and after.
    std::uint64_t unpaired = 0;

    // False: there were never two cameras whose moments can be compared.
    bool any() const { return whole + unpaired > 0; }
};

// Not thread safe.
class MomentMeter {
public:
    // A picture. Only those of cameras of one publisher (of the host: that of its own) have moments
    // in common. More pictures of one camera and moment, as of depth and colour or of further
    // settings, count once. One that comes so late that `open_moments` later moments have begun is
    // not counted; a picture from long before begins anew, as of a recording that is played again.
    // Safe for untrusted input: impossible times are left out.
    void add(ParticipantId publisher, CameraId camera, TimePoint moment, TimePoint captured);

    // Those of the moments that later pictures have closed, since the last reset().
    MomentFigures figures() const;
    void reset();

    static constexpr std::size_t open_moments = 16;

private:
    static constexpr Duration long_before = 1s;
    // Publishers beyond this many replace those that are silent for longest.
    static constexpr std::size_t most_publishers = 64;
    // The median is exact up to the width of a bin; longer skews are in the last one.
    static constexpr double bin_ms = 0.25;
    static constexpr std::size_t bins = 1024;

    struct Running {
        TimePoint first, newest;  // moments
    };
    struct Exposure {
        CameraId camera{};
        TimePoint captured;
    };
    struct Publisher {
        TimePoint newest;
        std::map<TimePoint, std::vector<Exposure>> open;  // by moment, one of each camera
        std::map<CameraId, Running> cameras;
    };
    void close_first(Publisher& publisher);

    std::map<ParticipantId, Publisher> publishers_;
    std::array<std::uint32_t, bins> skews_{};
    MomentFigures counts_;
};

}  // namespace theatron

// SPDX-License-Identifier: Apache-2.0
// The calibrations of a session's cameras that are recorded. Each new one begins a segment, so
// while somebody nudges a camera, that from before stays until the camera has stood still.
//
// Pure: times are arguments, of one clock. Not thread safe.
#pragma once

#include <functional>
#include <map>

#include "base/bytes.h"
#include "base/ids.h"
#include "base/time.h"

namespace theatron::client {

class SettledPlaces {
public:
    // A nudged calibration is recorded once it `stays`, or is nudged for `longest_nudging`.
    static constexpr Duration stays = std::chrono::seconds(1);
    static constexpr Duration longest_nudging = std::chrono::seconds(10);

    // The calibration to be recorded of a camera that has `calibration` now. `adjustment`: that of
    // an operator; empty: none. Valid until the next call.
    const Bytes& settled(CameraId camera, const Bytes& calibration, const Bytes& adjustment,
                         TimePoint now);
    // A camera's newest calibration is not recorded yet.
    bool is_settling() const;

    void keep_only(const std::function<bool(CameraId)>& is_kept);
    void clear() { places_.clear(); }

private:
    struct Place {
        Bytes recorded, newest;    // calibrations
        TimePoint since, changed;  // `newest` differs since, and was set last
        Bytes adjustment;
    };
    std::map<CameraId, Place> places_;
};

}  // namespace theatron::client

// SPDX-License-Identifier: Apache-2.0
// A decorator for any camera that simulates faults, for tests: silence, lost frames, repeated
// pictures, jumps in time, unplugging, a hanging driver.
//
// The faults depend only on the seed and the time, so that a camera that is opened again still
// has the current fault.
#pragma once

#include <functional>
#include <optional>

#include "base/options.h"
#include "capture/camera.h"

namespace theatron::capture {

inline constexpr const char* faults_help =
    "any kind    faults=SEED: for tests, the camera fails now and then in every way that cameras "
    "do; faults_every=10 (seconds)";

enum class FaultKind : std::uint8_t { silence, lost_frames, repeat, time_jump, unplugged, hang };
inline constexpr int fault_kinds = 6;

struct Fault {
    FaultKind kind{};
    TimePoint begin, end;
    Duration jump{};  // of a time_jump
};

// One fault per `every`, lasting from a few frames to three seconds.
struct FaultPlan {
    std::uint32_t seed = 1;
    Duration every = 10s;
    TimePoint from{};  // no faults before

    // The fault of the stretch of time that contains `now`, active or not.
    Fault nearest(TimePoint now) const;
    // The fault active at `now`.
    std::optional<Fault> at(TimePoint now) const;
};

// `clock` and `sleep` as in capture/clock.h. Throws Error while unplugged.
std::unique_ptr<Camera> make_faulty_camera(std::unique_ptr<Camera> camera, const FaultPlan& plan,
                                           std::function<TimePoint()> now,
                                           std::function<void(Duration)> sleep);

// Nullopt without the option faults=.
std::optional<FaultPlan> take_fault_options(Options& options);

}  // namespace theatron::capture

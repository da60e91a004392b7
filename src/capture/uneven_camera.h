// SPDX-License-Identifier: Apache-2.0
// A decorator for any camera that makes it late and incomplete, for tests of cameras that are not
// synchronised.
#pragma once

#include <functional>
#include <optional>

#include "base/options.h"
#include "capture/camera.h"

namespace theatron::capture {

inline constexpr const char* uneven_help =
    "any kind    late_ms=MS: for tests, each picture is taken and delivered MS later; "
    "skip_every=N: each Nth picture is missing";

struct Unevenness {
    Duration late{};     // of each picture's times, at most 30 ms; less than a period
    int skip_every = 0;  // the pictures with numbers that this divides are missing; 0: none
    bool operator==(const Unevenness&) const = default;
};

// `sleep` as in capture/clock.h.
std::unique_ptr<Camera> make_uneven_camera(std::unique_ptr<Camera> camera, Unevenness unevenness,
                                           std::function<void(Duration)> sleep);

// Nullopt without the options late_ms= and skip_every=. Throws Error where no picture would be
// left.
std::optional<Unevenness> take_uneven_options(Options& options);

}  // namespace theatron::capture

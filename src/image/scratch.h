// SPDX-License-Identifier: Apache-2.0
// Working memory of functions on images, which no later call reads. It belongs to
// the thread, not to the camera: cameras that take turns on one core then use the
// same memory, which stays in the caches, instead of each fetching its own. Measured
// in docs/decisions/lanes.md.
#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "image/view.h"

namespace theatron {

// The calling thread's T for images of this size, made with T(size) when first asked
// for. Its contents are what the last user left. Valid until the thread asks
// for a T of a further size. A thread keeps those of the eight sizes it asked for last.
template <typename T>
T& scratch_of_this_thread(Size size) {
    constexpr std::size_t most_sizes = 8;
    thread_local std::vector<std::pair<Size, std::unique_ptr<T>>> kept;
    const auto found = std::find_if(kept.begin(), kept.end(),
                                    [&](const auto& entry) { return entry.first == size; });
    if (found != kept.end()) {
        std::rotate(kept.begin(), found, found + 1);
        return *kept.front().second;
    }
    if (kept.size() == most_sizes)
        kept.pop_back();
    kept.emplace(kept.begin(), size, std::make_unique<T>(size));
    return *kept.front().second;
}

}  // namespace theatron

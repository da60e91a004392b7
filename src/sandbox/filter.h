// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sandbox/limits.h"

namespace theatron::sandbox {

// A sanitizer has threads of its own, and does more in a crash than the product's code may.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool has_sanitizer = true;
#elif defined(__has_feature)
inline constexpr bool has_sanitizer =
    __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
inline constexpr bool has_sanitizer = false;
#endif

// The only descriptors of a child besides three that lead to /dev/null.
inline constexpr int channel_descriptor = 3, input_descriptor = 4, area_descriptor = 5;

// From now on this process ends at any system call that the profile does not name. False where the
// system has no filters; then nothing has changed.
bool load_filter(Profile profile);

}  // namespace theatron::sandbox

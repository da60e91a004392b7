// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sandbox/limits.h"

namespace theatron::sandbox {

// A sanitizer starts threads and makes system calls that the product's code must not make.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool has_sanitizer = true;
#elif defined(__has_feature)
inline constexpr bool has_sanitizer =
    __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
inline constexpr bool has_sanitizer = false;
#endif

// The only descriptors of a child, besides three of /dev/null.
inline constexpr int channel_descriptor = 3, input_descriptor = 4, area_descriptor = 5;

// Installs the filter: any system call that the profile does not list ends this process. False,
// without effect, if the system has no filters.
bool load_filter(Profile profile);

}  // namespace theatron::sandbox

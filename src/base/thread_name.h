// SPDX-License-Identifier: Apache-2.0
// Names of threads, as profilers and the benchmarks see them.
#pragma once

#include <pthread.h>

namespace theatron {

// A browser's page has one thread.
#ifdef __EMSCRIPTEN__
inline constexpr bool has_threads = false;
#else
inline constexpr bool has_threads = true;
#endif

// At most 15 characters.
inline void name_this_thread([[maybe_unused]] const char* name) {
#ifdef __linux__
    pthread_setname_np(pthread_self(), name);
#endif
}

}  // namespace theatron

// SPDX-License-Identifier: Apache-2.0
// Names of threads, as profilers and the benchmarks see them.
#pragma once

#include <pthread.h>

namespace theatron {

// At most 15 characters.
inline void name_this_thread([[maybe_unused]] const char* name) {
#ifdef __linux__
    pthread_setname_np(pthread_self(), name);
#endif
}

}  // namespace theatron

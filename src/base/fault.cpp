// SPDX-License-Identifier: Apache-2.0
#include "base/fault.h"

#include <atomic>
#include <mutex>

#include "base/line_limit.h"
#include "base/log.h"
#include "base/steady_clock.h"

namespace theatron {
namespace {

std::atomic<std::uint64_t> count{0};

}  // namespace

void note_fault(std::string_view where, std::string_view what) noexcept {
    ++count;
    try {
        static std::mutex mutex;
        static LineLimit limit;
        std::optional<std::uint64_t> left_out;
        {
            const std::lock_guard lock(mutex);
            left_out = limit.take(std::string(where), steady_now());
        }
        if (left_out)
            log::error(where, "unexpected fault", {{"what", what}, {"left_out", *left_out}});
    } catch (...) {
        // Without memory for a line it is only counted.
    }
}

std::uint64_t fault_count() {
    return count;
}

}  // namespace theatron

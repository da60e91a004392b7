// SPDX-License-Identifier: Apache-2.0
#include "cli/output_end.h"

#include <csignal>
#include <optional>
#include <thread>

#include "base/output.h"
#include "base/steady_clock.h"
#include "cli/stop_signal.h"

namespace theatron::cli {
namespace {

constexpr Duration line_patience = std::chrono::seconds(1);
constexpr Duration result_patience = std::chrono::seconds(10);

}  // namespace

void outlive_readers() {
    std::signal(SIGPIPE, SIG_IGN);
}

bool finish_output() {
    const TimePoint begin = steady_now();
    std::optional<TimePoint> told;
    while (!output::is_written()) {
        const TimePoint now = steady_now();
        if (stop_requested() && !told)
            told = now;
        const bool waits_long = output::has_results() && !told;
        if (now - told.value_or(begin) >= (waits_long ? result_patience : line_patience))
            break;
        std::this_thread::sleep_for(10ms);
    }
    return !output::has_results() && !output::has_lost_results();
}

}  // namespace theatron::cli

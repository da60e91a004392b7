// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>

#include "base/line_writer.h"
#include "base/log.h"
#include "base/log_output.h"

namespace theatron::log {
namespace {

constexpr Duration exit_patience = std::chrono::milliseconds(500);

void write_to_stderr(std::string_view line) {
    while (!line.empty()) {
        const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
        if (written < 0 && errno == EINTR)
            continue;
        if (written <= 0)
            return;  // there is no place to report it
        line.remove_prefix(std::size_t(written));
    }
}

// Never destroyed: other threads may log until the process ends, and the writing thread may
// be blocked by a pipe without a reader.
LineWriter& writer() {
    static LineWriter* const only = [] {
        auto* made = new LineWriter(write_to_stderr);
        std::atexit([] { flush(exit_patience); });
        return made;
    }();
    return *only;
}

LineWriter* aborting_writer = nullptr;

// The writing thread goes on meanwhile, unless it is the one that aborts. Only reads an atomic
// number and sleeps; a signal handler may do both.
extern "C" void on_abort(int) {
    for (int i = 0; i < exit_patience / 10ms && !aborting_writer->idle(); ++i) {
        constexpr timespec pause{0, 10'000'000};
        nanosleep(&pause, nullptr);
    }
}

}  // namespace

void output_line(std::string line) {
    writer().put(std::move(line));
}

void flush(Duration patience) {
    writer().flush(patience);
}

void flush_before_abort() {
    aborting_writer = &writer();
    // After the handler returns, abort() ends the process as it would without.
    std::signal(SIGABRT, on_abort);
}

}  // namespace theatron::log

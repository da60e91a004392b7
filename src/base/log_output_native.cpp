// SPDX-License-Identifier: Apache-2.0
// The threads that write standard error, the log's, and standard output.
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <optional>

#include "base/line_writer.h"
#include "base/log.h"
#include "base/log_format.h"
#include "base/log_output.h"
#include "base/output.h"

namespace theatron {
namespace {

constexpr Duration exit_patience = std::chrono::milliseconds(500);
constexpr const char* wipe = "\r\033[K";

bool write_all(int file, std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = ::write(file, text.data(), text.size());
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0 && errno == EAGAIN) {
            // Another program that has the same terminal or pipe does not want to wait for it.
            pollfd ready{file, POLLOUT, 0};
            (void)poll(&ready, 1, -1);
            continue;
        }
        if (written <= 0)
            return false;
        text.remove_prefix(std::size_t(written));
    }
    return true;
}

// The same terminal, pipe or file.
bool is_same_file(int a, int b) {
    struct stat of_a {
    }, of_b{};
    return fstat(a, &of_a) == 0 && fstat(b, &of_b) == 0 && of_a.st_dev == of_b.st_dev &&
           of_a.st_ino == of_b.st_ino;
}

// Never destroyed: other threads may log until the process ends, and a writing thread may be
// blocked by a pipe without a reader.
LineWriter& error_writer() {
    static LineWriter* const only = [] {
        auto* made = new LineWriter(
            [](std::string_view line) { return write_all(STDERR_FILENO, line); },
            [](std::uint64_t left_out) {
                return write_all(STDERR_FILENO,
                                 log::sentence_line("... " + std::to_string(left_out) +
                                                    " lines were left out."));
            });
        std::atexit([] { log::flush(exit_patience); });
        return made;
    }();
    return *only;
}

// Lines for one and the same file keep their order. Elsewhere neither waits for the other.
LineWriter& writer_of_output() {
    static LineWriter* const only = [] {
        if (is_same_file(STDOUT_FILENO, STDERR_FILENO))
            return &error_writer();
        return new LineWriter(
            [](std::string_view line) { return write_all(STDOUT_FILENO, line); },
            [](std::uint64_t left_out) {
                error_writer().put(log::sentence_line("... " + std::to_string(left_out) +
                                                      " lines of standard output were left out."));
                return true;
            });
    }();
    return *only;
}

LineWriter& writer_of(output::Stream stream) {
    return stream == output::Stream::output ? writer_of_output() : error_writer();
}

// The stream of a status line that stands on the terminal; a line wipes it first.
constexpr int no_stream = -1;
std::atomic<int> status_stream{no_stream};

std::string wiped(std::string line, int file) {
    if (status_stream != no_stream && isatty(file) &&
        status_stream.exchange(no_stream) != no_stream)
        line.insert(0, wipe);
    return line;
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

namespace log {

void output_line(std::string line) {
    error_writer().put(wiped(std::move(line), STDERR_FILENO));
}

void flush(Duration patience) {
    error_writer().flush(patience);
}

void flush_before_abort() {
    aborting_writer = &error_writer();
    // After the handler returns, abort() ends the process as it would without.
    std::signal(SIGABRT, on_abort);
}

}  // namespace log

namespace output {

void print(std::string lines, Stream stream) {
    const int file = stream == Stream::output ? STDOUT_FILENO : STDERR_FILENO;
    writer_of(stream).put(wiped(std::move(lines), file));
}

void result(std::string line) {
    writer_of_output().keep(wiped(std::move(line), STDOUT_FILENO));
}

void status_line(const std::string& text, Stream stream) {
    LineWriter& writer = writer_of(stream);
    if (!writer.idle())
        return;
    status_stream = int(stream);
    writer.put(wipe + text);
}

void end_status_line() {
    if (const int stream = status_stream.exchange(no_stream); stream != no_stream)
        writer_of(output::Stream(stream)).put("\n");
}

bool is_written() {
    return writer_of_output().idle() && error_writer().idle();
}

bool has_results() {
    return writer_of_output().keeps();
}

bool has_lost_results() {
    return writer_of_output().has_lost_kept();
}

}  // namespace output
}  // namespace theatron

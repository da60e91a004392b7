// SPDX-License-Identifier: Apache-2.0
// Writes lines on a thread of its own, so that the thread that logs never waits
// for a terminal, a pipe or a disk. Not in the web build.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include "base/time.h"

namespace theatron {

class LineWriter {
public:
    // Lines that may wait, and their bytes. Further ones are left out, and a line states their
    // number once lines can be written again.
    static constexpr std::size_t max_waiting = 1024;
    static constexpr std::size_t max_waiting_bytes = std::size_t(4) << 20;

    // `write` is called from the writer's thread only, and may block; false: the line is lost.
    using Write = std::function<bool(std::string_view)>;
    // `tell` states how many lines were left out; by default as a line of `write`.
    using Tell = std::function<bool(std::uint64_t left_out)>;
    explicit LineWriter(Write write, Tell tell = {});
    ~LineWriter();  // writes all lines that wait

    // From any thread. Never blocks, never throws.
    void put(std::string line) noexcept;
    // The same for a line that is not left out, however many wait: a result that a script reads.
    void keep(std::string line) noexcept;

    // Waits until all lines put before are written. False if that takes longer, at once if the line
    // that is being written already has.
    bool flush(Duration patience);

    // Nothing waits to be written. Safe in a signal handler.
    bool idle() const { return unwritten_ == 0; }
    // A line of keep() waits.
    bool keeps() const { return kept_ > 0; }
    // A line of keep() could not be written.
    bool has_lost_kept() const { return lost_kept_; }

private:
    struct Line {
        std::string text;
        bool is_kept = false;
    };
    void add(std::string line, bool is_kept) noexcept;
    void run();

    const Write write_;
    const Tell tell_;
    std::atomic<std::size_t> unwritten_{0};  // waiting, or being written
    std::atomic<std::size_t> kept_{0};       // those of them that are kept
    std::atomic<bool> lost_kept_{false};

    std::mutex mutex_;  // guards all below
    std::condition_variable changed_;
    std::deque<Line> waiting_;
    std::size_t waiting_bytes_ = 0;
    std::uint64_t left_out_ = 0;
    TimePoint waits_since_;  // the line that is written now or next
    bool stopping_ = false;
    std::thread thread_;  // runs from the first line on
};

}  // namespace theatron

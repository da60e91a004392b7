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
    // Lines that may wait. Further ones are left out, and a line states their number.
    static constexpr std::size_t max_waiting = 1024;

    // `write` is called from the writer's thread only, and may block.
    explicit LineWriter(std::function<void(std::string_view)> write);
    ~LineWriter();  // writes all lines that wait

    // From any thread. Never blocks, never throws.
    void put(std::string line) noexcept;

    // Waits until all lines put before are written. False if that takes longer.
    bool flush(Duration patience);

    // Nothing waits to be written. Safe in a signal handler.
    bool idle() const { return unwritten_ == 0; }

private:
    void run();

    const std::function<void(std::string_view)> write_;
    std::atomic<std::size_t> unwritten_{0};  // waiting, or being written

    std::mutex mutex_;  // guards all below
    std::condition_variable changed_;
    std::deque<std::string> waiting_;
    std::uint64_t left_out_ = 0;
    bool stopping_ = false;
    std::thread thread_;
};

}  // namespace theatron

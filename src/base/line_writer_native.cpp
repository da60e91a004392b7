// SPDX-License-Identifier: Apache-2.0
#include "base/line_writer.h"

#include <utility>

#include "base/thread_name.h"

namespace theatron {

LineWriter::LineWriter(std::function<void(std::string_view)> write)
    : write_(std::move(write)), thread_([this] { run(); }) {}

LineWriter::~LineWriter() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void LineWriter::put(std::string line) noexcept {
    try {
        const std::lock_guard lock(mutex_);
        if (waiting_.size() >= max_waiting) {
            ++left_out_;
            return;
        }
        waiting_.push_back(std::move(line));
        ++unwritten_;
    } catch (...) {
        // Without memory for a line the failure cannot be reported either.
        return;
    }
    changed_.notify_all();
}

bool LineWriter::flush(Duration patience) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, patience, [&] { return idle(); });
}

void LineWriter::run() {
    name_this_thread("log");
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [&] { return !waiting_.empty() || stopping_; });
        if (waiting_.empty())
            return;
        const std::string line = std::move(waiting_.front());
        waiting_.pop_front();
        const std::uint64_t left_out = std::exchange(left_out_, 0);
        lock.unlock();
        write_(line);
        if (left_out > 0)
            write_("... " + std::to_string(left_out) + " lines were left out.\n");
        lock.lock();
        --unwritten_;
        changed_.notify_all();
    }
}

}  // namespace theatron

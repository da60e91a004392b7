// SPDX-License-Identifier: Apache-2.0
#include "base/line_writer.h"

#include <algorithm>
#include <utility>

#include "base/steady_clock.h"
#include "base/thread_name.h"

namespace theatron {

LineWriter::LineWriter(Write write, Tell tell) : write_(std::move(write)), tell_(std::move(tell)) {}

LineWriter::~LineWriter() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable())
        thread_.join();
}

void LineWriter::put(std::string line) noexcept {
    add(std::move(line), false);
}

void LineWriter::keep(std::string line) noexcept {
    add(std::move(line), true);
}

void LineWriter::add(std::string line, bool is_kept) noexcept {
    try {
        const std::lock_guard lock(mutex_);
        const bool is_full =
            waiting_.size() >= max_waiting ||
            (!waiting_.empty() && waiting_bytes_ + line.size() > max_waiting_bytes);
        if (is_full && !is_kept) {
            ++left_out_;
            return;
        }
        if (!thread_.joinable())
            thread_ = std::thread([this] { run(); });
        if (idle())
            waits_since_ = steady_now();
        const std::size_t bytes = line.size();
        waiting_.push_back({std::move(line), is_kept});
        waiting_bytes_ += bytes;
        ++unwritten_;
        kept_ += is_kept;
    } catch (...) {
        // Without memory for a line the failure cannot be reported either.
        lost_kept_ = lost_kept_ || is_kept;
        return;
    }
    changed_.notify_all();
}

bool LineWriter::flush(Duration patience) {
    std::unique_lock lock(mutex_);
    const Duration left = waits_since_ + patience - steady_now();
    return changed_.wait_for(lock, std::max(left, Duration(0)), [&] { return idle(); });
}

void LineWriter::run() {
    name_this_thread("log");
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [&] { return !waiting_.empty() || stopping_; });
        if (waiting_.empty())
            return;
        const Line line = std::move(waiting_.front());
        waiting_.pop_front();
        waiting_bytes_ -= line.text.size();
        std::uint64_t left_out = std::exchange(left_out_, 0);
        lock.unlock();
        if (!write_(line.text)) {
            ++left_out;
            lost_kept_ = lost_kept_ || line.is_kept;
        } else if (left_out > 0) {
            const bool told =
                tell_ ? tell_(left_out)
                      : write_("... " + std::to_string(left_out) + " lines were left out.\n");
            left_out = told ? 0 : left_out;
        }
        lock.lock();
        left_out_ += left_out;
        waits_since_ = steady_now();
        --unwritten_;
        kept_ -= line.is_kept;
        changed_.notify_all();
    }
}

}  // namespace theatron

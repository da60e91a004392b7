// SPDX-License-Identifier: Apache-2.0
#include "send/workers.h"

#include <algorithm>

#include "base/fault.h"
#include "base/thread_name.h"

namespace theatron::send {
namespace {

int usual_threads() {
    return std::max(1, int(std::thread::hardware_concurrency()));
}

}  // namespace

Workers::Workers(int threads)
    : threads_(threads > 0 ? threads : usual_threads()),
      pool_("work", threads_),
      background_("behind", std::max(1, threads_ / 2), background_niceness),
      looking_([this] { look_around(); }) {}

Workers::~Workers() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    changed_.notify_all();
    looking_.join();
}

Workers::Ticket Workers::look_after(std::function<void()> look) {
    const std::lock_guard lock(mutex_);
    looks_.emplace(next_ticket_, std::move(look));
    return next_ticket_++;
}

void Workers::forget(Ticket ticket) {
    const std::lock_guard lock(mutex_);
    looks_.erase(ticket);
}

void Workers::look_around() {
    name_this_thread("look");
    std::unique_lock lock(mutex_);
    while (!stopping_) {
        for (const auto& [ticket, look] : looks_)
            (void)contain("look", look);
        changed_.wait_for(lock, look_every, [this] { return stopping_; });
    }
}

}  // namespace theatron::send

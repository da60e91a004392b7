// SPDX-License-Identifier: Apache-2.0
#include "world/asio.h"

#include "base/fault.h"

namespace theatron::world {
namespace {

struct Running {
    std::mutex mutex;
    std::condition_variable changed;
    int count = 0;  // guarded by mutex
};

Running& in_run() {
    static Running all;
    return all;
}

void count_running(int more) {
    const std::lock_guard lock(in_run().mutex);
    in_run().count += more;
    in_run().changed.notify_all();
}

}  // namespace

std::string ErrorCode::message() const {
    switch (fault) {
        case Fault::none:
            return "no error";
        case Fault::closed:
            return "closed";
        case Fault::refused:
            return "refused";
        case Fault::reset:
            return "reset";
        case Fault::timeout:
            return "no answer in time";
        case Fault::aborted:
            return "aborted";
    }
    return "";
}

void Loop::post(std::function<void()> work) {
    {
        const std::lock_guard lock(mutex_);
        ready_.push_back(std::move(work));
    }
    Schedule::instance().after({}, [weak = weak_from_this()] {
        if (const auto loop = weak.lock(); loop && !loop->is_stopped())
            (void)loop->run_one();
    });
}

bool Loop::run_one() {
    std::function<void()> work;
    {
        const std::lock_guard lock(mutex_);
        if (ready_.empty())
            return false;
        work = std::move(ready_.front());
        ready_.pop_front();
    }
    (void)contain("net", work);
    return true;
}

void Loop::stop() {
    const std::lock_guard lock(mutex_);
    is_stopped_ = true;
    changed_.notify_all();
}

void Loop::restart() {
    const std::lock_guard lock(mutex_);
    is_stopped_ = false;
}

bool Loop::is_stopped() const {
    const std::lock_guard lock(mutex_);
    return is_stopped_;
}

std::size_t Loop::poll() {
    std::size_t count = 0;
    while (!is_stopped() && run_one())
        ++count;
    return count;
}

void Loop::run() {
    count_running(1);
    {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return is_stopped_; });
    }
    count_running(-1);
}

void Loop::wait_for_running(int count) {
    std::unique_lock lock(in_run().mutex);
    in_run().changed.wait(lock, [&] { return in_run().count >= count; });
}

int Loop::running() {
    const std::lock_guard lock(in_run().mutex);
    return in_run().count;
}

}  // namespace theatron::world

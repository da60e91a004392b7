// SPDX-License-Identifier: Apache-2.0
#include "cli/stop_signal.h"

#include <semaphore.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <condition_variable>
#include <csignal>
#include <mutex>
#include <thread>

#include "base/log.h"
#include "base/steady_clock.h"
#include "base/thread_name.h"

namespace theatron::cli {
namespace {

constexpr Duration last_words = std::chrono::milliseconds(200);

std::atomic<int> requested{0};  // the first signal
static_assert(std::atomic<int>::is_always_lock_free);

// Ends the process. Never destroyed, since its thread goes on until the very end.
class Watcher {
public:
    Watcher() {
        sem_init(&told_, 0, 0);
        std::thread([this] { run(); }).detach();
    }
    static Watcher& of_this_process() {
        static Watcher& watcher = *new Watcher;
        return watcher;
    }
    // Also in a signal's handler.
    void tell() { sem_post(&told_); }

    void set_exit_code(int code) {
        const std::lock_guard lock(mutex_);
        exit_code_ = code;
    }
    void begin_saving(Duration patience) {
        const std::lock_guard lock(mutex_);
        watch_.begin_saving(patience);
    }
    void end_saving(Duration patience) {
        const std::lock_guard lock(mutex_);
        watch_.end_saving(patience, steady_now());
        changed_.notify_all();
    }

private:
    [[noreturn]] void run() {
        name_this_thread("end");
        while (sem_wait(&told_) != 0 && errno == EINTR) {
        }
        std::unique_lock lock(mutex_);
        watch_.tell(steady_now());
        while (*watch_.due() > steady_now())
            changed_.wait_for(lock, *watch_.due() - steady_now());
        const bool is_saved = !watch_.is_saving();
        log::say(is_saved ? "Something did not end in time, so the program was ended; everything "
                            "was saved before."
                          : "Something could not be saved in time, and the program was ended.");
        log::flush(last_words);
        _exit(is_saved ? exit_code_ : 1);
    }

    sem_t told_{};
    std::mutex mutex_;
    std::condition_variable changed_;
    EndWatch watch_;
    int exit_code_ = 0;
};

Watcher* caught = nullptr;

}  // namespace

void catch_stop_signals() {
    caught = &Watcher::of_this_process();
    const auto stop = [](int signal) {
        int none = 0;
        requested.compare_exchange_strong(none, signal);
        caught->tell();
    };
    std::signal(SIGINT, stop);
    std::signal(SIGTERM, stop);
    // A command that was started to outlive its terminal (nohup) ignores it; that is kept.
    if (std::signal(SIGHUP, stop) == SIG_IGN)
        std::signal(SIGHUP, SIG_IGN);
}

bool stop_requested() {
    return requested != 0;
}

bool stopped_by_person() {
    return requested == SIGINT;
}

void begin_end(int exit_code) {
    Watcher::of_this_process().set_exit_code(exit_code);
    Watcher::of_this_process().tell();
}

Saving::Saving(Duration patience) : patience_(patience) {
    Watcher::of_this_process().begin_saving(patience);
}

Saving::~Saving() {
    Watcher::of_this_process().end_saving(patience_);
}

}  // namespace theatron::cli

// SPDX-License-Identifier: Apache-2.0
#include "sandbox/spawn_plan.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <condition_variable>
#include <cstring>
#include <functional>
#include <future>
#include <mutex>
#include <queue>
#include <thread>
#include <utility>

#include "base/error.h"
#include "base/thread_name.h"

namespace theatron::sandbox {
namespace {

// PR_SET_PDEATHSIG refers to the thread that started the child, so a permanent thread starts all.
class LastingThread {
public:
    static LastingThread& instance() {
        // Never destroyed: threads of cameras may outlive main().
        static LastingThread& only = *new LastingThread;
        return only;
    }

    pid_t call(std::function<pid_t()> work) {
        std::packaged_task<pid_t()> task(std::move(work));
        std::future<pid_t> result = task.get_future();
        {
            const std::lock_guard lock(mutex_);
            tasks_.push(std::move(task));
        }
        wake_.notify_one();
        return result.get();
    }

private:
    LastingThread() {
        std::thread([this] {
            name_this_thread("spawn");
            while (true)
                next()();
        }).detach();
    }

    std::packaged_task<pid_t()> next() {
        std::unique_lock lock(mutex_);
        wake_.wait(lock, [this] { return !tasks_.empty(); });
        std::packaged_task<pid_t()> task = std::move(tasks_.front());
        tasks_.pop();
        return task;
    }

    std::mutex mutex_;
    std::condition_variable wake_;
    std::queue<std::packaged_task<pid_t()>> tasks_;
};

}  // namespace

SpawnPlan::SpawnPlan(std::string what) : what_(std::move(what)) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawnattr_init(&attributes_);
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setsigdefault(&attributes_, &all);
    posix_spawnattr_setpgroup(&attributes_, 0);
    posix_spawnattr_setflags(
        &attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
}

SpawnPlan::~SpawnPlan() {
    for (const int copy : copies_)
        close(copy);
    posix_spawnattr_destroy(&attributes_);
    posix_spawn_file_actions_destroy(&actions_);
}

void SpawnPlan::to_null(int descriptor, int flags) {
    posix_spawn_file_actions_addopen(&actions_, descriptor, "/dev/null", flags, 0);
}

// Copies to a high number first, so that later moves do not overwrite the descriptor.
void SpawnPlan::move(int from, int to) {
    constexpr int above = 16;
    const int copy = fcntl(from, F_DUPFD_CLOEXEC, above);
    if (copy < 0)
        throw Error("Too many files are open to start " + what_ + ".");
    copies_.push_back(copy);
    posix_spawn_file_actions_adddup2(&actions_, copy, to);
}

void SpawnPlan::close_from(int first) {
    posix_spawn_file_actions_addclosefrom_np(&actions_, first);
}

pid_t SpawnPlan::start(const char* program, std::vector<std::string> words,
                       char** environment) const {
    std::vector<char*> argv;
    for (std::string& word : words)
        argv.push_back(word.data());
    argv.push_back(nullptr);
    pid_t pid = -1;
    const int error = LastingThread::instance().call([&] {
        return posix_spawn(&pid, program, &actions_, &attributes_, argv.data(), environment);
    });
    if (error != 0)
        throw Error("Cannot start " + what_ + ": " + std::strerror(error) + ".");
    return pid;
}

}  // namespace theatron::sandbox

// SPDX-License-Identifier: Apache-2.0
#include "sandbox/spawn.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <unistd.h>

#include <condition_variable>
#include <cstring>
#include <functional>
#include <future>
#include <mutex>
#include <queue>
#include <string_view>
#include <thread>

#include "base/error.h"
#include "base/thread_name.h"
#include "sandbox/filter.h"

extern char** environ;

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

// The variables that a program needs to start. A reader gets no others.
std::vector<char*> small_environment() {
    std::vector<char*> kept;
    for (char** entry = environ; *entry; ++entry) {
        const std::string_view name = std::string_view(*entry).substr(0, std::strcspn(*entry, "="));
        if (name == "LD_LIBRARY_PATH" || name.ends_with("SAN_OPTIONS"))
            kept.push_back(*entry);
    }
    kept.push_back(nullptr);
    return kept;
}

class Actions {
public:
    Actions() {
        posix_spawn_file_actions_init(&actions_);
        posix_spawnattr_init(&attributes_);
    }
    ~Actions() {
        for (const int copy : copies_)
            close(copy);
        posix_spawnattr_destroy(&attributes_);
        posix_spawn_file_actions_destroy(&actions_);
    }
    Actions(const Actions&) = delete;

    void to_null(int descriptor, int flags) {
        posix_spawn_file_actions_addopen(&actions_, descriptor, "/dev/null", flags, 0);
    }
    // Copies to a high number first, so that later moves do not overwrite the descriptor.
    void move(int from, int to) {
        constexpr int above = 16;
        const int copy = fcntl(from, F_DUPFD_CLOEXEC, above);
        if (copy < 0)
            throw Error("Too many files are open to start a reader.");
        copies_.push_back(copy);
        posix_spawn_file_actions_adddup2(&actions_, copy, to);
    }
    void close_from(int first) { posix_spawn_file_actions_addclosefrom_np(&actions_, first); }

    // Ctrl-C in the terminal is for the parent only.
    void detach_from_terminal() {
        sigset_t none, all;
        sigemptyset(&none);
        sigfillset(&all);
        posix_spawnattr_setsigmask(&attributes_, &none);
        posix_spawnattr_setsigdefault(&attributes_, &all);
        posix_spawnattr_setpgroup(&attributes_, 0);
        posix_spawnattr_setflags(
            &attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    }

    int spawn(pid_t& pid, char** argv, char** environment) const {
        return posix_spawn(&pid, "/proc/self/exe", &actions_, &attributes_, argv, environment);
    }

private:
    posix_spawn_file_actions_t actions_;
    posix_spawnattr_t attributes_;
    std::vector<int> copies_;
};

}  // namespace

pid_t spawn(const SpawnOptions& options) {
    std::vector<std::string> arguments = options.arguments;
    arguments.insert(arguments.begin(), program_invocation_short_name);
    std::vector<char*> argv;
    for (std::string& argument : arguments)
        argv.push_back(argument.data());
    argv.push_back(nullptr);

    Actions actions;
    actions.to_null(STDIN_FILENO, O_RDONLY);
    actions.to_null(STDOUT_FILENO, O_WRONLY);
    // Reports of a sanitizer must stay visible.
    if (!has_sanitizer)
        actions.to_null(STDERR_FILENO, O_WRONLY);
    actions.move(options.channel, channel_descriptor);
    actions.move(options.input, input_descriptor);
    actions.move(options.area, area_descriptor);
    actions.close_from(area_descriptor + 1);
    actions.detach_from_terminal();

    std::vector<char*> environment = small_environment();
    pid_t pid = -1;
    const int error = LastingThread::instance().call(
        [&] { return actions.spawn(pid, argv.data(), environment.data()); });
    if (error != 0)
        throw Error(std::string("Cannot start a reader: ") + std::strerror(error) + ".");
    return pid;
}

}  // namespace theatron::sandbox

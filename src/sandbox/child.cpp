// SPDX-License-Identifier: Apache-2.0
#include "sandbox/child.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <utility>

#include "base/descriptor.h"
#include "base/error.h"
#include "base/log.h"
#include "sandbox/protocol.h"
#include "sandbox/spawn.h"

namespace theatron::sandbox {
namespace {

Descriptor opened(int number) {
    if (number < 0)
        throw Error(std::string("Cannot start a reader: ") + std::strerror(errno) + ".");
    return Descriptor(number);
}

// Shared memory with a sealed size: shrinking it would crash the other process on access.
Descriptor make_area(std::size_t bytes) {
    Descriptor area = opened(memfd_create("theatron", MFD_CLOEXEC | MFD_ALLOW_SEALING));
    if (ftruncate(area.get(), off_t(bytes)) != 0 ||
        fcntl(area.get(), F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) != 0)
        throw Error("Cannot make the memory that is shared with a reader.");
    return area;
}

bool wanted_unfiltered() {
    const char* set = std::getenv(unfiltered_variable);
    return set && std::string_view(set) == "1";
}

void say_once_that_nothing_filters() {
    static std::atomic_flag said;
    if (!said.test_and_set())
        log::warning(
            "sandbox",
            "foreign files are read without a system-call filter, which this system lacks");
}

std::string in_seconds(Duration time) {
    return std::to_string(std::chrono::duration_cast<std::chrono::seconds>(time).count()) + " s";
}

int milliseconds(Duration time) {
    return int(std::chrono::duration_cast<std::chrono::milliseconds>(time).count());
}

}  // namespace

Child::Child(const std::string& reader, int input, std::string subject, const Limits& limits)
    : subject_(std::move(subject)), limits_(limits) {
    if (!can_start_children())
        throw Error("This program's main() does not call sandbox::run_as_child().");
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0)
        throw Error(std::string("Cannot start a reader: ") + std::strerror(errno) + ".");
    Descriptor ours(ends[0]);
    Descriptor theirs(ends[1]);
    const Descriptor area = make_area(limits.area_bytes);
    void* const shared = mmap(nullptr, limits.area_bytes, PROT_READ, MAP_SHARED, area.get(), 0);
    if (shared == MAP_FAILED)
        throw Error("Cannot make the memory that is shared with a reader.");
    area_ = {static_cast<std::byte*>(shared), limits.area_bytes};
    channel_ = ours.get();
    message_.resize(max_message_bytes + 1);
    try {
        pid_ = spawn({{child_argument, reader, std::to_string(getpid()),
                       std::to_string(limits.area_bytes), std::to_string(limits.memory_bytes),
                       std::to_string(limits.cpu_seconds), wanted_unfiltered() ? "1" : "0"},
                      theirs.get(),
                      input,
                      area.get()});
        // Only the child has its end of the channel, so the channel closes when it ends.
        close(theirs.release());
        const ByteView ready = receive_within(limits_.start);
        if (ready.size() != 1 ||
            (ready[0] != std::byte(Ready::filtered) && ready[0] != std::byte(Ready::unfiltered)))
            refuse("no beginning");
        if (ready[0] == std::byte(Ready::unfiltered))
            say_once_that_nothing_filters();
    } catch (...) {
        end();
        munmap(area_.data(), area_.size());
        throw;
    }
    ours.release();
}

Child::~Child() {
    end();
    close(channel_);
    munmap(area_.data(), area_.size());
}

void Child::send(ByteView message) {
    if (pid_ < 0)
        throw Error(problem_);
    if (::send(channel_, message.data(), message.size(), MSG_NOSIGNAL | MSG_DONTWAIT) < 0) {
        if (errno == EAGAIN)
            refuse("no heed to what it is asked");
        report_end();
    }
}

ByteView Child::receive() {
    const ByteView message = receive_within(limits_.answer);
    if (++answers_ % answers_per_cpu_limit == 0)
        allow_more_cpu_time();
    return message;
}

bool Child::wait(Duration timeout) {
    pollfd ready{channel_, POLLIN, 0};
    int count;
    do {
        count = poll(&ready, 1, milliseconds(timeout));
    } while (count < 0 && errno == EINTR);
    return pid_ < 0 || count != 0;
}

ByteView Child::receive_within(Duration patience) {
    if (pid_ < 0)
        throw Error(problem_);
    if (!wait(patience))
        fail("kept its reader busy for " + in_seconds(patience) + " without an answer");
    const ssize_t size = recv(channel_, message_.data(), message_.size(), MSG_DONTWAIT);
    if (size <= 0)
        report_end();
    if (std::size_t(size) > max_message_bytes)
        refuse("a message that is too long");
    return ByteView(message_).first(std::size_t(size));
}

void Child::allow_more_cpu_time() {
    clockid_t clock;
    timespec used{};
    rlimit limit{};
    if (clock_getcpuclockid(pid_, &clock) != 0 || clock_gettime(clock, &used) != 0 ||
        prlimit(pid_, RLIMIT_CPU, nullptr, &limit) != 0)
        return;
    limit.rlim_cur = rlim_t(used.tv_sec) + rlim_t(limits_.cpu_seconds);
    prlimit(pid_, RLIMIT_CPU, &limit, nullptr);
}

void Child::refuse(const std::string& what) {
    fail("made its reader give an impossible answer (" + what + ")");
}

// Called when the channel has closed, which only the end of the child causes.
void Child::report_end() {
    const int status = end();
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    if (code == ended_no_filter)
        problem_ = "This system has no system-call filter (seccomp), without which " + subject_ +
                   " is not read; set " + unfiltered_variable +
                   "=1 to read such files all the same.";
    else if (code == ended_no_limits)
        problem_ =
            "The limits of a reader cannot be set, without which " + subject_ + " is not read.";
    if (!problem_.empty())
        throw Error(problem_);
    if (code == ended_out_of_memory)
        fail("made its reader use more than " + std::to_string(limits_.memory_bytes >> 20) +
             " MiB of memory");
    if (signal == SIGXCPU)
        fail("made its reader compute for more than " + std::to_string(limits_.cpu_seconds) + " s");
    if (signal == SIGSYS)
        fail("made its reader try a system call that it may not make");
    if (signal != 0)
        fail(std::string("made its reader crash (") + strsignal(signal) + ")");
    fail("made its reader end");
}

void Child::fail(const std::string& what) {
    end();
    std::string subject = subject_;
    if (!subject.empty() && subject[0] >= 'a' && subject[0] <= 'z')
        subject[0] = char(subject[0] - 'a' + 'A');
    problem_ = subject + " " + what + ", so it is not read any further.";
    throw Error(problem_);
}

// Ends the child; returns its status as of waitpid().
int Child::end() {
    int status = 0;
    if (pid_ > 0) {
        kill(pid_, SIGKILL);
        while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
        }
    }
    pid_ = -1;
    return status;
}

}  // namespace theatron::sandbox

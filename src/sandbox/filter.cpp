// SPDX-License-Identifier: Apache-2.0
#include "sandbox/filter.h"

#include <errno.h>
#include <linux/videodev2.h>
#include <seccomp.h>
#include <signal.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <initializer_list>
#include <memory>

namespace theatron::sandbox {
namespace {

class Filter {
public:
    Filter() : context_(seccomp_init(SCMP_ACT_KILL_PROCESS), seccomp_release) {
        good_ = context_ != nullptr;
        if (good_ && !has_sanitizer)
            check(seccomp_attr_set(context_.get(), SCMP_FLTATR_CTL_TSYNC, 1));
    }

    // Allows the call if all conditions on its arguments are met.
    void allow(int call, std::initializer_list<scmp_arg_cmp> conditions = {}) {
        if (good_)
            check(seccomp_rule_add_array(context_.get(), SCMP_ACT_ALLOW, call,
                                         unsigned(conditions.size()), conditions.begin()));
    }

    // The call does nothing and gives this error.
    void fail(int call, std::uint32_t error) {
        if (good_)
            check(seccomp_rule_add(context_.get(), SCMP_ACT_ERRNO(error), call, 0));
    }

    bool load() {
        if (good_)
            check(seccomp_load(context_.get()));
        return good_;
    }

private:
    void check(int error) { good_ = good_ && error == 0; }

    std::unique_ptr<void, decltype(&seccomp_release)> context_;
    bool good_ = false;
};

// The kernel ignores the upper half of a register that passes a descriptor or flags.
constexpr scmp_datum_t low_half = 0xffffffff;

scmp_arg_cmp is(unsigned argument, scmp_datum_t value) {
    return {argument, SCMP_CMP_MASKED_EQ, low_half, value};
}
scmp_arg_cmp lacks(unsigned argument, scmp_datum_t bits) {
    return {argument, SCMP_CMP_MASKED_EQ, bits, 0};
}
scmp_arg_cmp is_null(unsigned argument) {
    return {argument, SCMP_CMP_EQ, 0, 0};
}

void allow_computing(Filter& filter) {
    for (const int call :
         {SCMP_SYS(brk), SCMP_SYS(munmap), SCMP_SYS(mremap), SCMP_SYS(madvise), SCMP_SYS(futex),
          SCMP_SYS(clock_gettime), SCMP_SYS(gettimeofday), SCMP_SYS(sched_yield), SCMP_SYS(gettid),
          SCMP_SYS(getpid), SCMP_SYS(exit), SCMP_SYS(exit_group), SCMP_SYS(rt_sigreturn),
          SCMP_SYS(rt_sigprocmask), SCMP_SYS(restart_syscall)})
        filter.allow(call);
    // Private anonymous memory that is never executable.
    constexpr unsigned protection = 2, descriptor = 4;
    filter.allow(SCMP_SYS(mmap), {lacks(protection, PROT_EXEC), is(descriptor, low_half)});
    filter.allow(SCMP_SYS(mprotect), {lacks(protection, PROT_EXEC)});
    // abort() is allowed: its signal tells the parent more than a forbidden call would.
    filter.allow(SCMP_SYS(tgkill), {is(0, scmp_datum_t(getpid())), is(2, SIGABRT)});
    filter.allow(SCMP_SYS(write), {is(0, STDERR_FILENO)});
    filter.allow(SCMP_SYS(writev), {is(0, STDERR_FILENO)});
}

void allow_channel(Filter& filter) {
    filter.allow(SCMP_SYS(read), {is(0, channel_descriptor)});
    filter.allow(SCMP_SYS(write), {is(0, channel_descriptor)});
}

void allow_file(Filter& filter) {
    for (const int call : {SCMP_SYS(read), SCMP_SYS(pread64), SCMP_SYS(lseek)})
        filter.allow(call, {is(0, input_descriptor)});
}

void refuse_politely(Filter& filter) {
    for (const int call :
         {SCMP_SYS(open), SCMP_SYS(openat), SCMP_SYS(sched_getaffinity), SCMP_SYS(rt_sigaction)})
        filter.fail(call, EACCES);
    for (const int call : {SCMP_SYS(clone), SCMP_SYS(clone3)})
        filter.fail(call, EAGAIN);
}

void allow_source(Filter& filter) {
    filter.allow(SCMP_SYS(read), {is(0, input_descriptor)});
    filter.allow(SCMP_SYS(write), {is(0, input_descriptor)});
    // The address must be null: the call could otherwise reach other peers.
    constexpr unsigned address = 4;
    filter.allow(SCMP_SYS(recvfrom), {is(0, input_descriptor), is_null(address)});
    filter.allow(SCMP_SYS(sendto), {is(0, input_descriptor), is_null(address)});
    filter.allow(SCMP_SYS(poll));
    filter.allow(SCMP_SYS(ppoll));
}

void allow_stream(Filter& filter) {
    allow_source(filter);
    refuse_politely(filter);
    // libavformat asks for the name of the machine, to tell it to the server.
    filter.fail(SCMP_SYS(uname), EACCES);
}

// The peer of a connected socket is fixed: the address in a message has no effect.
void allow_display(Filter& filter) {
    allow_source(filter);
    filter.allow(SCMP_SYS(recvmsg), {is(0, input_descriptor)});
    filter.allow(SCMP_SYS(sendmsg), {is(0, input_descriptor)});
    filter.allow(SCMP_SYS(writev), {is(0, input_descriptor)});
    // The library ends a connection that the server has closed.
    filter.allow(SCMP_SYS(shutdown), {is(0, input_descriptor)});
    filter.allow(SCMP_SYS(close), {is(0, input_descriptor)});
    // The parent set the flags that the library sets.
    filter.fail(SCMP_SYS(fcntl), 0);
}

void allow_device(Filter& filter) {
    for (const unsigned long request :
         {VIDIOC_S_FMT, VIDIOC_S_PARM, VIDIOC_REQBUFS, VIDIOC_QUERYBUF, VIDIOC_QBUF, VIDIOC_DQBUF,
          VIDIOC_STREAMON})
        filter.allow(SCMP_SYS(ioctl), {is(0, input_descriptor), is(1, request)});
    constexpr unsigned protection = 2, descriptor = 4;
    filter.allow(SCMP_SYS(mmap),
                 {lacks(protection, PROT_EXEC | PROT_WRITE), is(descriptor, input_descriptor)});
    filter.allow(SCMP_SYS(poll));
    filter.allow(SCMP_SYS(ppoll));
    refuse_politely(filter);
}

}  // namespace

bool load_filter(Profile profile) {
    Filter filter;
    allow_computing(filter);
    allow_channel(filter);
    switch (profile) {
        case Profile::file:
            allow_file(filter);
            break;
        case Profile::library:
            allow_file(filter);
            refuse_politely(filter);
            break;
        case Profile::source:
            allow_source(filter);
            break;
        case Profile::stream:
            allow_stream(filter);
            break;
        case Profile::display:
            allow_display(filter);
            break;
        case Profile::device:
            allow_device(filter);
            break;
    }
    return filter.load();
}

}  // namespace theatron::sandbox

// SPDX-License-Identifier: Apache-2.0
// A video device that does not exist: a library for LD_PRELOAD. The program that it is preloaded
// into opens the device and hands it to a reader process, as it would a real one.
//
// V4L2_STANDIN_DEVICE is the path that is opened. V4L2_STANDIN_PICTURES: the number of pictures
// after which the device is unplugged; it can be opened again.
//
// The device is a memory file, whose bytes are its buffers. Each control, mapping and poll is also
// made as the real system call, so the reader's filter judges it as it would with a real device.
// The reader of video devices is the only child process that gets this library and its variables:
// readers get no variables of the program (sandbox/spawn.cpp).
#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "standin_device.h"

#define EXPORTED extern "C" __attribute__((visibility("default")))

namespace {

constexpr const char* memory_name = "v4l2_standin";
constexpr std::string_view reader_argument = "--sandboxed-reader", reader_name = "v4l2";

template <class Function>
Function* next(Function*, const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

bool is_memory(int descriptor) {
    char link[32], path[64] = {};
    std::snprintf(link, sizeof(link), "/proc/self/fd/%d", descriptor);
    return readlink(link, path, sizeof(path) - 1) > 0 &&
           std::string_view(path).substr(0, 8 + std::strlen(memory_name)) ==
               std::string("/memfd:") + memory_name + " ";
}

// The device that this process was handed: found before the filter, which allows no look.
struct Handed {
    int descriptor = -1;
    std::optional<standin::Device> device;

    Handed() {
        for (int one = 3; one < 8; ++one)
            if (is_memory(one))
                descriptor = one;
        if (descriptor < 0)
            return;
        void* const memory = mmap(nullptr, standin::most_buffers * standin::buffer_bytes,
                                  PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
        if (memory == MAP_FAILED)
            return;
        const char* const pictures = std::getenv("V4L2_STANDIN_PICTURES");
        device.emplace(static_cast<std::uint8_t*>(memory), pictures ? std::atol(pictures) : 0);
    }
};
Handed handed;

// The program that opens the device only asks for its abilities.
int control(int descriptor, unsigned long request, void* argument) {
    if (handed.device && descriptor == handed.descriptor)
        return handed.device->control(request, argument);
    standin::Device closed(nullptr, 0);
    return request == VIDIOC_QUERYCAP ? closed.control(request, argument) : ENOTTY;
}

int open_device() {
    const int descriptor = memfd_create(memory_name, MFD_CLOEXEC);
    if (descriptor >= 0 &&
        ftruncate(descriptor, off_t(standin::most_buffers * standin::buffer_bytes)) != 0)
        return -1;
    return descriptor;
}

bool is_device(const char* path) {
    const char* const device = std::getenv("V4L2_STANDIN_DEVICE");
    return device && path && std::strcmp(path, device) == 0;
}

}  // namespace

// The mode argument exists only with O_CREAT or O_TMPFILE; otherwise the number read here is not
// used.
#define OPENED(name)                          \
    va_list rest;                             \
    va_start(rest, flags);                    \
    const mode_t mode = va_arg(rest, mode_t); \
    va_end(rest);                             \
    return is_device(path) ? open_device() : next(name, #name)(path, flags, mode)

EXPORTED int open(const char* path, int flags, ...) {
    OPENED(open);
}

EXPORTED int open64(const char* path, int flags, ...) {
    OPENED(open64);
}

EXPORTED int fstat(int descriptor, struct stat* info) noexcept {
    const int result = next(fstat, "fstat")(descriptor, info);
    if (result == 0 && S_ISREG(info->st_mode) && is_memory(descriptor))
        info->st_mode = (info->st_mode & ~mode_t(S_IFMT)) | S_IFCHR;
    return result;
}

EXPORTED int ioctl(int descriptor, unsigned long request, ...) noexcept {
    va_list rest;
    va_start(rest, request);
    void* const argument = va_arg(rest, void*);
    va_end(rest);
    const long real = syscall(SYS_ioctl, descriptor, request, argument);
    if (real == 0 || errno != ENOTTY || (!handed.device && !is_memory(descriptor)))
        return int(real);
    if (handed.device && descriptor != handed.descriptor)
        return -1;
    errno = control(descriptor, request, argument);
    return errno == 0 ? 0 : -1;
}

// Waits as long as the device would.
EXPORTED int poll(pollfd* all, nfds_t count, int timeout_ms) {
    if (!handed.device || count != 1 || all->fd != handed.descriptor)
        return int(syscall(SYS_poll, all, count, timeout_ms));
    (void)syscall(SYS_poll, all, count, 0);
    int wait_ms = handed.device->ready_in_ms();
    if (wait_ms < 0) {
        all->revents = POLLERR;
        return 1;
    }
    if (timeout_ms >= 0 && wait_ms > timeout_ms)
        wait_ms = timeout_ms;
    if (wait_ms > 0)
        (void)syscall(SYS_poll, nullptr, 0, wait_ms);
    all->revents = handed.device->ready_in_ms() == 0 ? POLLIN : 0;
    return all->revents != 0;
}

EXPORTED int posix_spawn(pid_t* pid, const char* path, const posix_spawn_file_actions_t* actions,
                         const posix_spawnattr_t* attributes, char* const argv[],
                         char* const environment[]) {
    std::vector<std::string> own;
    std::vector<char*> variables;
    for (char* const* one = environment; one && *one; ++one)
        variables.push_back(*one);
    if (argv[0] && argv[1] && argv[2] && argv[1] == reader_argument && argv[2] == reader_name)
        for (const char* name : {"LD_PRELOAD", "V4L2_STANDIN_PICTURES"})
            if (const char* value = std::getenv(name))
                own.push_back(std::string(name) + "=" + value);
    for (std::string& one : own)
        variables.push_back(one.data());
    variables.push_back(nullptr);
    return next(posix_spawn, "posix_spawn")(pid, path, actions, attributes, argv, variables.data());
}

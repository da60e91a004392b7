// SPDX-License-Identifier: Apache-2.0
// A disk with faults: a library for LD_PRELOAD that stalls, slows down or fails
// the writing of files below one folder.
//
// SLOW_DISK_FOLDER names the folder by its real path. SLOW_DISK_CONTROL names a
// file outside of it, whose first word says how the disk is. The file is read at
// every call, so a test changes the disk while the program runs:
//
//   well      as without this library; also if the file is missing or empty
//   stall     every call waits until the file says something else
//   slow N    every call takes N milliseconds longer
//   full      a file cannot grow (ENOSPC); its present bytes can be overwritten
//   error     every call fails (EIO), also syncing
//   gone      every call fails (ENODEV), also opening: the disk was unplugged
//
// Covers write, pwrite, writev, pwritev, fallocate, ftruncate, fdatasync, fsync,
// sync_file_range and open for writing. Does not see writes that the C library's
// stdio makes by itself. Reading is never disturbed.
#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

#define EXPORTED extern "C" __attribute__((visibility("default")))

namespace {

constexpr long look_again_ms = 5;  // at the control file of a stalled disk

enum class Disk { well, stall, slow, full, error, gone };

struct State {
    Disk disk = Disk::well;
    long extra_ms = 0;  // of a slow one
};

void sleep_ms(long ms) {
    const timespec time{ms / 1000, ms % 1000 * 1'000'000};
    nanosleep(&time, nullptr);
}

State read_state() {
    const char* control = std::getenv("SLOW_DISK_CONTROL");
    // System calls, since this library has its own open().
    const int file =
        control ? int(syscall(SYS_openat, AT_FDCWD, control, O_RDONLY | O_CLOEXEC)) : -1;
    if (file < 0)
        return {};
    char text[64] = {};
    const ssize_t size = read(file, text, sizeof(text) - 1);
    syscall(SYS_close, file);
    if (size <= 0)
        return {};
    constexpr struct {
        const char* word;
        Disk disk;
    } words[] = {{"stall", Disk::stall},
                 {"slow", Disk::slow},
                 {"full", Disk::full},
                 {"error", Disk::error},
                 {"gone", Disk::gone}};
    for (const auto& [word, disk] : words)
        if (std::strncmp(text, word, std::strlen(word)) == 0)
            return {disk, std::atol(text + std::strlen(word))};
    return {};
}

bool is_below_folder(const char* path) {
    const char* folder = std::getenv("SLOW_DISK_FOLDER");
    if (!folder)
        return false;
    const std::size_t length = std::strlen(folder);
    return std::strncmp(path, folder, length) == 0 && path[length] == '/';
}

bool is_concerned(int file) {
    char link[32], path[PATH_MAX];
    std::snprintf(link, sizeof(link), "/proc/self/fd/%d", file);
    const ssize_t length = readlink(link, path, sizeof(path) - 1);
    if (length <= 0)
        return false;
    path[length] = 0;
    return is_below_folder(path);
}

// Waits as the disk would; returns the error of a call that would make the file `new_size`
// bytes long, or 0. A negative size means that the call does not make it longer.
int error_of_call(int file, off_t new_size) {
    const int errno_before = errno;
    if (!is_concerned(file)) {
        errno = errno_before;
        return 0;
    }
    State state = read_state();
    while (state.disk == Disk::stall) {
        sleep_ms(look_again_ms);
        state = read_state();
    }
    if (state.disk == Disk::slow)
        sleep_ms(state.extra_ms);
    struct stat info {};
    const bool grows = new_size >= 0 && fstat(file, &info) == 0 && new_size > info.st_size;
    errno = errno_before;
    switch (state.disk) {
        case Disk::full:
            return grows ? ENOSPC : 0;
        case Disk::error:
            return EIO;
        case Disk::gone:
            return ENODEV;
        default:
            return 0;
    }
}

template <class Function>
Function* next(Function*, const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

// Calls the real function, unless the disk fails.
template <class Function, class... Arguments>
auto call(Function* own, const char* name, int file, off_t new_size, Arguments... arguments) {
    using Result = decltype(own(file, arguments...));
    if (const int error = error_of_call(file, new_size); error != 0) {
        errno = error;
        return Result(-1);
    }
    return next(own, name)(file, arguments...);
}

off_t size_of(const iovec* parts, int count) {
    off_t size = 0;
    for (int i = 0; i < count; ++i)
        size += off_t(parts[i].iov_len);
    return size;
}

// Where write() goes on: at the end of a file that is appended to.
off_t position_of(int file) {
    struct stat info {};
    if (fcntl(file, F_GETFL) & O_APPEND)
        return fstat(file, &info) == 0 ? info.st_size : 0;
    return lseek(file, 0, SEEK_CUR);
}

int error_of_open(int folder, const char* path, int flags) {
    if ((flags & (O_WRONLY | O_RDWR | O_CREAT)) == 0)
        return 0;
    // The folder that the file lies in, by its real path.
    char text[PATH_MAX];
    std::snprintf(text, sizeof(text), "%s", path);
    char* slash = std::strrchr(text, '/');
    if (slash)
        slash[slash == text ? 1 : 0] = 0;
    const int parent = int(syscall(SYS_openat, folder, slash ? text : ".", O_PATH | O_CLOEXEC));
    if (parent < 0)
        return 0;
    char link[32], real[PATH_MAX];
    std::snprintf(link, sizeof(link), "/proc/self/fd/%d", parent);
    const ssize_t length = readlink(link, real, sizeof(real) - 2);
    syscall(SYS_close, parent);
    if (length <= 0)
        return 0;
    real[length] = '/';
    real[length + 1] = 0;
    return is_below_folder(real) && read_state().disk == Disk::gone ? ENODEV : 0;
}

}  // namespace

EXPORTED ssize_t write(int file, const void* bytes, size_t size) {
    return call(write, "write", file, position_of(file) + off_t(size), bytes, size);
}

EXPORTED ssize_t pwrite(int file, const void* bytes, size_t size, off_t at) {
    return call(pwrite, "pwrite", file, at + off_t(size), bytes, size, at);
}

EXPORTED ssize_t pwrite64(int file, const void* bytes, size_t size, off64_t at) {
    return call(pwrite64, "pwrite64", file, at + off_t(size), bytes, size, at);
}

EXPORTED ssize_t writev(int file, const iovec* parts, int count) {
    return call(writev, "writev", file, position_of(file) + size_of(parts, count), parts, count);
}

EXPORTED ssize_t pwritev(int file, const iovec* parts, int count, off_t at) {
    return call(pwritev, "pwritev", file, at + size_of(parts, count), parts, count, at);
}

EXPORTED ssize_t pwritev64(int file, const iovec* parts, int count, off64_t at) {
    return call(pwritev64, "pwritev64", file, at + size_of(parts, count), parts, count, at);
}

EXPORTED int fallocate(int file, int mode, off_t at, off_t size) {
    return call(fallocate, "fallocate", file, at + size, mode, at, size);
}

EXPORTED int fallocate64(int file, int mode, off64_t at, off64_t size) {
    return call(fallocate64, "fallocate64", file, at + size, mode, at, size);
}

// Takes no room, so a full disk does not mind.
EXPORTED int ftruncate(int file, off_t size) noexcept {
    return call(ftruncate, "ftruncate", file, -1, size);
}

EXPORTED int ftruncate64(int file, off64_t size) noexcept {
    return call(ftruncate64, "ftruncate64", file, -1, size);
}

EXPORTED int fdatasync(int file) {
    return call(fdatasync, "fdatasync", file, -1);
}

EXPORTED int fsync(int file) {
    return call(fsync, "fsync", file, -1);
}

EXPORTED int sync_file_range(int file, off64_t at, off64_t size, unsigned flags) {
    return call(sync_file_range, "sync_file_range", file, -1, at, size, flags);
}

// The mode argument exists only with O_CREAT or O_TMPFILE; otherwise the number read here is
// not used.
#define OPENED(name, folder, ...)                                           \
    va_list rest;                                                           \
    va_start(rest, flags);                                                  \
    const mode_t mode = va_arg(rest, mode_t);                               \
    va_end(rest);                                                           \
    if (const int error = error_of_open(folder, path, flags); error != 0) { \
        errno = error;                                                      \
        return -1;                                                          \
    }                                                                       \
    return next(name, #name)(__VA_ARGS__, flags, mode)

EXPORTED int open(const char* path, int flags, ...) {
    OPENED(open, AT_FDCWD, path);
}

EXPORTED int open64(const char* path, int flags, ...) {
    OPENED(open64, AT_FDCWD, path);
}

EXPORTED int openat(int folder, const char* path, int flags, ...) {
    OPENED(openat, folder, folder, path);
}

EXPORTED int openat64(int folder, const char* path, int flags, ...) {
    OPENED(openat64, folder, folder, path);
}

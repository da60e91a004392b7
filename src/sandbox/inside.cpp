// SPDX-License-Identifier: Apache-2.0
#include "sandbox/inside.h"

#include <fcntl.h>
#include <malloc.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <charconv>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <new>
#include <string_view>

#include "sandbox/filter.h"
#include "sandbox/protocol.h"

namespace theatron::sandbox {
namespace {

bool may_start_children = false;

// Input is trusted: only the parent writes these arguments.
std::size_t number(const char* text) {
    std::size_t value = 0;
    std::from_chars(text, text + std::strlen(text), value);
    return value;
}

// Ties this process to its parent's life. True on success.
bool die_with(pid_t parent) {
    // If the parent ended before the first call, another process is the parent by now.
    return prctl(PR_SET_PDEATHSIG, SIGKILL) == 0 && getppid() == parent;
}

// The size of this process' address space in bytes. 0: unknown.
std::size_t address_space() {
    const int file = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
    char text[128] = {};
    const ssize_t count = file < 0 ? -1 : read(file, text, sizeof(text) - 1);
    close(file);
    return count <= 0 ? 0 : number(std::strtok(text, " ")) * std::size_t(sysconf(_SC_PAGESIZE));
}

bool limit(__rlimit_resource what, rlim_t soft, rlim_t hard) {
    const rlimit value{soft, hard};
    return setrlimit(what, &value) == 0;
}

bool limit_resources(std::size_t memory, std::size_t cpu_seconds) {
    const std::size_t taken = address_space();
    const auto none = [](__rlimit_resource what) { return limit(what, 0, 0); };
    return taken > 0 && limit(RLIMIT_AS, taken + memory, taken + memory) &&
           // The parent raises the soft limit as long as answers come; the filter prevents the
           // child from doing so.
           limit(RLIMIT_CPU, cpu_seconds, RLIM_INFINITY) &&
           // No further descriptor can be opened.
           limit(RLIMIT_NOFILE, area_descriptor, area_descriptor) && none(RLIMIT_CORE) &&
           none(RLIMIT_FSIZE) && none(RLIMIT_NPROC) && none(RLIMIT_MEMLOCK) &&
           none(RLIMIT_MSGQUEUE) && prctl(PR_SET_DUMPABLE, 0) == 0 &&
           prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0;
}

// Maps the shared memory, followed by an inaccessible page that catches overruns. Empty: failed.
std::span<std::byte> map_area(std::size_t bytes) {
    const auto page = std::size_t(sysconf(_SC_PAGESIZE));
    void* const place =
        mmap(nullptr, bytes + page, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (place == MAP_FAILED)
        return {};
    void* const area =
        mmap(place, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_FIXED, area_descriptor, 0);
    close(area_descriptor);
    if (area == MAP_FAILED)
        return {};
    return {static_cast<std::byte*>(area), bytes};
}

int run(const Reader& reader, char** argv) {
    if (reader.prepare)
        reader.prepare();
    const std::span<std::byte> area = map_area(number(argv[area_argument]));
    if (area.empty() || !limit_resources(number(argv[memory_argument]), number(argv[cpu_argument])))
        return ended_no_limits;
    // After a failed allocation glibc tries another arena and reads the number of processors from a
    // file to bound their number.
    mallopt(M_ARENA_MAX, 1);
    // A set time zone keeps date formatting from opening a file.
    setenv("TZ", "UTC", 1);
    tzset();
    const bool filtered = load_filter(reader.profile);
    if (!filtered && number(argv[unfiltered_argument]) != 1)
        return ended_no_filter;
    Inside inside(input_descriptor, area);
    const auto ready = std::byte(filtered ? Ready::filtered : Ready::unfiltered);
    try {
        inside.send({&ready, 1});
        reader.run(inside);
    } catch (const std::bad_alloc&) {
        return ended_out_of_memory;
    } catch (...) {
        return ended_by_exception;
    }
    return ended_well;
}

}  // namespace

std::optional<Bytes> Inside::receive() {
    Bytes message(max_message_bytes);
    const ssize_t count = read(channel_descriptor, message.data(), message.size());
    if (count <= 0)
        return std::nullopt;
    message.resize(std::size_t(count));
    return message;
}

void Inside::send(ByteView message) {
    // A failed write is ignored: the parent has ended this process or is about to.
    [[maybe_unused]] const ssize_t written =
        write(channel_descriptor, message.data(), message.size());
}

bool can_start_children() {
    return may_start_children;
}

void run_as_child(int argc, char** argv, std::span<const Reader> readers) {
    if (argc != argument_count || std::string_view(argv[1]) != child_argument) {
        may_start_children = true;
        return;
    }
    if (!die_with(pid_t(number(argv[parent_argument]))))
        _exit(ended_no_limits);
    for (const Reader& reader : readers)
        if (std::string_view(argv[name_argument]) == reader.name)
            // No exit handler of the program may run in the child.
            _exit(run(reader, argv));
    _exit(ended_no_limits);
}

}  // namespace theatron::sandbox

// SPDX-License-Identifier: Apache-2.0
// Malicious readers, each in a child of this test program. They try the attacks of somebody who
// controls a library through the bytes that it reads.
#include <arpa/inet.h>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <memory>
#include <new>
#include <thread>

#include "base/error.h"
#include "sandbox/child.h"
#include "sandbox/filter.h"
#include "sandbox/inside.h"
#include "testing/temporary_folder.h"

namespace theatron::sandbox {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
namespace fs = std::filesystem;

// The action of a reader when it receives a message.
using Deed = void (*)(Inside&);

template <Deed deed>
void when_asked(Inside& inside) {
    while (inside.receive()) {
        deed(inside);
        inside.send(as_bytes("still here"));
    }
}

void work(Inside& inside) {
    char text[16] = {};
    const ssize_t count = pread(inside.input(), text, sizeof(text), 0);
    std::memcpy(inside.area().data(), text, std::size_t(count));
}
void open_a_file(Inside&) {
    (void)open("/etc/passwd", O_RDONLY);
}
void try_to_open(Inside& inside) {
    const bool opened = open("/etc/passwd", O_RDONLY) >= 0;
    const bool refused = !opened && errno == EACCES;
    std::memcpy(inside.area().data(), refused ? "refused" : "opened ", 7);
}
void make_a_file(Inside&) {
    (void)open("/tmp/theatron_was_here", O_WRONLY | O_CREAT, 0600);
}
void connect_somewhere(Inside&) {
    const int s = socket(AF_INET, SOCK_STREAM, 0);
    const sockaddr_in address{AF_INET, htons(80), {htonl(INADDR_LOOPBACK)}, {}};
    (void)connect(s, reinterpret_cast<const sockaddr*>(&address), sizeof(address));
}
void fork_itself(Inside&) {
    if (syscall(SYS_fork) == 0)
        pause();
}
void start_a_thread(Inside&) {
    std::thread([] {}).join();
}
void execute_a_program(Inside&) {
    char name[] = "/bin/true";
    char* const arguments[] = {name, nullptr};
    execv(name, arguments);
}
void kill_its_parent(Inside&) {
    kill(getppid(), SIGTERM);
}
void abort_its_parent(Inside&) {
    // The one signal allowed must not reach other processes.
    syscall(SYS_tgkill, getpid() - 1, getpid() - 1, SIGABRT);
}
void trace_its_parent(Inside&) {
    ptrace(PTRACE_ATTACH, getppid(), nullptr, nullptr);
}
void run_new_code(Inside&) {
    (void)mmap(nullptr, 4096, PROT_READ | PROT_WRITE | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1,
               0);
}
void map_the_file(Inside& inside) {
    (void)mmap(nullptr, 4096, PROT_READ, MAP_PRIVATE, inside.input(), 0);
}
void write_to_the_file(Inside& inside) {
    (void)!write(inside.input(), "x", 1);
}
void raise_its_limit(Inside&) {
    const rlimit more{1000, RLIM_INFINITY};
    setrlimit(RLIMIT_CPU, &more);
}
void outlive_its_parent(Inside&) {
    (void)syscall(SYS_prctl, 1, 0, 0, 0, 0);
}
void take_8_gib(Inside&) {
    for (int i = 0; i < 8; ++i)
        if (mmap(nullptr, std::size_t(1) << 30, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS,
                 -1, 0) == MAP_FAILED)
            throw std::bad_alloc();
}
void take_small_pieces(Inside&) {
    for (int i = 0; i < 8 << 10; ++i)
        if (mmap(nullptr, std::size_t(1) << 20, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS,
                 -1, 0) == MAP_FAILED)
            throw std::bad_alloc();
}
void spin(Inside&) {
    volatile unsigned turns = 0;
    while (true)
        turns = turns + 1;
}
void write_past_the_area(Inside& inside) {
    volatile std::byte* end = inside.area().data() + inside.area().size();
    *end = std::byte(1);
}
void crash(Inside&) {
    // A pointer that the compiler knows to be null may be left out with its write.
    volatile int* volatile nowhere = nullptr;
    *nowhere = 1;
}
void give_up(Inside&) {
    abort();
}
void throw_something(Inside&) {
    throw 1;
}
void talk_too_long(Inside& inside) {
    const Bytes message(max_message_bytes + 1);
    (void)!write(channel_descriptor, message.data(), message.size());
    (void)inside;
}
void talk_and_talk(Inside& inside) {
    for (int i = 0; i < 1'000'000; ++i)
        inside.send(as_bytes("more"));
}
// A reader of profile `source`: relays bytes from the connection, and answers there.
void pass_on(Inside& inside) {
    while (inside.receive()) {
        pollfd ready{inside.input(), POLLIN, 0};
        poll(&ready, 1, 10'000);
        char text[16];
        const ssize_t count = recv(inside.input(), text, sizeof(text), 0);
        send(inside.input(), "thanks", 6, 0);
        inside.send(as_bytes(std::string_view(text, std::size_t(count))));
    }
}
void send_elsewhere(Inside& inside) {
    const sockaddr_in address{AF_INET, htons(80), {htonl(INADDR_LOOPBACK)}, {}};
    sendto(inside.input(), "x", 1, 0, reinterpret_cast<const sockaddr*>(&address), sizeof(address));
}
void control_a_device(Inside& inside) {
    syscall(SYS_ioctl, inside.input(), 0x5413, 0);
}

struct Forbidden {
    Reader reader;
    const char* said;
};

constexpr const char* not_allowed = "a system call that it may not make";

const std::vector<Forbidden> harm = {
    {{"open", Profile::file, when_asked<open_a_file>}, not_allowed},
    {{"make", Profile::file, when_asked<make_a_file>}, not_allowed},
    {{"connect", Profile::file, when_asked<connect_somewhere>}, not_allowed},
    {{"fork", Profile::file, when_asked<fork_itself>}, not_allowed},
    {{"thread", Profile::file, when_asked<start_a_thread>}, not_allowed},
    {{"exec", Profile::file, when_asked<execute_a_program>}, not_allowed},
    {{"kill", Profile::file, when_asked<kill_its_parent>}, not_allowed},
    {{"tgkill", Profile::file, when_asked<abort_its_parent>}, not_allowed},
    {{"ptrace", Profile::file, when_asked<trace_its_parent>}, not_allowed},
    {{"code", Profile::file, when_asked<run_new_code>}, not_allowed},
    {{"map", Profile::file, when_asked<map_the_file>}, not_allowed},
    {{"write", Profile::file, when_asked<write_to_the_file>}, not_allowed},
    {{"limits", Profile::file, when_asked<raise_its_limit>}, not_allowed},
    {{"outlive", Profile::file, when_asked<outlive_its_parent>}, not_allowed},
    {{"8gib", Profile::file, when_asked<take_8_gib>}, "more than 64 MiB of memory"},
    {{"pieces", Profile::file, when_asked<take_small_pieces>}, "more than 64 MiB of memory"},
    {{"spin", Profile::file, when_asked<spin>}, "compute for more than 1 s"},
    {{"past", Profile::file, when_asked<write_past_the_area>}, "crash"},
    {{"crash", Profile::file, when_asked<crash>}, "crash"},
    {{"abort", Profile::file, when_asked<give_up>}, "crash"},
    {{"throw", Profile::file, when_asked<throw_something>}, "made its reader end"},
    {{"long", Profile::file, when_asked<talk_too_long>}, "a message that is too long"},
    {{"library fork", Profile::library, when_asked<fork_itself>}, not_allowed},
    {{"library exec", Profile::library, when_asked<execute_a_program>}, not_allowed},
    {{"library connect", Profile::library, when_asked<connect_somewhere>}, not_allowed},
    {{"library write", Profile::library, when_asked<write_to_the_file>}, not_allowed},
    {{"library thread", Profile::library, when_asked<start_a_thread>}, "made its reader end"},
    {{"library 8gib", Profile::library, when_asked<take_8_gib>}, "more than 64 MiB of memory"},
    {{"source open", Profile::source, when_asked<open_a_file>}, not_allowed},
    {{"source connect", Profile::source, when_asked<connect_somewhere>}, not_allowed},
    {{"source sendto", Profile::source, when_asked<send_elsewhere>}, not_allowed},
    {{"source ioctl", Profile::source, when_asked<control_a_device>}, not_allowed},
    {{"stream connect", Profile::stream, when_asked<connect_somewhere>}, not_allowed},
    {{"stream sendto", Profile::stream, when_asked<send_elsewhere>}, not_allowed},
    {{"stream ioctl", Profile::stream, when_asked<control_a_device>}, not_allowed},
    {{"stream fork", Profile::stream, when_asked<fork_itself>}, not_allowed},
    {{"display open", Profile::display, when_asked<open_a_file>}, not_allowed},
    {{"display connect", Profile::display, when_asked<connect_somewhere>}, not_allowed},
    {{"display sendto", Profile::display, when_asked<send_elsewhere>}, not_allowed},
    {{"device connect", Profile::device, when_asked<connect_somewhere>}, not_allowed},
    {{"device ioctl", Profile::device, when_asked<control_a_device>}, not_allowed},
    {{"device write", Profile::device, when_asked<write_to_the_file>}, not_allowed},
};

std::vector<Reader> all_readers() {
    std::vector<Reader> readers = {{"good", Profile::file, when_asked<work>},
                                   {"library", Profile::library, when_asked<try_to_open>},
                                   {"source", Profile::source, pass_on},
                                   {"talk", Profile::file, when_asked<talk_and_talk>}};
    for (const Forbidden& forbidden : harm)
        readers.push_back(forbidden.reader);
    return readers;
}

constexpr Limits limits{
    .memory_bytes = 64 << 20, .area_bytes = 1 << 20, .cpu_seconds = 1, .start = 60s, .answer = 60s};

class Sandbox : public ::testing::Test {
protected:
    Sandbox() {
        const fs::path path = folder_.path() / "file";
        std::ofstream(path) << "content";
        file_ = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    }
    ~Sandbox() override { close(file_); }

    // The Error's sentence after one message to the reader.
    std::string problem_with(const char* reader, const Limits& l = limits) {
        Child child(reader, file_, "the file 'x'", l);
        child.send(as_bytes("go"));
        try {
            child.receive();
        } catch (const Error& error) {
            EXPECT_EQ(child.pid(), -1);
            return error.what();
        }
        return {};
    }

    theatron::testing::TemporaryFolder folder_;
    int file_ = -1;
};

std::string text(ByteView bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST_F(Sandbox, AReaderReadsTheFileThatTheParentOpened) {
    Child child("good", file_, "the file 'x'", limits);
    for (int i = 0; i < 2 * answers_per_cpu_limit + 1; ++i) {
        child.send(as_bytes("go"));
        EXPECT_EQ(text(child.receive()), "still here");
    }
    EXPECT_EQ(text(child.area().first(7)), "content");
}

TEST_F(Sandbox, ALibraryThatLooksForAFileFindsNoneAndGoesOn) {
    Child child("library", file_, "the file 'x'", limits);
    child.send(as_bytes("go"));
    EXPECT_EQ(text(child.receive()), "still here");
    EXPECT_EQ(text(child.area().first(7)), "refused");
}

TEST_F(Sandbox, WhatAReaderMayNotDoEndsItAloneAndIsSaid) {
    for (const Forbidden& forbidden : harm) {
        SCOPED_TRACE(forbidden.reader.name);
        const std::string problem = problem_with(forbidden.reader.name);
        EXPECT_THAT(problem, StartsWith("The file 'x' "));
        // A sanitizer's crash report makes other calls or needs memory, so the child ends
        // otherwise.
        if (!has_sanitizer) {
            EXPECT_THAT(problem, HasSubstr(forbidden.said));
        }
    }
    EXPECT_FALSE(fs::exists("/tmp/theatron_was_here"));
}

TEST_F(Sandbox, AReaderThatDoesNotAnswerIsEnded) {
    Limits impatient = limits;
    impatient.cpu_seconds = 60;
    impatient.answer = 0s;
    EXPECT_THAT(problem_with("spin", impatient), HasSubstr("busy for 0 s without an answer"));
}

TEST_F(Sandbox, AReaderThatTalksWithoutEndFillsNoMemoryOfTheParents) {
    Child child("talk", file_, "the file 'x'", limits);
    child.send(as_bytes("go"));
    for (int i = 0; i < 1000; ++i)
        EXPECT_EQ(text(child.receive()), "more");
}

TEST_F(Sandbox, NothingWorksWithAChildAfterItsEnd) {
    Child child("crash", file_, "the file 'x'", limits);
    child.send(as_bytes("go"));
    EXPECT_THROW(child.receive(), Error);
    EXPECT_THROW(child.receive(), Error);
    EXPECT_THROW(child.send(as_bytes("go")), Error);
}

TEST_F(Sandbox, WhatAParentRefusesEndsTheChild) {
    Child child("good", file_, "the file 'x'", limits);
    try {
        child.refuse("a picture of 7 GB");
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("impossible answer (a picture of 7 GB)"));
    }
    EXPECT_EQ(child.pid(), -1);
}

TEST_F(Sandbox, AReaderInheritsNothingButWhatItIsGiven) {
    const int secret = open((folder_.path() / "file").c_str(), O_RDONLY);  // no O_CLOEXEC
    setenv("THEATRON_TEST_SECRET", "1", 1);
    const Child child("good", file_, "the file 'x'", limits);
    const fs::path process = "/proc/" + std::to_string(child.pid());
    std::vector<int> descriptors;
    for (const auto& entry : fs::directory_iterator(process / "fd"))
        descriptors.push_back(std::stoi(entry.path().filename()));
    EXPECT_THAT(descriptors, ::testing::UnorderedElementsAre(0, 1, 2, 3, 4));
    std::ifstream environment(process / "environ");
    const std::string all((std::istreambuf_iterator<char>(environment)), {});
    EXPECT_EQ(all.find("THEATRON_TEST_SECRET"), std::string::npos);
    unsetenv("THEATRON_TEST_SECRET");
    close(secret);
}

TEST_F(Sandbox, AChildLivesAsLongAsItsParentNotAsTheThreadThatStartedIt) {
    std::unique_ptr<Child> child;
    std::thread([&] {
        child = std::make_unique<Child>("good", file_, "the file 'x'", limits);
    }).join();
    child->send(as_bytes("go"));
    EXPECT_EQ(text(child->receive()), "still here");
}

TEST_F(Sandbox, ASourceReadsAndAnswersTheConnectionThatTheParentOpened) {
    int ends[2];
    ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends), 0);
    Child child("source", ends[1], "the source 'y'", limits);
    child.send(as_bytes("go"));
    ASSERT_EQ(write(ends[0], "hello", 5), 5);
    EXPECT_EQ(text(child.receive()), "hello");
    char answer[6];
    ASSERT_EQ(read(ends[0], answer, sizeof(answer)), 6);
    EXPECT_EQ(std::string(answer, 6), "thanks");
    close(ends[0]);
    close(ends[1]);
}

TEST_F(Sandbox, NoChildIsLeftBehind) {
    for (const char* reader : {"good", "crash", "spin"})
        problem_with(reader);
    errno = 0;
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
    EXPECT_EQ(errno, ECHILD);
}

TEST_F(Sandbox, AReaderThatIsNotThereIsAnError) {
    EXPECT_THROW(Child("nobody", file_, "the file 'x'", limits), Error);
}

}  // namespace
}  // namespace theatron::sandbox

int main(int argc, char** argv) {
    theatron::sandbox::run_as_child(argc, argv, theatron::sandbox::all_readers());
    ::testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: Apache-2.0
#include "child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string_view>

#include "base/error.h"

namespace theatron::bench {

std::filesystem::path neighbour_program(const std::string& name) {
    return std::filesystem::read_symlink("/proc/self/exe").parent_path() / name;
}

ChildProcess::ChildProcess(const std::vector<std::string>& arguments, const std::string& state_home,
                           const std::string& name) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
        throw Error("Cannot start a child process.");
    const std::string program = neighbour_program(name).string();
    std::vector<std::string> copies = arguments;
    copies.insert(copies.begin(), program);
    std::vector<char*> argv;
    for (std::string& argument : copies)
        argv.push_back(argument.data());
    argv.push_back(nullptr);
    std::string own_state = "XDG_STATE_HOME=" + state_home;
    std::vector<char*> variables;
    for (char** variable = environ; *variable; ++variable)
        if (state_home.empty() || !std::string_view(*variable).starts_with("XDG_STATE_HOME="))
            variables.push_back(*variable);
    if (!state_home.empty())
        variables.push_back(own_state.data());
    variables.push_back(nullptr);

    const pid_t parent = getpid();
    pid_ = fork();
    if (pid_ == 0) {
        // Only system calls are safe here: other threads may have held locks at the fork.
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        const int nothing = open("/dev/null", O_RDONLY);
        if (getppid() == parent && nothing >= 0 && dup2(nothing, STDIN_FILENO) >= 0 &&
            dup2(ends[1], STDOUT_FILENO) >= 0)
            execve(program.c_str(), argv.data(), variables.data());
        _exit(127);
    }
    close(ends[1]);
    output_ = ends[0];
    if (pid_ < 0) {
        close(output_);
        throw Error("Cannot start a child process.");
    }
}

ChildProcess::~ChildProcess() {
    if (pid_ > 0) {
        kill(pid_, SIGKILL);
        waitpid(pid_, nullptr, 0);
    }
    close(output_);
}

std::string ChildProcess::read_line() {
    std::string line;
    char c = 0;
    while (read(output_, &c, 1) == 1 && c != '\n')
        line += c;
    return line;
}

void ChildProcess::interrupt() {
    if (pid_ > 0)
        kill(pid_, SIGINT);
}

ChildProcess::End ChildProcess::wait() {
    int status = 0;
    rusage usage{};
    wait4(pid_, &status, 0, &usage);
    pid_ = -1;
    const auto seconds = [](timeval t) { return double(t.tv_sec) + double(t.tv_usec) * 1e-6; };
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
            seconds(usage.ru_utime) + seconds(usage.ru_stime), double(usage.ru_maxrss) / 1024};
}

}  // namespace theatron::bench

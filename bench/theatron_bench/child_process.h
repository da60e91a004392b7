// SPDX-License-Identifier: Apache-2.0
// Runs a program of the same folder as a child, for measurements between processes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace theatron::bench {

// The path of a program beside this one, which may not exist.
std::filesystem::path neighbour_program(const std::string& name);

class ChildProcess {
public:
    // Starts it with `arguments`; its standard output is readable. The child is killed when the
    // calling thread ends, for whatever reason. `state_home`: of its person's settings; empty:
    // those of this process. Throws Error.
    explicit ChildProcess(const std::vector<std::string>& arguments,
                          const std::string& state_home = "",
                          const std::string& program = "theatron");
    ~ChildProcess();  // kills the child if it still runs
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    // The next line of the output; empty at the end.
    std::string read_line();

    int pid() const { return pid_; }
    void interrupt();

    struct End {
        int exit_code = 0;
        double cpu_seconds = 0;
        double peak_memory_mb = 0;
    };
    // Waits until the child has ended.
    End wait();

private:
    int pid_ = -1;
    int output_ = -1;
};

}  // namespace theatron::bench

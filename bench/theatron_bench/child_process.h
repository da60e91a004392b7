// SPDX-License-Identifier: Apache-2.0
// The program `theatron`, which lies beside this one, as a child: for measurements between
// processes.
#pragma once

#include <string>
#include <vector>

namespace theatron::bench {

class ChildProcess {
public:
    // Starts it with `arguments`; its standard output can be read. The child is
    // killed when the thread that calls this ends, however that comes about. Throws Error.
    explicit ChildProcess(const std::vector<std::string>& arguments);
    ~ChildProcess();  // kills what still runs
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    // The next line of its output; empty at the end.
    std::string read_line();

    int pid() const { return pid_; }
    void interrupt();

    struct End {
        int exit_code = 0;
        double cpu_seconds = 0;
        double peak_memory_mb = 0;
    };
    // Waits for its end.
    End wait();

private:
    int pid_ = -1;
    int output_ = -1;
};

}  // namespace theatron::bench

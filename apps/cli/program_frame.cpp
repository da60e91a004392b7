// SPDX-License-Identifier: Apache-2.0
#include "cli/program_frame.h"

#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>

#include "base/error.h"
#include "base/log.h"
#include "base/output.h"
#include "base/standard_streams.h"
#include "cli/instruction_set.h"
#include "cli/output_end.h"

namespace theatron::cli {
namespace {

// A crash dump would hold the people's faces and voices, the patient, keys and pictures. Linux
// neither writes a dump of one byte nor gives it to a program (core(5)); 0 stops files alone.
void forbid_crash_dumps() {
    rlimit limit{};
    if (getrlimit(RLIMIT_CORE, &limit) != 0)
        return;
    limit.rlim_cur = std::min<rlim_t>(1, limit.rlim_max);
    (void)setrlimit(RLIMIT_CORE, &limit);
}

void print_problem(const std::string& problem) {
    output::print("theatron: " + problem + "\n", output::Stream::error);
}

int run_and_tell(const std::function<int()>& work) {
    try {
        hold_to_instruction_set();
        return work();
    } catch (const Error& e) {
        print_problem(e.what());
    } catch (const std::filesystem::filesystem_error& e) {
        print_problem("Cannot use '" + e.path1().string() + "': " + e.code().message() + ".");
    } catch (const std::exception& e) {
        print_problem(std::string("something unexpected went wrong: ") + e.what());
    }
    return 1;
}

// Output may still be in a buffer or a queue, and writing it can fail.
int with_output_written(int code) {
    std::cout.flush();
    const bool is_flushed = std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout;
    if (finish_output() && is_flushed)
        return code;
    print_problem("The output could not be written: its disk is full or its reader gone.");
    (void)finish_output();
    return code != 0 ? code : 1;
}

}  // namespace

void run_program(int argc, char** argv, const std::vector<sandbox::Reader>& readers,
                 const std::function<int()>& work) {
    reserve_standard_streams();
    forbid_crash_dumps();
    sandbox::run_as_child(argc, argv, readers);
    outlive_readers();
    // At the file-size limit, writing then fails with an error instead of ending the process.
    std::signal(SIGXFSZ, SIG_IGN);
    log::flush_before_abort();
    const int code = with_output_written(run_and_tell(work));
    // Without what exit() runs: threads that nobody waits for may still be in a library or the
    // system.
    std::_Exit(code);
}

}  // namespace theatron::cli

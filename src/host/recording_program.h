// SPDX-License-Identifier: Apache-2.0
// A recording of a session that its host makes by itself, when an operator asks for it: the program
// `theatron record` as a child, which joins like any other recorder. A fault of it costs the host
// nothing, and its file is whole up to its last moments whatever happens to both.
//
// Safe from any thread.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "base/time.h"

namespace theatron::host {

class RecordingProgram {
public:
    // Until a child that was asked to end has its file whole; then it is killed.
    static constexpr Duration end_patience = std::chrono::seconds(20);
    // A recording does not begin on a disk with less.
    static constexpr std::uint64_t least_free_bytes = 200'000'000;

    enum class Phase {
        none,  // nothing was recorded yet
        running,
        ending,      // it fetches and writes the rest
        whole,       // the last one ended, and nothing is missing in it
        incomplete,  // something is missing in it; `inspect` lists what
        failed,      // it ended with `problem`
    };
    struct State {
        Phase phase = Phase::none;
        std::filesystem::path file;  // of the one that runs, or the last one
        double seconds = 0;
        std::uint64_t bytes = 0;                  // of its files
        std::optional<std::uint64_t> free_bytes;  // of the disk of recordings; nullopt: unknown
        std::string problem;                      // a sentence; of one that is not whole
    };

    struct Options {
        std::filesystem::path folder;  // of recordings, is made when the first one begins
        // The program and its words before the link and the file. It ends with this process.
        std::vector<std::string> program = {"/proc/self/exe", "record", "--with-parent"};
    };
    explicit RecordingProgram(Options options);
    ~RecordingProgram() { end(); }
    RecordingProgram(const RecordingProgram&) = delete;
    RecordingProgram& operator=(const RecordingProgram&) = delete;

    // Throws Error with one sentence where a recording cannot begin now.
    void require_ready(TimePoint now);
    // `link`: by which it joins; no other program sees it. `link_name`: of that link. `title`
    // begins the name of the file, as far as a file may have it. Returns the file. Throws Error.
    std::filesystem::path start(const std::string& link, const std::string& link_name,
                                const std::string& title, TimePoint now);
    // Asks it to end. False: none runs.
    bool stop();
    // Asks it to end and waits for that. From another thread than that of the session.
    void end();
    State state(TimePoint now);

    // To be called now and then, also where nobody asks for the state: the end of a recording,
    // once. `told`: its file and how it ended, for the audit log.
    struct End {
        std::string link, told;
    };
    std::optional<End> take_end(TimePoint now);

private:
    struct Child {
        pid_t id = 0;
        int said = -1;  // its standard error
        TimePoint begun;
    };
    // With mutex_:
    void look(TimePoint now);
    void listen();
    std::string problem_of(int status) const;

    const Options options_;
    std::mutex mutex_;  // guards all below
    std::optional<Child> child_;
    State state_;
    std::string link_, line_, remark_;  // the link's name; what the child says, and said last
    std::optional<End> ended_;
};

const char* text_of(RecordingProgram::Phase phase);

}  // namespace theatron::host

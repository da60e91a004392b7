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
        std::uint64_t bytes = 0;       // of its files
        std::uint64_t free_bytes = 0;  // of the disk on which recordings are; 0: unknown
        std::string problem;           // what the program said last
    };

    struct Options {
        std::filesystem::path folder;  // of recordings, is made when the first one begins
        // The program and its words before the link and the file.
        std::vector<std::string> program = {"/proc/self/exe", "record"};
    };
    explicit RecordingProgram(Options options) : options_(std::move(options)) {}
    // Waits for a child that runs, whose session has ended or is asked to end now.
    ~RecordingProgram();
    RecordingProgram(const RecordingProgram&) = delete;
    RecordingProgram& operator=(const RecordingProgram&) = delete;

    // `link`: by which it joins; no other program sees it. `title` begins the name of the file, as
    // far as a file may have it. Throws Error with one sentence, also where one runs already.
    void start(const std::string& link, const std::string& title, TimePoint now);
    // Asks it to end. False: none runs.
    bool stop();
    State state(TimePoint now);
    // Notices its end. To be called now and then, also where nobody asks for the state.
    void follow(TimePoint now);

private:
    struct Child {
        pid_t id = 0;
        TimePoint begun;
        bool asked = false;  // to end
    };
    void look(TimePoint now);  // with mutex_

    const Options options_;
    std::mutex mutex_;  // guards all below
    std::optional<Child> child_;
    State state_;
    std::filesystem::path remarks_;  // what the program says, beside its file
};

const char* text_of(RecordingProgram::Phase phase);

}  // namespace theatron::host

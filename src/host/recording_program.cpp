// SPDX-License-Identifier: Apache-2.0
#include "host/recording_program.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string_view>
#include <thread>
#include <utility>

#include "base/error.h"
#include "base/log.h"
#include "base/outside_text.h"
#include "base/steady_clock.h"
#include "files/private_file.h"
#include "files/utc_text.h"
#include "record/segment_files.h"
#include "sandbox/spawn_plan.h"

namespace theatron::host {
namespace {

namespace fs = std::filesystem;

// As those of `theatron record`.
constexpr int exit_incomplete = 3;
constexpr std::size_t max_title = 60;  // bytes
constexpr std::size_t shown_of_remark = 300;

// Characters that every file system and shell takes as they are; '-' for the others.
std::string file_title(const std::string& title) {
    std::string result;
    for (const char c : clean_text(title, max_title)) {
        const bool is_plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') ||
                              (c >= 'A' && c <= 'Z') || c == '_' || c == '-';
        if (is_plain || (!result.empty() && result.back() != '-'))
            result += is_plain ? c : '-';
    }
    while (result.ends_with('-'))
        result.pop_back();
    return result.empty() ? "session" : result;
}

// "OR-3-2026-11-30T02-19-21Z.mkv", that is not there yet.
fs::path new_file(const fs::path& folder, const std::string& title) {
    std::string time = files::utc_text(files::utc_now());
    std::ranges::replace(time, ':', '-');
    const std::string name = file_title(title) + "-" + time;
    fs::path file = folder / (name + ".mkv");
    std::error_code none;
    for (int number = 2; fs::exists(file, none); ++number)
        file = folder / (name + "-" + std::to_string(number) + ".mkv");
    return file;
}

// With its later segments.
std::uint64_t bytes_of(const fs::path& file) {
    std::uint64_t bytes = 0;
    std::vector<fs::path> files = record::files_of_later_segments(file);
    files.push_back(file);
    for (const fs::path& part : files) {
        std::error_code none;
        if (const auto size = fs::file_size(part, none); !none)
            bytes += size;
    }
    return bytes;
}

class Pipe {
public:
    Pipe() {
        if (pipe2(ends_, O_CLOEXEC) != 0)
            throw Error("No recording was started: too many files are open.");
    }
    ~Pipe() {
        for (const int end : ends_)
            if (end >= 0)
                close(end);
    }
    Pipe(const Pipe&) = delete;
    int out() const { return ends_[0]; }
    int in() const { return ends_[1]; }
    // The text fits into the buffer of a pipe.
    void write(const std::string& text) const {
        if (::write(in(), text.data(), text.size()) != ssize_t(text.size()))
            throw Error("No recording was started: its link could not be handed over.");
    }
    // Reading from it never waits; owned by the caller.
    int take_out() {
        (void)fcntl(out(), F_SETFL, O_NONBLOCK);
        return std::exchange(ends_[0], -1);
    }

private:
    int ends_[2];
};

// Its standard input is `in`, its errors go to `said`.
pid_t spawn_program(std::vector<std::string> words, int in, int said) {
    sandbox::SpawnPlan plan("a recording");
    plan.move(in, STDIN_FILENO);
    plan.to_null(STDOUT_FILENO, O_WRONLY);
    plan.move(said, STDERR_FILENO);
    plan.close_from(STDERR_FILENO + 1);
    const std::string program = words.front();
    return plan.start(program.c_str(), std::move(words), environ);
}

// The recordings of a folder that the administrator has made are read by whom that one chose.
void make_folder(const fs::path& folder) {
    std::error_code none;
    if (!fs::is_directory(folder, none))
        files::open_private_folder(folder);
}

// Free bytes of the disk on which `folder` is, or will be.
std::optional<std::uint64_t> free_bytes_for(fs::path folder) {
    std::error_code none;
    while (!fs::exists(folder, none) && folder != folder.parent_path())
        folder = folder.parent_path();
    const auto space = fs::space(folder, none);
    return none ? std::nullopt : std::optional(std::uint64_t(space.available));
}

}  // namespace

const char* text_of(RecordingProgram::Phase phase) {
    constexpr const char* texts[] = {"none", "running", "ending", "whole", "incomplete", "failed"};
    return texts[std::size_t(phase)];
}

RecordingProgram::RecordingProgram(Options options)
    : options_([&] {
          options.folder = fs::absolute(options.folder);
          return std::move(options);
      }()) {}

void RecordingProgram::end() {
    (void)stop();
    const TimePoint end = steady_now() + end_patience;
    for (bool is_killed = false;;) {
        {
            const std::lock_guard lock(mutex_);
            look(steady_now());
            if (!child_)
                return;
            if (steady_now() > end && !std::exchange(is_killed, true)) {
                log::warning("host", "a recording did not end and was killed",
                             {{"file", state_.file.string()}});
                kill(child_->id, SIGKILL);
            }
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
}

void RecordingProgram::require_ready(TimePoint now) {
    const std::lock_guard lock(mutex_);
    look(now);
    if (child_)
        throw Error("This session is being recorded already.");
    make_folder(options_.folder);
    const auto free = free_bytes_for(options_.folder);
    if (free && *free < least_free_bytes)
        throw Error("The disk of '" + options_.folder.string() +
                    "' is full; make room on it, or "
                    "name another folder with --recordings.");
}

fs::path RecordingProgram::start(const std::string& link, const std::string& link_name,
                                 const std::string& title, TimePoint now) {
    require_ready(now);
    const std::lock_guard lock(mutex_);
    if (child_)
        throw Error("This session is being recorded already.");
    State begun{.phase = Phase::running, .file = new_file(options_.folder, title)};
    Pipe said;
    const Pipe to_child;
    to_child.write(link + "\n");
    std::vector<std::string> words = options_.program;
    for (const std::string& word : {std::string("@/dev/stdin"), begun.file.string()})
        words.push_back(word);
    const pid_t id = spawn_program(std::move(words), to_child.out(), said.in());
    child_ = {id, said.take_out(), now};
    state_ = std::move(begun);
    link_ = link_name;
    line_ = remark_ = "";
    log::info("host", "recording", {{"file", state_.file.string()}});
    return state_.file;
}

bool RecordingProgram::stop() {
    const std::lock_guard lock(mutex_);
    if (!child_)
        return false;
    state_.phase = Phase::ending;
    kill(child_->id, SIGINT);
    return true;
}

RecordingProgram::State RecordingProgram::state(TimePoint now) {
    const std::lock_guard lock(mutex_);
    look(now);
    State shown = state_;
    if (child_)
        shown.bytes = bytes_of(shown.file);
    shown.free_bytes = free_bytes_for(options_.folder);
    return shown;
}

std::optional<RecordingProgram::End> RecordingProgram::take_end(TimePoint now) {
    const std::lock_guard lock(mutex_);
    look(now);
    return std::exchange(ended_, std::nullopt);
}

// Keeps its last line.
void RecordingProgram::listen() {
    char part[1024];
    for (ssize_t count = 0; (count = read(child_->said, part, sizeof(part))) > 0;)
        for (const char c : std::string_view(part, std::size_t(count))) {
            if (c != '\n' && line_.size() < sizeof(part))
                line_ += c;
            if (c == '\n' && !line_.empty())
                remark_ = std::exchange(line_, "");
        }
}

std::string RecordingProgram::problem_of(int status) const {
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGINT && state_.phase == Phase::ending)
        return "It was stopped before it began.";
    if (WIFSIGNALED(status))
        return "Its program was ended by signal " + std::to_string(WTERMSIG(status)) + ".";
    const std::string said = clean_text(remark_, shown_of_remark);
    return said.empty() ? "Its program ended and said nothing." : said;
}

void RecordingProgram::look(TimePoint now) {
    if (!child_)
        return;
    int status = 0;
    pid_t ended = 0;
    do
        ended = waitpid(child_->id, &status, WNOHANG);
    while (ended < 0 && errno == EINTR);
    listen();
    if (state_.phase == Phase::running)
        state_.seconds = to_seconds(now - child_->begun);
    if (ended == 0)
        return;
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    if (code != 0)
        state_.problem = problem_of(status);
    state_.phase = code == 0                 ? Phase::whole
                   : code == exit_incomplete ? Phase::incomplete
                                             : Phase::failed;
    state_.bytes = bytes_of(state_.file);
    close(child_->said);
    ended_ = {link_, state_.file.filename().string() + ": " + text_of(state_.phase)};
    log::info("host", "recording ended",
              {{"file", state_.file.string()}, {"as", text_of(state_.phase)}});
    child_.reset();
}

}  // namespace theatron::host

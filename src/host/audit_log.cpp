// SPDX-License-Identifier: Apache-2.0
#include "host/audit_log.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/error.h"
#include "base/fault.h"
#include "base/hex_text.h"
#include "base/log.h"
#include "base/thread_name.h"
#include "base/utc.h"
#include "files/file_bytes.h"
#include "files/json_text.h"

namespace theatron::host {
namespace {

int open_to_append(const std::filesystem::path& path) {
    return open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0600);
}

std::size_t size_of(int file) {
    struct stat info {};
    return fstat(file, &info) == 0 ? std::size_t(info.st_size) : 0;
}

// The last line was cut off, by a full disk or the end of the program.
bool ends_within_line(int file, std::size_t size) {
    char last = '\n';
    return size > 0 && pread(file, &last, 1, off_t(size - 1)) == 1 && last != '\n';
}

std::string left_out_line(const std::map<session::AuditEvent::What, std::size_t>& left_out) {
    std::size_t all = 0;
    nlohmann::ordered_json events;
    for (const auto& [what, count] : left_out) {
        events[session::text_of(what)] = count;
        all += count;
    }
    return nlohmann::ordered_json{
        {"time", utc_text(utc_now())}, {"left_out", all}, {"events", events}}
        .dump();
}

}  // namespace

std::string audit_line(const session::AuditEvent& event, const std::string& time,
                       const std::string& address, const std::string& session) {
    nlohmann::ordered_json line{{"time", time}, {"event", session::text_of(event.what)}};
    if (!session.empty())
        line["session"] = session;
    if (event.participant != ParticipantId{}) {
        line["participant"] = std::uint32_t(event.participant);
        line["name"] = event.name;
        line["person"] = hex_text(event.person);
        line["role"] = wire::text_of(event.role);
        line["link"] = event.link;
        line["address"] = address;
    } else if (!event.link.empty()) {
        line["role"] = wire::text_of(event.role);
        line["link"] = event.link;
    }
    if (!event.by.empty())
        line["by"] = event.by;
    if (!event.detail.empty())
        line["detail"] = event.detail;
    return line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::filesystem::path usual_audit_log(const std::filesystem::path& state_folder) {
    return state_folder / "audit.jsonl";
}

session::AuditEvent deletion_of(const std::string& name) {
    return session::event_of_session(session::AuditEvent::What::deleted, session::at_the_host,
                                     name);
}

AuditLog::AuditLog(std::filesystem::path path, std::size_t max_bytes)
    : path_(std::move(path)), max_bytes_(max_bytes) {
    files::require_own_kind(path_, "{\"time\":", "an audit log");
    file_ = open_to_append(path_);
    struct stat info {};
    if (file_ < 0 || fstat(file_, &info) != 0 || !S_ISREG(info.st_mode)) {
        const std::string why = file_ < 0 ? std::strerror(errno) : "it is no file";
        if (file_ >= 0)
            close(file_);
        throw Error("Cannot write the audit log '" + path_.string() + "': " + why +
                    "; name another file with --audit.");
    }
    thread_ = std::thread([this] {
        name_this_thread("audit");
        run();
    });
}

AuditLog::~AuditLog() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    changed_.notify_all();
    thread_.join();
    if (file_ >= 0)
        close(file_);
}

void AuditLog::add(const session::AuditEvent& event, const std::string& address,
                   const std::string& session) {
    std::string line = audit_line(event, utc_text(utc_now()), address, session);
    {
        const std::lock_guard lock(mutex_);
        if (waiting_.size() >= max_waiting_lines)
            ++left_out_[event.what];
        else
            waiting_.push_back(std::move(line));
    }
    changed_.notify_all();
}

void AuditLog::leave_out(session::AuditEvent::What what) {
    {
        const std::lock_guard lock(mutex_);
        ++left_out_[what];
    }
    changed_.notify_all();
}

void AuditLog::run() {
    bool goes_on = true;
    while (goes_on) {
        // After a fault the lines that are left are tried again, as after a full disk.
        if (!contain("audit", [&] { goes_on = write_waiting(); })) {
            is_failing_ = true;
            const std::lock_guard lock(mutex_);
            goes_on = !stopping_;
        }
    }
}

bool AuditLog::write_waiting() {
    std::unique_lock lock(mutex_);
    if (is_failing_)
        changed_.wait_for(lock, std::chrono::seconds(1), [this] { return stopping_; });
    else
        changed_.wait(lock,
                      [this] { return !waiting_.empty() || !left_out_.empty() || stopping_; });
    // More of them may follow, or a line.
    if (waiting_.empty() && !left_out_.empty() && unwritten_.empty())
        changed_.wait_for(lock, left_out_period, [this] { return !waiting_.empty() || stopping_; });
    // Lines that could not be written are tried again before more are taken.
    if (unwritten_.empty())
        for (; !waiting_.empty(); waiting_.pop_front())
            unwritten_ += waiting_.front() + "\n";
    if (!left_out_.empty() && (!is_failing_ || stopping_)) {
        unwritten_ += left_out_line(left_out_) + "\n";
        left_out_.clear();
    }
    const bool stops = stopping_, is_last = stops && waiting_.empty();
    lock.unlock();
    is_failing_ = !unwritten_.empty() && !write(unwritten_);
    note(is_failing_ ? std::strerror(errno) : "");
    if (!is_failing_)
        unwritten_.clear();
    if (stops && is_failing_)
        log::error("host", "entries of the audit log are lost",
                   {{"file", path_.string()},
                    {"entries", std::ranges::count(unwritten_, '\n') + waiting()}});
    return !is_last && !(stops && is_failing_);
}

std::string AuditLog::problem() const {
    const std::lock_guard lock(mutex_);
    return problem_;
}

std::size_t AuditLog::waiting() const {
    const std::lock_guard lock(mutex_);
    return waiting_.size();
}

// Logged once, not at each trial.
void AuditLog::note(const std::string& problem) {
    std::string before;
    {
        const std::lock_guard lock(mutex_);
        before = std::exchange(problem_, problem);
    }
    if (before.empty() && !problem.empty())
        log::error("host", "the audit log cannot be written",
                   {{"file", path_.string()}, {"why", problem}});
    if (!before.empty() && problem.empty())
        log::info("host", "the audit log is written again", {{"file", path_.string()}});
}

// All lines or none: what a full disk took of them is cut off again.
bool AuditLog::write(const std::string& lines) {
    if (!reopen())
        return false;
    if (const std::size_t size = size_of(file_); size > 0 && size + lines.size() > max_bytes_) {
        rotate();
        if (!reopen())
            return false;
    }
    const std::size_t before = size_of(file_);
    const std::string bytes = (ends_within_line(file_, before) ? "\n" : "") + lines;
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t count = ::write(file_, bytes.data() + done, bytes.size() - done);
        if (count < 0 && errno == EINTR)
            continue;
        if (count <= 0)
            break;
        done += std::size_t(count);
    }
    if (done < bytes.size() || fdatasync(file_) != 0) {
        const int why = errno;
        // If this fails, too, a line may be in the file twice.
        (void)!ftruncate(file_, off_t(before));
        errno = why;
        return false;
    }
    return true;
}

// Lines in a file that was moved away or deleted would be lost.
bool AuditLog::reopen() {
    struct stat opened {
    }, named{};
    if (file_ >= 0 && fstat(file_, &opened) == 0 && lstat(path_.c_str(), &named) == 0 &&
        opened.st_ino == named.st_ino && opened.st_dev == named.st_dev)
        return true;
    if (file_ >= 0)
        close(file_);
    file_ = open_to_append(path_);
    return file_ >= 0;
}

void AuditLog::rotate() {
    const auto numbered = [&](int number) {
        return number == 0 ? path_
                           : std::filesystem::path(path_.string() + "." + std::to_string(number));
    };
    close(std::exchange(file_, -1));
    std::error_code ignored;
    for (int number = max_old_audits - 1; number >= 0; --number)
        std::filesystem::rename(numbered(number), numbered(number + 1), ignored);
}

}  // namespace theatron::host

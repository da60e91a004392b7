// SPDX-License-Identifier: Apache-2.0
// The audit log of a host: a file of JSON lines (docs/formats/audit.md) on who came, left, was
// admitted, removed or given another role, and on which cameras were shared.
#pragma once

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <thread>

#include "base/time.h"
#include "session/audit_event.h"

namespace theatron::host {

// One line without its end. `time` as in base/utc.h; `address` may be empty. `session`: its name;
// empty for the first session of a host.
std::string audit_line(const session::AuditEvent& event, const std::string& time,
                       const std::string& address, const std::string& session = "");

// The file in a host's state folder, where no other one is named.
std::filesystem::path usual_audit_log(const std::filesystem::path& state_folder);

// The event of a further session that was ended for good, by the person at the host's machine.
session::AuditEvent deletion_of(const std::string& name);

// An own thread writes each line to the disk before it takes the next ones. A slow or full disk
// delays nobody: lines wait, those beyond max_waiting_lines are left out, and a line says how many
// of each kind, at the latest after left_out_period and at the end. A file that was moved away or
// deleted is made anew.
class AuditLog {
public:
    // A file that has become larger is renamed to NAME.1, that one to NAME.2 and so on; the
    // oldest is deleted.
    static constexpr std::size_t max_audit_bytes = 4 << 20;
    static constexpr int max_old_audits = 9;
    static constexpr std::size_t max_waiting_lines = 4096;
    static constexpr Duration left_out_period = std::chrono::seconds(10);

    // Opens the file to append, readable by its owner alone, and starts the thread. Throws Error
    // with one sentence if that cannot be done.
    explicit AuditLog(std::filesystem::path path, std::size_t max_bytes = max_audit_bytes);
    // Writes the lines that wait.
    ~AuditLog();

    // From any thread; never waits for the disk.
    void add(const session::AuditEvent& event, const std::string& address,
             const std::string& session = "");
    // Counts an event that was not added, for the line about those left out.
    void leave_out(session::AuditEvent::What what);
    // Why the newest lines could not be written, in the words of the system; empty if they were.
    // From any thread.
    std::string problem() const;

private:
    void run();
    bool write_waiting();  // false at the end
    void note(const std::string& problem);
    std::size_t waiting() const;
    bool write(const std::string& lines);
    bool reopen();
    void rotate();

    const std::filesystem::path path_;
    const std::size_t max_bytes_;
    int file_ = -1;  // the thread's, as the next two
    std::string unwritten_;
    bool is_failing_ = false;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::string> waiting_;  // guarded by mutex_, as are the next three
    std::map<session::AuditEvent::What, std::size_t> left_out_;
    std::string problem_;
    bool stopping_ = false;
    std::thread thread_;
};

}  // namespace theatron::host

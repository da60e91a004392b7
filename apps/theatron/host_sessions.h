// SPDX-License-Identifier: Apache-2.0
// The sessions of a running 'theatron host': those of its command line, and further ones that
// 'theatron session' creates and ends meanwhile (host/session_folder.h).
#pragma once

#include <future>
#include <memory>
#include <string>
#include <vector>

#include "base/time.h"
#include "host/host.h"
#include "host/session_folder.h"
#include "session_flags.h"

namespace theatron::app {

// All functions on one thread.
class HostSessions {
public:
    // A session that could not be opened is tried again after this time.
    static constexpr Duration retry_interval = std::chrono::seconds(10);

    // Opens the sessions of the command line. Throws Error with one sentence if that cannot be
    // done.
    HostSessions(const host::HostOptions& options, const SessionFlags& first,
                 const std::vector<SessionFlags>& further);
    ~HostSessions();
    HostSessions(const HostSessions&) = delete;
    HostSessions& operator=(const HostSessions&) = delete;

    host::Host& first() { return *first_; }
    // The name of a session in lines of the log; empty for the first one.
    std::string name_in_log(const std::string& name) const {
        return name == first_name_ ? "" : name;
    }
    // Those that are open, with their names; the first one first.
    std::vector<std::pair<std::string, host::Host*>> open() const;

    // Follows all files: links, filters, certificates, sessions. Call it twenty times a second.
    void follow();

    // As host::to_json().
    host::PortFigures figures() const;
    // A sentence about rooms that could not be saved; empty if all were.
    std::string room_problem() const;

private:
    struct Opened {
        std::unique_ptr<host::Host> host;
        std::string problem;  // a sentence, if there is no host
    };
    struct Further {
        SessionFlags flags;
        bool is_kept = false;   // not of the command line
        bool was_open = false;  // now or in an earlier run: it has links
        Opened opened;
        TimePoint next_try;
        // While it is opened, on a thread of its own: cameras may take long, and no session waits
        // for those of another one.
        std::future<Opened> opening;
    };

    void follow_folders();
    void take_kept(const host::KeptSession& kept);
    void open_due();
    void take_opened();
    // For good.
    void end(const std::string& name);
    std::vector<host::ClosedSession> closed() const;
    void tell();
    Further* find(const std::string& name);
    static Opened open(const host::Host& first, const std::filesystem::path& state,
                       const SessionFlags& flags);

    std::filesystem::path state_;
    std::string first_name_;
    std::unique_ptr<host::Host> first_;
    std::vector<std::unique_ptr<Further>> further_;
    TimePoint next_look_;
    std::vector<host::ToldSession> told_;
    std::string folder_problem_;  // that was logged
};

// All parts that are given for a camera make its region. Throws Error.
void draw_regions(host::Host& host, const std::vector<std::string>& texts);

}  // namespace theatron::app

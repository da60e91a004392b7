// SPDX-License-Identifier: Apache-2.0
// The network port of a host: one address, certificate and thread for all its sessions, and the
// pages that it serves. Each session comes and goes by its SessionPort (session_port.h).
#pragma once

#include <atomic>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/line_limit.h"
#include "host/audit_log.h"
#include "host/host_figures.h"
#include "host/kept_certificate.h"
#include "host/late_page.h"
#include "host/line_probe.h"
#include "host/port_options.h"
#include "host/session_switch.h"
#include "net/server.h"
#include "send/workers.h"

namespace theatron::host {

// The first session opens it in steps, in this order, so that cameras that take long and files that
// cannot be used come before people can connect. For further sessions these steps do nothing.
// All functions that open throw Error with one sentence.
class HostPort {
public:
    explicit HostPort(PortOptions options);
    // All sessions have left.
    ~HostPort();
    HostPort(const HostPort&) = delete;
    HostPort& operator=(const HostPort&) = delete;

    void require_free() const;  // nothing once it is open
    // `state_folder`: that of the host's certificate and audit log.
    void open_certificates(const std::filesystem::path& state_folder);
    const std::filesystem::path& state_folder() const { return state_folder_; }  // then
    AuditLog* open_audit();  // null: there is to be none
    void open_page();
    // Listens. Nobody is served before a session begins.
    void open();

    // From any thread, once it is open.
    net::Link link() const;  // without a token
    // The same for a program on this machine, past any proxy.
    net::Link own_link() const;
    std::uint16_t number() const { return server_->port(); }
    std::vector<HostFigures::Certificate> certificates() const;
    std::string page_problem() { return page_->current()->problem(); }
    // The sessions that are not open now, but will be.
    void set_closed(std::vector<ClosedSession> closed) { sessions_.set_closed(std::move(closed)); }
    std::uint64_t turned_away() const { return turned_away_; }
    // The threads of all lanes.
    send::Workers& workers() { return workers_; }

    // Used by the owner of the host.
    void follow_certificates();

private:
    friend class SessionPort;

    net::Server::Handler handler();
    net::HttpAnswer answer(const net::HttpRequest& request);
    std::optional<net::HttpAnswer> take_body(const net::HttpRequest& request, std::uint64_t bytes);
    std::optional<net::HttpAnswer> refuse_line(const net::HttpRequest& request) const;
    void note_link();
    void tell_address(const net::Link& link) const;
    const net::Certificate& linked_certificate() const;
    void note_certificates();
    void serve();
    // Runs `work` on the server's thread and waits for it. The thread runs.
    void run_there(const std::function<void()>& work);

    const PortOptions options_;
    std::filesystem::path state_folder_;
    // Used by the owner of the host.
    std::optional<KeptCertificate> certificate_, proxy_certificate_;
    std::map<std::string, std::string> told_of_certificates_;  // problems that were logged
    net::Access access_;
    std::unique_ptr<AuditLog> audit_;
    std::optional<LatePage> page_;
    mutable std::mutex mutex_;
    net::Link link_;                                      // guarded by mutex_, as is the next
    std::vector<HostFigures::Certificate> certificates_;  // as they are now
    LineLimit strangers_;                                 // of log lines; the door's thread
    LineProbe line_;                                      // the door's thread
    std::atomic<std::uint64_t> turned_away_ = 0;
    send::Workers workers_;
    SessionSwitch sessions_;
    std::unique_ptr<net::Server> server_;
    // Sessions that begin and leave, one at a time.
    std::mutex changing_;
    std::size_t present_ = 0;  // guarded by changing_, as are the next two
    bool is_over_ = false;     // the last session has left
    std::thread thread_;       // of the server
};

}  // namespace theatron::host

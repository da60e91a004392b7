// SPDX-License-Identifier: Apache-2.0
// A session's lines in the audit log of its host.
#pragma once

#include <string>
#include <utility>

#include "host/audit_log.h"

namespace theatron::host {

class SessionAudit {
public:
    // `session`: its name in each line; empty for the first session of a host. `log` outlives this.
    SessionAudit(AuditLog& log, std::string session) : log_(log), session_(std::move(session)) {}

    // As in AuditLog.
    void add(const session::AuditEvent& event, const std::string& address) {
        log_.add(event, address, session_);
    }
    void leave_out(session::AuditEvent::What what) { log_.leave_out(what); }
    std::string problem() const { return log_.problem(); }

private:
    AuditLog& log_;
    const std::string session_;
};

}  // namespace theatron::host

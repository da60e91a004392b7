// SPDX-License-Identifier: Apache-2.0
// How people reach a host: the options of its network port, which all its sessions share.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/closed_session.h"
#include "net/link.h"

namespace theatron::host {

struct PortOptions {
    net::Endpoint listen;
    std::string link_host;        // the link's host; empty: this machine's address
    std::filesystem::path audit;  // empty: audit.jsonl in the state folder
    bool is_audited = true;
    // Files of an organisation's certificate, for browsers (net::read_certificate); empty: the
    // host's own one.
    std::filesystem::path certificate, key;
    bool insists_on_https = false;  // answers carry Strict-Transport-Security; needs `certificate`
    // "NAME" or "NAME:PORT" (net::parse_public_name), of links instead of `link_host`; requests for
    // other names are refused. Empty: every name is right.
    std::string public_name;
    std::vector<std::string> proxies;         // trusted ones (net::Proxies)
    std::filesystem::path proxy_certificate;  // that they show, for links; needed with `proxies`
    std::filesystem::path page;               // the browser client (host/page.h); empty: none
    // Further sessions that will be open: until then their people are turned back.
    std::vector<ClosedSession> closed;
};

}  // namespace theatron::host

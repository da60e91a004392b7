// SPDX-License-Identifier: Apache-2.0
// The options of 'theatron host', on its command line and in its configuration file.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "host/host.h"
#include "session_flags.h"

namespace theatron::app {

struct HostFlags {
    SessionFlags first;
    host::PortOptions port;
    std::string listen = "0.0.0.0:4400";
    std::string state;
    std::string token_file;
    std::string summary;
    std::string audit;
    std::string certificate, key, proxy_certificate;
    std::string config;              // file
    std::vector<std::string> given;  // the command line, without the words of that file
    double seconds = 0;
    bool json = false;
    bool logs_json = false;
    bool prints_links = false;
    bool only_checks = false;  // the configuration
    // The words of each further session.
    std::vector<std::vector<std::string>> further;
};

void add_host_options(CLI::App& command, HostFlags& flags);

// Those of the host and its first session. Throws Error with one sentence about an option.
host::HostOptions host_options(const HostFlags& flags);

}  // namespace theatron::app

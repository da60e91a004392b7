// SPDX-License-Identifier: Apache-2.0
// The configuration file of 'theatron host' (base/config_text.h): its lines become words of the
// command line, so that every option can stand there and means the same.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/config_text.h"
#include "base/error.h"

namespace theatron::app {

// A configuration that cannot be used before somebody changes it.
class ConfigError : public Error {
public:
    using Error::Error;
};

// The exit code of a host with such a configuration: that of sysexits.h, which service managers
// know. The unit does not start it again (packaging/theatron-host@.service).
inline constexpr int config_exit_code = 78;

struct HostConfig {
    std::vector<std::string> words;  // "--camera", "k4a:0", ...
    std::vector<ConfigMistake> mistakes;
};

// `given`: words of the command line. A key whose option is among them is left out.
// `is_public`: others may read the file, so no token may stand in it.
HostConfig host_config(std::string_view text, const std::vector<std::string>& given,
                       bool is_public);

// The words of a command line 'theatron host ...', followed by those of the file that its --config
// names, if it does. Throws ConfigError with all mistakes of the file, a line each.
std::vector<std::string> with_config(const std::vector<std::string>& arguments);

}  // namespace theatron::app

// SPDX-License-Identifier: Apache-2.0
// --camera, the same in every command.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace theatron::cli {

// Takes one specification each time it is given, so that what follows on the
// command line stays what it is.
inline CLI::Option* add_camera_option(CLI::App& command, std::vector<std::string>& cameras,
                                      const char* help =
                                          "A camera, kind:value,key=value; repeat "
                                          "for more") {
    return command.add_option("--camera", cameras, help)->allow_extra_args(false);
}

}  // namespace theatron::cli

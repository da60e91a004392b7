// SPDX-License-Identifier: Apache-2.0
// Cameras that a command sends to a session.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "publish/camera_publisher.h"

namespace theatron::app {

// Opens the cameras and chooses their filters, as `theatron host` does for its own: `filters` as
// its --filter, `places` a file or empty. Throws Error with one sentence.
std::unique_ptr<publish::CameraPublisher> open_published(const std::vector<std::string>& cameras,
                                                         const std::vector<std::string>& filters,
                                                         const std::string& places,
                                                         const publish::Sharing& sharing);

// --share: sources that are shown as screens in the room.
void add_share_option(CLI::App& command, std::vector<std::string>& sources);
// `cameras`, then those of the shared sources.
std::vector<std::string> with_shared(std::vector<std::string> cameras,
                                     const std::vector<std::string>& sources);

}  // namespace theatron::app

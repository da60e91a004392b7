// SPDX-License-Identifier: Apache-2.0
// Cameras that a command sends to a session.
#pragma once

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

}  // namespace theatron::app

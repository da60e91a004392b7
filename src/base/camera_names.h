// SPDX-License-Identifier: Apache-2.0
// Cameras as people name them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace theatron {

// Index of the camera that has this name or, if none has, this number. Throws Error if there is no
// such camera.
std::size_t find_camera(const std::string& number_or_name, const std::vector<std::string>& names);

}  // namespace theatron

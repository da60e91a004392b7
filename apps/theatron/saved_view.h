// SPDX-License-Identifier: Apache-2.0
// Files of what a window shows.
#pragma once

#include <filesystem>
#include <string>

#include "base/bytes.h"

namespace theatron::app {

// Writes the bytes into a new file in this folder, whose name has the time in UTC and this
// extension (".png"). No file is replaced. Returns a sentence for the person: the file's path, or
// what is wrong.
std::string save_view(const std::filesystem::path& folder, const std::string& extension,
                      ByteView bytes);

}  // namespace theatron::app

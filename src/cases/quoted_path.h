// SPDX-License-Identifier: Apache-2.0
// The name of a file or folder in a sentence.
#pragma once

#include <filesystem>
#include <string>

#include "base/outside_text.h"

namespace theatron::cases {

// Names of files come from outside.
inline std::string quoted_path(const std::filesystem::path& path) {
    return "'" + clean_text(path.string(), 300) + "'";
}

}  // namespace theatron::cases

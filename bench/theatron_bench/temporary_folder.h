// SPDX-License-Identifier: Apache-2.0
// A folder for files between this program and its children, removed at the end.
#pragma once

#include <filesystem>

namespace theatron::bench {

class TemporaryFolder {
public:
    TemporaryFolder();  // throws Error
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::filesystem::path path;
};

}  // namespace theatron::bench

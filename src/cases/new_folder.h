// SPDX-License-Identifier: Apache-2.0
// A folder that comes into being whole or not at all.
#pragma once

#include <filesystem>

namespace theatron::cases {

// It is made beside its place under a hidden name of its own, gets its name by keep(), and vanishes
// without it. Nothing that was there before is changed. Throws Error.
class NewFolder {
public:
    // `folder` must not exist; folders above it are made.
    explicit NewFolder(const std::filesystem::path& folder);
    ~NewFolder();
    NewFolder(const NewFolder&) = delete;
    NewFolder& operator=(const NewFolder&) = delete;

    const std::filesystem::path& path() const { return making_; }
    // Throws if something of this name has come into being meanwhile.
    void keep();

private:
    std::filesystem::path folder_, making_;
};

// Throws Error if NewFolder could not be made there, for work that takes long before.
void require_new_folder(const std::filesystem::path& folder);

}  // namespace theatron::cases

// SPDX-License-Identifier: Apache-2.0
// A regular file, open for reading: by a process that is handed its descriptor.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace theatron::capture {

class ReadableFile {
public:
    // Throws Error with one sentence.
    explicit ReadableFile(const std::filesystem::path& path);
    ~ReadableFile();
    ReadableFile(const ReadableFile&) = delete;

    int descriptor() const { return descriptor_; }
    std::uint64_t bytes() const { return bytes_; }  // when it was opened

private:
    int descriptor_;
    std::uint64_t bytes_ = 0;
};

// The path within a sentence.
std::string quoted(const std::filesystem::path& path);

}  // namespace theatron::capture

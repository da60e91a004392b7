// SPDX-License-Identifier: Apache-2.0
// The one descriptor that the reader of a live source gets: opened here, in the parent.
#pragma once

#include <filesystem>
#include <string>
#include <utility>

namespace theatron::capture {

class SourceInput {
public:
    explicit SourceInput(int descriptor) : descriptor_(descriptor) {}
    ~SourceInput();
    SourceInput(SourceInput&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
    SourceInput(const SourceInput&) = delete;

    int descriptor() const { return descriptor_; }

private:
    int descriptor_;
};

// A TCP connection within 5 s to the first address of the host that answers. `subject` is the
// source within a sentence. Throws Error.
SourceInput connect_to(const std::string& host, int port, const std::string& subject);

// Throws Error if there is no such device, or it is none for video.
SourceInput open_video_device(const std::filesystem::path& path);

}  // namespace theatron::capture

// SPDX-License-Identifier: Apache-2.0
// The tracks of an Azure Kinect recording (Matroska, read through libavformat):
// depth as 16-bit big-endian values, colour as JPEG, the factory calibration as
// an attachment. Pictures come out as they lie in the file; nothing is decoded.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "base/bytes.h"
#include "base/time.h"
#include "image/view.h"

namespace theatron::capture {

// Whether a Matroska file of `file_bytes` bytes is shorter than its beginning
// promises. False where that does not say. Safe for untrusted input.
bool is_cut_off(ByteView beginning, std::uint64_t file_bytes);

class MkvFile {
public:
    struct Packet {
        enum class Track { depth, color };
        Track track = Track::depth;
        Duration time{};
        Bytes bytes;
    };

    // Throws Error for what is no Matroska file or has no depth track.
    explicit MkvFile(const std::filesystem::path& path);
    ~MkvFile();
    MkvFile(MkvFile&&) noexcept;
    MkvFile& operator=(MkvFile&&) noexcept;

    Size depth_size() const;
    Size color_size() const;  // 0 x 0 without a JPEG colour track
    // What the colour track holds instead, or empty.
    const std::string& other_color() const;
    double frames_per_second() const;  // 0 if the file does not say
    // The factory calibration's text; empty if there is none.
    const std::string& calibration() const;

    // Whether the file lacks its end, as after a full disk or an aborted copy.
    bool is_cut_off() const;

    // The next depth or colour picture, nothing at the end.
    std::optional<Packet> read();

private:
    struct Library;
    std::unique_ptr<Library> library_;
};

}  // namespace theatron::capture

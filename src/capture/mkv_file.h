// SPDX-License-Identifier: Apache-2.0
// The pictures of an Azure Kinect recording, read by a process in a sandbox (mkv_reader.h): a file
// that does harm there is a sentence here.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "base/bytes.h"
#include "base/time.h"
#include "capture/mkv_answer.h"
#include "sandbox/limits.h"

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
        Bytes bytes;  // empty: more than any camera's picture has
    };

    // Functions throw Error: for what is no Matroska file or has no depth track, and for what made
    // its reader end.
    explicit MkvFile(const std::filesystem::path& path, const sandbox::Limits& limits = {});
    ~MkvFile();

    Size depth_size() const { return description_.depth; }
    Size color_size() const { return description_.color; }  // 0 x 0 without a JPEG colour track
    // What the colour track holds instead, or empty.
    const std::string& other_color() const { return description_.other_color; }
    // 0 if the file does not say.
    double frames_per_second() const { return description_.frames_per_second; }
    // The factory calibration's text; empty if there is none.
    const std::string& calibration() const { return description_.calibration; }

    // Whether the file lacks its end, as after a full disk or an aborted copy.
    bool is_cut_off() const { return cut_off_; }

    // The next depth or colour picture, nothing at the end.
    std::optional<Packet> read();
    // Back to the first one.
    void rewind();

private:
    struct Process;
    MkvDescription open();

    std::filesystem::path path_;
    std::unique_ptr<Process> process_;
    bool cut_off_ = false;
    MkvDescription description_;
};

}  // namespace theatron::capture
